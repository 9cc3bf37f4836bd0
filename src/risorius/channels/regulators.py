"""Regulators: how speaker and listener share the turns, by rules and marks (paper B, section 2.1)."""

from .registry import register
from .ruled import marked_and_ruled

register("regulators", 25.0, marked_and_ruled, timing=(0.2, 0.3, "minimum_jerk"), rules=True, marks=True)
