"""The meanings of the words of APML and FML-APML (`data/apml.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache

from ..core.action_units import resolve_targets
from ..core.directions import Emphasis
from ..core.speech.tobi import boundary_tone, pitch_accent
from ..core.units import BehaviourSeconds, Share
from ..errors import ParameterError, unknown
from ..reading.frozen import FrozenDict
from .emotions import emotion
from .load import load
from .markup import markup_table


@dataclass(frozen=True, slots=True)
class Affect:
    """The emotion that shows an affect, and its share of the affect's intensity."""

    emotion: str
    share: Share

    def __post_init__(self) -> None:
        emotion(self.emotion)


@dataclass(frozen=True, slots=True)
class Act:
    """The display of a communicative act: action units while it lasts, and a gesture of the head first."""

    targets: Mapping[str, float] = field(default_factory=FrozenDict)
    gesture: str | None = None

    def __post_init__(self) -> None:
        resolve_targets(self.targets)
        gestures = markup_table().head
        if self.gesture is not None and self.gesture not in gestures:
            raise ParameterError(unknown("gesture", self.gesture, gestures))


@dataclass(frozen=True, slots=True)
class UsualAct:
    """The values of an act that gives none itself."""

    seconds: BehaviourSeconds
    intensity: Share


@dataclass(frozen=True, slots=True)
class ApmlTable:
    """Tones, levels, languages and turns by their names in APML; affects; acts by element and type."""

    accent: Mapping[str, str]
    boundary: Mapping[str, str]
    emphasis: Mapping[str, Emphasis]
    language: Mapping[str, str]
    turn: Mapping[str, str]
    affect: Mapping[str, Affect]
    act: Mapping[str, Mapping[str, Act]]
    usual: UsualAct

    def __post_init__(self) -> None:
        for label in self.accent.values():
            pitch_accent(label)
        for label in self.boundary.values():
            boundary_tone(label)
        for turn in self.turn.values():
            if turn not in markup_table().turn:
                raise ParameterError(unknown("turn", turn, markup_table().turn))


@cache
def apml_table() -> ApmlTable:
    """Return the package's table."""
    return load(ApmlTable, "apml.toml")
