"""A kernel's digest changes with all that its code is made of, and with nothing else."""

from __future__ import annotations

import importlib.util
import linecache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numba import typeof, types

from risorius.core.kernels import kernel_source
from risorius.render.inputs import SceneLight
from risorius.render.shade import shade

SOURCE = '''
from typing import NamedTuple
from risorius.core.kernels import vec
from risorius.core.kernels.four import four_at
from risorius.core.kernels.jit import device, fast_device, inlined, kernel, summing_kernel

FACTOR, TABLE = 2.0, (1, 2.5)

class Pair(NamedTuple):
    first: float
    second: float

@device
def scaled(x, factor=3.0):
    return x * factor

@inlined
def shifted(x):
    return x + FACTOR

def beside(x):
    return x

@kernel
def run(values, out):
    """Do it."""
    # Why.
    for k in range(len(values)):
        out[k] = scaled(shifted(values[k])) + TABLE[1] + vec.saturate(Pair(k, 1.0).second)
'''


def digest(folder: Path, source: str) -> str:
    file = folder / f"kernels_{len(list(folder.iterdir()))}.py"
    file.write_text(source)
    specification = importlib.util.spec_from_file_location("kernels", file)
    assert specification
    assert specification.loader
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return kernel_source.digest(module.run)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("FACTOR, TABLE = 2.0", "FACTOR, TABLE = 2.5"),
        ("(1, 2.5)", "(1, 3.5)"),
        ("x * factor", "x / factor"),
        ("factor=3.0", "factor=4.0"),
        ("@device\ndef scaled", "@fast_device\ndef scaled"),
        ("@kernel", "@summing_kernel"),
        ("vec.saturate", "vec.unit"),
        ("first: float", "zeroth: float"),
        ("for k in range(len(values))", "for k in range(len(out))"),
        ("def shifted(x):\n    return x +", "def shifted(x):\n    return x -"),
        ("+ TABLE[1]", "+ four_at(values, 0)"),
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


def test_the_lowering_of_vectors_is_in_every_digest(monkeypatch: pytest.MonkeyPatch) -> None:
    before = kernel_source.digest(shade)
    kernel_source._generators.cache_clear()
    monkeypatch.setattr(kernel_source, "_file_text", lambda _: "changed")
    try:
        assert kernel_source.digest(shade) != before
    finally:
        kernel_source._generators.cache_clear()


def test_what_cannot_be_told_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="cannot be told"):
        digest(tmp_path, SOURCE.replace("(1, 2.5)", "{1: 2.5}"))


def test_fields_and_their_types_are_in_the_text_of_a_signature() -> None:
    light: Any = typeof(SceneLight(*[np.zeros((2, 3), np.float32)] * 6, 1.0, 2.0))
    text = kernel_source.signature_text((light, types.int64))
    assert text.endswith(", int64")
    assert f"{SceneLight._fields[0]}: array(float32, 2d, C)" in text


def test_sources_are_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    kernel_source.digest(shade)
    monkeypatch.setattr(linecache, "getlines", None)
    kernel_source.digest(shade)
