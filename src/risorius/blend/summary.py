"""Counts over a whole clip: how often every channel showed, was inhibited or was limited."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..core.performance import frame_times
from ..core.score import Score
from .concatenate import SIGNED
from .plan import Plan, PlanSample

_LEAST = 1e-9


@dataclass(slots=True)
class Tally:
    """The counts of a channel in a clip, in frames × parameters.

    `active`: it requested something; `won`: it showed; `inhibited`: nothing of it was applied; `limited`:
    less was applied than requested.
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
        sample = PlanSample(plan, times)
        for name in plan.moving:
            if name not in SIGNED:
                _count(sample, name, tallies)
    return tallies


def _count(sample: PlanSample, name: str, tallies: dict[str, Tally]) -> None:
    shown = sample.value(name)
    for entry in sample.ledger(name).entries():
        tally, active, applied = tallies[entry.channel.name], entry.requested > _LEAST, entry.applied
        tally.active += int(active.sum())
        shows = applied >= shown[entry.index] - _LEAST
        tally.won += int((active & (applied > _LEAST) & (shows | entry.channel.on_top)).sum())
        tally.inhibited += int((active & (applied <= _LEAST)).sum())
        tally.limited += int((active & (applied > _LEAST) & (applied < entry.requested - _LEAST)).sum())
