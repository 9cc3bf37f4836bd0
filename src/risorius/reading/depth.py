"""The limit of nested data, one for TOML, JSON and XML.

Readers recurse as deep as the data, and Python allows a thousand nested calls.
"""

from __future__ import annotations

MAX_DEPTH = 32
"""Levels of tables, lists, objects or elements in one another, in every format that has them."""
TOO_DEEP = f"is nested too deeply; expected at most {MAX_DEPTH} levels"


def is_too_deep(data: object) -> bool:
    """Whether parsed data has more than `MAX_DEPTH` levels."""
    level = [data]
    for _ in range(MAX_DEPTH + 1):
        level = [
            item
            for outer in level
            if isinstance(outer, dict | list)
            for item in (outer.values() if isinstance(outer, dict) else outer)
            if isinstance(item, dict | list)
        ]
        if not level:
            return False
    return True
