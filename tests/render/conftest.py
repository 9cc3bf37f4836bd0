"""The standard head, a solver, and one small renderer for all tests of pictures."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head import load_head
from risorius.face.solve import FaceSolver
from risorius.looks.anatomy import find_anatomy
from risorius.looks.parts import skin_surface
from risorius.render import Renderer


@pytest.fixture(scope="session")
def head():
    return load_head("standard")


@pytest.fixture(scope="session")
def face(head):
    """A function from targets (as keyword arguments) to the frame."""
    solver = FaceSolver(head)

    def solve(**targets):
        values = np.array(NEUTRAL)
        for name, value in resolve_targets(targets).items():
            values[INDEX[name]] = value
        return solver.solve(values)

    return solve


@pytest.fixture(scope="session")
def anatomy(head):
    return find_anatomy(head)


@pytest.fixture(scope="session")
def surface(head, anatomy):
    return skin_surface(head, anatomy)


@pytest.fixture(scope="session")
def renderer(head):
    return Renderer(head, (240, 240))
