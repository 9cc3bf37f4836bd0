"""The lips' articulators, which speech moves, in millimetres that can be measured on any head.

Unlike muscles they mean the same on every face. Each head has a fit (`lip_rig`) that turns them into muscles.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ...errors import ParameterError, unknown
from ..parameters import INDEX, PARAMETERS, check_value

JAW, APERTURE, WIDTH, PROTRUSION = "jaw_drop", "lip_aperture", "lip_width", "lip_protrusion"
UPPER, CORNERS = "upper_lip", "lip_corners"
SHORTEST_CLOSURE = 0.04
"""Seconds: a shorter contact of the lips would be over before an eye could see it (DESIGN, section 3)."""


@dataclass(frozen=True, slots=True)
class Articulator:
    """One articulator: its range in mm, and the muscles (without side) that follow it.

    All are 0 at rest. The lower lip's tuck (`lip_tuck`) and the tongue (`tongue_up` its tip, `tongue_out`,
    `tongue_back` its body) are parameters and need no fit.
    """

    name: str
    low: float
    high: float
    follow: tuple[str, ...]


ARTICULATORS: Mapping[str, Articulator] = MappingProxyType(
    {
        a.name: a
        for a in (
            # How far the jaw alone drops the chin.
            Articulator(JAW, 0.0, 32.0, ("masseter",)),
            # The gap between the inner lips at the midline; below zero they are pressed together.
            Articulator(
                APERTURE,
                -6.0,
                32.0,
                (
                    "depressor_labii",
                    "orbicularis_oris_presser",
                    "mentalis",
                    "lip_seal",
                    "levator_labii_superioris",
                ),
            ),
            # From corner to corner, against rest.
            Articulator(WIDTH, -16.0, 10.0, ("zygomatic_major", "risorius")),
            # How far the middle of both lips comes forward.
            Articulator(PROTRUSION, -8.0, 6.0, ("orbicularis_oris_funneler",)),
            # How far the upper lip is raised beyond its third of what the lips open.
            Articulator(UPPER, 0.0, 4.0, ("levator_labii_superioris",)),
            # How far the corners are raised.
            Articulator(CORNERS, -4.0, 4.0, ("triangularis",)),
        )
    }
)

CONTROLS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "jaw": {"masseter": 1.0},
        "open": {"depressor_labii": 1.0},
        "upper": {"levator_labii_superioris": 1.0},
        "round": {"orbicularis_oris_funneler": 1.0},
        # Not the risorius: beside a triangularis, which pulls in nearly the same direction, it does not widen
        # the mouth, so that vowels were too narrow in sadness. The zygomatic major agrees with a smile.
        "spread": {"zygomatic_major": 1.0},
        "lift": {"zygomatic_major": 1.0},
        "lower": {"triangularis": 1.0},
    }
)
"""Each control moves some muscles, on both sides, by their factors."""

FITTED: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {**CONTROLS, "open": {"depressor_labii": 1.0, "levator_labii_superioris": 0.25}}
)
"""The variables of a head's fit. There the lower lip opens together with the upper one, as it mostly does."""

SEAL_MM = 8.0
"""mm that a seal (`lip_seal`) of 1 takes from a gap; it shuts any (DESIGN, section 2)."""
WIDEST_MM = 80.0
"""mm: a seal leaves a gap of at most this times what it lacks to 1; so it shuts wide gaps evenly, too."""

PRESSING: Mapping[str, float] = MappingProxyType({"orbicularis_oris_presser": 0.1, "mentalis": 0.03})
"""Activation per millimetre of aperture below zero: the lips press, which no gap shows."""


def leader(parameter: str) -> str:
    """Return the articulator that a parameter follows, or the parameter's own name."""
    return _LEADERS.get(parameter, parameter)


# A parameter that follows two articulators is led by the first.
_LEADERS = {
    p.name: a.name
    for a in reversed(list(ARTICULATORS.values()))
    for base in a.follow
    for p in PARAMETERS
    if p.base == base
}


def check_lip_target(name: str, value: float) -> None:
    """Raise ParameterError unless `name` is an articulator or a parameter, and `value` within its range."""
    articulator = ARTICULATORS.get(name)
    if articulator is None:
        if name not in INDEX:
            raise ParameterError(unknown("articulator or parameter", name, (*ARTICULATORS, *INDEX)))
        check_value(PARAMETERS[INDEX[name]], value)
    elif not articulator.low <= value <= articulator.high:
        raise ParameterError(
            f"{name} = {value} is out of range; expected {articulator.low:g} to {articulator.high:g} mm"
        )


def within_range(name: str, value: float) -> float:
    """Return the nearest value to `value` in the range of an articulator or parameter."""
    limits = ARTICULATORS.get(name) or PARAMETERS[INDEX[name]]
    return min(max(value, limits.low), limits.high)
