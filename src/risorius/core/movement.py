"""Movements: the atoms of a performance, each with its cause."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ..errors import InputError, ParameterError, unknown
from .action_units import Targets, check_intensity, in_parameters, unit_weights
from .channels import CHANNELS
from .functions import DEFAULT_FUNCTION, ONSET_FUNCTIONS, FunctionName
from .key_shapes import KeyShape
from .lips.articulators import leader
from .parameters import INDEX, PARAMETERS, check_value
from .time import on_ticks, put_on_ticks
from .units import MAX_SECONDS, Seconds

CurveKeys = tuple[tuple[float, float], ...]
"""The keys (time in seconds, value) of a curve."""


@dataclass(frozen=True, slots=True)
class Cause:
    """The cause of a movement: its rule, its trigger (phone, word, mark), and its place in the source."""

    rule: str = ""
    trigger: str = ""
    place: str = ""


@dataclass(frozen=True, slots=True)
class Movement:
    """An atomic movement (paper A, section 4): targets reached in `onset` and left in `offset` seconds.

    Times in seconds, read to the nearest tick. `targets` maps action units (`AU12.left`) and parameters to
    values; `parameters` has all as parameters. `priority` and
    `release_priority` (in the offset phase): None for the priority of the channel. `on_top`: a muscle adds to
    what the others leave of it, x + (1 - x)·F, instead of the larger of both.
    """

    channel: str
    start: Seconds
    end: Seconds
    onset: Seconds
    offset: Seconds
    targets: Targets
    id: str = ""
    layer: str = ""
    priority: float | None = None
    release_priority: float | None = None
    function: FunctionName = DEFAULT_FUNCTION
    cause: Cause = field(default_factory=Cause)
    on_top: bool = False

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end", "onset", "offset")

    @property
    def label(self) -> str:
        """A name for messages: the id, or the channel and start."""
        return self.id or f"{self.channel}@{self.start:g}"

    @property
    def parameters(self) -> Mapping[str, float]:
        """The targets as values of parameters: units by their muscles, added and clipped (paper B, 6.4)."""
        return in_parameters(self.targets)


def fitted(onset: float, offset: float, length: float) -> tuple[float, float]:
    """Return onset and offset, shrunk in proportion if they are longer than the movement."""
    if onset + offset <= length:
        return onset, offset
    factor = length / (onset + offset)
    return onset * factor, offset * factor


@dataclass(frozen=True, slots=True)
class Dominance:
    """The dominance of a lip segment over one parameter (Cohen and Massaro; facts: science/01, section 1.1).

    `magnitude`: in comparison with the neighbours (1 for a vowel); `before`, `after`: time constants in
    seconds of the fall on either side of the plateau; `exponent`: of the fall; `plateau`: the share of the
    segment around its centre with full dominance.
    """

    magnitude: float = 1.0
    before: float = 0.05
    after: float = 0.05
    exponent: float = 1.0
    plateau: float = 0.5


DEFAULT_DOMINANCE = Dominance()
YIELDING = 0.08
"""Seconds at either end of a silence in which its dominance falls."""


def silent_dominance(dominance: Dominance, seconds: float) -> Dominance:
    """Return the dominance of a silence of some length: full in the middle half, or all but its ends.

    So a long silence gives way near the next phone, and not from its own middle on.
    """
    plateau = max(dominance.plateau, 1.0 - 2.0 * YIELDING / seconds) if seconds > 0.0 else 1.0
    return replace(dominance, plateau=plateau)


@dataclass(frozen=True, slots=True)
class LipSegment:
    """One phone's lips: targets, how dominant each is, and the limits it sets on the other channels.

    `phone` is "" for silence. Targets are articulators in mm (`articulators`), which mean the same on every
    head, or parameters. `dominance` maps either, or "*" for all others, to its Dominance. Targets of contact
    parameters (`lip_seal`, `lip_tuck`) are goals, which the lips reach during [start, end] in any case
    (DESIGN section 3). `limits` maps parameters to (low, high). `yields`, for the model `lookahead`, maps a
    target ("*": all others) to a rate of speech in phones a second, above which the phone takes its
    neighbours' shape. `precision`, for the model `effort`, maps a target ("*": all others, else 1) to how
    much it matters that it is reached, relative to a vowel's (1).
    """

    phone: str
    start: float
    end: float
    targets: Mapping[str, float]
    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    dominance: Mapping[str, Dominance] = field(default_factory=dict)
    cause: Cause = field(default_factory=Cause)
    yields: Mapping[str, float] = field(default_factory=dict)
    precision: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end")

    def with_targets(
        self, targets: Mapping[str, float], precision: Mapping[str, float] | None = None
    ) -> LipSegment:
        """Return the segment with other targets; `precision`: of these targets, None for its own."""
        changed = {"targets": targets} if precision is None else {"targets": targets, "precision": precision}
        return self._with(changed)

    def from_start(self, start: float) -> LipSegment:
        """Return the segment with another start, a whole tick in seconds."""
        return self._with({"start": start})

    def _with(self, changed: Mapping[str, object]) -> LipSegment:
        """Return a changed segment, in a fifth of the time of `replace`: its times are whole ticks."""
        segment, put = object.__new__(LipSegment), object.__setattr__
        for name in self.__slots__:
            put(segment, name, changed[name] if name in changed else getattr(self, name))
        return segment

    def dominance_of(self, name: str) -> Dominance:
        """Return the dominance over a target: its own, its articulator's, that of "*", or the default."""
        dominances = self.dominance
        return (
            dominances.get(name) or dominances.get(leader(name)) or dominances.get("*") or DEFAULT_DOMINANCE
        )

    def precision_of(self, name: str) -> float:
        """Return the precision of a target: its own, its articulator's, that of "*", or 1."""
        precision = self.precision
        return precision.get(name, precision.get(leader(name), precision.get("*", 1.0)))


@dataclass(frozen=True, slots=True)
class ManualCurve:
    """Curves drawn by hand: for each parameter its keys (time, value), joined by straight lines.

    Times in seconds, read to the nearest tick. `replaces`: from its first to its last key a curve replaces
    every other channel in its parameter, so that it can also be lower; else the highest value shows.
    `shapes`: for parameters whose curve is not straight, how it passes each key.
    """

    keys: Mapping[str, CurveKeys]
    cause: Cause = field(default_factory=Cause)
    replaces: bool = False
    shapes: Mapping[str, tuple[KeyShape, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        keys = {name: _on_ticks(curve) for name, curve in self.keys.items()}
        if any(keys[name] is not curve for name, curve in self.keys.items()):
            object.__setattr__(self, "keys", keys)


def _on_ticks(keys: CurveKeys) -> CurveKeys:
    """Return keys whose times are whole ticks; the same object if they are already."""
    times = np.fromiter((time for time, _ in keys), np.float64, len(keys))
    rounded = on_ticks(times)
    if np.array_equal(rounded, times):
        return keys
    return tuple(zip(rounded.tolist(), (value for _, value in keys), strict=True))


def check_movement(m: Movement) -> None:
    """Raise InputError or ParameterError if a movement cannot be performed."""
    CHANNELS.get(m.channel)
    check_span(m.label, m.start, m.end)
    for what, value in (("onset", m.onset), ("offset", m.offset)):
        if not 0.0 <= value <= MAX_SECONDS:
            expected = f"0 to {MAX_SECONDS:g} seconds"
            raise InputError(f"movement '{m.label}': {what} = {value} is out of range; expected {expected}")
    ONSET_FUNCTIONS.get(m.function)
    for name, value in m.targets.items():
        if unit_weights(name):
            check_intensity(name, value)
        else:
            check_target(name, value)


def check_span(label: str, start: float, end: float) -> None:
    """Raise InputError unless 0 <= start < end <= MAX_SECONDS."""
    if not 0.0 <= start <= MAX_SECONDS:
        raise InputError(f"'{label}': start = {start} is out of range; expected 0 to {MAX_SECONDS:g} seconds")
    if not start < end:
        raise InputError(f"'{label}': end = {end} must come after start = {start}")
    if not end <= MAX_SECONDS:
        raise InputError(f"'{label}': end = {end} is out of range; expected at most {MAX_SECONDS:g} seconds")


def check_shapes(curve: ManualCurve) -> None:
    """Raise InputError unless each parameter with shapes has one for each key, its handles on their sides."""
    for name, shapes in curve.shapes.items():
        keys = len(curve.keys.get(name, ()))
        if len(shapes) != keys:
            raise InputError(
                f"curve of {name}: {len(shapes)} shapes; expected one for each of its {keys} keys"
            )
        for number, shape in enumerate(shapes):
            before, after = shape.before or (0.0, 0.0), shape.after or (0.0, 0.0)
            within = all(abs(part) <= MAX_SECONDS for part in (*before, *after))
            if not (within and before[0] <= 0.0 <= after[0]):
                raise InputError(
                    f"curve of {name}: shape {number} has handles {list(before)} and {list(after)}; "
                    "expected [seconds, value] from the key, one back and one on"
                )


def check_target(name: str, value: float) -> None:
    """Raise ParameterError unless `name` is a parameter and `value` within its range."""
    if name not in INDEX:
        raise ParameterError(unknown("parameter", name, INDEX))
    check_value(PARAMETERS[INDEX[name]], value)
