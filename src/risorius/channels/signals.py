"""Signals: movements at accents and questions, by rules and marks (paper B, section 2.1)."""

from .registry import register
from .ruled import marked_and_ruled

register(
    "signals",
    40.0,
    marked_and_ruled,
    timing=(0.1, 0.2, "minimum_jerk"),
    rules=True,
    marks=True,
    exclusive=True,
)
