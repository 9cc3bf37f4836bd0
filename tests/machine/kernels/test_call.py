"""Kernels refuse what they are not declared for, and agree with their Python functions."""

from __future__ import annotations

import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from risorius.core.arrays import Array
from risorius.face.muscles.activations import activate
from risorius.face.muscles.jaw import turn_about
from risorius.face.numerics.robust_fit import subtract_moves
from risorius.face.numerics.sparse import carry, without_fourth
from risorius.face.skin.network import pull
from risorius.looks.normals import face_normals, vertex_normals
from risorius.machine.kernels.call import Kernel
from risorius.render.camera import project
from risorius.render.shade import shade

RNG = np.random.default_rng(0)
POINTS, OUT = RNG.normal(size=(5, 4)), np.zeros((5, 3), np.float32)


def python(kernel: Any) -> Any:
    """Return the function that a kernel was made of."""
    assert isinstance(kernel, Kernel)
    return kernel.declared.function


@pytest.mark.parametrize(
    ("arguments", "fault"),
    [
        ((POINTS.astype(np.float32), OUT), "'points' is an array of float32 of the shape (5, 4)"),
        ((POINTS[0], OUT), "'points' is an array of float64 of the shape (4,)"),
        ((RNG.normal(size=(5, 3)), OUT), "'points' is an array of float64 of the shape (5, 3)"),
        ((POINTS[::2], OUT), "not in C order"),
        ((np.asfortranarray(POINTS), OUT), "not in C order"),
        ((POINTS.astype(">f8"), OUT), "'points' is an array of >f8"),
        ((POINTS, OUT.astype(np.float64)), "'out' is an array of float64"),
        ((POINTS.tolist(), OUT), "'points' is of the type list"),
        ((None, OUT), "'points' is of the type NoneType"),
        ((POINTS,), "takes 2 arguments (points, out), not 1"),
        ((POINTS, OUT, OUT), "takes 2 arguments (points, out), not 3"),
    ],
)
def test_what_a_kernel_is_not_declared_for_is_refused(arguments: tuple[Any, ...], fault: str) -> None:
    with pytest.raises(TypeError) as caught:
        without_fourth(*arguments)
    assert fault in str(caught.value)
    assert "face.numerics.sparse.without_fourth" in str(caught.value)


def test_numbers_of_other_kinds_are_refused() -> None:
    entries = np.zeros(6, np.uint32), np.zeros(0, np.uint32), np.zeros(0)
    with pytest.raises(TypeError, match=r"face\.skin\.network\.pull"):
        pull(*entries, POINTS, "far", np.zeros((5, 4)))


def test_tuples_of_other_lengths_are_refused() -> None:
    with pytest.raises(TypeError, match="tuples of as many values as declared"):
        shade((1, 2), None, None, None, None, None, OUT)


def test_arrays_of_subclasses_and_numbers_of_numpy_are_taken(tmp_path: Path) -> None:
    mapped = np.lib.format.open_memmap(tmp_path / "a.npy", "w+", np.float64, (5, 4))
    mapped[:] = POINTS
    out = np.zeros((5, 3), np.float32)
    without_fourth(mapped, out)
    np.testing.assert_array_equal(out, POINTS[:, :3].astype(np.float32))


def test_a_kernel_of_several_signatures_takes_each() -> None:
    turn, about = np.eye(3)[[1, 2, 0]], np.array([1.0, 2.0, 3.0])
    for kind in (np.float64, np.float32):
        out = np.zeros((5, 3), kind)
        turn_about(turn, about, np.ascontiguousarray(POINTS[:, :3]), out)
        np.testing.assert_allclose(out, about + (POINTS[:, :3] - about) @ turn.T, rtol=1e-6)


def cases() -> dict[str, tuple[Any, list[Any]]]:
    """Return kernels with arguments, of which some are written to."""
    faces = np.array([[0, 1, 2, 2], [2, 1, 3, 3], [3, 1, 4, 0]], np.int32)
    corners = POINTS[:, :3].astype(np.float32)
    starts, around = np.array([0, 1, 4, 6, 8, 9], np.int32), np.array([0, 0, 1, 2, 0, 1, 1, 2, 2], np.int32)
    pairs, holding = np.array([[0, 3], [2, 1]], np.uint32), np.array([[1, 2]], np.uint32)
    region = np.array([4, 0, 2], np.int32)
    return {
        "activations": (activate, [pairs, holding, np.array([0.4]), RNG.random((2, 5)), np.zeros((3, 7))]),
        "sums": (carry, [region, RNG.normal(size=(6, 3)), RNG.normal(size=(6, 4)), np.zeros((3, 3)), POINTS]),
        "normals of faces": (face_normals, [corners, faces, np.zeros((3, 3), np.float32)]),
        "normals of vertices": (
            vertex_normals,
            [RNG.normal(size=(3, 3)).astype(np.float32), starts, around, np.zeros((5, 3), np.float32)],
        ),
        "camera": (
            project,
            [corners, np.eye(4, dtype=np.float32)[:3], np.zeros((5, 2), np.int32), np.zeros(5, np.float32)],
        ),
        "result": (
            subtract_moves,
            [
                RNG.normal(size=(4, 3, 2)),
                RNG.normal(size=(4, 3)),
                RNG.normal(size=2),
                np.zeros((4, 3)),
                np.zeros(4),
            ],
        ),
    }


@pytest.mark.parametrize("name", cases())
def test_a_kernel_agrees_with_its_python_function(name: str) -> None:
    kernel, arguments = cases()[name]
    copies = [np.copy(argument) for argument in arguments]
    found, expected = kernel(*arguments), python(kernel)(*copies)
    assert (found is None) == (expected is None)
    if found is not None:
        assert found == pytest.approx(float(expected), rel=1e-6)
    for one, other in zip(arguments, copies, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-5, atol=1e-6)


def test_threads_run_kernels_at_the_same_time() -> None:
    points: Array = RNG.normal(size=(4000, 4))
    results = [np.zeros((4000, 3), np.float32) for _ in range(4)]
    threads = [threading.Thread(target=without_fourth, args=(points, out)) for out in results]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for out in results:
        np.testing.assert_array_equal(out, points[:, :3].astype(np.float32))


def test_references_to_arguments_are_not_kept() -> None:
    out = np.zeros((5, 3), np.float32)
    before = sys.getrefcount(POINTS), sys.getrefcount(out), sys.getrefcount(None)
    for _ in range(2000):
        without_fourth(POINTS, out)
    after = sys.getrefcount(POINTS), sys.getrefcount(out), sys.getrefcount(None)
    assert before[:2] == after[:2]
    assert abs(after[2] - before[2]) < 100
