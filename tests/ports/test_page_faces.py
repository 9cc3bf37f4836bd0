"""What a page unpacks is what was packed."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np
import pytest

from risorius.ports import page_faces
from risorius.ports.page_faces import CHUNK, COARSER, PackedFaces

VERTICES = 5


class _Packer:
    def positions(self, face: Any) -> Any:
        return face


@pytest.fixture
def packed(monkeypatch: pytest.MonkeyPatch) -> tuple[np.ndarray, PackedFaces]:
    monkeypatch.setattr(page_faces, "pose_of", lambda face: face[0, :2].astype(np.float32))
    points = np.random.default_rng(0).integers(-30_000, 30_000, (2 * CHUNK + 3, VERTICES, 3))
    return points, PackedFaces(_Packer(), points)  # type: ignore[arg-type]


def _unpacked(chunks: list[bytes]) -> np.ndarray:
    faces: list[np.ndarray] = []
    for chunk in chunks:
        low, high = np.frombuffer(zlib.decompress(chunk), np.uint8).reshape(2, -1).astype(np.int32)
        folded = (low | high << 8).reshape(-1, 3 * VERTICES)
        before = faces[0] if faces else 0
        for difference in (folded >> 1) ^ -(folded & 1):
            before = before + difference
            faces.append(before)
    return np.array(faces).reshape(-1, 3, VERTICES).transpose(0, 2, 1)


def test_faces_come_back_to_half_a_step(packed: tuple[np.ndarray, PackedFaces]) -> None:
    points, faces = packed
    assert len(faces.chunks) == 3
    assert np.abs(COARSER * _unpacked(faces.chunks) - points).max() <= COARSER / 2


def test_there_is_a_pose_for_each_face(packed: tuple[np.ndarray, PackedFaces]) -> None:
    points, faces = packed
    assert np.array_equal(np.frombuffer(faces.poses, "<f4").reshape(-1, 2), points[:, 0, :2])
