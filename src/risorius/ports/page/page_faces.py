"""Faces of a performance as small as a page can unpack: the changes from frame to frame, deflated.

A chunk holds up to CHUNK faces. Each face is the difference, in steps of STEP mm, from the one before; the
first of a chunk from the first of all, which is the difference from zero. A difference d is written as 2 d,
or as -2 d - 1 if it is negative: uint16, x of all vertices, then y, z, then the heights of the fine wrinkles,
in steps of their own. All low bytes of a chunk come
before all high ones. A page inflates only the chunks about its playhead.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Iterator
from itertools import islice

import numpy as np

from ...core.arrays import ByteArray, Float32Array, Int16Array
from ...face.frame import FaceFrame
from . import face_packer
from .face_packer import FacePacker, pose_of

CHUNK = 30
COARSER = 4
"""The number of the studio's steps in one of the page's; the heights of wrinkles have the studio's."""
STEP = COARSER * face_packer.STEP


class PackedFaces:
    """The chunks, as they are packed, and the poses of all faces, float32 of shape (frames, POSE)."""

    def __init__(self, packer: FacePacker, faces: Iterable[FaceFrame]) -> None:
        self._packer = packer
        self._poses: list[Float32Array] = []
        self.chunks = list(self._packed(faces))

    @property
    def poses(self) -> bytes:
        """The poses, little-endian."""
        return np.array(self._poses, "<f4").tobytes()

    def _packed(self, faces: Iterable[FaceFrame]) -> Iterator[bytes]:
        base: Int16Array | None = None
        remaining = iter(faces)
        while chunk := list(islice(remaining, CHUNK)):
            self._poses.extend(map(pose_of, chunk))
            points = np.stack([self._steps(face) for face in chunk])
            before = np.zeros_like(points[:1]) if base is None else base
            base = points[:1] if base is None else base
            yield deflated(_bytes(np.diff(points.astype(np.int32), axis=0, prepend=before)))

    def _steps(self, face: FaceFrame) -> Int16Array:
        """Return a face as x of all vertices, y, z, and the heights: shape (3 * vertices + folds.count,)."""
        steps = np.round(self._packer.positions(face) / COARSER)
        heights = self._packer.folds.heights(face.wrinkles)
        return np.concatenate([steps.T.ravel(), heights]).astype(np.int16)


def _bytes(differences: np.ndarray) -> bytes:
    folded = ((differences << 1) ^ (differences >> 31)).astype("<u2").ravel()
    planes: ByteArray = folded.view(np.uint8).reshape(-1, 2)
    return planes.T.tobytes()


def deflated(data: bytes) -> bytes:
    """Return data as zlib has it, which a browser calls `deflate`."""
    return zlib.compress(data, 9)
