"""Machine code comes from the package, from the cache, or from numba if the source was edited."""

from __future__ import annotations

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from risorius.errors import RisoriusError
from risorius.face.muscles.activations import activate
from risorius.machine import cache_folder
from risorius.machine.kernels import store
from risorius.machine.kernels.build import import_all
from risorius.machine.kernels.declared import kernels

ROOT = Path(cache_folder.ROOT).parents[1]
NORMALS = """
import numpy as np
from risorius.looks.normals import face_normals
out = np.zeros((1, 3), np.float32)
face_normals(np.eye(3, dtype=np.float32), np.array([[0, 1, 2, 2]], np.int32), out)
print(out[0].tolist())
"""


def run(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    command, variables = [sys.executable, "-c", code], {**os.environ, **environment}
    return subprocess.run(command, env=variables, capture_output=True, text=True, check=True)


@pytest.fixture
def sources(tmp_path: Path) -> Path:
    """A copy of the sources alone, without machine code."""
    copied = tmp_path / "src" / "risorius"
    for path in cache_folder.ROOT.rglob("*.py"):
        made = copied / path.relative_to(cache_folder.ROOT)
        made.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, made)
    return copied


def test_an_edited_source_is_compiled_again_and_kept(sources: Path, tmp_path: Path) -> None:
    variables = {"PYTHONPATH": str(sources.parent), cache_folder.VARIABLE: str(tmp_path / "cache")}
    first = run(NORMALS, **variables)
    assert first.stderr.count("risorius: compiling") == 1
    assert "looks.normals.face_normals" in first.stderr
    again = run(NORMALS, **variables)
    assert (again.stdout, again.stderr) == (first.stdout, "")
    file = sources / "looks" / "normals.py"
    text = file.read_text()
    assert "cross(first, second)" in text
    file.write_text(text.replace("cross(first, second)", "cross(second, first)"))
    changed = run(NORMALS, **variables)
    assert changed.stdout != first.stdout
    assert "compiling" in changed.stderr


def test_a_missing_numba_is_said_with_the_extra_that_brings_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache_folder, "PACKAGED", tmp_path / "none")
    monkeypatch.setenv(cache_folder.VARIABLE, str(tmp_path))
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    with pytest.raises(RisoriusError, match=re.escape("pip install 'risorius[compile]'")):
        store.find(activate.declared)


def test_an_installed_package_reads_no_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kernel = activate.declared
    known = {"sources": {"all": "0123"}, "kernels": {kernel.name: "abcd"}}
    (tmp_path / cache_folder.INDEX).write_text(json.dumps(known))
    (tmp_path / f"{kernel.name}-abcd-{store.of_this_machine(kernel.wide)}.o").write_bytes(b"code")
    monkeypatch.setattr(cache_folder, "PACKAGED", tmp_path)
    cache_folder.built.cache_clear()
    cache_folder.sources.cache_clear()
    try:
        assert store.find(kernel) == b"code"
        assert cache_folder.sources() == "0123"
    finally:
        cache_folder.built.cache_clear()
        cache_folder.sources.cache_clear()


def test_the_face_runs_without_numba() -> None:
    code = (
        "import sys, risorius; next(iter(risorius.pose({'AU12': 1.0}).faces()));"
        "print(*sorted({m.partition('.')[0] for m in sys.modules} & {'numba', 'llvmlite'}))"
    )
    assert run(code).stdout.split() == ["llvmlite"]


def test_importing_the_solver_loads_no_compiler() -> None:
    code = "import sys, risorius.face.solve; print({'numba', 'llvmlite'} & set(sys.modules))"
    assert run(code).stdout.strip() == "set()"


def test_only_published_parts_of_numba_are_used() -> None:
    private = re.compile(
        r"\bnumba\.(?!carray|cfunc|extending\b|from_dtype|njit|types\b)\w+|from numba import (?!types$)"
    )
    for path in cache_folder.ROOT.rglob("*.py"):
        for line in path.read_text(encoding="utf-8").splitlines():
            assert not private.search(line), f"{path}: {line}"


@pytest.mark.full
def test_a_wheel_has_the_code_of_all_kernels(tmp_path: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--no-deps",
        "--no-build-isolation",
        "-q",
        "-w",
        str(tmp_path),
    ]
    subprocess.run([*command, str(ROOT)], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    assert not wheel.name.endswith("-any.whl")
    with zipfile.ZipFile(wheel) as archive:
        known = json.loads(archive.read("risorius/machine/code/index.json"))
        names = set(archive.namelist())
    import_all()
    assert set(known["kernels"]) == set(kernels)
    for name, made_of in known["kernels"].items():
        assert any(found.startswith(f"risorius/machine/code/{name}-{made_of}-") for found in names)
