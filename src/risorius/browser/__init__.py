"""What a browser runs: pages of the studio, of live faces and of `.html` files. No other Python is here."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parent
"""The folder of the pages and their modules."""
