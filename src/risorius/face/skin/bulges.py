"""Bulges: flesh that loses area gains height (paper A, section 3; paper B, section 6).

A column of flesh of depth T over an area that shrinks by the factor J keeps its volume if it grows to T / J;
the skin over it rises by T·(1/J − 1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...core.arrays import Array, UInt32Array
from ...machine.kernels.jit import device, kernel
from ...reading.frozen import FrozenDict
from ...reading.toml import package_text, parse_rows
from ..head.face_coordinates import FaceCoordinates
from ..head.head import Head
from .compression import Compression, Zone
from .wrinkle_layouts import Landmarks, Spacing, Vector, spot

TABLE = "bulges.toml"
# Loss of area that does not show yet: without it a bulge would begin abruptly.
TAKEN_UP = 0.02
OFF_EYE = 4.0  # mm over an eyeball within which less swells, down to nothing: flesh there would enter the eye
_HIDDEN = ("lips", "inner_mouth", "lids", "ears", "garment")


@dataclass(frozen=True, slots=True)
class Bulge:
    """A place at which flesh swells, in mm of the tables; see `bulges.toml`."""

    source: str
    anchor: Landmarks
    offset: tuple[float, float]
    size: tuple[Spacing, Spacing]
    compression: Vector
    depth: Spacing
    cap: Spacing


@lru_cache(maxsize=1)
def bulges() -> Mapping[str, Bulge]:
    """Return all bulges by name."""
    return FrozenDict(parse_rows(Bulge, package_text(str(__package__), TABLE), TABLE))


class Bulges:
    """The bulges of one head; keeps a workspace."""

    def __init__(self, head: Head) -> None:
        unit = FaceCoordinates.of(head).unit
        self._mask, compression = _swelling(head)
        self._compression = rows = compression.anew()
        self._depth, self._cap = (
            np.array([getattr(b, key) for b in bulges().values()])[rows.row_zone] * unit
            for key in ("depth", "cap")
        )
        self._area = np.empty(len(rows.row_vertex))
        self.vertices = np.unique(rows.row_vertex)

    def lift(self, skin: Array, out: Array) -> None:
        """Add the mm by which the level-0 `skin` (N0, 4) swells to `out` (N1,)."""
        self._compression.measure(skin, self._area)
        _swell(self._area, self._compression.row_vertex, self._mask, self._depth, self._cap, out)


@lru_cache(maxsize=4)
def _swelling(head: Head) -> tuple[Array, Compression]:
    """Return the masks of all rows, and the measure of their compression."""
    marks = FaceCoordinates.of(head)
    fine = head.skin.matrix @ head.rest
    shown = np.ones(len(fine))
    for name in _HIDDEN:
        shown *= 1.0 - np.clip(head.skin.matrix @ head.masks[name], 0.0, 1.0)
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        shown *= np.clip((np.linalg.norm(fine - centre, axis=1) - radius) / OFF_EYE, 0.0, 1.0)
    zones = [Zone(_mask(b, marks, fine) * shown, _pull(b, head)) for b in bulges().values()]
    return np.concatenate([zone.mask[zone.mask > 0.0] for zone in zones]), Compression.of(head, zones)


def _mask(bulge: Bulge, marks: FaceCoordinates, fine: Array) -> Array:
    centre = marks.mean(bulge.anchor) + np.array([*bulge.offset, 0.0])
    mask = spot(marks.left_half(fine), centre, bulge.size)
    mask[mask < 1e-3] = 0.0
    return mask


def _pull(bulge: Bulge, head: Head) -> Array:
    middles = head.rest[head.quads].mean(axis=1)
    pull = np.tile(np.asarray(bulge.compression), (len(middles), 1))
    pull[:, 0] *= np.where(middles[:, 0] < 0.0, -1.0, 1.0)
    return pull


@device()
def bulge_height(area: float, depth: float, cap: float) -> float:
    """Return the mm, at most `cap`, by which flesh of `depth` mm swells at the share `area` of its area."""
    if area >= 1.0:
        return 0.0
    lost = 1.0 / area - 1.0
    return float(cap * np.tanh(depth * lost * lost / (lost + TAKEN_UP) / cap))


@kernel("f8[:], u4[:], f8[:], f8[:], f8[:], f8[:]")
def _swell(area: Array, vertex: UInt32Array, mask: Array, depth: Array, cap: Array, out: Array) -> None:
    for r in range(len(area)):
        out[vertex[r]] += mask[r] * bulge_height(area[r], depth[r], cap[r])
