"""Brows and lashes on the moving skin: they turn with the triangles in which they are rooted."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray, Int64Array
from .head_model import FACIAL_HAIRS, HeadModel
from .normals import Normals
from .strands import Strands, flat_ribbons


class RootedHairs:
    """Hairs on a model's face, for programs that move each vertex: ribbons as `HeadModel.parts` has them.

    `names` are those parts of `FACIAL_HAIRS` that are wanted. Renderers that turn ribbons towards the camera
    follow the same frames of the roots (`render/ribbons.py`).
    """

    def __init__(self, model: HeadModel, names: Collection[str] = FACIAL_HAIRS) -> None:
        self._rest: FloatArray = model.skin.points
        hairs = {name: model.hairs[name] for name in names}
        rooted = np.unique(np.concatenate([strands.roots.ravel() for strands in hairs.values()]))
        quads = model.head.skin.quads
        faces = quads[np.isin(quads, rooted).any(axis=1)]
        self._used: Int64Array = np.unique(faces)
        self._normals = Normals(np.searchsorted(self._used, faces).astype(np.int32), len(self._used))
        self._hairs: dict[str, Strands] = {
            name: replace(strands, roots=np.searchsorted(self._used, strands.roots).astype(np.int32))
            for name, strands in hairs.items()
        }

    def points(self, skin: FloatArray) -> dict[str, Array]:
        """Return the ribbons' points (n, 3) by part on a skin (N1, 3)."""
        near = np.ascontiguousarray(skin[self._used], np.float32)
        normals: Float32Array = np.empty_like(near)
        self._normals.update(near, normals)
        return {name: flat_ribbons(strands, near, normals) for name, strands in self._hairs.items()}

    def moves(self, displacement: Array) -> dict[str, Array]:
        """Return the displacements (n, 3) by part that go with that of the skin (N1, 3) from rest."""
        rest, moved = self.points(self._rest), self.points(self._rest + displacement)
        return {name: moved[name] - rest[name] for name in rest}
