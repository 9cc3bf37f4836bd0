"""A kernel's digest changes with all that its code is made of, and with nothing else."""

from __future__ import annotations

import importlib.util
import linecache
from pathlib import Path

import pytest

from risorius.machine.kernels import digest as module
from risorius.machine.kernels.declared import kernels
from risorius.render import shade

SOURCE = '''
from typing import Annotated, NamedTuple
from risorius.core.arrays import Array
from risorius.machine.kernels import vec
from risorius.machine.kernels.jit import device, kernel

FACTOR, TABLE = 2.0, (1, 2.5)

class Pair(NamedTuple):
    first: Annotated[float, "f8"]
    second: Annotated[float, "f8"]

@device()
def scaled(x, factor=3.0):
    return x * factor

@device(inlined=True)
def shifted(x):
    return x + FACTOR

def beside(x):
    return x

@kernel("f8[:], Pair, f8[:]")
def run(values, pair, out):
    """Do it."""
    # Why.
    for k in range(len(values)):
        out[k] = scaled(shifted(values[k])) + TABLE[1] + vec.saturate(pair.second)
'''


def digest(folder: Path, source: str) -> str:
    file = folder / f"kernels_{len(list(folder.iterdir()))}.py"
    file.write_text(source)
    specification = importlib.util.spec_from_file_location("kernels", file)
    assert specification
    assert specification.loader
    loaded = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(loaded)
    return module.digest(loaded.run.declared)


@pytest.fixture(autouse=True)
def forget():
    """Forget the kernel of the text, which does not belong to the package."""
    yield
    kernels.pop(".run", None)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("FACTOR, TABLE = 2.0", "FACTOR, TABLE = 2.5"),
        ("(1, 2.5)", "(1, 3.5)"),
        ("x * factor", "x / factor"),
        ("factor=3.0", "factor=4.0"),
        ("@device()\ndef scaled", '@device("fast")\ndef scaled'),
        ("@device(inlined=True)", "@device()"),
        ('f8[:]")', 'f8[:]", arithmetic="sums")'),
        ('"f8[:], Pair, f8[:]"', '"f8[:], Pair, f4[:]"'),
        ('first: Annotated[float, "f8"]', 'first: Annotated[float, "f4"]'),
        ("first: ", "zeroth: "),
        ("vec.saturate", "vec.unit"),
        ("for k in range(len(values))", "for k in range(len(out))"),
        ("def shifted(x):\n    return x +", "def shifted(x):\n    return x -"),
    ],
)
def test_what_a_kernel_reaches_is_in_its_digest(tmp_path: Path, before: str, after: str) -> None:
    assert before in SOURCE
    assert digest(tmp_path, SOURCE.replace(before, after)) != digest(tmp_path, SOURCE)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("# Why.", "# Because."),
        ("Do it.", "Do that."),
        ("def beside(x):\n    return x", "def beside(x):\n    return -x"),
        ("FACTOR, TABLE", "OTHER = 1\n\nFACTOR, TABLE"),
    ],
)
def test_what_changes_no_code_is_not(tmp_path: Path, before: str, after: str) -> None:
    assert before in SOURCE
    assert digest(tmp_path, SOURCE.replace(before, after)) == digest(tmp_path, SOURCE)


def test_what_cannot_be_told_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="cannot be told"):
        digest(tmp_path, SOURCE.replace("(1, 2.5)", "{1: 2.5}"))


def test_sources_are_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    before = module.digest(shade.shade.declared)
    monkeypatch.setattr(linecache, "getlines", None)
    assert module.digest(shade.shade.declared) == before
