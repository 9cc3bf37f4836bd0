"""Edits: what cannot be done is named; ids and causes stay; what is done and undone leaves nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from risorius.core.edits import (
    Add,
    ClearKeys,
    Delete,
    Keys,
    Move,
    Retarget,
    Stretch,
    edited,
    identified,
    is_edited,
    named,
)
from risorius.core.movement import Cause, LipSegment, ManualCurve, Movement
from risorius.core.score import Score, check_score
from risorius.core.time import on_tick
from risorius.errors import RisoriusError

DURATION = 10.0
BROWS = {"frontalis_medialis.left": 0.8, "frontalis_medialis.right": 0.8}
SMILE = {"zygomatic_major.left": 0.5}


def movement(name, start, end, channel="signals", layer="", targets=BROWS):
    cause = Cause("signals.brows", '"much"', "script:1:3")
    return Movement(channel, start, end, 0.1, 0.2, targets, id=name, layer=layer, cause=cause)


SCORE = Score(
    DURATION,
    (movement("a", 1.0, 2.0), movement("b", 3.0, 4.0), movement("c", 0.5, 9.0, "emotion", targets=SMILE)),
    (LipSegment("AA", 0.0, 10.0, {"masseter": 0.5}),),
    (ManualCurve({"mentalis.left": ((0.0, 0.1), (1.0, 0.2)), "masseter": ((0.0, 0.0), (2.0, 0.5))}),),
)

IMPOSSIBLE = [
    (Move("d", 1.0), "unknown block 'd'; expected one of a, b, c"),
    (Move("a", 10.0), "would start at 10 s, after the end at 10 s"),
    (Move("a", 3.0), "'a' and 'b' both start at 3 s"),
    (Stretch("a", end=0.5), "end = 0.5 must come after start = 1"),
    (Stretch("a", onset=-1.0), "onset = -1.0 is out of range; expected 0 to 21600 seconds"),
    (Retarget("a", {"AU1": 2.0}), "out of range"),
    (Retarget("a", {"frontalis": 1.0}), "unknown"),
    (Add("signal", 1.0, 2.0, BROWS), "unknown channel 'signal'; did you mean 'signals'"),
    (Add("lips", 1.0, 2.0, BROWS), "draw keys instead"),
    (Add("manual", 1.0, 2.0, BROWS), "draw keys instead"),
    (Add("signals", 1.0, 2.0, BROWS, id="a"), "block 'a' already exists"),
    (Add("signals", 11.0, 12.0, BROWS), "after the end"),
    (Add("signals", 1.0, 2.0, BROWS, function="bouncy"), "unknown onset function 'bouncy'"),
    (Delete("d"), "unknown block 'd'"),
    (Keys("mentalist", ((0.0, 0.1),)), "unknown muscle or parameter 'mentalist'; did you mean 'mentalis'"),
    (Keys("masseter", ()), "has no keys"),
    (Keys("masseter", ((1.0, 0.1), (1.0, 0.2))), "times must increase"),
    (Keys("masseter", ((1.0, 1.1),)), "out of range"),
    (Keys("masseter", ((1.0, 0.1), (11.0, 0.2))), "outside the clip"),
    (ClearKeys("mentalis.right"), "no curve is drawn by hand for 'mentalis.right'"),
]


@pytest.mark.parametrize(("edit", "message"), IMPOSSIBLE)
def test_an_impossible_edit_is_named(edit, message):
    with pytest.raises(RisoriusError) as caught:
        edited(SCORE, edit)
    assert message in str(caught.value)


seconds = st.floats(0.0, 9.9)
names = st.sampled_from("abc")
values = st.floats(0.0, 1.0)
ticks = seconds.map(on_tick)
keys = st.lists(st.tuples(ticks, values), min_size=1, max_size=5, unique_by=lambda key: key[0]).map(
    lambda pairs: tuple(sorted(pairs))
)
edits = st.one_of(
    st.builds(Move, names, seconds),
    st.builds(Stretch, names, seconds, st.floats(5.0, 12.0), values, values),
    st.builds(Retarget, names, st.fixed_dictionaries({"AU2.left": values}), seconds),
    st.builds(Add, st.sampled_from(["signals", "emotion", "head"]), seconds, st.just(10.0), st.just(BROWS)),
    st.builds(Delete, names),
    st.builds(Keys, st.sampled_from(["masseter", "mentalis.left", "head_yaw"]), keys, st.booleans()),
    st.builds(ClearKeys, st.sampled_from(["masseter", "mentalis.left"])),
)


def after(score, some):
    for edit in some:
        try:
            score = edited(score, named(score, edit))
        except RisoriusError:
            continue
    return score


@given(st.lists(edits, max_size=8))
def test_every_edit_leaves_a_score_that_can_be_performed_and_ids_that_are_its_own(some):
    score = after(SCORE, some)
    check_score(score)
    ids = [m.id for m in score.movements]
    assert len(set(ids)) == len(ids)
    assert all(name in "abc" or name.startswith("hand.") for name in ids)
    assert score.lips is SCORE.lips


@given(st.lists(edits, max_size=8))
def test_an_untouched_movement_is_the_same_and_a_touched_one_says_so(some):
    before = {m.id: m for m in SCORE.movements}
    touched = {getattr(edit, "movement", None) for edit in some}
    for m in after(SCORE, some).movements:
        if m.id in before and m.id not in touched:
            assert m is before[m.id]
        assert is_edited(m) == (m is not before.get(m.id))
        if m.id in before:
            assert m.cause.rule == "signals.brows"
            assert m.cause.place.count("by hand") <= 1


@given(names, seconds)
def test_a_block_moved_there_and_back_is_where_it_was(name, start):
    origin = next(m for m in SCORE.movements if m.id == name)
    there = _or_none(SCORE, Move(name, start))
    assume(there is not None)
    back = edited(there, Move(name, origin.start))
    (found,) = (m for m in back.movements if m.id == name)
    assert found.end == pytest.approx(origin.end)
    assert replace(found, cause=origin.cause, end=origin.end) == origin


def _or_none(score, edit):
    try:
        return edited(score, edit)
    except RisoriusError:
        return None


@given(seconds, st.floats(0.01, 3.0))
def test_a_block_added_and_deleted_leaves_the_score_as_it_was(start, length):
    added = edited(SCORE, Add("signals", start, start + length, {"AU1": 0.5}))
    assert edited(added, Delete("hand.1")) == SCORE
    (found,) = (m for m in added.movements if m.id == "hand.1")
    assert found.parameters == dict.fromkeys(BROWS, 0.5)
    assert found.cause.rule == "by hand"


@given(keys)
def test_keys_stand_in_place_of_those_drawn_before_and_can_be_taken_back(drawn):
    score = edited(SCORE, Keys("masseter", drawn))
    held = [curve for curve in score.manual if "masseter" in curve.keys]
    assert [curve.keys["masseter"] for curve in held] == [drawn]
    assert any("mentalis.left" in curve.keys for curve in score.manual)
    assert edited(score, ClearKeys("masseter")) == edited(SCORE, ClearKeys("masseter"))


@given(keys)
def test_keys_of_a_name_without_side_are_of_both(drawn):
    score = edited(SCORE, Keys("mentalis", drawn))
    held = {name: keys for curve in score.manual for name, keys in curve.keys.items()}
    assert held["mentalis.left"] == held["mentalis.right"] == drawn
    cleared = edited(edited(score, ClearKeys("mentalis.left")), ClearKeys("mentalis.right"))
    assert edited(score, ClearKeys("mentalis")) == cleared


def test_an_edit_is_the_same_again_on_a_score_planned_anew():
    fixed = named(edited(SCORE, Add("signals", 1.5, 2.5, BROWS)), Add("signals", 4.0, 5.0, BROWS))
    assert fixed.id == "hand.2"
    assert [m.id for m in edited(SCORE, fixed).movements if m.id.startswith("hand")] == ["hand.2"]


def test_a_layer_and_a_function_can_be_chosen():
    score = edited(SCORE, Add("signals", 5.0, 6.0, BROWS, layer="", function="linear"))
    (found,) = (m for m in score.movements if m.id == "hand.1")
    assert (found.layer, found.function) == ("", "linear")


IDS = [
    ((("x", 0.0), ("x", 1.0), ("x", 2.0)), ("x", "x#2", "x#3")),
    ((("", 0.0), ("", 1.0)), ("signals@0.000", "signals@1.000")),
    ((("x", 0.0), ("x#2", 1.0), ("x", 2.0)), ("x", "x#2", "x#3")),
]


@pytest.mark.parametrize(("given_", "expected"), IDS)
def test_every_movement_gets_an_id_of_its_own(given_, expected):
    score = Score(DURATION, tuple(movement(name, start, start + 0.5) for name, start in given_))
    assert tuple(m.id for m in identified(score).movements) == expected


def test_ids_that_are_there_stay():
    assert identified(SCORE) == SCORE


def test_keys_are_read_to_the_nearest_tick():
    score = edited(SCORE, Keys("masseter", ((0.1 + 0.2, 0.5),)))
    assert score.manual[-1].keys["masseter"] == ((0.3, 0.5),)
