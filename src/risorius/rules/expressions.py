"""Felt and posed expressions: two rows of one table (`expressions.toml`; paper A, section 7)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Annotated

from ..core.channels import CHANNELS
from ..core.choices import EXPRESSIONS
from ..core.functions import FunctionName
from ..errors import ParameterError, unknown
from ..reading.frozen import FrozenDict
from ..reading.hints import Range
from .emotions import Emotion, PriorityLevel
from .load import load
from .modulation import Modulation

TimeFactor = Annotated[float, Range(0.05, 5.0)]
FELT, POSED = EXPRESSIONS


@dataclass(frozen=True, slots=True)
class ExpressionKind:
    """Factors on an emotion's onset and offset, its onset function (None: its own), and whether it modulates
    the speaker's other movements.
    """

    onset: TimeFactor
    offset: TimeFactor
    modulates: bool
    function: FunctionName | None = None

    def of(self, emotion: Emotion) -> Emotion:
        """Return an emotion that comes and goes so."""
        return replace(
            emotion,
            onset=round(emotion.onset * self.onset, 6),
            offset=round(emotion.offset * self.offset, 6),
            function=self.function or emotion.function,
            modulation=emotion.modulation if self.modulates else Modulation(),
        )


@dataclass(frozen=True, slots=True)
class Overwhelmed:
    """The priority of an emotion of full intensity that overwhelms the speaker; the lips have 60."""

    priority: PriorityLevel


@dataclass(frozen=True, slots=True)
class _Table:
    felt: ExpressionKind
    posed: ExpressionKind
    overwhelmed: Overwhelmed


@cache
def _table() -> _Table:
    return load(_Table, "expressions.toml")


def overwhelming(emotions: Mapping[str, Emotion]) -> Mapping[str, Emotion]:
    """Return emotions that outdo speech at full intensity (paper A, section 1: "too happy to speak").

    At lower ones they keep the priorities of their own.
    """
    level = _table().overwhelmed.priority
    own = {name: e.priority or (CHANNELS.get("emotion").priority,) * 5 for name, e in emotions.items()}
    return {
        name: replace(e, priority=(*own[name][:-1], max(own[name][-1], level)))
        for name, e in emotions.items()
    }


@cache
def expressions() -> Mapping[str, ExpressionKind]:
    """Return the rows of the table by name."""
    return FrozenDict({FELT: _table().felt, POSED: _table().posed})


def expressed(emotions: Mapping[str, Emotion], name: str) -> Mapping[str, Emotion]:
    """Return emotions that come and go as the expression `name` does; ParameterError for an unknown one."""
    if name not in expressions():
        raise ParameterError(unknown("expression", name, expressions()))
    if name == FELT:
        return emotions
    return {key: expressions()[name].of(emotion) for key, emotion in emotions.items()}
