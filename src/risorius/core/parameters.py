"""The one table of parameters: 35 muscles (paper A, Table 1), contact, tongue, head and gaze.

Everything else that depends on a parameter's name, side, range, threshold or rivals derives from this table.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

import numpy as np

from ..errors import ParameterError, unknown
from .arrays import Array


class Kind(StrEnum):
    """The part of the face that a parameter moves; it determines how channels are combined in it."""

    MUSCLE = "muscle"
    CONTACT = "contact"
    TONGUE = "tongue"
    HEAD = "head"
    GAZE = "gaze"
    DISTANCE = "distance"


@dataclass(frozen=True, slots=True)
class Parameter:
    """One column of every curve.

    `number` is the muscle's in paper A, Table 1 (None for other parameters); `threshold` the activation
    above which it inhibits its rivals; `min_onset`, `min_offset` the shortest time in seconds in which
    it may contract or relax fully (paper A, section 6; values from DESIGN, section 2).
    """

    name: str
    base: str
    side: str
    kind: Kind
    group: str
    unit: str
    low: float
    high: float
    neutral: float
    number: int | None
    threshold: float
    min_onset: float
    min_offset: float

    @property
    def signed(self) -> bool:
        """Whether values below zero have a meaning (degrees)."""
        return self.low < 0.0


DEFAULT_THRESHOLD = 0.1
SIDES = ("left", "right")

# Minimum onset and offset per group, seconds.
_MIN_DURATION = {"lids": 0.04, "lips": 0.12, "jaw": 0.12, "brows": 0.15, "cheeks": 0.25, "nose": 0.25}

# number, name, sides, group
_MUSCLES: tuple[tuple[int, str, int, str], ...] = (
    (1, "zygomatic_major", 2, "cheeks"),
    (2, "zygomatic_minor", 2, "cheeks"),
    (3, "triangularis", 2, "cheeks"),
    (4, "risorius", 2, "cheeks"),
    (5, "depressor_labii", 2, "lips"),
    (6, "mentalis", 2, "lips"),
    (7, "orbicularis_oris_funneler", 1, "lips"),
    (8, "orbicularis_oris_presser", 1, "lips"),
    (9, "frontalis_medialis", 2, "brows"),
    (10, "frontalis_lateralis", 2, "brows"),
    (11, "levator_labii_nasi", 2, "nose"),
    (12, "levator_labii_superioris", 2, "cheeks"),
    (13, "depressor_supercilii", 2, "brows"),
    (14, "corrugator_supercilii", 2, "brows"),
    (15, "depressor_glabellae", 2, "brows"),
    (16, "levator_palpebrae", 2, "lids"),
    (17, "orbicularis_oculi_palpebralis", 2, "lids"),
    (18, "orbicularis_oculi_orbitalis", 2, "lids"),
    (19, "masseter", 1, "jaw"),
)

# name, kind, group, unit, low, high, neutral
_OTHERS: tuple[tuple[str, Kind, str, str, float, float, float], ...] = (
    ("lip_seal", Kind.CONTACT, "lips", "", 0.0, 1.0, 0.0),
    ("lip_tuck", Kind.CONTACT, "lips", "", 0.0, 1.0, 0.0),
    ("tongue_up", Kind.TONGUE, "lips", "", 0.0, 1.0, 0.0),
    ("tongue_out", Kind.TONGUE, "lips", "", 0.0, 1.0, 0.0),
    ("tongue_back", Kind.TONGUE, "lips", "", 0.0, 1.0, 0.0),
    ("head_pitch", Kind.HEAD, "head", "deg", -60.0, 60.0, 0.0),
    ("head_yaw", Kind.HEAD, "head", "deg", -80.0, 80.0, 0.0),
    ("head_roll", Kind.HEAD, "head", "deg", -45.0, 45.0, 0.0),
    ("gaze_pitch", Kind.GAZE, "gaze", "deg", -35.0, 35.0, 0.0),
    ("gaze_yaw", Kind.GAZE, "gaze", "deg", -45.0, 45.0, 0.0),
    ("gaze_distance", Kind.DISTANCE, "gaze", "m", 0.1, 100.0, 0.8),
)

# Conflicting muscles by number: paper A, Table 2, made symmetric (facts: science/errata, A4).
CONFLICTING_NUMBERS: tuple[tuple[int, int], ...] = (
    (1, 3), (1, 4), (1, 6), (1, 7), (1, 12),
    (2, 3), (2, 4), (2, 6), (2, 7), (2, 12),
    (3, 7), (4, 7), (5, 6), (5, 8), (7, 8),
    (8, 11), (8, 12), (9, 11), (11, 16), (16, 17),
)  # fmt: skip

# Names that users bring from other systems.
ALIASES: dict[str, str] = {
    "jaw_open": "masseter",
    "jaw": "masseter",
    "lip_funneler": "orbicularis_oris_funneler",
    "lip_presser": "orbicularis_oris_presser",
    "lip_pressor": "orbicularis_oris_presser",
    "orbicularis_oris_pressor": "orbicularis_oris_presser",
    "eye_closing": "orbicularis_oculi_palpebralis",
    "blink": "orbicularis_oculi_palpebralis",
    "levator_palpebrae_superioris": "levator_palpebrae",
    "depressor_anguli_oris": "triangularis",
    "caninus": "levator_labii_superioris",
}


def _muscle(number: int, base: str, side: str, group: str) -> Parameter:
    seconds = _MIN_DURATION[group]
    name = f"{base}.{side}" if side else base
    return Parameter(
        name, base, side, Kind.MUSCLE, group, "", 0.0, 1.0, 0.0, number, DEFAULT_THRESHOLD, seconds, seconds
    )


def _build() -> tuple[Parameter, ...]:
    rows = [
        _muscle(number, base, side, group)
        for number, base, sides, group in _MUSCLES
        for side in (SIDES if sides == 2 else ("",))
    ]
    for name, kind, group, unit, low, high, neutral in _OTHERS:
        seconds = _MIN_DURATION.get(group, 0.12)
        timing = (None, DEFAULT_THRESHOLD, seconds, seconds)
        rows.append(Parameter(name, name, "", kind, group, unit, low, high, neutral, *timing))
    return tuple(rows)


PARAMETERS: tuple[Parameter, ...] = _build()
NAMES: tuple[str, ...] = tuple(p.name for p in PARAMETERS)
INDEX: dict[str, int] = {name: i for i, name in enumerate(NAMES)}
MUSCLES: tuple[Parameter, ...] = tuple(p for p in PARAMETERS if p.kind is Kind.MUSCLE)
NEUTRAL: Array = np.array([p.neutral for p in PARAMETERS])
NEUTRAL.setflags(write=False)
BASES: dict[str, tuple[Parameter, ...]] = {}
for _p in PARAMETERS:
    BASES[_p.base] = (*BASES.get(_p.base, ()), _p)


def _rivals() -> dict[str, tuple[str, ...]]:
    pairs = {frozenset(pair) for pair in CONFLICTING_NUMBERS}

    def conflict(p: Parameter, q: Parameter) -> bool:
        if p.number is None or q.number is None or frozenset((p.number, q.number)) not in pairs:
            return False
        return not p.side or not q.side or p.side == q.side

    return {p.name: tuple(q.name for q in PARAMETERS if conflict(p, q)) for p in PARAMETERS}


RIVALS: dict[str, tuple[str, ...]] = _rivals()
"""The parameters that conflict with each one: paper A, Table 2, tested per side."""


def parameters_named(name: str) -> tuple[Parameter, ...]:
    """Return the parameters of `name`: both sides if it names none.

    `name` is in any case, an alias of `ALIASES` or a name of the table, with or without `.left`/`.right`.
    Raises ParameterError for an unknown name or for a side that the parameter does not have.
    """
    if not isinstance(name, str):
        raise ParameterError(f"{name!r} is not the name of a muscle or parameter")
    return _parameters_named(name)


@lru_cache(maxsize=1024)
def _parameters_named(name: str) -> tuple[Parameter, ...]:
    stem, dot, side = name.strip().lower().replace("-", "_").replace(" ", "_").partition(".")
    base = ALIASES.get(stem, stem)
    parameters = BASES.get(base)
    if parameters is None:
        raise ParameterError(unknown("muscle or parameter", name, (*BASES, *ALIASES)))
    if not dot:
        return parameters
    one_side = tuple(p for p in parameters if p.side == side)
    if not one_side:
        sides = " or ".join(f".{p.side}" for p in parameters if p.side) or "no side"
        raise ParameterError(f"'{base}' has no side '.{side}'; expected {sides}")
    return one_side


def check_value(parameter: Parameter, value: float) -> float:
    """Return `value` as a float; raise ParameterError if it is not finite or out of the parameter's range."""
    number = float(value)
    if not (parameter.low <= number <= parameter.high):
        unit = f" {parameter.unit}" if parameter.unit else ""
        raise ParameterError(
            f"{parameter.name} = {value} is out of range; "
            f"expected {parameter.low:g} to {parameter.high:g}{unit}"
        )
    return number
