"""The way to closures and from them: in time, and no faster than lips are."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.blend.mouth.closure_speed import CHIN, ClosureSpeedLimit, smooth_minimum
from risorius.blend.mouth.contact import SEAL, TUCK, contact_goals
from risorius.blend.mouth.tradeoffs import checked, tradeoffs
from risorius.core.lips.lip_rig import OPENING, gap_left
from risorius.core.movement import LipSegment, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score
from risorius.errors import InputError
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.fit.lip_fit import MeasuredMouth
from risorius.face.head.head import load_head
from risorius.rules.lips import lip_table

FASTEST = tradeoffs().opening.fastest
TIMES = np.arange(0.0, 2.0, 0.001)
ASKED = 320.0
"""mm/s: what the lips' gap may come to (facts: lips, 8)."""


@pytest.mark.parametrize(
    ("order", "named"),
    [
        (("opening", "rounding", "tukc", "seal"), "unknown demand 'tukc'; did you mean 'tuck'"),
        (("opening", "rounding", "seal"), "expected each of"),
        (("seal", "opening", "rounding", "tuck"), "last 'seal', which never gives way"),
    ],
)
def test_an_order_that_gives_up_a_closure_is_refused(order: tuple[str, ...], named: str) -> None:
    with pytest.raises(InputError, match=named):
        checked(replace(tradeoffs(), order=order))


def approach(*spans: tuple[float, float], contact: str = SEAL) -> ClosureSpeedLimit:
    return ClosureSpeedLimit(contact_goals([LipSegment("x", a, b, {contact: 1.0}) for a, b in spans]))


@given(edges=st.lists(st.floats(0.1, 1.9), min_size=4, max_size=8, unique=True))
def test_the_way_is_shut_in_closures_and_never_too_fast(edges: list[float]) -> None:
    spans = [(a, b) for a, b in list(pairwise(sorted(edges)))[::2] if b - a > 0.05]
    most = np.minimum(approach(*spans).most(TIMES), 20.0)
    for start, end in spans:
        assert (most[(start <= TIMES) & (end >= TIMES)] <= 1e-9).all()
    assert np.abs(np.diff(most)).max(initial=0.0) <= 0.001 * FASTEST * 1.001


def test_a_vowel_between_closures_opens_as_far_as_time_allows() -> None:
    tops = [
        approach((0.5, 0.6), (0.6 + gap, 1.0 + gap)).most(np.array([0.6 + gap / 2.0]))[0]
        for gap in (0.03, 0.06, 0.12, 0.3)
    ]
    assert tops == sorted(tops)
    assert tops[0] > 0.0
    assert tops[-1] == pytest.approx(FASTEST * 0.3 / 4.0, rel=0.1)


@given(a=st.floats(-5.0, 20.0), b=st.floats(0.0, 20.0))
def test_the_smooth_minimum_is_near_the_least(a: float, b: float) -> None:
    found = float(smooth_minimum(np.array(a), np.array(b), 3.0))
    assert min(a, b) - 0.75 - 1e-9 <= found <= min(a, b)


def test_rounding_gives_way_beside_a_tuck() -> None:
    near = approach((0.9, 1.1), contact=TUCK)
    shape = near.reached(lambda _: np.full(len(TIMES), 2.0), TIMES)
    assert shape("lip_protrusion")[1000] == pytest.approx(2.0 * tradeoffs().rounding.remaining)
    assert shape("lip_protrusion")[0] == 2.0
    assert shape("jaw_drop")[1000] == pytest.approx(2.0, abs=0.2)


def test_the_chin_stays_higher_where_closures_keep_the_lips_from_opening() -> None:
    asked = {"lip_aperture": 12.0, "jaw_drop": 8.0}
    shape = approach((0.9, 1.1)).reached(lambda name: np.full(len(TIMES), asked[name]), TIMES)
    missing = asked["lip_aperture"] - np.maximum(shape("lip_aperture"), 0.0)
    assert missing.max() == pytest.approx(12.0)
    assert shape("jaw_drop")[0] == pytest.approx(8.0)
    assert shape("jaw_drop") == pytest.approx(8.0 - CHIN * missing, abs=0.15)


def said(phones: str, each: float, model: str, *movements: Movement) -> Score:
    """A score of phones that last equally long, from 0.5 s on."""
    table, lips = lip_table(), []
    for number, phone in enumerate(phones.split()):
        shape, start = table.shape(phone), 0.5 + number * each
        held = table.holdings[shape.lip_class]
        asked = (shape.targets, held.limits, held.dominance)
        own = {"yields": held.yields, "precision": held.precision}
        lips.append(LipSegment(phone, start, start + each, *asked, **own))
    return Score(1.0 + len(lips) * each, movements, tuple(lips), settings=BlendSettings("graded", lips=model))


SURPRISE = Movement(
    "emotion",
    0.0,
    9.0,
    0.3,
    0.3,
    {"masseter": 0.8, "depressor_labii.left": 0.5, "depressor_labii.right": 0.5},
)


@pytest.mark.parametrize("model", ["dominance", "lookahead"])
@pytest.mark.parametrize("each", [0.05, 0.08, 0.12, 0.2])
@pytest.mark.parametrize("movements", [(), (SURPRISE,)])
def test_the_gap_is_no_faster_than_people_are(
    model: str, each: float, movements: tuple[Movement, ...]
) -> None:
    rig = load_lip_rig()
    score = said("M AA P AE T B IY M AO R P EH N M", each, model, *movements)
    times = np.arange(0.3, score.duration, 0.005)
    values = blend.at(score, times, rig)
    gap = gap_left(rig.gap({n: values[:, INDEX[n]] for n in OPENING}), values[:, INDEX[SEAL]])
    speed = np.abs(np.diff(gap)) / 0.005
    assert np.percentile(speed, 99.0) <= ASKED
    assert speed.max() <= ASKED * (1.2 if movements else 1.0)
    closed = [s for s in score.lips if SEAL in s.targets]
    middles = blend.at(score, np.array([(s.start + s.end) / 2.0 for s in closed]), rig)
    assert (middles[:, INDEX[SEAL]] == 1.0).all()


@pytest.mark.parametrize(("model", "most"), [("effort", ASKED), ("dominance", ASKED), ("lookahead", 400.0)])
@pytest.mark.parametrize("phones", ["AA V M AA", "AA V P AO", "IH V B AA"])
def test_a_lip_goes_evenly_from_the_teeth_to_a_closure(phones: str, model: str, most: float) -> None:
    score = said(phones, 0.05, model)
    mouth = MeasuredMouth(load_head())
    times = np.arange(0.5, 0.65, 0.005)
    gap = [mouth.measure_values(v)[1] for v in blend.at(score, times, load_lip_rig())]
    assert np.abs(np.diff(gap)).max() / 0.005 <= most
