"""The standard head, its anatomy and its skin, for all tests of what is drawn."""

from __future__ import annotations

import pytest

from risorius.face.head.head import load_head
from risorius.looks.anatomy import find_anatomy
from risorius.looks.parts import skin_surface


@pytest.fixture(scope="session")
def head():
    return load_head("standard")


@pytest.fixture(scope="session")
def anatomy(head):
    return find_anatomy(head)


@pytest.fixture(scope="session")
def surface(head, anatomy):
    return skin_surface(head, anatomy)
