from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.muscle_coupling import Link
from risorius.core.parameters import INDEX, MUSCLES, NEUTRAL, RIVALS
from risorius.errors import InputError, ParameterError
from risorius.face.head.coupled_muscles import NO_LINKS, Links, load_links
from risorius.face.solve import FaceSolver
from tests.profiles import examples

from ..conftest import values_of

NASI, SUPERIORIS = "levator_labii_nasi", "levator_labii_superioris"


def written(tmp_path, text):
    path = tmp_path / "links.toml"
    path.write_text(text)
    return path


ROW = '[[link]]\nmuscle = "{}"\nlinked = "{}"\nweight = {}\nsource = "test"\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (ROW.format("levator_labi_nasi", SUPERIORIS, 0.5), "did you mean 'levator_labii_nasi'"),
        (ROW.format(NASI, "lip_seal", 0.5), "unknown muscle 'lip_seal'"),
        (ROW.format(NASI, SUPERIORIS, 1.1), "weight = 1.1 is out of range; expected a number from 0 to 1"),
        (ROW.format(NASI, SUPERIORIS, -0.1), "out of range"),
        (ROW.format(NASI, SUPERIORIS, "nan"), "a number"),
        (ROW.format(NASI, NASI, 0.5), "expected two different muscles"),
        (ROW.format("masseter", "mentalis", 0.5) + 'sides = "other"\n', "expected two different muscles"),
        (ROW.format("zygomatic_major", "triangularis", 0.5), "conflict"),
        (ROW.format(NASI, SUPERIORIS, 0.5) + "wieght = 1\n", "did you mean 'link.0..weight'|wieght"),
        ('[[link]]\nmuscle = "mentalis"\n', "missing"),
        ("link = [", "not a TOML file"),
    ],
)
def test_a_table_that_does_not_fit_is_named_with_its_place(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(InputError, match=message) as caught:
        load_links(path)
    assert str(caught.value).startswith(str(path))


def test_a_table_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        load_links(tmp_path / "links.toml")


@pytest.mark.parametrize("weight", [-0.1, 1.1, float("nan")])
def test_a_weight_out_of_range_is_refused_in_code_too(weight):
    with pytest.raises(ParameterError, match="weight"):
        Link(NASI, SUPERIORIS, weight, "test")


def test_a_linked_muscle_contracts_by_the_weight_at_least():
    links = Links.of([Link(NASI, SUPERIORIS, 0.5, "test")])
    values = values_of({f"{NASI}.left": 0.8, f"{SUPERIORIS}.right": 0.3})
    linked = links.apply(values, np.empty(46))
    assert linked[INDEX[f"{SUPERIORIS}.left"]] == pytest.approx(0.4)
    assert linked[INDEX[f"{SUPERIORIS}.right"]] == 0.3
    more = links.apply(values_of({NASI: 0.2, SUPERIORIS: 0.9}), np.empty(46))
    assert more[INDEX[f"{SUPERIORIS}.left"]] == 0.9


def test_a_link_with_the_other_side():
    links = Links.of([Link("mentalis", "mentalis", 0.5, "test", "other")])
    linked = links.apply(values_of({"mentalis.right": 1.0}), np.empty(46))
    assert linked[INDEX["mentalis.left"]] == 0.5
    assert linked[INDEX["mentalis.right"]] == 1.0


def test_no_links_change_nothing():
    values = values_of({"AU12": 0.4, "head_yaw": -20.0})
    np.testing.assert_array_equal(NO_LINKS.apply(values, np.empty(46)), values)


@given(st.lists(st.floats(0.0, 1.0), min_size=len(MUSCLES), max_size=len(MUSCLES)))
@examples(50, derandomize=True)
def test_the_shipped_table_only_adds_and_stays_in_range(activations):
    values = np.array(NEUTRAL)
    values[[INDEX[m.name] for m in MUSCLES]] = activations
    linked = load_links().apply(values, np.empty(46))
    assert (linked >= values).all()
    assert (linked[[INDEX[m.name] for m in MUSCLES]] <= 1.0).all()


def test_the_shipped_table_has_the_links_of_the_paper():
    linked = load_links().apply(values_of({f"{SUPERIORIS}.left": 1.0}), np.empty(46))
    assert 0.0 < linked[INDEX[f"{NASI}.left"]] < 0.5
    assert linked[INDEX[f"{NASI}.right"]] == 0.0
    brow = load_links().apply(values_of({"corrugator_supercilii.left": 1.0}), np.empty(46))
    assert 0.3 < brow[INDEX["corrugator_supercilii.right"]] < 1.0


def test_no_shipped_link_wakes_a_rival():
    for m in MUSCLES:
        linked = load_links().apply(values_of({m.name: 1.0}), np.empty(46))
        woken = [n.name for n in MUSCLES if linked[INDEX[n.name]] > 0.0]
        assert not [r for r in RIVALS[m.name] if r in woken], m.name


def test_a_solver_takes_a_table_and_parameters_stay_as_given(head, solver):
    values = values_of({"corrugator_supercilii.left": 1.0})
    free = FaceSolver(head, links=NO_LINKS).solve(values)
    linked = solver.solve(values)
    right = head.skin.matrix @ head.rest[:, 0] < -20.0
    rest = head.skin.matrix @ head.rest
    assert np.abs(free.skin - rest)[right].max() < 0.1 < np.abs(linked.skin - rest)[right].max()
    np.testing.assert_array_equal(linked.parameters, values)
