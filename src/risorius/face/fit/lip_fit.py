"""The fit of a head's lips: the measures of its mesh as functions of the lips' controls."""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations_with_replacement
from pathlib import Path

import numpy as np

from ...core.arrays import Array, Int64Array
from ...core.lips.articulators import APERTURE, FITTED
from ...core.lips.lip_rig import DEGREE, MEASURES, NONE, LipRig, rig_of_fit
from ...core.parameters import BASES, INDEX, NEUTRAL
from ..head.head import Head, load_head
from ..solve import FaceSolver
from .measure import CORNERS, Gauge

SAMPLES = 1200
# The largest activation of each control in speech.
LARGEST = {"jaw": 0.5, "open": 1.0, "upper": 0.6, "round": 0.95, "spread": 0.4, "lift": 0.3, "lower": 0.3}
# Share of the samples in which a control is at rest, because most controls rest most of the time.
AT_REST = 0.35
OPEN_MM = 0.3
# Controls whose effects are too curved for squares, alone or together.
_CURVED = ("jaw", "open", "upper", "round", "spread")
_UPPER_LIP = 51  # iBUG


@lru_cache(maxsize=8)
def fitted(file: Path, changed: int) -> LipRig:
    """Return the rig of the head in a file that was changed at a time (ns), fitted to it."""
    found = fit(load_head(file))
    return rig_of_fit(found.terms, found.coefficients)


def fit(head: Head) -> LipRig:
    """Return the least-squares fit over random settings of the controls, the same for the same head."""
    mouth = MeasuredMouth(head)
    draw = np.random.default_rng(0)
    settings = draw.random((SAMPLES, len(FITTED))) * [LARGEST[name] for name in FITTED]
    settings[draw.random(settings.shape) < AT_REST] = 0.0
    measured = np.array([mouth.measure(dict(zip(FITTED, row, strict=True))) for row in settings.tolist()])
    terms = _terms()
    products = np.prod(np.append(settings, np.ones((SAMPLES, 1)), axis=1)[:, terms], axis=2)
    coefficients = np.linalg.lstsq(products, measured, rcond=None)[0]
    # Shut lips do not show what a control adds to their gap.
    gap = MEASURES.index(APERTURE)
    apart = measured[:, gap] > OPEN_MM
    coefficients[:, gap] = np.linalg.lstsq(products[apart], measured[apart, gap], rcond=None)[0]
    return LipRig(terms, coefficients)


def _terms() -> Int64Array:
    """Return all products of up to two controls, and of up to three curved ones; shape (k, 3)."""
    every, curved = range(len(FITTED)), [list(FITTED).index(name) for name in _CURVED]
    terms = [t for n in (1, 2) for t in combinations_with_replacement(every, n)]
    terms += combinations_with_replacement(curved, DEGREE)
    return np.array([(*t, *[NONE] * (DEGREE - len(t))) for t in terms])


class MeasuredMouth:
    """A head's mouth, moved by parameters or controls and measured on its mesh, in mm from rest."""

    def __init__(self, head: Head) -> None:
        self._solver, self._gauge = FaceSolver(head), Gauge(head)
        self._rest = np.zeros(len(MEASURES))
        self._rest = self.measure_values(NEUTRAL)

    def measure(self, controls: dict[str, float]) -> Array:
        """Return `MEASURES` (6,) for controls 0..1."""
        values = NEUTRAL.copy()
        for name, amount in controls.items():
            for base, factor in FITTED[name].items():
                for p in BASES[base]:
                    values[INDEX[p.name]] += amount * factor
        return self.measure_values(np.minimum(values, 1.0))

    def measure_values(self, values: Array) -> Array:
        """Return `MEASURES` (6,) for a value of every parameter, shape (46,)."""
        frame = self._solver.solve(np.where(NEUTRAL == 0.0, np.clip(values, -90.0, 1.0), values))
        measures, points = self._gauge.measure(frame), self._gauge.landmarks(frame)
        corners = points[list(CORNERS), 1].mean()
        return (
            np.array(
                [
                    measures.jaw_drop_mm,
                    measures.lip_gap_mm,
                    measures.mouth_width_mm,
                    measures.lip_protrusion_mm,
                    points[_UPPER_LIP, 1],
                    corners,
                ]
            )
            - self._rest
        )
