"""Punctuators: movements at pauses, by rules and marks (paper B, section 2.1)."""

from .registry import register
from .ruled import marked_and_ruled

# The rules' movements last as long as their pause; the timing is that of marked ones.
register(
    "punctuators",
    30.0,
    marked_and_ruled,
    timing=(0.1, 0.2, "minimum_jerk"),
    rules=True,
    marks=True,
    exclusive=True,
)
