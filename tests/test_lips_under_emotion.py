"""A fast part of `benchmarks/lips.py`: every phone is read from the lips under a display at full strength."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from risorius.settings import Settings

BENCHMARKS = Path(__file__).parent.parent / "benchmarks"


@pytest.fixture(scope="module")
def measures() -> ModuleType:
    sys.path.insert(0, str(BENCHMARKS))
    import lips_measures

    sys.path.remove(str(BENCHMARKS))
    return lips_measures


@pytest.mark.parametrize("display", ["happiness", "surprise", "disgust"])
def test_phones_are_read_and_the_display_is_seen(measures: ModuleType, display: str) -> None:
    spoken = measures.Spoken.of("We have five more waves.", Settings(lively=False))
    found = measures.measure(spoken, display)
    assert found.closures == found.closed == 1
    assert found.tucks == found.touching > 0
    assert min(found.deviation) >= 0.85
    assert min(found.correlation) >= 0.85
    assert min(found.narrower_mm) >= 3.0
    assert min(found.further_mm) >= 1.0
    assert max(found.sibilant_jaw_mm) <= 4.0
    assert np.sum(found.upper_kept) >= 0.9 * np.sum(found.upper_whole)
