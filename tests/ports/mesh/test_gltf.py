from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.numerics.rotations import about_axis
from risorius.ports.mesh.gltf import Gltf, quaternion, quaternions

from ..gltf_reader import Document

ANGLES = st.floats(-3.1, 3.1)


@given(ANGLES, st.sampled_from([0, 1, 2]))
def test_a_quaternion_is_half_the_angle_about_its_axis(angle: float, axis: int) -> None:
    x, y, z, w = quaternion(about_axis(np.eye(3)[axis], angle))
    assert (x, y, z)[axis] == pytest.approx(np.sin(angle / 2), abs=1e-9)
    assert w == pytest.approx(np.cos(angle / 2), abs=1e-9)


def test_quaternions_are_of_unit_length_in_single_precision() -> None:
    found = quaternions([about_axis(np.array([0.6, 0.8, 0.0]), 0.1 * k) for k in range(20)])
    assert found.dtype == np.float32
    assert np.abs(np.linalg.norm(found.astype(float), axis=1) - 1.0).max() < 1e-6


@pytest.mark.parametrize("moved", [[], [3], [0, 9], range(10)])
def test_what_does_not_move_is_left_out_and_read_as_nothing(tmp_path: Path, moved: list[int]) -> None:
    values = np.zeros((10, 3), np.float32)
    values[list(moved)] = np.arange(1.0, 4.0)
    gltf = Gltf()
    first = gltf.accessor(np.arange(5, dtype=np.uint8))
    index = gltf.sparse(values)
    gltf.save(tmp_path / "x.glb")
    document = Document(tmp_path / "x.glb")
    assert np.array_equal(document.array(index), values)
    assert document.array(first).ravel().tolist() == [0, 1, 2, 3, 4]
    assert all(view["byteOffset"] % 4 == 0 for view in document.json["bufferViews"])
