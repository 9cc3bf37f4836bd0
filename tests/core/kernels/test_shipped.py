"""Kernels of the package's file: they fit, they are what would be compiled, and nothing depends on them."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numba import typeof
from numba.core import event
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import cpu_target

from risorius.core.kernels import kernel_source, shipped
from risorius.looks.normals import face_normals

POINTS = np.random.default_rng(1).normal(size=(9, 3)).astype(np.float32)
FACES = np.arange(12, dtype=np.int32).reshape(3, 4) % len(POINTS)


@pytest.fixture
def anew() -> Iterator[None]:
    """Read the file anew in a test, and after it."""
    _forget()
    yield
    _forget()


def _forget() -> None:
    shipped._archive.cache_clear()
    shipped._contents.cache_clear()


def arguments() -> tuple[Any, ...]:
    return POINTS, FACES, np.zeros((3, 3), np.float32)


def loaded() -> Any:
    kinds = tuple(typeof(argument) for argument in arguments())
    return shipped.load(face_normals.py_func, kinds, cpu_target.target_context)  # type: ignore[attr-defined]


def test_the_first_pictures_compile_nothing() -> None:
    if json.loads(shipped._archive().read(shipped.INDEX))["fits"] != shipped.machine():
        pytest.skip("the file is for another machine or another numba")
    assert shipped.covers("realistic")
    assert shipped.covers("explaining")
    assert shipped.needed("realistic") > 40


def test_code_of_the_file_does_what_is_compiled() -> None:
    made = loaded()
    assert made is not None
    with global_compiler_lock:
        compiled = face_normals._compiler.compile(made.signature.args, None)  # type: ignore[attr-defined]
    results = []
    for function in (made.entry_point, compiled.entry_point, face_normals.py_func):  # type: ignore[attr-defined]
        inputs = arguments()
        function(*inputs)
        results.append(inputs[2])
    assert results[0].tobytes() == results[1].tobytes()
    np.testing.assert_allclose(results[0], results[2], rtol=1e-5)


def test_a_changed_kernel_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel_source, "digest", lambda _: "0" * 32)
    assert loaded() is None
    assert shipped.name_of(face_normals) in shipped.stale()
    assert not shipped.covers("realistic")


@pytest.mark.usefixtures("anew")
def test_a_file_for_another_numba_is_not_read_further(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shipped.numba, "__version__", "0.0")
    assert loaded() is None
    assert shipped.needed("realistic") > 40


@pytest.mark.usefixtures("anew")
@pytest.mark.parametrize("damage", ["missing", "not an archive", "no index", "cut off"])
def test_a_damaged_file_costs_only_time(damage: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, whole = tmp_path / "kernels.zip", shipped.FILE.read_bytes()
    written = io.BytesIO()
    zipfile.ZipFile(written, "w").close()
    contents = {"not an archive": b"kernels", "no index": written.getvalue(), "cut off": whole[:5000]}
    if damage in contents:
        file.write_bytes(contents[damage])
    monkeypatch.setattr(shipped, "FILE", file)
    assert loaded() is None
    assert not shipped.covers("realistic")
    assert shipped.needed("realistic") == 0


def test_a_kernel_of_the_file_is_stored_and_not_looked_for_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shipped.numba.config, "CACHE_DIR", str(tmp_path))
    kinds = tuple(typeof(argument) for argument in arguments())
    cache = shipped.KernelCache(face_normals.py_func)  # type: ignore[attr-defined]
    with event.install_recorder(shipped.STORED) as told:
        made = cache.load_overload(kinds, cpu_target.target_context)
    assert len(told.buffer) == 2  # its start and its end
    assert len(list(tmp_path.rglob("*.nbc"))) == 1
    monkeypatch.setattr(shipped, "load", None)
    again = cache.load_overload(kinds, cpu_target.target_context)
    assert again.signature == made.signature
