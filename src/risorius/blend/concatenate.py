"""Movements of one layer follow one another: paper A, section 5.2, with its errors corrected.

DESIGN, section 3, "Within a channel", is the contract; facts: science/errata, A1 and A2, give the reasons.
Each movement becomes a step of its layer, and two steps if another movement interrupts it. Each step becomes
a piece of the curve of every parameter that it moves or lets go.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

from ..core.channels import CHANNELS
from ..core.functions import CORNERED, DEFAULT_FUNCTION
from ..core.movement import Movement, fitted
from ..core.parameters import NEUTRAL, PARAMETERS, Kind
from .curve_pieces import FARTHEST, CurvePiece, CurvePieces, MovementCurve, last_time, speed_at, value_at
from .priority_curve import PriorityClaim

NEUTRALS: dict[str, float] = {p.name: float(n) for p, n in zip(PARAMETERS, NEUTRAL, strict=True)}
SIGNED = frozenset(p.name for p in PARAMETERS if p.signed or p.neutral != 0.0)
"""Parameters that are signed deviations from their neutral: degrees, and the distance of the gaze."""


EYES = frozenset(p.name for p in PARAMETERS if p.kind in (Kind.GAZE, Kind.DISTANCE))
"""Eyes start and stop at once, and undo exactly what a head that follows them turns."""


@dataclass(slots=True)
class LayerStep:
    """The time for which one movement moves its layer, with its actual onset and offset. Seconds.

    `until`: when all that it moved is at rest again, or the next step has taken over.
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
        """The start of the offset."""
        return self.end - self.offset

    def claim(self) -> PriorityClaim:
        """Return the priority that it claims for its channel."""
        m = self.movement
        own = CHANNELS.get(m.channel).priority if m.priority is None else m.priority
        after = own if m.release_priority is None else m.release_priority
        return PriorityClaim(self.start, self.release, self.until, own, after)


@dataclass(slots=True)
class LayerCurves:
    """The movements of one layer, concatenated: steps in order and a curve for each parameter."""

    steps: list[LayerStep]
    curves: dict[str, MovementCurve]


def concatenate(movements: Iterable[Movement], function: str | None = None) -> LayerCurves:
    """Return the concatenation of one layer's movements, no two of which start together.

    `function`, unless it is None, replaces the movements' own onset functions. Values of parameters become
    deviations from their neutral.
    """
    steps = sequence(movements, function)
    return LayerCurves(steps, _curves(steps))


def sequence(movements: Iterable[Movement], function: str | None = None) -> list[LayerStep]:
    """Return the steps of a layer in order; a movement resumes after one that is nested within it."""
    steps: list[LayerStep] = []
    interrupted: list[LayerStep] = []
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


def _resume(steps: list[LayerStep], interrupted: list[LayerStep], before: float) -> None:
    """Resume the interrupted movements when the interrupting one lets go, if that is before `before`."""
    while interrupted and steps[-1].release < before:
        at, outer = steps[-1].release, interrupted.pop()
        if outer.end - at > outer.offset:
            steps.append(_step(outer.movement, at, outer.function))


def _step(movement: Movement, start: float, function: str | None) -> LayerStep:
    """Return a movement from `start` on; onset and offset shrink in proportion if they do not fit."""
    onset, offset = fitted(movement.onset, movement.offset, movement.end - start)
    targets = {name: value - NEUTRALS[name] for name, value in movement.parameters.items()}
    shape = function or movement.function
    return LayerStep(movement, start, movement.end, onset, offset, shape, targets, movement.end)


def _curves(steps: list[LayerStep]) -> dict[str, MovementCurve]:
    """Return the curve of each parameter; those that are always moved alike, as both sides are, share one."""
    alike = _moved_alike(steps)
    chosen = set(alike.values())
    finished: dict[str, CurvePieces] = defaultdict(CurvePieces)
    live: dict[str, CurvePiece] = {}
    before: LayerStep | None = None
    for step in steps:
        levels_left = _take_over(live, step.start)
        left = {name: live[name] for name in levels_left}
        _finish(live, finished)
        if before is not None:
            before.until = min(before.until, step.start)
        for name in {**levels_left, **step.targets}:
            if name not in chosen:
                continue
            level, movement = levels_left.get(name, (0.0, step.movement))
            if name in step.targets:
                movement = step.movement
            elif level == 0.0:
                continue
            piece = live[name] = _piece(name, level, step, movement, before)
            if step.function not in CORNERED and name not in EYES:
                _keep_speed(piece, name, level, left.get(name))
            step.until = max(step.until, piece.last)
        before = step
    _finish(live, finished)
    curves = {name: MovementCurve(pieces) for name, pieces in finished.items()}
    return {name: curves[other] for name, other in alike.items()}


def _moved_alike(steps: list[LayerStep]) -> dict[str, str]:
    """Return for each parameter the first one that all steps move to the same targets, most often itself."""
    targets: dict[str, list[tuple[int, float]]] = defaultdict(list)
    for number, step in enumerate(steps):
        for name, target in step.targets.items():
            targets[name].append((number, target))
    first: dict[object, str] = {}
    return {
        name: first.setdefault((name in SIGNED, name in EYES, *own), name) for name, own in targets.items()
    }


def _finish(live: dict[str, CurvePiece], finished: dict[str, CurvePieces]) -> None:
    """Move the live pieces to the finished ones: nothing changes them any more."""
    for name, piece in live.items():
        finished[name].append(piece)
    live.clear()


def _take_over(live: dict[str, CurvePiece], time: float) -> dict[str, tuple[float, Movement]]:
    """Stop all pieces that are not yet at rest; return the level that each leaves, and its movement."""
    levels_left = {}
    for name, piece in live.items():
        if piece.last > time:
            levels_left[name] = (value_at(piece, time), piece.movement)
            piece.stop = time
    return levels_left


def _piece(
    name: str, level: float, step: LayerStep, movement: Movement, before: LayerStep | None
) -> CurvePiece:
    """Return how `step` moves a parameter that is at `level` when the step starts."""
    target = step.targets.get(name, 0.0)
    signed = name in SIGNED
    exponential = step.function == DEFAULT_FUNCTION
    piece = CurvePiece(
        step.start, 0.0, target, math.inf, target, step.onset, step.release, step.offset, step.end,
        step.function, movement,
    )  # fmt: skip
    overlaps = level != 0.0 or (before is not None and step.start < before.end)
    if before is not None and overlaps:
        if signed or (level < target and not exponential):
            piece.begin, piece.rise = level, target - level
        elif level < target:
            piece.begin, piece.rise, piece.cap = level, 1.0, target
        else:
            piece.begin, piece.rise = target, 0.0
            if before.offset > 0.0:
                piece.excess, piece.fade = level - target, before.offset
                piece.fade_function = before.function
    piece.last = last_time(piece, signed)
    return piece


def _keep_speed(piece: CurvePiece, name: str, level: float, left: CurvePiece | None) -> None:
    """Let a piece begin with the speed of the one before, as far as an unsigned value stays within 0..1."""
    slowing = piece.onset if piece.rise else piece.fade
    speed = speed_at(left, piece.start, level) if left is not None and slowing > 0.0 else 0.0
    if not speed:
        return
    if name not in SIGNED:
        reach = FARTHEST * slowing
        speed = min(max(speed, -level / reach), (1.0 - level) / reach)
    piece.speed, piece.slowing = speed, slowing
