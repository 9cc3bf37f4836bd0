"""Channels that show nothing but their rules and marks (paper B, section 2.1).

Signals move at accents and questions, punctuators at pauses, regulators when speaker and listener take turns.
"""

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
# The punctuators' rules give movements that last as long as their pause; this is the timing of marked ones.
register(
    "punctuators",
    30.0,
    marked_and_ruled,
    timing=(0.1, 0.2, "minimum_jerk"),
    rules=True,
    marks=True,
    exclusive=True,
)
register("regulators", 25.0, marked_and_ruled, timing=(0.2, 0.3, "minimum_jerk"), rules=True, marks=True)
