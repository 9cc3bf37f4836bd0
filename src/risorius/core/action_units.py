"""Action units (FACS) as weighted muscles, and the resolution of targets to parameters.

Sources: DESIGN section 2; facts science/05, sections 5.1 and 5.2 (the muscles of each unit). The weights of
units that 35 muscles only approximate are our own and marked as approximate.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated

from ..errors import ParameterError, unknown
from ..reading.frozen import FrozenDict
from ..reading.hints import Then
from ..reading.schema import MisfitError
from .parameters import BASES, INDEX, PARAMETERS, Parameter, check_value, parameters_named


@dataclass(frozen=True, slots=True)
class ActionUnit:
    """One unit: its FACS name, and the parameters that perform it (or approximate it) at intensity 1."""

    number: int
    name: str
    weights: Mapping[str, float]
    approximate: bool = False


def _unit(number: int, name: str, approximate: bool = False, /, **weights: float) -> ActionUnit:
    return ActionUnit(number, name, weights, approximate)


_UNITS = (
    _unit(1, "inner brow raiser", frontalis_medialis=1.0),
    _unit(2, "outer brow raiser", frontalis_lateralis=1.0),
    _unit(4, "brow lowerer", depressor_supercilii=0.9, corrugator_supercilii=1.0, depressor_glabellae=0.9),
    _unit(5, "upper lid raiser", levator_palpebrae=1.0),
    _unit(6, "cheek raiser", orbicularis_oculi_orbitalis=1.0),
    _unit(7, "lid tightener", orbicularis_oculi_palpebralis=0.16, orbicularis_oculi_orbitalis=0.3),
    _unit(9, "nose wrinkler", levator_labii_nasi=1.0),
    _unit(10, "upper lip raiser", levator_labii_superioris=1.0),
    _unit(11, "nasolabial deepener", zygomatic_minor=1.0),
    _unit(12, "lip corner puller", zygomatic_major=1.0),
    _unit(13, "sharp lip puller", True, zygomatic_major=0.6),
    _unit(14, "dimpler", True, zygomatic_major=0.25, risorius=0.25, triangularis=0.25),
    _unit(15, "lip corner depressor", triangularis=1.0),
    _unit(16, "lower lip depressor", depressor_labii=1.0),
    _unit(17, "chin raiser", mentalis=1.0),
    _unit(18, "lip pucker", True, orbicularis_oris_funneler=0.8),
    _unit(19, "tongue show", tongue_out=1.0),
    _unit(20, "lip stretcher", risorius=1.0),
    _unit(
        22,
        "lip funneler",
        orbicularis_oris_funneler=0.7,
        depressor_labii=0.8,
        levator_labii_superioris=0.35,
    ),
    _unit(23, "lip tightener", True, orbicularis_oris_presser=0.45),
    _unit(24, "lip pressor", orbicularis_oris_presser=0.4, mentalis=0.4),
    _unit(25, "lips part", True, depressor_labii=0.35, masseter=0.05),
    _unit(26, "jaw drop", masseter=0.35),
    _unit(27, "mouth stretch", masseter=0.8),
    _unit(28, "lip suck", True, orbicularis_oris_presser=1.0),
    _unit(41, "lid droop", orbicularis_oculi_palpebralis=0.3),
    _unit(42, "slit", orbicularis_oculi_palpebralis=0.6),
    _unit(43, "eyes closed", orbicularis_oculi_palpebralis=1.0),
    _unit(44, "squint", orbicularis_oculi_palpebralis=0.4, orbicularis_oculi_orbitalis=0.4),
    _unit(45, "blink", orbicularis_oculi_palpebralis=1.0),
    _unit(46, "wink", orbicularis_oculi_palpebralis=1.0),
    _unit(51, "head turn left", head_yaw=30.0),
    _unit(52, "head turn right", head_yaw=-30.0),
    _unit(53, "head up", head_pitch=15.0),
    _unit(54, "head down", head_pitch=-20.0),
    _unit(55, "head tilt left", head_roll=20.0),
    _unit(56, "head tilt right", head_roll=-20.0),
    _unit(61, "eyes turn left", gaze_yaw=30.0),
    _unit(62, "eyes turn right", gaze_yaw=-30.0),
    _unit(63, "eyes up", gaze_pitch=20.0),
    _unit(64, "eyes down", gaze_pitch=-20.0),
)

ACTION_UNITS: dict[int, ActionUnit] = {unit.number: unit for unit in _UNITS}

# Units of FACS that 35 muscles cannot show: they are reported by name, not ignored.
NOT_SHOWN: dict[int, str] = {
    8: "lips toward each other",
    21: "neck tightener",
    29: "jaw thrust",
    30: "jaw sideways",
    31: "jaw clencher",
    32: "lip bite",
    33: "cheek blow",
    34: "cheek puff",
    35: "cheek suck",
    36: "tongue bulge",
    37: "lip wipe",
    38: "nostril dilator",
    39: "nostril compressor",
    57: "head forward",
    58: "head back",
    65: "walleye",
    66: "cross-eye",
}

_AU_NAME = re.compile(r"au_?0*(\d+)(?:\.(left|right|l|r))?", re.IGNORECASE)
_AU_SIDES = {"l": "left", "r": "right"}


@lru_cache(maxsize=1024)
def action_unit(name: str) -> tuple[ActionUnit, str] | None:
    """Return the unit and side ("" for both) of a name such as `AU12.left`, None if it is not an AU.

    Raises ParameterError for a unit that is unknown or that the muscles cannot show, with its FACS name.
    """
    match = _AU_NAME.fullmatch(name.strip())
    if match is None:
        return None
    # Nine digits are enough for any unit, and Python refuses to read thousands.
    number, side = int(match[1][:9]), (match[2] or "").lower()
    unit = ACTION_UNITS.get(number)
    if unit is None and number in NOT_SHOWN:
        raise ParameterError(f"AU{number} ({NOT_SHOWN[number]}) cannot be shown by the 35 muscles")
    if unit is None:
        raise ParameterError(unknown("action unit", name, (f"AU{n}" for n in ACTION_UNITS)))
    return unit, _AU_SIDES.get(side, side)


@lru_cache(maxsize=1024)
def _parameters_of(number: int, side: str) -> tuple[tuple[Parameter, float], ...]:
    unit = ACTION_UNITS[number]
    pairs = tuple((p, weight) for base, weight in unit.weights.items() for p in parameters_named(base))
    if not side:
        return pairs
    if all(not p.side for p, _ in pairs):
        raise ParameterError(f"AU{unit.number} ({unit.name}) has no sides; expected AU{unit.number}")
    return tuple((p, weight) for p, weight in pairs if p.side in ("", side))


def target_names() -> dict[str, str]:
    """Return the names that a pose may set: action units with their effects, then muscles and the others."""
    units = {f"AU{unit.number}": unit.name for unit in ACTION_UNITS.values()}
    return units | dict.fromkeys(BASES, "")


def check_intensity(name: str, value: float) -> float:
    """Return an action unit's or emotion's intensity; raise ParameterError if it is not within 0 to 1."""
    if not 0.0 <= float(value) <= 1.0:
        raise ParameterError(f"{name} = {value} is out of range; expected 0 to 1")
    return float(value)


def resolve_targets(targets: Mapping[str, float]) -> dict[str, float]:
    """Return the parameters' values, in the table's order, for targets by action unit, muscle or alias.

    Units add up and are clipped to the parameter's range (paper B, section 6.4); a name without a side means
    both sides. Raises ParameterError for unknown names and for values out of range.
    """
    total: dict[str, float] = {}
    for name, value in targets.items():
        unit_and_side = action_unit(name)
        if unit_and_side is None:
            for p in parameters_named(name):
                total[p.name] = total.get(p.name, 0.0) + check_value(p, value)
            continue
        unit, side = unit_and_side
        intensity = check_intensity(name, value)
        for p, weight in _parameters_of(unit.number, side):
            total[p.name] = total.get(p.name, 0.0) + weight * intensity
    parameters = [PARAMETERS[index] for index in sorted(INDEX[name] for name in total)]
    return {p.name: min(max(total[p.name], p.low), p.high) for p in parameters}


def kept_units(targets: Mapping[str, float]) -> dict[str, float]:
    """Return targets with the action units of the face kept, as `AU12` or `AU12.left`, before the parameters.

    Those of head and eyes are degrees, and become parameters, as muscles and aliases do. Raises as
    `resolve_targets`.
    """
    units: dict[str, float] = {}
    others: dict[str, float] = {}
    for name, value in targets.items():
        unit_and_side = action_unit(name)
        unit, side = unit_and_side or (None, "")
        if unit is None or any(p.signed for p, _ in _parameters_of(unit.number, side)):
            others[name] = value
            continue
        written = f"AU{unit.number}.{side}" if side else f"AU{unit.number}"
        units[written] = min(units.get(written, 0.0) + check_intensity(name, value), 1.0)
    return {**units, **resolve_targets(others)}


@lru_cache(maxsize=1024)
def unit_weights(name: str) -> Mapping[str, float]:
    """Return the weights of the parameters that an action unit, written as `kept_units` does, contracts.

    Empty for the name of a parameter.
    """
    unit, side = action_unit(name) or (None, "")
    return FrozenDict({} if unit is None else {p.name: w for p, w in _parameters_of(unit.number, side)})


def in_parameters(targets: Mapping[str, float]) -> Mapping[str, float]:
    """Return targets as values of parameters; those that have no action unit as they are."""
    for name in targets:
        if name.startswith("AU"):
            return _in_parameters(tuple(targets.items()))
    return targets


# Each movement is asked for its parameters several times while it is planned.
@lru_cache(maxsize=4096)
def _in_parameters(targets: tuple[tuple[str, float], ...]) -> Mapping[str, float]:
    return FrozenDict(resolve_targets(dict(targets)))


def read_targets(targets: Mapping[str, float]) -> dict[str, float]:
    """Return the result of `kept_units`; for the strict reader: MisfitError names the target at fault."""
    try:
        return kept_units(targets)
    except ParameterError:
        for name, value in targets.items():
            try:
                kept_units({name: value})
            except ParameterError as error:
                raise MisfitError(error.message, name, kind=ParameterError) from None
        raise


Targets = Annotated[Mapping[str, float], Then(read_targets)]
"""Targets by action unit, muscle or alias, as files hold them; read, they are as `kept_units` writes them."""
