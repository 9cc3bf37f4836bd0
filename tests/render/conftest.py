"""The standard head, a solver, and one small renderer for all tests of pictures."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.render.software_renderer import SoftwareRenderer


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
def model(head):
    return head_model(head)


@pytest.fixture(scope="session")
def anatomy(model):
    return model.anatomy


@pytest.fixture(scope="session")
def renderer(model):
    return SoftwareRenderer(model, (240, 240))
