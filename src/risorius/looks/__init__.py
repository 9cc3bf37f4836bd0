"""The drawn parts of a head with their colours: hair, brows, lashes, garment and muscles.

Renderers, files and the studio's page share it. The package `render` says how a picture of it is drawn.
"""
