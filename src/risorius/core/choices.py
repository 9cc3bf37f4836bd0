"""Names, ranges and defaults of what users choose, as far as several packages need them.

Nothing here loads numpy: the command line's help waits for it. What a name stands for is registered, or
stands in a table, where it is carried out.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Generic, NamedTuple, TypeVar

T = TypeVar("T")


class NumberRange(NamedTuple):
    """The least and the greatest number that may be chosen."""

    low: float
    high: float

    def allows(self, number: float) -> bool:
        """Tell whether a number lies in the range."""
        return self.low <= number <= self.high


class BlendDefault(NamedTuple, Generic[T]):
    """A default of how movements are combined: of a score that does not say, and of one that is planned."""

    score: T
    planned: T


RATES = NumberRange(80, 440)
"""Words per minute."""
SILENCES = NumberRange(0.0, 60.0)
"""Seconds of silence before and after what is spoken."""
LEAD, TAIL = 0.5, 0.7
"""Seconds of silence before and after plain text."""

# A score that does not say otherwise is combined as in paper A. What is planned for a script has curves
# without corners, and conflicts that are resolved gradually.
CONFLICT = BlendDefault(score="inhibit", planned="graded")
CONTACT = BlendDefault(score=True, planned=True)
LIPS = BlendDefault(score="effort", planned="effort")
ROUNDING = BlendDefault(score=0.0, planned=0.02)

CONFLICT_POLICIES = ("inhibit", "graded", "attenuate", "sum")
ONSET_FUNCTIONS = ("exponential", "linear", "minimum_jerk", "saccade")
LIP_MODELS = ("effort", "dominance", "lookahead")
BLINK_MODELS = ("natural", "itti", "pelachaud", "none")
MANNERS = ("plain", "whisper", "murmur", "shout")
EXPRESSIONS = ("felt", "posed")
EXPRESSION_NAMES: Mapping[str, str] = MappingProxyType(
    {
        "vrm0": "VRM's presets, for avatars of VRM 0",
        "vrm1": "for those of VRM 1",
        "arkit": "the 52 shapes, for Perfect Sync",
        "ARKit": "these with capitals",
    }
)
"""The sets of expressions of a VRM avatar, of which one is sent or written."""
DYNAMICS: Mapping[str, str] = MappingProxyType(
    {"springs": "with inertia", "biphasic": "stiffer under strain", "static": ""}
)
"""The models of the moving skin."""
MUSCLE_MODES: Mapping[str, str] = MappingProxyType(
    {
        "fields": "calibrated on sculpts and scans",
        "lines": "forces of six types along the lines and within the zones of the head's muscles.toml",
    }
)
"""The models of the muscles."""
