"""Lip segments blended by looking ahead, and what both models make of textbook cases."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import risorius
from risorius import BlendChoices, Settings
from risorius.blend.mouth.coarticulation import LIP_MODELS, Coarticulation, without_gaps
from risorius.blend.mouth.lookahead import NARROWEST, OPPOSED, SPOILED, WIDEST, LookAheadModel
from risorius.core.movement import Dominance, LipSegment
from tests.profiles import examples

WIDTH, PROTRUSION, CORNERS, GAP = "lip_width", "lip_protrusion", "lip_corners", "lip_aperture"
ROUND = {WIDTH: -12.0, GAP: 3.0}
SPREAD = {WIDTH: 2.0, GAP: 4.0}
OPEN = {GAP: 10.0}
YIELDS = {WIDTH: 0.0, GAP: 11.0}
FREE = {"*": Dominance(0.2, 0.035, 0.035)}


def vowel(start: float, end: float, targets: dict[str, float]) -> LipSegment:
    held = {"*": Dominance(1.0, 0.055, 0.055)} | (
        {WIDTH: Dominance(1.6, 0.06, 0.055)} if WIDTH in targets else {}
    )
    return LipSegment("V", start, end, targets, dominance=held)


def consonant(start: float, end: float, yields: dict[str, float] | None = None) -> LipSegment:
    given = YIELDS if yields is None else yields
    return LipSegment("C", start, end, {GAP: 3.0}, dominance=FREE, yields=given)


def curve(
    model: str, found: list[LipSegment], times: list[float] | np.ndarray, name: str = WIDTH
) -> np.ndarray:
    made: Coarticulation = LIP_MODELS.get(model)(without_gaps(found))
    weights = made.weights(made.group(name), np.asarray(times, dtype=np.float64))
    return weights.average(made.targets(name))


def posture(found: list[LipSegment], name: str = WIDTH) -> list[float]:
    return LookAheadModel(without_gaps(found)).targets(name)[1:-1].tolist()


@st.composite
def phones(draw: st.DrawFn) -> list[LipSegment]:
    start, found = 0.0, []
    for _ in range(draw(st.integers(1, 10))):
        end = start + draw(st.floats(0.02, 0.4))
        yields = draw(st.sampled_from(({}, YIELDS, {"*": 5.0})))
        targets = {WIDTH: draw(st.floats(-10, 5)), GAP: draw(st.floats(-2, 10))}
        found.append(LipSegment("X", start, end, targets, yields=yields))
        start = end + draw(st.sampled_from((0.0, 0.05, 0.3)))
    return found


@examples(40)
@given(phones())
def test_weights_are_shares(found: list[LipSegment]) -> None:
    model = LookAheadModel(without_gaps(found))
    for name in (WIDTH, GAP, "tongue_up"):
        weights = model.weights(model.group(name), np.arange(-0.5, found[-1].end + 0.5, 0.003))
        assert weights.weight.min() >= 0.0
        assert weights.average(np.ones(len(model.targets(name)))) == pytest.approx(np.ones(weights.count))


@examples(30)
@given(phones())
def test_no_articulator_jumps(found: list[LipSegment]) -> None:
    times = np.arange(-0.3, found[-1].end + 0.3, 0.0005)
    values = curve("lookahead", found, times)
    # The fastest step is 1.875 times its mean speed, over at least 0.12 s; the range of targets is 15 mm.
    assert np.abs(np.diff(values)).max() <= 15.0 * 1.875 / 0.12 * 0.0005 * 1.001


def test_consonants_take_the_vowel_to_come() -> None:
    assert posture([consonant(0.0, 0.1), consonant(0.1, 0.2), vowel(0.2, 0.4, ROUND)]) == [-12.0] * 3


def test_before_a_pause_they_take_the_vowel_just_past() -> None:
    assert posture([vowel(0.0, 0.2, ROUND), consonant(0.2, 0.3)]) == [-12.0, -12.0]


def test_a_consonant_that_keeps_its_shape_stops_the_vowel() -> None:
    kept = consonant(0.1, 0.2, {})
    assert posture([consonant(0.0, 0.1), kept, vowel(0.2, 0.4, ROUND)]) == [0.0, 0.0, -12.0]


def test_a_consonant_alone_keeps_its_own_shape() -> None:
    assert posture([consonant(0.0, 0.1)], GAP) == [3.0]


def test_fewer_clusters_stay_distinct_in_fast_speech() -> None:
    def gap_of_consonant(seconds: float) -> float:
        found = [
            vowel(0.0, seconds, OPEN),
            consonant(seconds, 2 * seconds),
            vowel(2 * seconds, 3 * seconds, OPEN),
        ]
        return posture(found, GAP)[1]

    assert gap_of_consonant(0.15) == 3.0
    assert gap_of_consonant(0.06) == 10.0


def test_opposite_postures_are_scaled() -> None:
    lifted, lowered = {CORNERS: 4.0}, {CORNERS: -4.0}
    found = posture([vowel(0.0, 0.2, lifted), vowel(0.2, 0.4, lowered), vowel(0.4, 0.6, lowered)], CORNERS)
    assert found == pytest.approx([4.0 * (1 - OPPOSED / 2), -4.0 * (1 - OPPOSED / 2), -4.0])


def rounded(*order: dict[str, float] | None) -> list[list[float]]:
    """Return width and protrusion, by phone, as shares of their own; None is a silence."""
    found, given = [], []
    for number, targets in enumerate(order):
        if targets is not None:
            found.append(vowel(0.2 * number, 0.2 * (number + 1), targets))
            given.append(targets)
    model = LookAheadModel(without_gaps(found))
    spoken = [index for index, silent in enumerate(model._silent) if not silent]
    return [
        [
            float(model.targets(name)[i]) / own[name]
            for i, own in zip(spoken, given, strict=True)
            if name in own
        ]
        for name in (WIDTH, PROTRUSION)
    ]


OO, EE = {WIDTH: -NARROWEST, PROTRUSION: 3.4}, {WIDTH: WIDEST}
LAX_OO, LAX_EE = {WIDTH: -7.4, PROTRUSION: 1.6}, {WIDTH: 0.8}
KEPT = {GAP: 3.0}


def test_a_rounded_action_between_two_spread_ones_loses_in_width_and_protrusion() -> None:
    """Paper B, section 4.3: consecutive actions change each other's intensity."""
    both, one = 1.0 - SPOILED, 1.0 - SPOILED / 2
    assert rounded(EE, OO, EE)[1] == pytest.approx([both])
    assert rounded(EE, OO)[1] == rounded(OO, EE)[1] == pytest.approx([one])
    assert rounded(OO)[1] == pytest.approx([1.0])
    assert rounded(EE, OO, EE)[0] == pytest.approx([one, both, one])
    # Of a long vowel of two shapes, both are one action, and so is what opposes it.
    assert rounded(LAX_EE, EE, LAX_OO, OO, LAX_EE, EE)[1] == pytest.approx([both, both])


def test_a_silence_or_lips_at_rest_keep_actions_apart() -> None:
    assert rounded(EE, None, OO, None, EE)[1] == pytest.approx([1.0])
    assert rounded(EE, KEPT, OO, KEPT, EE)[1] == pytest.approx([1.0])


@pytest.mark.parametrize("rate", [110, None, 250])
@pytest.mark.parametrize(
    ("beside", "alone"), [("he who he", "who"), ("we do see", "do"), ("he knew he", "knew")]
)
def test_oo_between_two_ees_protrudes_less_than_alone(beside: str, alone: str, rate: int | None) -> None:
    """At least 15 % less, on the curves."""

    def protrusion(text: str) -> float:
        settings = Settings(fps=100, lively=False, rate=rate, blend=BlendChoices(lips="lookahead"))
        take = risorius.speak(text, text=True, settings=settings)
        assert take.utterance is not None
        phone = next(p for p in take.utterance.phones if p.symbol == "UW")
        times = (take.times >= phone.start) & (take.times <= phone.end)
        return float(take.curves["orbicularis_oris_funneler"][times].max())

    assert protrusion(beside) <= 0.85 * protrusion(alone)


@pytest.mark.parametrize("text", ["loose", "a spruce moose", "a juice"])
def test_an_s_is_round_after_its_vowel_from_nine_phones_a_second_on(text: str) -> None:
    """Paper B, section 5.2: which phones share a shape depends on the rate; `lips.toml` gives it for /s/."""

    def share(rate: int) -> float:
        settings = Settings(fps=100, lively=False, rate=rate, blend=BlendChoices(lips="lookahead"))
        take = risorius.speak(text, text=True, settings=settings)
        assert take.utterance is not None
        *_, vowel, s, _ = take.utterance.phones
        assert (vowel.symbol, s.symbol) == ("UW", "S")
        curve = take.curves["orbicularis_oris_funneler"]
        middle = curve[round(50.0 * (s.start + s.end))]
        return float(middle / curve[round(50.0 * (vowel.start + vowel.end))])

    assert share(80) < 0.2
    assert share(175) > 0.6


def test_a_posture_remains_where_there_is_no_time_for_the_next() -> None:
    def peak(seconds: float) -> float:
        found = [vowel(0.0, 1.0, OPEN), vowel(1.0, 1.0 + seconds, ROUND), vowel(1.0 + seconds, 3.0, OPEN)]
        return float(curve("lookahead", found, np.arange(0.8, 2.0, 0.005)).min())

    assert peak(0.3) == pytest.approx(-12.0)
    assert peak(0.05) > -8.0


class TestTextbook:
    """Löfqvist and others' favourites; times of the phones are ours."""

    BOTH = pytest.mark.parametrize("model", ["dominance", "lookahead"])

    @BOTH
    def test_stew_rounding_begins_in_the_s(self, model: str) -> None:
        s, t = consonant(0.5, 0.62), consonant(0.62, 0.7)
        rounded = curve(model, [s, t, vowel(0.7, 0.95, ROUND)], [0.6])
        spread = curve(model, [s, t, vowel(0.7, 0.95, SPREAD)], [0.6])
        assert rounded[0] < -2.0
        assert spread[0] > -0.01

    @BOTH
    def test_boot_is_rounded_in_its_t_and_beet_is_not(self, model: str) -> None:
        t = consonant(0.75, 0.85)
        boot = curve(model, [vowel(0.5, 0.75, ROUND), t], [0.8])
        beet = curve(model, [vowel(0.5, 0.75, SPREAD), t], [0.8])
        assert boot[0] < -4.0
        assert beet[0] > 0.0
