"""Movements of one layer follow one another: paper A, section 5.2, with its errors mended.

DESIGN, section 3, "Within a channel", is the contract; facts: science/errata, A1 and A2, the reasons.
The movements of a layer become steps in the order in which they hold the layer (a movement that was
interrupted holds it twice), and each step a stroke in every parameter that it moves or lets go.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ..core.functions import DEFAULT_FUNCTION
from ..core.movement import CHANNEL_PRIORITY, Movement, fitted
from ..core.parameters import NEUTRAL, PARAMETERS
from .levels import PriorityClaim
from .strokes import Stroke, StrokeCurve, Strokes, last_time, value_at

NEUTRALS: dict[str, float] = {p.name: float(n) for p, n in zip(PARAMETERS, NEUTRAL, strict=True)}
SIGNED = frozenset(p.name for p in PARAMETERS if p.signed or p.neutral != 0.0)
"""Parameters worked as signed deviations from their neutral: degrees, and the distance looked at."""


@dataclass(slots=True)
class Step:
    """One movement's hold on its layer, with the onset and offset that it really gets. Seconds.

    `until`: when all that it left has come to rest, or the next step has taken over.
    """

    movement: Movement
    start: float
    end: float
    onset: float
    offset: float
    function: str
    targets: dict[str, float]
    until: float

    @property
    def release(self) -> float:
        """When the offset begins."""
        return self.end - self.offset

    def claim(self) -> PriorityClaim:
        """Return the priority that it claims for its channel."""
        m = self.movement
        own = CHANNEL_PRIORITY[m.channel] if m.priority is None else m.priority
        after = own if m.release_priority is None else m.release_priority
        return PriorityClaim(self.start, self.release, self.until, own, after)


@dataclass(slots=True)
class Layer:
    """The movements of one layer, concatenated: steps in order and a curve for each parameter."""

    steps: list[Step]
    curves: dict[str, StrokeCurve]


def concatenate(movements: Iterable[Movement], function: str | None = None) -> Layer:
    """Return the concatenation of one layer's movements, no two of which start together.

    `function` replaces the movements' own onset functions where not None. Values of parameters with a
    neutral other than 0 become deviations from it.
    """
    steps = sequence(movements, function)
    return Layer(steps, _curves(steps))


def sequence(movements: Iterable[Movement], function: str | None = None) -> list[Step]:
    """Return the steps of a layer in order: movements, and those resumed after one nested within them."""
    steps: list[Step] = []
    interrupted: list[Step] = []
    for movement in sorted(movements, key=lambda m: m.start):
        _resume(steps, interrupted, movement.start)
        step = _step(movement, movement.start, function)
        if steps and step.end <= steps[-1].end:
            interrupted.append(steps[-1])
        while interrupted and interrupted[-1].end < step.end:
            interrupted.pop()
        steps.append(step)
    _resume(steps, interrupted, math.inf)
    return steps


def _resume(steps: list[Step], interrupted: list[Step], before: float) -> None:
    """Resume interrupted movements where the one that interrupts lets go, if that is before `before`."""
    while interrupted and steps[-1].release < before:
        at, outer = steps[-1].release, interrupted.pop()
        if outer.end - at > outer.offset:
            steps.append(_step(outer.movement, at, outer.function))


def _step(movement: Movement, start: float, function: str | None) -> Step:
    """A movement held from `start` on; an onset and offset too long for it shrink in proportion."""
    onset, offset = fitted(movement.onset, movement.offset, movement.end - start)
    targets = {name: value - NEUTRALS[name] for name, value in movement.targets.items()}
    shape = function or movement.function
    return Step(movement, start, movement.end, onset, offset, shape, targets, movement.end)


def _curves(steps: list[Step]) -> dict[str, StrokeCurve]:
    done: dict[str, Strokes] = defaultdict(Strokes)
    live: dict[str, Stroke] = {}
    before: Step | None = None
    for step in steps:
        left = _take_over(live, step.start)
        _finish(live, done)
        if before is not None:
            before.until = min(before.until, step.start)
        for name in {**left, **step.targets}:
            level, movement = left.get(name, (0.0, step.movement))
            if name in step.targets:
                movement = step.movement
            elif level == 0.0:
                continue
            stroke = live[name] = _stroke(name, level, step, movement, before)
            step.until = max(step.until, stroke.last)
        before = step
    _finish(live, done)
    return _shared(done)


def _shared(done: Mapping[str, Strokes]) -> dict[str, StrokeCurve]:
    """Return the curves of strokes by parameter; those of both sides are one, mostly."""
    known: dict[object, StrokeCurve] = {}
    curves = {}
    for name, strokes in done.items():
        key = strokes.key()
        if key not in known:
            known[key] = StrokeCurve(strokes)
        curves[name] = known[key]
    return curves


def _finish(live: dict[str, Stroke], done: dict[str, Strokes]) -> None:
    """Put away the live strokes, which nothing changes any more."""
    for name, stroke in live.items():
        done[name].append(stroke)
    live.clear()


def _take_over(live: dict[str, Stroke], time: float) -> dict[str, tuple[float, Movement]]:
    """Stop all strokes that are not yet at rest and return the levels they leave, and whose they are."""
    left = {}
    for name, stroke in live.items():
        if stroke.last > time:
            left[name] = (value_at(stroke, time), stroke.movement)
            stroke.stop = time
    return left


def _stroke(name: str, level: float, step: Step, movement: Movement, before: Step | None) -> Stroke:
    """What `step` makes of a parameter that stands at `level` when it starts."""
    target = step.targets.get(name, 0.0)
    signed = name in SIGNED
    exponential = step.function == DEFAULT_FUNCTION
    stroke = Stroke(
        step.start, 0.0, target, math.inf, target, step.onset, step.release, step.offset, step.end,
        step.function, movement,
    )  # fmt: skip
    overlaps = level != 0.0 or (before is not None and step.start < before.end)
    if before is not None and overlaps:
        if signed or (level < target and not exponential):
            stroke.begin, stroke.rise = level, target - level
        elif level < target:
            stroke.begin, stroke.rise, stroke.cap = level, 1.0, target
        else:
            stroke.begin, stroke.rise = target, 0.0
            if before.offset > 0.0:
                stroke.excess, stroke.fade = level - target, before.offset
                stroke.fade_function = before.function
    stroke.last = last_time(stroke, signed)
    return stroke
