"""Faces as binary messages: the moving points of each frame, as whole hundredths of a millimetre.

Little-endian. Header of 6 uint32: kind (1 a take's frames, 2 a dialled face, 3 the face at a time), take (or
the request's number), first frame, count, vertices per frame, floats of pose per frame. Then the poses,
float32 (count, 14): quaternions x, y, z, w of head, left eye and right eye, the jaw's angle in radians, and
how much blood the lips gain, of the usual.
Then the positions, int16 (count, vertices, 3): `origin + step * value` mm in the head's frame, before the
head turns. The vertices are those of `parts` in order, as the meshes of the head's file have them. Then the
heights of the fine wrinkles, uint8 (count, `folds.count`): `folds.step * value` mm (`head_wrinkles.py`).
"""

from __future__ import annotations

import struct
from collections.abc import Iterator

import numpy as np

from ...core.arrays import Array, Float32Array, Int16Array
from ...face.frame import FaceFrame
from ...face.head.head import Head
from ...looks.eyeball import pupil_axes
from ...looks.head_model import FACIAL_HAIRS, head_model
from ...looks.parts import Part
from ...looks.perfusion import gained_by_lips
from ...looks.root_attachment import RootedHairs
from ...looks.srgb import linear
from ..mesh.gltf import quaternions
from .head_shade import blood, light
from .head_wrinkles import HeadWrinkles
from .skin_formulas import key_shadow, shading
from .stage_table import StageEye, StagePart, StageTable

FRAMES, DIALLED, MOMENT = 1, 2, 3
HEADER = struct.Struct("<6I")
POSE = 14
STEP = 0.01
_OWN = ("skin", "tongue", "teeth_lower")
PARTS = (*_OWN, *FACIAL_HAIRS)


class FacePacker:
    """The layout in which a head's faces are packed."""

    def __init__(self, head: Head) -> None:
        self.head = head
        model = head_model(head)
        self.head_parts: dict[str, Part] = model.parts()
        self._hairs = RootedHairs(model)
        points = np.concatenate([self.head_parts[name].points for name in PARTS])
        self.vertices = len(points)
        self.origin = np.round(0.5 * (points.min(axis=0) + points.max(axis=0)))
        self.parts = tuple(self._parts())
        self.folds = HeadWrinkles(head)

    def _parts(self) -> Iterator[StagePart]:
        first = 0
        for name in PARTS:
            count = len(self.head_parts[name].points)
            about = np.zeros(3) if name == "skin" else self.head.head_pivot
            yield StagePart(name, first, count, _place(about))
            first += count

    def described(self) -> StageTable:
        """Return the table that a page needs to unpack faces."""
        return StageTable(
            vertices=self.vertices,
            pose=POSE,
            step=STEP,
            origin=_place(self.origin),
            pivot=_place(self.head.head_pivot),
            eyes=tuple(map(self._eye, range(2))),
            lips=tuple((int(upper), int(lower)) for upper, lower in self.head.lip_pairs),
            light=light(),
            cloth=_place(linear(self.head.identity.looks.cloth)),
            blood=blood(),
            shading=shading(),
            shadow=key_shadow(head_model(self.head).anatomy),
            folds=self.folds.described(),
            parts=self.parts,
        )

    def _eye(self, side: int) -> StageEye:
        head = self.head
        return StageEye(
            centre=_place(head.eye_centre[side]),
            radius=float(head.eye_radius[side]),
            axes=tuple(pupil_axes()[side].ravel().tolist()),
            lids=tuple((int(upper), int(lower)) for upper, lower in head.lid_pairs[side]),
        )

    def packed(self, kind: int, take: int, first: int, faces: list[FaceFrame]) -> bytes:
        """Return the message with these faces."""
        poses = np.concatenate([pose_of(face) for face in faces])
        positions = np.stack([self.positions(face) for face in faces])
        header = HEADER.pack(kind, take, first, len(faces), self.vertices, POSE)
        heights = [self.folds.heights(face.wrinkles).tobytes() for face in faces]
        return b"".join((header, poses.astype("<f4").tobytes(), positions.tobytes(), *heights))

    def positions(self, face: FaceFrame) -> Int16Array:
        """Return the points of a face in steps from the origin, shape (vertices, 3)."""
        skin = face.skin.astype(np.float64)
        points = np.concatenate([skin, face.tongue, face.teeth_lower, *self._hairs.points(skin).values()])
        return np.asarray(np.round((points - self.origin) / STEP).clip(-32768, 32767), "<i2")


def pose_of(face: FaceFrame) -> Float32Array:
    """Return how a face's head, eyes and jaw are turned, and the blood of its lips, shape (POSE,)."""
    turns = quaternions([face.head_rotation, *face.eye_rotation]).ravel()
    return np.concatenate([turns, np.array([face.jaw_angle, gained_by_lips(face)], np.float32)])


def _place(point: Array) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z
