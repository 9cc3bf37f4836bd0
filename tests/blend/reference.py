"""A second implementation of DESIGN, section 3: slow, one time after the other, formula by formula.

It shares nothing with the package but the types and the table; it is what the fast one is tested against.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from risorius.core.functions import ONSET_FUNCTIONS
from risorius.core.movement import Movement


@dataclass(frozen=True)
class Hold:
    """A movement, or what is left of one after an interruption."""

    start: float
    end: float
    onset: float
    offset: float
    source: Movement

    @property
    def release(self) -> float:
        return self.end - self.offset


def phi_plus(x: float, duration: float) -> float:
    return 2.0 ** (x / duration) - 1.0


def phi_minus(x: float, duration: float) -> float:
    return 2.0 ** (1.0 - x / duration) - 1.0


def shape(name: str, x: float) -> float:
    return {
        "exponential": lambda u: 2.0**u - 1.0,
        "linear": lambda u: u,
        "minimum_jerk": lambda u: 10 * u**3 - 15 * u**4 + 6 * u**5,
        "saccade": lambda u: 0.5 + 0.5 * (2 * u - 1) * (2.5 - abs(2 * u - 1) ** 1.5) / 1.5,
    }.get(name, ONSET_FUNCTIONS.get(name))(min(max(x, 0.0), 1.0))


def hold(movement: Movement, start: float) -> Hold:
    length, wanted = movement.end - start, movement.onset + movement.offset
    factor = min(1.0, length / wanted) if wanted > 0 else 1.0
    return Hold(start, movement.end, movement.onset * factor, movement.offset * factor, movement)


def order(movements: Sequence[Movement]) -> list[Hold]:
    """Movements in the order in which they hold the layer; what is nested interrupts."""
    queue = [(m.start, 0, i, hold(m, m.start)) for i, m in enumerate(movements)]
    heapq.heapify(queue)
    held: list[Hold] = []
    waiting: list[Hold] = []  # interrupted, innermost last
    while queue or waiting:
        if waiting and held and (not queue or held[-1].release < queue[0][0]):
            inner, outer = held[-1], waiting.pop()
            if outer.end - inner.release > outer.offset:
                held.append(hold(outer.source, inner.release))
            continue
        if not queue:
            break
        new = heapq.heappop(queue)[3]
        if held and new.end <= held[-1].end:
            waiting.append(held[-1])
        waiting = [w for w in waiting if w.end >= new.end]
        held.append(new)
    return held


def alone(s: Hold, target: float, t: float) -> float:
    """F of one movement: paper A, section 4."""
    name = s.source.function
    if s.start <= t < s.start + s.onset:
        return target * shape(name, (t - s.start) / s.onset)
    if s.start + s.onset <= t <= s.release:
        return target
    if s.release < t < s.end:
        return target * shape(name, 1.0 - (t - s.end + s.offset) / s.offset)
    return 0.0


def slowing(
    earlier: list[Hold], parameter: str, signed: bool, two: Hold, a: float, over: float, x: float
) -> float:
    """What the speed before movement 2 adds after it has begun: smooth functions make no corner there."""
    if (
        two.source.function in ("exponential", "linear")
        or parameter.startswith("gaze")
        or x >= over
        or earlier[-1].start >= two.start
    ):
        return 0.0
    before = max(two.start - 1e-5, earlier[-1].start)
    speed = (a - concatenated(earlier, parameter, signed, before)) / (two.start - before)
    if not signed:
        reach = 27.0 / 256.0 * over
        speed = min(max(speed, -a / reach), (1.0 - a) / reach)
    return speed * x * (1.0 - x / over) ** 3


def concatenated(held: list[Hold], parameter: str, signed: bool, t: float) -> float:
    """F of all movements in order: paper A, section 5.2, as DESIGN mends it."""
    if not held:
        return 0.0
    *earlier, two = held
    if t < two.start or (t == two.start and two.onset > 0):
        return concatenated(earlier, parameter, signed, t)
    b = two.source.targets.get(parameter, 0.0)
    a = concatenated(earlier, parameter, signed, two.start) if earlier else 0.0
    if not earlier or not (two.start < earlier[-1].end or a != 0.0):
        return alone(two, b, t)
    name, x = two.source.function, t - two.start
    if signed or (a < b and name != "exponential"):
        slowed = slowing(earlier, parameter, signed, two, a, two.onset, x) if a != b else 0.0
        return a + (b - a) * shape(name, x / two.onset) + slowed if x < two.onset else alone(two, b, t)
    if a < b:
        xi = two.onset * math.log2(1.0 + b - a)
        if x < xi:
            return a + phi_plus(x, two.onset)
        return b if x <= two.onset else alone(two, b, t)
    one = earlier[-1]
    base = b if x <= two.onset else alone(two, b, t)
    if one.offset == 0.0:
        return base
    base += slowing(earlier, parameter, signed, two, a, one.offset, x)
    if one.source.function != "exponential":
        return base + (a - b) * (1.0 - shape(one.source.function, x / one.offset))
    xi = one.offset * (1.0 - math.log2(1.0 + a - b))
    return base + (phi_minus(x + xi, one.offset) if x < one.offset - xi else 0.0)


def curve(movements: Sequence[Movement], parameter: str, signed: bool, times: Sequence[float]) -> list[float]:
    """One parameter of one layer at the times."""
    held = order(movements)
    return [concatenated(held, parameter, signed, float(t)) for t in times]


def with_function(movement: Movement, name: str) -> Movement:
    return replace(movement, function=name)
