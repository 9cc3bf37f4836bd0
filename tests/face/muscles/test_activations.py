from __future__ import annotations

import numpy as np
import pytest

from risorius.core.parameters import INDEX, parameters_named
from risorius.face.muscles.activations import YIELDS
from risorius.face.muscles.muscles import MuscleFields

from ..conftest import values_of

PRESSER = "orbicularis_oris_presser"


@pytest.mark.parametrize("pair", YIELDS, ids="-".join)
def test_muscles_that_hold_each_other_contract_less_but_never_less_for_more(head, pair):
    fields, share = MuscleFields.of(head), YIELDS[pair]
    first, second = (INDEX[parameters_named(name)[0].name] for name in pair)
    steps = np.linspace(0.0, 1.0, 21)
    for other in (0.0, 0.5, 1.0):
        acting = np.array([fields.activations(values_of({pair[0]: a, pair[1]: other})) for a in steps])
        assert (np.diff(acting[:, first]) >= -1e-12).all()
        assert (np.diff(acting[:, second]) <= 1e-12).all()
        assert acting[-1, first] == pytest.approx(1.0 - share * other)
        assert acting[-1, second] == pytest.approx(other * (1.0 - share * other))


def test_no_muscle_yields_more_than_a_half():
    for name in {muscle for pair in YIELDS for muscle in pair}:
        assert sum(share for pair, share in YIELDS.items() if name in pair) <= 0.5


def test_a_muscle_without_sides_yields_half_to_one_side(head):
    acting = MuscleFields.of(head).activations(values_of({PRESSER: 1.0, "mentalis.left": 1.0}))
    share = YIELDS[PRESSER, "mentalis"]
    assert acting[INDEX[PRESSER]] == pytest.approx(1.0 - 0.5 * share)
    assert acting[INDEX["mentalis.left"]] == pytest.approx(1.0 - share)
    assert acting[INDEX["mentalis.right"]] == 0.0
