"""Division of a gaze shift between eyes and head: main sequence, Freedman's law, vestibulo-ocular reflex.

Freedman 2001, as used by Itti, Dhavale and Pighin 2003: within a dead zone the eyes go alone; beyond it the
head takes a share that grows with the shift. The share printed there jumps at the zone's edge; ours is the
same line begun there. The zone is 10 degrees where theirs is 11.2: head and eyes follow the same behaviour
(paper B, section 5.2), and most looks away are hardly larger. The eyes land first; while the head follows
they counter-rotate, so that gaze stays where it landed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from ..core.counter_rng import CounterRng
from ..core.movement import Cause, Movement
from ..core.parameters import INDEX, PARAMETERS
from ..rules.match import EYES
from ..rules.profiles import BlinkHabits
from ..rules.saccade import saccade_duration
from ..rules.stillness import StillTime, after_pauses
from .blinks import blink

Angles = tuple[float, float]
"""Pitch and yaw in degrees."""

HEAD = ("head_pitch", "head_yaw")
# Shifts back to within this of straight ahead bring the head to rest (paper B, section 5.2), degrees.
_AHEAD = 5.0
_OVERLAP = 0.02
ZONE = 10.0
"""Degrees of a shift that the eyes make alone, unless they are already turned."""
# It becomes nothing where they are turned so far already, degrees.
_TURNED = 40.0
# Seconds between two saccades at least (Lee, Badler and Badler 2002).
_REFRACTORY = 0.05
BLINK = "gaze.lids.shift"
# The shift at which the probability of a blink is the profile's, degrees.
_LARGE = 33.0


@dataclass(frozen=True, slots=True)
class GazeShift:
    """Gaze goes to a direction in the world at `start` seconds; `blinks`: it may bring a blink."""

    start: float
    direction: Angles
    cause: Cause
    blinks: bool = True


def head_share(shift: float, eye: float, zone: float = ZONE) -> float:
    """Return how far the head goes in a shift of gaze by `shift` degrees from an eye at `eye` in the head.

    `zone`: degrees that the eyes go alone.
    """
    ahead = eye if shift >= 0.0 else -eye
    alone = max(0.0, zone * (1.0 - ahead / _TURNED))
    slope = min(1.0, 0.65 * (abs(ahead) / 35.0 + 1.1))
    return math.copysign(max(abs(shift) - alone, 0.0) * slope, shift)


def head_duration(degrees: float) -> float:
    """Return the head's seconds: a triangle of speed with a peak of 3.9 A + 16 degrees a second."""
    size = abs(degrees)
    return 2.0 * size / (3.9 * size + 16.0)


def head_help(mark: Movement) -> Movement | None:
    """Return the head's share of a marked look, the eyes turned against it; None if they go alone.

    The mark stays as it is written: eyes and head together look where it says.
    """
    goal = {axis: mark.targets.get(eye, 0.0) for axis, eye in zip(HEAD, EYES, strict=True)}
    share = {axis: head_share(angle, 0.0) for axis, angle in goal.items()}
    if not any(share.values()) or any(axis in mark.targets for axis in HEAD):
        return None
    seconds = head_duration(math.hypot(*share.values()))
    counter = {eye: -share[axis] for axis, eye in zip(HEAD, EYES, strict=True)}
    return Movement(
        "gaze", mark.start + mark.onset, mark.end + seconds, seconds, seconds, {**share, **counter},
        id=f"{mark.label}.head", layer=f"{mark.layer}.head", function="minimum_jerk", cause=mark.cause,
    )  # fmt: skip


@dataclass
class _Chain:
    """Steps of one layer, each held until the next begins."""

    layer: str
    names: Sequence[str]
    steps: list[tuple[float, float, Angles, str, Cause]] = field(default_factory=list)

    def add(self, start: float, onset: float, values: Angles, function: str, cause: Cause) -> None:
        """Go to the values from `start` on, within `onset` seconds."""
        self.steps.append((start, onset, values, function, cause))

    def movements(self, duration: float) -> Iterator[Movement]:
        """Yield the chain's movements."""
        ends = [start + _OVERLAP for start, *_ in self.steps[1:]]
        ends += [max(duration, start + onset) + 2 * _OVERLAP for start, onset, *_ in self.steps[-1:]]
        for (start, onset, values, function, cause), end in zip(self.steps, ends, strict=True):
            targets = {
                name: min(max(v, PARAMETERS[INDEX[name]].low), PARAMETERS[INDEX[name]].high)
                for name, v in zip(self.names, values, strict=True)
            }
            yield Movement(
                "gaze", start, end, min(onset, end - start - _OVERLAP), _OVERLAP, targets,
                id=f"{cause.rule}@{start:.3f}.{self.layer}", layer=self.layer, function=function, cause=cause,
            )  # fmt: skip


class _Pose:
    """The directions of eyes and head, and all movements that brought them there."""

    def __init__(self, pauses: Sequence[StillTime], zone: float) -> None:
        self._pauses, self._zone = pauses, zone
        self.eye: Angles = (0.0, 0.0)
        self.head: Angles = (0.0, 0.0)
        self.ready = 0.0
        self.eyes, self.heads = _Chain("look", EYES), _Chain("head", HEAD)

    def shift(self, start: float, direction: Angles, cause: Cause) -> float:
        """Shift gaze from `start` on; return by how many degrees."""
        gaze = (self.eye[0] + self.head[0], self.eye[1] + self.head[1])
        size = math.dist(gaze, direction)
        head = self._head(direction, gaze)
        first = (direction[0] - self.head[0], direction[1] - self.head[1])
        landing = saccade_duration(math.dist(first, self.eye))
        self.eyes.add(start, landing, first, "saccade", cause)
        self.eye = (direction[0] - head[0], direction[1] - head[1])
        self.ready = start + landing + _REFRACTORY
        if moved := math.dist(head, self.head):
            onset = head_duration(moved)
            follows = after_pauses(start + landing, onset, self._pauses)
            self.eyes.add(follows, onset, self.eye, "minimum_jerk", cause)
            self.heads.add(follows, onset, head, "minimum_jerk", cause)
            self.ready = follows + max(onset, _REFRACTORY)
        self.head = head
        return size

    def _head(self, direction: Angles, gaze: Angles) -> Angles:
        if math.hypot(*direction) < _AHEAD:
            return (0.0, 0.0)
        pitch, yaw = (
            head + head_share(to - at, eye, self._zone)
            for head, to, at, eye in zip(self.head, direction, gaze, self.eye, strict=True)
        )
        return pitch, yaw


def blinks_with(degrees: float, habits: BlinkHabits, numbers: CounterRng) -> bool:
    """Draw whether a shift of gaze brings a blink.

    The probability grows with the square of the angle (that it grows: Evinger et al. 1994).
    """
    return numbers.uniform("chance") < habits.shift * min(abs(degrees) / _LARGE, 1.0) ** 2


def shifts_of(
    shifts: Sequence[GazeShift],
    duration: float,
    habits: BlinkHabits,
    boundaries: Sequence[float],
    pauses: Sequence[StillTime],
    numbers: CounterRng,
    zone: float = ZONE,
) -> Iterator[Movement]:
    """Yield the movements of eyes, head and lids for shifts of gaze in order of time.

    A shift that comes while the last one is under way waits for it, and is left out if the next one comes
    first. The head does not follow in `pauses` that are short, but after them. `habits` say how probable a
    blink is with a shift by 33 degrees; see `blinks_with`. `zone`: degrees that the eyes go alone.
    """
    pose = _Pose(pauses, zone)
    for number, (shift, following) in enumerate(pairwise([*shifts, None])):
        assert shift is not None
        start = max(shift.start, pose.ready)
        if start >= (following.start if following else duration):
            continue
        size = pose.shift(start, shift.direction, shift.cause)
        if shift.blinks and blinks_with(size, habits, numbers.under("blink", number)):
            yield blink("gaze", start, 1.0, habits, boundaries, Cause(BLINK, shift.cause.trigger), "lids")
    yield from pose.eyes.movements(duration)
    yield from pose.heads.movements(duration)
