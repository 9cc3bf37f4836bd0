"""The visible parts of hairs: most hair lies under other hair and need not be drawn.

For each direction of a grid around the head, when it is first needed, the head at rest is drawn to see which
points of each hair win samples. A picture draws what is visible from any corner of the camera's cell; the
rest is neither moved, projected, lit nor drawn.
"""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray, Int8Array, Int32Array
from ..looks.attributes import HAIR
from ..machine.array_cache import cached_arrays
from .camera import Camera, project
from .ribbons import NOTHING, WHOLE
from .scene import HeadScene, ShownHair
from .visibility import Visibility

STEP = 12.0
"""Degrees between directions."""
_AROUND, _HIGHEST = round(360.0 / STEP), 84
_LARGEST = 1440
"""Greatest number of samples per side."""
_FINER = 0.5
"""Least width of a picture's samples, as a share of those here: finer ones would show hairs missed here."""


class HairViews:
    """The visible parts of a scene's hairs from `distance` mm away, with samples `sample` mm wide."""

    def __init__(self, scene: HeadScene, distance: float, sample: float) -> None:
        self._scene, self._distance, self._sample = scene, distance, sample
        centre, self._radius = scene.anatomy.sphere()
        self._side = min(math.ceil(2.0 * self._radius / sample), _LARGEST)
        self._centre = (0.0, float(centre[1]), float(centre[2]))
        self._nodes: dict[tuple[int, int], Int8Array] = {}
        self._cells: dict[tuple[int, int], ShownHair] = {}
        self._buffers: _Buffers | None = None

    def clone(self, scene: HeadScene) -> HairViews:
        """Return a copy for a clone of the scene; both share the directions that either computes."""
        other = copy(self)
        other._scene, other._buffers = scene, None
        return other

    def fit(self, distance: float, sample: float) -> bool:
        """Whether they are those for a distance and a sample, but for what rounding changes."""
        mine = self._distance, self._sample
        return all(math.isclose(*pair, rel_tol=1e-4) for pair in zip(mine, (distance, sample), strict=True))

    @property
    def reliable(self) -> bool:
        """Whether the picture's samples are not much finer than those drawn here."""
        return self._sample * self._side >= _FINER * 2.0 * self._radius

    def seen(self, eye: FloatArray, rotation: Array) -> ShownHair:
        """Return the part of each hair that may be visible from `eye` (3,); `rotation` (3, 3) is the head's.

        The call may change the pose of the scene.
        """
        x, y, z = (np.subtract(eye, self._centre) @ rotation).tolist()
        across = math.degrees(math.atan2(x, z)) / STEP
        high = math.degrees(math.atan2(y, math.hypot(x, z)))
        up = max(-_HIGHEST, min(high, _HIGHEST - 1e-6)) / STEP
        i, j = math.floor(across), math.floor(up)
        if (i, j) not in self._cells:
            place = (
                *self._centre,
                self._radius,
                self._distance,
                self._sample,
                self._side,
                i % _AROUND,
                j,
            )
            inputs = [*self._scene.at_rest(), np.array(place)]
            (points,) = cached_arrays("hair-seen", inputs, lambda: (self._cell(i, j),))
            self._cells[i, j] = self._scene.show_hair(np.asarray(points, np.int8))
        return self._cells[i, j]

    def _cell(self, across: int, up: int) -> Int8Array:
        """Return each hair's first and last point (H, 2) that any corner of a cell sees."""
        corners = np.stack([self._node(m % _AROUND, n) for m in (across, across + 1) for n in (up, up + 1)])
        return np.stack([corners[:, :, 0].min(axis=0), corners[:, :, 1].max(axis=0)], axis=1)

    def _node(self, across: int, up: int) -> Int8Array:
        if (across, up) not in self._nodes:
            self._nodes[across, up] = self._look(math.radians(across * STEP), math.radians(up * STEP))
        return self._nodes[across, up]

    def _look(self, across: float, up: float) -> Int8Array:
        """Draw the head at rest from a direction; return each hair's first and last visible point (H, 2)."""
        scene, level = self._scene, math.cos(up) * self._distance
        way = (math.sin(across) * level, math.sin(up) * self._distance, math.cos(across) * level)
        x, y, z = self._centre
        angle = 2.0 * math.degrees(math.asin(min(self._radius / self._distance, 0.86)))
        camera = Camera((x + way[0], y + way[1], z + way[2]), self._centre, angle)
        scene.rest_at(np.asarray(camera.eye, np.float32), self._sample)
        buffers = self._buffers = self._buffers or _Buffers(scene, self._side)
        project(scene.positions, camera.matrix(self._side, self._side), buffers.xy, buffers.key)
        buffers.seen.draw(buffers.xy, buffers.key, scene.triangles, scene.two_sided)
        return self._winners(buffers.seen.ids)

    def _winners(self, ids: Int32Array) -> Int8Array:
        scene = self._scene
        drawn = np.unique(ids[ids >= scene.solid])
        hair, part = scene.surfaces[drawn] - HAIR, scene.hair_segments[drawn - scene.solid]
        visible = np.tile(np.array([NOTHING], np.int8), (scene.hairs, 1))
        np.minimum.at(visible[:, 0], hair, part)
        np.maximum.at(visible[:, 1], hair, part + 1)
        # Brows and lashes move with the face: what is visible at rest says nothing of other poses.
        visible[: scene.facial_hairs] = WHOLE
        return visible


class _Buffers:
    """Buffers to draw a scene with, `side` samples high and wide."""

    def __init__(self, scene: HeadScene, side: int) -> None:
        self.xy: Int32Array = np.zeros((len(scene.positions), 2), np.int32)
        self.key: Float32Array = np.zeros(len(scene.positions), np.float32)
        self.seen = Visibility(side, side, len(scene.triangles))
