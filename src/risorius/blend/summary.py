"""How every channel fared over a whole clip."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..core.performance import frame_times
from ..core.score import Score
from .concatenate import SIGNED
from .limits import LIPS
from .plan import Moment, Plan

_LEAST = 1e-9


@dataclass(slots=True)
class Tally:
    """How a channel fared in a clip, in frames × parameters.

    `active`: it asked for something; `won`: it showed; `inhibited`: nothing was left of it; `limited`: less
    than it asked for was left.
    """

    active: int = 0
    won: int = 0
    inhibited: int = 0
    limited: int = 0


def summarize(source: Score | Plan, fps: Fraction) -> dict[str, Tally]:
    """Return for each channel how often it won, was inhibited or limited, over all frames and muscles."""
    plan = source if isinstance(source, Plan) else Plan(source)
    tallies = {channel.name: Tally() for channel in plan.channels}
    for times in plan.batches(frame_times(plan.score.duration, fps)):
        moment = Moment(plan, times)
        for name in plan.moving:
            if name not in SIGNED:
                _count(moment, name, tallies)
    return tallies


def _count(moment: Moment, name: str, tallies: dict[str, Tally]) -> None:
    own, shown = moment.own(name), moment.value(name)
    for channel in moment.plan.channels:
        if name not in channel.curves:
            continue
        _, asked = channel.sample(name, moment.times)
        index, given = moment.resolved(channel, name)
        if channel.name != LIPS:
            given = moment.bounded(channel, name, index, given, own)
        tally, active = tallies[channel.name], asked > _LEAST
        tally.active += int(active.sum())
        tally.won += int((active & (given > _LEAST) & (given >= shown[index] - _LEAST)).sum())
        tally.inhibited += int((active & (given <= _LEAST)).sum())
        tally.limited += int((active & (given > _LEAST) & (given < asked - _LEAST)).sum())
