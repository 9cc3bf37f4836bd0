"""The lips' rig inverts the measures of its head: each control is where its polynomial is what is wanted."""

from itertools import combinations_with_replacement

import numpy as np

from risorius.core.lips.articulators import CONTROLS
from risorius.core.lips.lip_rig import DEGREE, MEASURES, NONE, LipRig, solve

RNG = np.random.default_rng(3)
COUNT = 400


def polynomials() -> tuple[list[np.ndarray], np.ndarray]:
    """Return rising polynomials, some of them flat at first, and a place for each."""
    first, second, third = RNG.uniform(0.02, 6.0, COUNT), RNG.uniform(0.0, 4.0, COUNT), np.zeros(COUNT)
    third[::2] = RNG.uniform(0.0, 2.0, len(third[::2]))
    return [np.zeros(COUNT), first, second, third], RNG.uniform(0.01, 1.0, COUNT)


def test_a_control_is_where_its_measure_is_what_is_wanted() -> None:
    powers, places = polynomials()
    wanted = sum(power * places**k for k, power in enumerate(powers))
    assert np.abs(solve(powers, wanted) - places).max() < 1e-9
    beyond = solve(powers, 1.5 * sum(powers))
    assert (beyond == 1.0).all()
    assert (solve(powers, np.zeros(COUNT)) == 0.0).all()


def test_a_solution_does_not_depend_on_which_others_are_wanted() -> None:
    powers, places = polynomials()
    wanted = sum(power * places**k for k, power in enumerate(powers))
    together = solve(powers, wanted)
    for k in range(0, COUNT, 37):
        alone = solve([power[k : k + 1] for power in powers], wanted[k : k + 1])
        assert alone[0] == together[k]


def test_a_measure_is_the_sum_of_its_terms() -> None:
    terms = np.array(list(combinations_with_replacement(range(NONE + 1), DEGREE)))
    rig = LipRig(terms, RNG.uniform(-4.0, 4.0, (len(terms), len(MEASURES))))
    controls = {name: RNG.uniform(0.0, 1.0, COUNT) for name in CONTROLS}
    column = np.array([*controls.values(), np.ones(COUNT)])
    for number, measure in enumerate(MEASURES):
        expected = rig.coefficients[:, number] @ column[terms].prod(axis=1)
        assert np.abs(rig.passive(measure, controls) - expected).max() < 1e-12
