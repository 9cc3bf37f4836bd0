"""What is drawn of a head: its parts with their colours, hair, brows, lashes, garment and muscles.

Renderers, and the files and pages that show a head, take it from here; how a picture is drawn is `render`'s.
"""
