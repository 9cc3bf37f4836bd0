"""The standard head and one solver for all tests of the face."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver

# The six emotions by action units (facts: science/05, section 5.3), as strong as a face can show them.
EMOTIONS = {
    "happiness": {"AU6": 1.0, "AU12": 1.0},
    "sadness": {"AU1": 1.0, "AU4": 0.5, "AU15": 1.0, "AU17": 1.0},
    "anger": {"AU4": 1.0, "AU5": 0.6, "AU7": 1.0, "AU10": 0.5, "AU23": 1.0, "AU24": 0.5},
    "disgust": {"AU9": 1.0, "AU10": 1.0, "AU15": 0.5, "AU16": 0.5, "AU17": 0.5},
    "fear": {"AU1": 1.0, "AU2": 0.6, "AU4": 0.6, "AU5": 1.0, "AU20": 1.0, "AU25": 1.0},
    "surprise": {"AU1": 1.0, "AU2": 1.0, "AU5": 1.0, "AU22": 0.2, "AU25": 1.0},
}
MOUTH_MUSCLES = (
    "zygomatic_major",
    "zygomatic_minor",
    "triangularis",
    "risorius",
    "depressor_labii",
    "mentalis",
    "orbicularis_oris_funneler",
    "orbicularis_oris_presser",
    "levator_labii_nasi",
    "levator_labii_superioris",
)


def values_of(targets):
    """Values (46,) for targets by action unit, muscle or parameter; a name without a side means both."""
    values = np.array(NEUTRAL)
    for name, value in resolve_targets(targets).items():
        values[INDEX[name]] = value
    return values


@pytest.fixture(scope="session")
def head():
    return load_head("standard")


@pytest.fixture(scope="session")
def solver(head):
    return FaceSolver(head)


@pytest.fixture(scope="session")
def face(solver):
    """A function from targets (as keyword arguments) to the frame."""
    return lambda **targets: solver.solve(values_of(targets))


@pytest.fixture(scope="session")
def rest(head):
    """The level-1 skin at rest (N1, 3)."""
    return head.skin.matrix @ head.rest


@pytest.fixture(scope="session")
def fine_mirror(rest):
    """Index (N1,) of each level-1 vertex's mirror image."""
    from scipy.spatial import cKDTree

    distance, index = cKDTree(rest).query(rest * [-1.0, 1.0, 1.0])
    assert distance.max() < 0.05
    return index
