"""Lips and tongue against the teeth: they meet where they must and pierce nowhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from risorius.face.contact.teeth import LONG, SHORT, Teeth
from risorius.face.contact.tooth_row import ToothRow
from risorius.face.head.head import load_head
from risorius.face.muscles.jaw import Jaw
from risorius.face.solve import FaceSolver
from risorius.rules.emotions import emotion
from tests.profiles import everyday

from ..conftest import values_of
from ..flips import Flips
from ..teeth import TeethTester

PIERCED = 0.3  # mm
CHEEK = ["orbicularis_oris_funneler", "zygomatic_major"]
EMOTIONS = ("happiness", "sadness", "anger", "disgust", "fear", "surprise")
# What the demonstration sentences do to the mouth, one phone each.
PHONES = {
    "closure": {"masseter": 0.1, "lip_seal": 1.0},
    "f": {"masseter": 0.08, "lip_tuck": 1.0},
    "th": {"masseter": 0.12, "tongue_up": 0.15, "tongue_out": 1.0, "depressor_labii": 0.2},
    "l": {"masseter": 0.15, "tongue_up": 1.0, "depressor_labii": 0.25},
    "o": {"masseter": 0.45, "orbicularis_oris_funneler": 0.45},
    "a": {"masseter": 0.5, "depressor_labii": 0.2, "tongue_back": 0.5},
}


@pytest.fixture(scope="module")
def tester(head):
    return TeethTester(head)


@pytest.fixture(scope="module")
def teeth(head):
    return Teeth.of(head)


def foremost(mesh):
    """The foremost vertex (3,) of a row's crowns."""
    crowns = mesh.vertices[mesh.material < 0.5]
    return crowns[crowns[:, 2].argmax()]


def alone(count):
    """Vertices (count, 2) that are kept out of the teeth each by itself."""
    return np.repeat(np.arange(count, dtype=np.uint32), 2).reshape(-1, 2)


def under(name, phone):
    return {**emotion(name).targets(1.0), **PHONES[phone]}


@pytest.mark.parametrize("phone", PHONES)
@pytest.mark.parametrize("name", EMOTIONS)
def test_nothing_pierces_the_teeth_in_speech_under_emotion(solver, tester, name, phone):
    frame = solver.solve(values_of(under(name, phone)))
    assert tester.in_lips(frame) <= PIERCED
    assert tester.lips_in(frame) <= PIERCED
    assert max(tester.tongue_in(frame)) <= PIERCED


def test_the_tester_finds_what_pierces(solver, tester, head):
    frame = solver.solve(values_of({}))
    frame.skin[:, 2] -= 4.0
    frame.tongue[:, 2] += 4.0
    assert tester.in_lips(frame) > 1.0
    assert max(tester.tongue_in(frame)) > 1.0


@pytest.mark.parametrize("out", [0.2, 0.4, 0.6, 0.8])
def test_on_its_way_out_the_tongue_passes_over_the_lower_teeth(solver, tester, out):
    frame = solver.solve(values_of({**PHONES["th"], "tongue_out": out}))
    assert max(tester.tongue_in(frame)) <= PIERCED


def test_the_tongue_rises_to_the_ridge_for_l(solver, head):
    frame, flat = (solver.solve(values_of({**PHONES["l"], "tongue_up": up})) for up in (1.0, 0.0))
    tip = np.argsort(flat.tongue[:, 2])[-20:]
    assert (frame.tongue[tip, 1] - flat.tongue[tip, 1]).min() > 6.0
    edge = head.teeth_upper.vertices[head.teeth_upper.material < 0.5][:, 1].min()
    assert frame.tongue[:, 1].max() > edge + 3.0


@pytest.mark.parametrize("opening", [0.0, 0.4, 1.0])
def test_what_is_far_from_the_teeth_stays(teeth, opening):
    far = np.array([[0.0, -65.0, 60.0], [50.0, -65.0, 0.0], [0.0, 40.0, 0.0], [0.0, -66.0, -60.0]])
    moved = far.copy()
    whole = replace(teeth, places=alone(len(far)))
    whole.keep_out(moved, opening)
    np.testing.assert_array_equal(moved, far)


@pytest.mark.parametrize("muscle", everyday(CHEEK, CHEEK[1:]))
def test_long_faces_of_a_cheek_do_not_cut_the_teeth_of_a_wide_jaw(muscle):
    head = load_head("olaf")
    frame = FaceSolver(head).solve(values_of({muscle: 1.0, "masseter": 1.0}))
    assert TeethTester(head).in_lips(frame) <= PIERCED


def test_a_long_edge_is_kept_out_by_its_middle_evenly_as_it_grows(teeth, head):
    """Both ends stand before a tooth and the middle lies in it; what is shorter has no middle."""
    middle = foremost(head.teeth_upper) - [0.0, -2.0, 1.0]
    pushed = []
    for length in np.linspace(SHORT - 0.5, LONG + 1.0, 30):
        ends = middle + length * np.array([[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]])
        moved = ends.copy()
        replace(teeth, places=np.array([[0, 1]], np.uint32)).keep_out(moved, 0.0)
        pushed.append(np.linalg.norm(moved - ends, axis=1).max())
    assert pushed[0] == 0.0
    assert pushed[-1] > 0.5
    assert np.abs(np.diff(pushed)).max() < 0.15


def test_a_corner_that_is_pushed_before_the_teeth_is_not_folded_over(solver, head):
    """Where an open mouth's corner was drawn back against the teeth, its layers lay all but flat."""
    pose = {"risorius": 0.648, "levator_labii_nasi": 0.891, "triangularis": 0.16, "masseter": 0.807}
    found, _ = Flips(head).with_areas(solver.solve(values_of(pose)).skin)
    assert len(found) == 0


def test_a_tongue_behind_the_teeth_stays_and_one_in_them_does_not(teeth, head):
    crown = foremost(head.teeth_upper)
    behind, inside = crown - [0.0, 0.0, 12.0], crown - [0.0, 0.0, 0.5]
    moved = np.array([behind, inside])
    teeth.keep_in(moved, 0.0)
    np.testing.assert_array_equal(moved[0], behind)
    assert np.linalg.norm(moved[1] - inside) > 0.5


def test_at_rest_the_skin_is_before_the_teeth(teeth, rest):
    kept = rest.copy()
    teeth.keep_out(kept, 0.0)
    np.testing.assert_array_equal(kept, rest)


def test_the_lower_row_goes_with_the_jaw(teeth, head):
    front = foremost(head.teeth_lower)
    inside = front - [0.0, 0.0, 1.0]
    turned = Jaw.of(head).carry(inside[None], 0.5)
    single = replace(teeth, places=alone(1))
    closed, opened = inside[None].copy(), turned.copy()
    single.keep_out(closed, 0.0)
    single.keep_out(opened, 0.5)
    assert (
        closed[0, 2] > front[2] - PIERCED
    )  # layers of skin keep their order, and the deepest gives way most
    np.testing.assert_allclose(Jaw.of(head).carry(closed, 0.5), opened, atol=1e-9)


def test_a_row_is_as_wide_as_its_teeth(head):
    row = ToothRow.of(head.teeth_upper, 1.0)
    crowns = head.teeth_upper.vertices[head.teeth_upper.material < 0.5]
    assert row.front.max() >= np.hypot(crowns[:, 0], crowns[:, 2] - row.middle[0]).max() - 0.5
    assert row.edge[np.abs(row.edge) < 900.0].min() == pytest.approx(crowns[:, 1].min())


def test_the_coarse_table_leaves_nothing_out(teeth):
    """Around every place the coarse table bounds what the fine one says."""
    draw = np.random.default_rng(3)
    for row in (teeth.upper, teeth.lower):
        anywhere = replace(row, around=np.array([-np.inf, np.inf, 0.0]) + np.zeros_like(row.around))
        points = draw.uniform([-40.0, -85.0, -40.0], [40.0, -45.0, 35.0], (20_000, 3))
        fast, slow = points.copy(), points.copy()
        places = alone(len(points))
        for r, skin in ((row, fast), (anywhere, slow)):
            both = replace(teeth, upper=r, lower=r, places=places)
            both.keep_out(skin, 0.4)
        np.testing.assert_array_equal(fast, slow)
        fast, slow = points.copy(), points.copy()
        for r, tongue in ((row, fast), (anywhere, slow)):
            replace(teeth, upper=r, lower=r).keep_in(tongue, 0.4)
        np.testing.assert_array_equal(fast, slow)
        assert (np.abs(slow - points).max(axis=1) > 0.0).sum() > 50
