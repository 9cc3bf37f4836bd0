"""Paper A's demonstration, section 6 and Figure 7, on the curves that are shown."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.core.arrays import Array
from risorius.rules.emotions import emotion

DEMO = Path(__file__).parent.parent / "examples" / "demo.xml"
SMILE = ("zygomatic_major.left", "zygomatic_major.right")


def demonstration(*without: str) -> risorius.Take:
    """The demonstration by paper A's own policy and function, 200 frames a second."""
    blend = risorius.BlendChoices(conflict="inhibit", onset_function="exponential")
    settings = risorius.Settings(fps=Fraction(200), blend=blend, without=without)
    return risorius.speak(DEMO, settings=settings)


@pytest.fixture(scope="module")
def figure_7() -> risorius.Take:
    return demonstration()


def within(take: risorius.Take, name: str, start: float, end: float) -> Array:
    times = take.times
    return take.curves[name][(times >= start) & (times < end)]


def word(take: risorius.Take, text: str) -> tuple[float, float]:
    assert take.utterance is not None
    found = next(w for w in take.utterance.words if w.text.lower() == text)
    return found.start, found.end


def test_full_happiness_is_full() -> None:
    assert emotion("happiness").targets(1.0)[SMILE[0]] == 1.0
    take = risorius.speak("Aha.", emotion={"happiness": 1.0})
    assert max(take.curves[SMILE[0]]) == pytest.approx(1.0)


def conflict(take: risorius.Take) -> float:
    """Return when the funneler of /R/ in "very" is active: above the threshold of 0.1, after "it"."""
    rounded = (take.curves["orbicularis_oris_funneler"] > 0.1) & (take.times > word(take, "it")[1])
    return float(take.times[rounded][0])


def test_the_smile_rises_undisturbed_while_nothing_conflicts(figure_7: risorius.Take) -> None:
    # phi+ of section 4, from 1 s on, until the fall before the conflict.
    onset = emotion("happiness").onset
    times = figure_7.times[(figure_7.times >= 1.0) & (figure_7.times < conflict(figure_7) - 0.25)]
    alone = np.minimum(2.0 ** ((times - 1.0) / onset) - 1.0, 1.0)
    for name in SMILE:
        shown = within(figure_7, name, 1.0, conflict(figure_7) - 0.25)
        assert np.abs(shown - alone).max() < 0.02
        assert shown.max() > 0.7


def test_it_gives_way_before_the_lips_round_and_no_faster_than_it_can(figure_7: risorius.Take) -> None:
    at = conflict(figure_7)
    smile = figure_7.curves[SMILE[0]]
    before = (figure_7.times > at - 0.2) & (figure_7.times <= at)
    # Psi of section 6, recomputed, with the shortest offset of the muscle.
    psi = 2.0 ** ((at - figure_7.times[before]) / 0.25) - 1.0
    lips = demonstration("emotion").curves[SMILE[0]]  # what speech draws the corners aside itself
    own = lips.max()
    assert (smile[before] <= psi + own).all()
    assert np.abs(smile[before] - psi)[: len(psi) // 2].max() < 0.05
    rounded = figure_7.curves["orbicularis_oris_funneler"] > 0.1
    assert smile[rounded] == pytest.approx(lips[rounded], abs=1e-6)


def test_it_returns_to_full_when_all_is_said(figure_7: risorius.Take) -> None:
    assert figure_7.utterance is not None
    last = figure_7.utterance.words[-1].end
    assert max(within(figure_7, SMILE[0], last, 4.0)) == pytest.approx(1.0, abs=1e-6)


def test_surprise_becomes_happiness_without_a_jump(figure_7: risorius.Take) -> None:
    steps = {n: np.abs(np.diff(figure_7.curves[n])).max() for n in ("frontalis_medialis.left", *SMILE)}
    assert max(steps.values()) < 0.05
