"""The standard head has the proportions of people, as `benchmarks/proportions.py` measures them."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from risorius.face.head.head import load_head

BENCHMARKS = Path(__file__).parent.parent / "benchmarks"

# Bounds in mm: what is expected, or within 2 %.
BOUNDS = {
    "face width at mouth level": (107.3, 111.7),
    "face width at mid chin": (85.7, 89.3),
    "face width at the nose's base": (115.6, 120.4),
    "mouth width": (45.0, 47.6),
    "inner brow over the eyes, as drawn": (18.0, 20.0),
    "inner brow over the eyes, point 22": (18.0, 20.0),
    "brow's tail from the midline, as drawn": (48.0, 52.0),
    "brow's tail from the midline, point 26": (48.0, 52.0),
    "hairline over the pupil": (60.7, 63.3),
    "glabella to occiput": (170.5, 177.5),
    "ear length": (50.0, 52.0),
}


@pytest.fixture(scope="module")
def proportions() -> dict[str, float]:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(BENCHMARKS))
        module = importlib.import_module("proportions")
    rest = module.Rest(load_head())
    return {name: measure(rest) for name, (measure, _) in module.MEASURES.items()}


def test_every_measure_has_bounds(proportions: dict[str, float]) -> None:
    assert set(proportions) == set(BOUNDS)


@pytest.mark.parametrize("measure", BOUNDS)
def test_the_standard_head_is_proportioned_as_people_are(proportions: dict[str, float], measure: str) -> None:
    low, high = BOUNDS[measure]
    assert low <= proportions[measure] <= high
