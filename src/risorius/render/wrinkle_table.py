"""The wrinkle regions in the form that the skin's shader reads."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from ..core.arrays import Array, Float32Array, Int32Array, IntArray
from ..face.head.face_coordinates import FaceCoordinates
from ..face.head.head import Head
from ..face.skin.wrinkle_layouts import Dimples, Fold
from ..face.skin.wrinkle_regions import PlacedRegion, place_regions
from ..looks.noise import noise_at
from ..machine.array_cache import cached_arrays
from ..machine.kernels.jit import f4, i4, kernel

LINES, FOLD, DIMPLES = 0, 1, 2
# Columns of `style`.
KIND, FURROW, SHADOW, SHARE = 0, 1, 2, 3
RAGGED, WANDERING = 0.18, 9.0  # mm by which creases stray from their line, and the length over which they do
FAINT = f4(0.004)  # mm: lower folds are not shaded
MESH_CARRIES = 0.6  # share of the mesh's own relief that need not be shaded again


class WrinkleTable(NamedTuple):
    """Wrinkle regions on the skin.

    `regions` (m,) int32 has bit r set on the triangles that region r covers, `raised` (m,) on those where it
    can be seen in this frame; `place` (N1, R, 4) phase and its slope (1/mm) in x, y, z at rest; `height`
    (N1, R) mm in this frame; `style` (R, 4) kind, width of the furrow in mm, shadow, and the share of the
    height that is shaded.
    """

    regions: Annotated[Int32Array, "i4[:]"]
    raised: Annotated[Int32Array, "i4[:]"]
    place: Annotated[Float32Array, "f4[:, :, :]"]
    height: Annotated[Float32Array, "f4[:, :]"]
    style: Annotated[Float32Array, "f4[:, :]"]


def lay_creases(head: Head, triangles: int) -> WrinkleTable:
    """Place a head's wrinkle regions in a scene of `triangles` triangles that starts with the skin's."""
    placed, unit = place_regions(head), FaceCoordinates.of(head).unit
    fine, faces = np.asarray(head.skin.matrix @ head.rest), head.skin.triangles
    covered = np.zeros(triangles, np.int32)
    for number, region in enumerate(placed):
        covered[: len(faces)] |= (region.zone.mask[faces] > 0.0).any(axis=1).astype(np.int32) << number
    stray = RAGGED * noise_at(fine, WANDERING)
    phases = np.array([p.phase for p in placed])
    (place,) = cached_arrays(
        "creases", [phases, stray, fine, faces], lambda: (_places(phases, stray, fine, faces),)
    )
    return WrinkleTable(
        covered,
        np.zeros_like(covered),
        place,
        np.zeros((len(fine), len(placed)), np.float32),
        np.array([_style(p, unit) for p in placed], np.float32),
    )


def raise_creases(creases: WrinkleTable, triangles: Int32Array, wrinkles: Float32Array) -> None:
    """Set the wrinkles' heights (N1, R) in mm, and mark the `triangles` (n, 3) on which they can be seen."""
    creases.height[:] = wrinkles
    _find_raised(creases, triangles)


@kernel("WrinkleTable, i4[:, :]")
def _find_raised(creases: WrinkleTable, triangles: Int32Array) -> None:
    for t in range(len(triangles)):
        bits, r, raised = creases.regions[t], i4(0), i4(0)
        while bits:
            if bits & 1:
                share, highest = creases.style[r, SHARE], f4(0)
                for corner in range(3):
                    highest = max(highest, creases.height[triangles[t, corner], r] * share)
                if highest > FAINT:
                    raised |= i4(1 << r)
            bits >>= 1
            r += i4(1)
        creases.raised[t] = raised


def _style(placed: PlacedRegion, unit: float) -> tuple[float, float, float, float]:
    sizes, layout = placed.region.sizes, placed.region.layout
    kind = FOLD if isinstance(layout, Fold) else DIMPLES if isinstance(layout, Dimples) else LINES
    furrow = layout.spacing * unit if isinstance(layout, Dimples) else sizes.furrow * unit
    return kind, furrow, sizes.shadow, 1.0 - MESH_CARRIES * sizes.relief


def _places(phases: Array, stray: Array, points: Array, faces: IntArray) -> Float32Array:
    """Return phase and slope (N1, R, 4) of regions whose phases are (R, N1)."""
    slopes = _Slopes(points, faces)
    return np.stack([_place(phase, stray, slopes) for phase in phases], axis=1).astype(np.float32)


def _place(phase: Array, stray: Array, slopes: _Slopes) -> Array:
    """Return phase and slope (N1, 4) of a region whose creases stray by `stray` (N1,) mm.

    The regions are symmetric; the straying is not.
    """
    ragged = phase + stray * np.linalg.norm(slopes.of(phase), axis=1)
    return np.column_stack([ragged, slopes.of(ragged)])


class _Slopes:
    """Slopes of values along a surface: at each vertex the mean of the triangles', by area."""

    def __init__(self, points: Array, faces: IntArray) -> None:
        a, b, c = (points[faces[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        twice = np.linalg.norm(normal, axis=1, keepdims=True)
        self._corners = faces.T
        self._ways = [np.cross(normal / twice, edge) for edge in (c - b, a - c, b - a)]
        self._weight = np.zeros((len(points), 1))
        for corner in self._corners:
            np.add.at(self._weight, corner, twice)

    def of(self, values: Array) -> Array:
        """Return the slope (N1, 3) of `values` (N1,)."""
        own = sum(values[corner, None] * way for corner, way in zip(self._corners, self._ways, strict=True))
        total = np.zeros((len(self._weight), 3))
        for corner in self._corners:
            np.add.at(total, corner, own)
        return np.asarray(total / np.maximum(self._weight, 1e-12))
