"""The lips' rig inverts the measures of its head: each control is where its polynomial is what is wanted."""

import numpy as np

from risorius.core.lip_rig import _solve

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
    assert np.abs(_solve(powers, wanted) - places).max() < 1e-9
    beyond = _solve(powers, 1.5 * sum(powers))
    assert (beyond == 1.0).all()
    assert (_solve(powers, np.zeros(COUNT)) == 0.0).all()


def test_a_solution_does_not_depend_on_which_others_are_wanted() -> None:
    powers, places = polynomials()
    wanted = sum(power * places**k for k, power in enumerate(powers))
    together = _solve(powers, wanted)
    for k in range(0, COUNT, 37):
        alone = _solve([power[k : k + 1] for power in powers], wanted[k : k + 1])
        assert alone[0] == together[k]
