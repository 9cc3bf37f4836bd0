import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, PARAMETERS, RIVALS
from risorius.errors import InputError
from risorius.reading.toml import parse
from risorius.rules.emotions import emotions
from risorius.rules.fuzzy import FuzzyTable, blend_units, blended, fuzzy_table
from risorius.rules.fuzzy_sets import check_centres, concluded, memberships
from risorius.rules.load import DATA

CENTRES = (-1.0, -0.5, 0.0, 0.5, 1.0)
PAIRS = list(itertools.permutations(emotions(), 2))
INTENSITY = st.floats(0.0, 1.0)


@pytest.mark.parametrize("centres", [[], [1.0], [0.0, 0.0], [1.0, 0.5]])
def test_centres_that_do_not_rise_are_refused(centres: list[float]) -> None:
    with pytest.raises(InputError, match="do not increase"):
        check_centres(centres)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('one = "anger"', 'one = "angst"', r"fuzzy.toml:\d+:1: unknown emotion 'angst'"),
        ('other = "fear"', 'other = "surprise"', "surprise is paired with itself"),
        ("upper = [0.2, 0.45, 0.8, 1.0, 1.0]", "upper = [0.2]", "expected a list of 5"),
        ("upper = [0.2, 0.45", "upper = [1.2, 0.45", "out of range"),
    ],
)
def test_bad_tables_are_refused(old: str, new: str, message: str) -> None:
    text = (DATA / "fuzzy.toml").read_text()
    assert old in text
    with pytest.raises(InputError, match=message):
        parse(FuzzyTable, text.replace(old, new, 1), "fuzzy.toml")


@given(st.floats(-2.0, 2.0))
def test_memberships_add_up_to_one(value: float) -> None:
    found = memberships(value, CENTRES)
    assert sum(found) == pytest.approx(1.0)
    assert all(0.0 <= m <= 1.0 for m in found)


@given(st.floats(-1.0, 1.0), st.floats(0.0, 0.1))
def test_conclusions_are_continuous_and_rise_with_their_consequents(value: float, step: float) -> None:
    rising = (0.0, 0.1, 0.5, 0.5, 1.0)
    change = concluded(value + step, CENTRES, rising) - concluded(value, CENTRES, rising)
    assert -1e-12 <= change <= step + 1e-12


def test_at_a_set_s_centre_its_rule_alone_speaks() -> None:
    assert [concluded(c, CENTRES, (0.3, 0.1, 0.9, 0.2, 0.7)) for c in CENTRES] == [0.3, 0.1, 0.9, 0.2, 0.7]


@given(st.sampled_from(PAIRS), INTENSITY, INTENSITY, st.floats(0.0, 0.05))
def test_a_blend_rises_with_its_own_emotion_and_falls_with_the_other(
    pair: tuple[str, str], own: float, other: float, step: float
) -> None:
    name, rival = pair
    base = blend_units(name, {name: own, rival: other})
    stronger = blend_units(name, {name: min(own + step, 1.0), rival: other})
    against = blend_units(name, {name: own, rival: min(other + step, 1.0)})
    for parameter, value in base.items():
        assert abs(stronger[parameter]) >= abs(value) - 1e-12
        assert abs(against[parameter]) <= abs(value) + 1e-12


@given(st.sampled_from(PAIRS), INTENSITY, INTENSITY, st.floats(0.0, 1e-3))
def test_blends_have_no_jumps(pair: tuple[str, str], own: float, other: float, step: float) -> None:
    name, rival = pair
    before = blended({name: own, rival: other})
    after = blended({name: min(own + step, 1.0), rival: max(other - step, 0.0)})
    # Where another of two rivals becomes the stronger one they change places.
    for p in before.keys() & after.keys():
        assert abs(after[p] - before[p]) <= 12.0 * step * PARAMETERS[INDEX[p]].high + 1e-9


@given(st.sampled_from(list(emotions())), INTENSITY)
def test_alone_or_beside_nothing_an_emotion_is_whole(name: str, intensity: float) -> None:
    whole = emotions()[name].shown_units(intensity)
    assert blend_units(name, {name: intensity}) == whole
    other = next(n for n in emotions() if n != name)
    assert blend_units(name, {name: intensity, other: 0.0}) == pytest.approx(whole)


def test_happiness_and_sadness_share_the_face() -> None:
    both = blended({"happiness": 0.8, "sadness": 0.8})
    sad, happy = emotions()["sadness"].targets(0.8), emotions()["happiness"].targets(0.8)
    assert both["frontalis_medialis.left"] == pytest.approx(sad["frontalis_medialis.left"])
    assert both["zygomatic_major.left"] == pytest.approx(happy["zygomatic_major.left"])
    assert both["orbicularis_oculi_orbitalis.left"] < 0.5 * happy["orbicularis_oculi_orbitalis.left"]


@pytest.mark.parametrize("shares", [(0.7, 0.7), (0.4, 0.9), (1.0, 0.35)])
@pytest.mark.parametrize("pair", [("happiness", "sadness"), ("disgust", "surprise"), ("fear", "pride")])
def test_of_rivals_of_two_emotions_the_weaker_stays_at_rest(
    pair: tuple[str, str], shares: tuple[float, float]
) -> None:
    company = dict(zip(pair, shares, strict=True))
    both = blended(company)
    own = [resolve_targets(blend_units(name, company)) for name in pair]
    rivals = [(one, other) for one in both for other in RIVALS[one] if both.get(other)]
    assert all(any(t.get(one) and t.get(other) for t in own) for one, other in rivals)
    for parameter, value in both.items():
        assert abs(value) == max(abs(t.get(parameter, 0.0)) for t in own)


def test_a_smile_and_grief_in_one_tag_do_not_pull_the_corners_both_ways() -> None:
    both = blended({"happiness": 0.7, "sadness": 0.7})
    assert both["zygomatic_major.left"] == pytest.approx(0.7)
    assert not {"triangularis.left", "triangularis.right", "mentalis.left"} & both.keys()


def test_what_one_emotion_contracts_together_it_keeps_in_company() -> None:
    table = emotions()["disgust"].targets(1.0)
    kept = [(a, b) for a in table for b in RIVALS[a] if table[a] and table.get(b)]
    both = blended({"disgust": 1.0, "boredom": 0.05})
    assert all(both[a] and both[b] for a, b in kept)


def test_a_pair_is_found_both_ways_round() -> None:
    table = fuzzy_table()
    assert table.keeps("sadness", "happiness").lower == table.pair[0].other_lower
    assert table.keeps("pride", "doubt") is table.default
