"""What a page unpacks is what was packed."""

from __future__ import annotations

import zlib
from typing import Any, NamedTuple

import numpy as np
import pytest

from risorius.ports.page import page_faces
from risorius.ports.page.page_faces import CHUNK, COARSER, PackedFaces

VERTICES, FOLDS = 5, 4


class _Folds:
    def heights(self, wrinkles: Any) -> Any:
        return wrinkles


class _Packer:
    folds = _Folds()

    def positions(self, face: Any) -> Any:
        return face.points


class _Face(NamedTuple):
    points: np.ndarray
    wrinkles: np.ndarray


@pytest.fixture
def packed(monkeypatch: pytest.MonkeyPatch) -> tuple[list[_Face], PackedFaces]:
    monkeypatch.setattr(page_faces, "pose_of", lambda face: face.points[0, :2].astype(np.float32))
    random = np.random.default_rng(0)
    points = random.integers(-30_000, 30_000, (2 * CHUNK + 3, VERTICES, 3))
    heights = random.integers(0, 256, (len(points), FOLDS), np.uint8)
    faces = [_Face(*face) for face in zip(points, heights, strict=True)]
    return faces, PackedFaces(_Packer(), faces)  # type: ignore[arg-type]


def _unpacked(chunks: list[bytes]) -> np.ndarray:
    """Return each face's x of all vertices, y, z, and heights of wrinkles."""
    faces: list[np.ndarray] = []
    for chunk in chunks:
        low, high = np.frombuffer(zlib.decompress(chunk), np.uint8).reshape(2, -1).astype(np.int32)
        folded = (low | high << 8).reshape(-1, 3 * VERTICES + FOLDS)
        before = faces[0] if faces else 0
        for difference in (folded >> 1) ^ -(folded & 1):
            before = before + difference
            faces.append(before)
    return np.array(faces)


def test_faces_come_back_to_half_a_step_and_wrinkles_exactly(
    packed: tuple[list[_Face], PackedFaces],
) -> None:
    faces, pages = packed
    assert len(pages.chunks) == 3
    steps, heights = np.split(_unpacked(pages.chunks), [3 * VERTICES], axis=1)
    points = np.stack([face.points.T.ravel() for face in faces])
    assert np.abs(COARSER * steps - points).max() <= COARSER / 2
    assert np.array_equal(heights, [face.wrinkles for face in faces])


def test_there_is_a_pose_for_each_face(packed: tuple[list[_Face], PackedFaces]) -> None:
    faces, pages = packed
    poses = np.frombuffer(pages.poses, "<f4").reshape(-1, 2)
    assert np.array_equal(poses, [face.points[0, :2] for face in faces])
