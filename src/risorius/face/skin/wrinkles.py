"""Expressive wrinkles (paper B, section 6.2): the skin keeps its length and folds while its ground shortens.

Paper B reads the tangents of a spline surface from a table, by age and by the distance between two isolines.
Here the height of a fold has a closed form, because its shape is known (docs/wrinkles.md gives the reasons).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...core.arrays import Array, Float32Array, IntArray, UInt32Array
from ...core.parameters import INDEX, parameters_named
from ...machine.kernels.jit import device, kernel
from ..head.face_coordinates import FaceCoordinates
from ..head.head import Head
from .ageing import DEFAULT_AGE, SkinAge, skin_at
from .bulges import Bulges
from .compression import Compression
from .wrinkle_layouts import Dimples, Fold
from .wrinkle_regions import PlacedRegion, check_factors, place_regions
from .wrinkle_relief import relief

# Excess length that stays flat before a fold rises: a square root alone would start infinitely steep and show
# every tremor.
FLAT = 0.012
LOW = 0.1  # share of its cap below which a height is found by a series, wrong by 6e-8 of it at most
OPENED = 0.25  # stretch beyond 1 that opens a crease that shows at rest


class Wrinkles:
    """The wrinkles and bulges of one head at one age; keeps a workspace.

    `factors` by region name, 0 to 2, else 1: how much of its wrinkles a speaker shows. Raises InputError for
    an age or factor out of range, and for a region that does not exist.
    """

    def __init__(
        self, head: Head, age: float = DEFAULT_AGE, factors: Mapping[str, float] | None = None
    ) -> None:
        self.age = age
        factor, skin = check_factors(factors or {}), skin_at(age)
        placed, compression, self._relief = _folding(head)
        self._bulges = Bulges(head)
        self._compression = compression.anew()
        rows = self._compression
        self._mask = np.concatenate([p.zone.mask[p.zone.mask > 0.0] for p in placed])
        self._law = _law(placed, skin, factor, FaceCoordinates.of(head).unit)
        self._stretch = np.empty(len(rows.row_vertex))
        self._drawn_in = [_DrawnIn.of(p, z, rows) for z, p in enumerate(placed) if _draws_in(p)]
        self._held = [
            _HeldFlat.of(p.region.sizes.muscle, z, rows)
            for z, p in enumerate(placed)
            if p.region.sizes.muscle
        ]
        self._lift = np.zeros(head.skin.matrix.shape[0])
        self.shape = (head.skin.matrix.shape[0], len(placed))
        self._raised = _Raised(head, np.union1d(rows.row_vertex[self._relief != 0.0], self._bulges.vertices))

    def fold(self, skin: Array, fine: Array, values: Array, heights: Float32Array) -> None:
        """Write the `heights` (N1, R) in mm of folds on the level-0 skin (N0, 4), and raise `fine` (N1, 4).

        `values` (46,) are those of the parameters.

        `fine` moves along its normals by the bulges and by the part of the folds that the mesh can show. The
        caller passes `heights` of 0 once; only the tenth of them that can differ from 0 is written.
        """
        self._lift[:] = 0.0
        rows = self._compression
        rows.measure(skin, self._stretch)
        for drawn in self._drawn_in:
            drawn.shorten(values, self._stretch)
        for flattener in self._held:
            flattener.flatten(values, self._stretch)
        _fold(
            self._stretch,
            rows.row_vertex,
            rows.row_zone,
            self._mask,
            self._relief,
            self._law,
            heights,
            self._lift,
        )
        self._bulges.lift(skin, self._lift)
        self._raised.move(self._lift, fine)


@lru_cache(maxsize=4)
def _folding(head: Head) -> tuple[tuple[PlacedRegion, ...], Compression, Array]:
    placed = place_regions(head)
    return placed, Compression.of(head, [p.zone for p in placed], taut=True), relief(head, placed)


class _DrawnIn(NamedTuple):
    """Rows of the stretch that muscles shorten which end in the skin, by the share `gathers`.

    `muscles` (k, 2): the parameters of their left and right side; `left` (r,): the rows' share of the left
    one. Dimples (`alone`) are shortened by nothing else.
    """

    rows: slice
    muscles: IntArray
    left: Array
    gathers: float
    alone: bool
    work: tuple[Array, Array]

    @classmethod
    def of(cls, placed: PlacedRegion, zone: int, compression: Compression) -> _DrawnIn:
        """Find the rows of a region of dimples, or of a fold that muscles draw in."""
        layout = placed.region.layout
        assert isinstance(layout, Dimples | Fold)
        first, last = np.searchsorted(compression.row_zone, [zone, zone + 1])
        rows = slice(int(first), int(last))
        alone = isinstance(layout, Dimples)
        names = (layout.muscle,) if isinstance(layout, Dimples) else layout.muscles
        muscles = np.array([[INDEX[p.name] for p in parameters_named(name)] for name in names])
        left = np.full(rows.stop - rows.start, 0.5) if alone else compression.row_side[rows]
        return cls(rows, muscles, left, layout.gathers, alone, (np.empty_like(left), np.empty_like(left)))

    def shorten(self, values: Array, stretch: Array) -> None:
        """Write the rows' `stretch` at `values` (46,); that of the strongest muscle counts.

        Skin that is stretched is shortened from there, so that its creases stay open while no muscle pulls.
        """
        left, right = (self.gathers * a for a in values[self.muscles].max(axis=0).tolist())
        own, (drawn, more) = stretch[self.rows], self.work
        if self.alone:
            own.fill(1.0)
        np.maximum(own, 1.0, out=drawn)
        drawn -= right
        drawn -= np.multiply(self.left, left - right, out=more)
        np.minimum(own, drawn, out=own)


class _HeldFlat(NamedTuple):
    """Rows of the stretch that fold under one muscle alone, its left or right one by their `side`."""

    rows: slice
    side: Array
    left: int
    right: int
    work: tuple[Array, Array]

    @classmethod
    def of(cls, muscle: str, zone: int, rows: Compression) -> _HeldFlat:
        """Find the rows of a zone that folds under a `muscle` alone."""
        first, last = np.searchsorted(rows.row_zone, [zone, zone + 1])
        own = slice(int(first), int(last))
        work = (np.empty(last - first), np.empty(last - first))
        return cls(own, rows.row_side[own], INDEX[f"{muscle}.left"], INDEX[f"{muscle}.right"], work)

    def flatten(self, values: Array, stretch: Array) -> None:
        """Take from the compression in `stretch` (r,) the part that other muscles than this one cause."""
        own, (idle, shortened) = stretch[self.rows], self.work
        left, right = ((1.0 - float(values[k])) ** 2 for k in (self.left, self.right))
        if left == right == 1.0:
            np.maximum(own, 1.0, out=own)
            return
        np.multiply(self.side, left - right, out=idle)
        idle += right
        np.subtract(1.0, own, out=shortened)
        np.maximum(shortened, 0.0, out=shortened)
        shortened *= idle
        own += shortened


def _draws_in(placed: PlacedRegion) -> bool:
    layout = placed.region.layout
    return isinstance(layout, Dimples) or (isinstance(layout, Fold) and bool(layout.muscles))


class _Raised:
    """Vertices (k,) that move along their normals, each with the quads `around` it."""

    def __init__(self, head: Head, vertices: IntArray) -> None:
        quads = head.skin.quads
        owner = np.repeat(np.arange(len(quads)), 4)
        order = np.argsort(quads.ravel(), kind="stable")
        starts = np.searchsorted(quads.ravel()[order], np.arange(head.skin.matrix.shape[0] + 1))
        around = [quads[owner[order[starts[v] : starts[v + 1]]]] for v in vertices]
        self._vertices = vertices.astype(np.uint32)
        self._start = np.concatenate([[0], np.cumsum([len(a) for a in around])]).astype(np.uint32)
        self._around = np.concatenate(around).astype(np.uint32)
        self._step = np.zeros((len(vertices), 3))

    def move(self, lift: Array, fine: Array) -> None:
        """Move `fine` (N1, 4) by `lift` (N1,) mm along its normals."""
        _steps(self._vertices, self._start, self._around, lift, fine, self._step)
        _step(self._vertices, self._step, fine)


def _law(placed: Sequence[PlacedRegion], skin: SkinAge, factor: Array, unit: float) -> Array:
    """Return one row per region: width, give, gain, depth at rest, cap."""
    return np.array(
        [
            (
                p.region.sizes.width * unit,
                skin.give * p.region.sizes.slack,
                skin.gain * f,
                skin.static * f * p.region.sizes.static * unit,
                p.region.sizes.cap * unit,
            )
            for p, f in zip(placed, factor, strict=True)
        ]
    )


@device()
def fold_height(width: float, stretch: float, give: float) -> float:
    """Return the height in mm of the fold in which skin keeps its length.

    Skin `width` mm long shortens without a fold to the share 1 − `give` of its length. Its ground shortens to
    the share `stretch`, d mm. A raised cosine over d has the skin's length if its height is h = (2d/π)·√e,
    with e = (1 − give)/stretch − 1, to second order in h/d; √e is computed as e/√(e + FLAT).
    """
    chord = width * stretch
    excess = (1.0 - give) / stretch - 1.0
    if excess <= 0.0:
        return 0.0
    return float(2.0 * chord / np.pi * excess / np.sqrt(excess + FLAT))


@device()
def capped(height: float, cap: float) -> float:
    """Soft-clip `height` (mm, ≥ 0) below `cap` (mm).

    Most skin is nearly flat: there the series of tanh is as exact as single precision, and faster.
    """
    x = height / cap
    return height * (1.0 - x * x * (1.0 / 3.0 - x * x * (2.0 / 15.0))) if x < LOW else cap * float(np.tanh(x))


@kernel("f8[:], u4[:], u4[:], f8[:], f8[:], f8[:, :], f4[:, :], f8[:]")
def _fold(
    stretch: Array,
    vertex: UInt32Array,
    zone: UInt32Array,
    mask: Array,
    relief: Array,
    law: Array,
    heights: Float32Array,
    lift: Array,
) -> None:
    for r in range(len(stretch)):
        z, v = zone[r], vertex[r]
        static, cap = law[z, 3], law[z, 4]
        moving = law[z, 2] * fold_height(law[z, 0], stretch[r], law[z, 1])
        resting = static * min(1.0, max(0.0, 1.0 - (stretch[r] - 1.0) / OPENED))
        heights[v, z] = mask[r] * capped(moving + resting, cap) if moving + resting > 0.0 else 0.0
        if moving > 0.0 and relief[r] != 0.0:
            lift[v] += relief[r] * mask[r] * capped(moving, cap)


@kernel("u4[:], u4[:], u4[:, :], f8[:], f8[:, :], f8[:, :]")
def _steps(
    vertices: UInt32Array, start: UInt32Array, around: UInt32Array, lift: Array, fine: Array, out: Array
) -> None:
    for k in range(len(vertices)):
        far = lift[vertices[k]]
        if far == 0.0:
            out[k, 0], out[k, 1], out[k, 2] = 0.0, 0.0, 0.0
            continue
        x, y, z = 0.0, 0.0, 0.0
        for f in range(start[k], start[k + 1]):
            p, q, r, s = around[f, 0], around[f, 1], around[f, 2], around[f, 3]
            ax, ay, az = fine[r, 0] - fine[p, 0], fine[r, 1] - fine[p, 1], fine[r, 2] - fine[p, 2]
            bx, by, bz = fine[s, 0] - fine[q, 0], fine[s, 1] - fine[q, 1], fine[s, 2] - fine[q, 2]
            x += ay * bz - az * by
            y += az * bx - ax * bz
            z += ax * by - ay * bx
        far /= np.sqrt(x * x + y * y + z * z + 1e-12)
        out[k, 0], out[k, 1], out[k, 2] = far * x, far * y, far * z


@kernel("u4[:], f8[:, :], f8[:, :]")
def _step(vertices: UInt32Array, step: Array, fine: Array) -> None:
    for k in range(len(vertices)):
        for c in range(3):
            fine[vertices[k], c] += step[k, c]
