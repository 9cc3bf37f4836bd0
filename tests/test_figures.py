"""The documentation's figures show the papers' values, and all of them are there."""

from __future__ import annotations

import importlib.util
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from risorius.core.parameters import INDEX

DOCS = Path(__file__).parent.parent / "docs"
PAGE = DOCS / "combination.md"
PICTURES = sorted(p for kind in ("png", "webp") for p in (DOCS / "pictures").glob(f"*.{kind}"))
DRAWN = re.findall(r'^    "([\w-]+)": \w+,$', (DOCS / "drawing.py").read_text(), re.MULTILINE)
WITH_FACES = {"demo", "paper-a"}
LARGEST, LARGEST_SHEET, LARGEST_FILM = 200_000, 900_000, 3_000_000


@pytest.fixture(scope="module")
def figures() -> Iterator[ModuleType]:
    spec = importlib.util.spec_from_file_location("figures", DOCS / "figures.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        # What the figures show must not need what draws them.
        patch.setitem(sys.modules, "matplotlib", None)
        spec.loader.exec_module(module)
        yield module


def test_figure_4_rises_for_two_seconds_holds_and_falls_for_three(figures: ModuleType) -> None:
    times = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.5, 7.0])
    half = np.sqrt(2.0) - 1.0  # 2^½ - 1: an exponential onset and offset are below one half at their middle
    assert figures.curve(figures.FIGURE_4, times) == pytest.approx([0, half, 1, 1, 1, half, 0], abs=1e-12)


def test_figure_5_follows_the_first_movement_and_is_released_to_half(figures: ModuleType) -> None:
    before, release, plateau = (
        np.linspace(1.5, 3.0, 31),
        np.linspace(3.0, 4.1, 111),
        np.linspace(4.2, 7.0, 29),
    )
    assert figures.curve(figures.FIGURE_5, before) == pytest.approx(np.ones(31))
    assert (np.diff(figures.curve(figures.FIGURE_5, release)) < 0.0).all()
    assert figures.curve(figures.FIGURE_5, plateau) == pytest.approx(np.full(29, 0.5))
    assert figures.curve(figures.FIGURE_5, np.array([9.0])) == pytest.approx([0.0])


def test_the_printed_formula_jumps_where_ours_does_not(figures: ModuleType) -> None:
    times = np.linspace(2.9, 4.3, 14_001)
    printed = figures.printed_overlap(*figures.FIGURE_5, times)
    ours = figures.curve(figures.FIGURE_5, times)
    assert np.abs(np.diff(printed)).max() == pytest.approx(0.5, abs=1e-3)
    assert np.abs(np.diff(ours)).max() < 1e-3
    # Printed: from 1 down to a - b = 0.5 at once, then up to (1 + d²)/(1 + d) with d = 0.5.
    assert printed[times > 3.0].max() == pytest.approx(1.25 / 1.5, abs=1e-3)


def test_a_printed_movement_alone_is_ours_where_it_is_long_enough(figures: ModuleType) -> None:
    times = np.linspace(0.0, 7.0, 701)
    ours = figures.curve(figures.FIGURE_4, times)
    assert figures.printed_alone(figures.FIGURE_4, times) == pytest.approx(ours, abs=1e-12)
    short = figures.printed_alone(figures.TOO_SHORT, times)
    assert np.abs(np.diff(short)).max() > 0.5


def test_a_movement_within_another_resumes(figures: ModuleType) -> None:
    outer, inner = figures.NESTED
    value, target = outer.targets[figures.ZYGOMATIC], inner.targets[figures.ZYGOMATIC]
    times = np.array([2.0, 3.8, 5.0, outer.end])
    assert figures.curve(figures.NESTED, times) == pytest.approx([value, target, value, 0.0])


def test_figure_6_the_smile_is_gone_while_the_lips_are_round(figures: ModuleType) -> None:
    times = np.linspace(0.0, 7.0, 7001)
    found = figures.figure_6(times)
    (smile, speech), (smile_after, speech_after) = found["before"], found["after"]
    assert speech_after == pytest.approx(speech)
    rounded = speech > 0.1 + 1e-9
    assert rounded.any()
    assert (smile_after[rounded] == 0.0).all()
    lowered = smile_after < smile - 1e-9
    first, last = times[rounded][[0, -1]]
    assert first - 0.25 <= times[lowered][0] < first
    assert last < times[lowered][-1] <= last + 0.25 + 1e-3


@pytest.mark.parametrize(
    ("title", "presser", "raiser"),
    [
        ("Lip Presser", 1.0, 0.0),
        ("Lip Raiser", 0.0, 1.0),
        ("their plain sum", 1.0, 1.0),
        ("ours (attenuate)", 1.0, 0.2),
        ("ours (inhibit)", 1.0, 0.0),
    ],
)
def test_figure_3_the_higher_priority_presses(
    figures: ModuleType, title: str, presser: float, raiser: float
) -> None:
    values = figures.pressed_and_raised(*figures.FACES[title]).performance.values[1]
    assert values[INDEX[figures.PRESSER]] == pytest.approx(presser)
    for side in ("left", "right"):
        assert values[INDEX[f"{figures.RAISER}.{side}"]] == pytest.approx(raiser)


def test_onset_functions_meet_every_target(figures: ModuleType) -> None:
    for name in figures.FUNCTIONS:
        plateaus = np.array([1.25, 2.75, 4.5])
        values = figures.curve(figures.FUNCTION_OVERLAP, plateaus, onset_function=name)
        assert values == pytest.approx([0.5, 1.0, 0.3]), name


def test_every_policy_says_the_smiling_sentence_with_the_same_closures(figures: ModuleType) -> None:
    takes = {name: figures.smiling(name) for name in figures.POLICIES}
    smiles = {name: take.performance[figures.ZYGOMATIC].sum() for name, take in takes.items()}
    assert sorted(smiles, key=lambda name: smiles[name]) == ["inhibit", "graded", "attenuate", "sum"]
    closed = takes["inhibit"].performance["lip_seal"] > 0.98
    assert closed.any()
    for take in takes.values():
        assert take.performance["lip_seal"][closed].min() > 0.97


def test_the_demonstration_is_the_papers(figures: ModuleType) -> None:
    take = figures.demonstration()
    assert take.duration == pytest.approx(4.0)
    assert take.utterance is not None
    assert [w.text for w in take.utterance.words] == ["Oh", "really", "I", "like", "it", "very", "much"]
    wanted = figures.silent(take)
    assert wanted["frontalis_medialis"][100] == pytest.approx(1.0)  # 0.5 s: surprise
    assert wanted[figures.ZYGOMATIC][600] > 0.8  # 3 s: happiness


def test_all_pictures_are_shown_and_small() -> None:
    pages = "".join(p.read_text() for p in (*DOCS.glob("*.md"), DOCS.parent / "README.md"))
    assert len(PICTURES) >= 9
    for picture in PICTURES:
        assert f"pictures/{picture.name})" in pages, picture.name
        largest = LARGEST if picture.stem in set(DRAWN) - WITH_FACES else LARGEST_SHEET
        largest = LARGEST_FILM if picture.name == "demo.webp" else largest
        assert picture.stat().st_size <= largest, picture.name


def test_all_figures_are_drawn() -> None:
    assert len(DRAWN) >= 9
    assert set(DRAWN) <= {p.stem for p in PICTURES}


@pytest.mark.parametrize("marker", ["policies", "policies by emotion", "open speech"])
def test_measured_tables_are_filled(marker: str) -> None:
    _, found, rest = PAGE.read_text().partition(f"<!-- {marker} -->")
    table, closed, _ = rest.partition(f"<!-- /{marker} -->")
    assert found
    assert closed
    assert table.count("\n|") >= 6
