"""What `benchmarks/lips_published.py` finds agrees with what was published, where that is robust."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import pytest

BENCHMARKS = Path(__file__).parent.parent / "benchmarks"


@pytest.fixture(scope="module")
def published() -> ModuleType:
    sys.path.insert(0, str(BENCHMARKS))
    import lips_published

    sys.path.remove(str(BENCHMARKS))
    return lips_published


def test_focus_and_the_ends_of_phrases_lower_the_jaw_half_as_far_as_the_most_measured(
    published: ModuleType,
) -> None:
    """In running speech the whole factors multiply, and hide which vowel it is."""
    stressed, focused, final = (ours for *_, ours in published.prosody())
    assert stressed == pytest.approx(1.0 + 0.15 / 2.0, abs=0.01)
    assert focused == pytest.approx(1.0 + 0.33 / 2.0, abs=0.01)
    assert final == pytest.approx(1.0 + 0.2 / 2.0, abs=0.02)


def test_vowels_stand_in_the_published_order(published: ModuleType) -> None:
    held = published.held
    assert held("AA")["jaw"] > held("EH")["jaw"] > held("IY")["jaw"]
    assert held("IY")["width"] > held("AA")["width"] > held("AO")["width"] > held("UW")["width"]
    assert held("UW")["protrusion"] > held("AO")["protrusion"] > held("AA")["protrusion"]
    assert held("UW")["gap"] < 0.5 * held("AA")["gap"]


def test_closures_of_a_label_file_are_told_from_bursts(published: ModuleType, tmp_path: Path) -> None:
    labels = tmp_path / "a.phn"
    labels.write_text("0 1600 h#\n1600 2560 pcl\n2560 3200 p\n3200 4800 aa\n4800 5600 bcl\n")
    ((*_, share, source, ours),) = published.closures(tmp_path, (("p", "pcl"),))
    assert share == "0.60"
    assert "1 stops" in source
    assert ours == pytest.approx(0.6, abs=0.1)
