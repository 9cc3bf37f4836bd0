"""The visibility buffer: the triangle that each sample of the picture shows.

The result depends on the order of the triangles alone. Samples are drawn band by band: a band's rows
stay in the processor's cache until they are shaded.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import ByteArray, Float32Array, Int32Array
from ..machine.kernels.jit import device, f4, index, kernel
from .fill import fill, fill_ribbon
from .raster import CHUNK, find_rows, is_ribbon

BAND = 96  # rows of samples drawn at once, a multiple of the samples per pixel and side


class Visibility:
    """Buffers for drawing up to a given number of triangles.

    `order` (k,) is the triangles to draw, one after the other; at first it is all of them. After `draw`,
    `ids` (height, width) int32 holds the index of the triangle that each sample shows or -1, and `depth`
    (height, width) float32 its key: larger is nearer, 0 is empty. After `prepare`, `rows` and `chunks` tell
    `rasterize` which rows each triangle covers.
    """

    def __init__(self, width: int, height: int, triangles: int, *, keep_ids: bool = True) -> None:
        self.depth: Float32Array = np.zeros((height, width), np.float32)
        self.ids: Int32Array = np.full((height, width) if keep_ids else (1, 1), -1, np.int32)
        self.rows: Int32Array = np.zeros((triangles, 2), np.int32)
        self._chunks: Int32Array = np.zeros((-(-triangles // CHUNK), 2), np.int32)
        self.order: Int32Array = np.arange(triangles, dtype=np.int32)

    @property
    def chunks(self) -> Int32Array:
        """The first and last row (n, 2) of each group of triangles in `order`."""
        return self._chunks[: -(-len(self.order) // CHUNK)]

    def draw(self, xy: Int32Array, key: Float32Array, triangles: Int32Array, two_sided: ByteArray) -> None:
        """Clear the buffers and draw.

        `xy` (n, 2) int32 are positions in 1/256 sample, x to the right and y down, the centre of the first
        sample at (128, 128); `key` (n,) float32 is positive, larger nearer, and affine in the picture (the
        reciprocal of the distance is); `triangles` (m, 3) int32 appear counter-clockwise when seen from
        the front; `two_sided` (m,) uint8 is 1 where the back is drawn too.
        """
        if len(triangles) != len(self.rows):
            raise ValueError(f"{len(triangles)} triangles for a buffer of {len(self.rows)}")
        self.prepare(xy, triangles, two_sided)
        rasterize_all(xy, key, triangles, self.order, self.rows, self.chunks, self.depth, self.ids)

    def prepare(self, xy: Int32Array, triangles: Int32Array, two_sided: ByteArray) -> None:
        """Find the rows that the triangles cover (see `draw`)."""
        height, width = self.depth.shape
        find_rows(xy, triangles, self.order, two_sided, height, width, self.rows, self.chunks)


@kernel("i4[:, :], f4[:], i4[:, :], i4[:], i4[:, :], i4[:, :], f4[:, :], i4[:, :]", wide=True)
def rasterize_all(
    xy: Int32Array,
    key: Float32Array,
    triangles: Int32Array,
    order: Int32Array,
    rows: Int32Array,
    chunks: Int32Array,
    depth: Float32Array,
    ids: Int32Array,
) -> None:
    """Draw all triangles in `order`, all rows."""
    for top in range(0, depth.shape[0], BAND):
        bottom = min(top + BAND, depth.shape[0])
        rasterize(xy, key, triangles, order, rows, chunks, top, bottom, depth, ids)


@device()
def rasterize(
    xy: Int32Array,
    key: Float32Array,
    triangles: Int32Array,
    order: Int32Array,
    rows: Int32Array,
    chunks: Int32Array,
    top: int,
    bottom: int,
    depth: Float32Array,
    ids: Int32Array,
) -> None:
    """Draw the rows from `top` to `bottom`; a later triangle wins only where it is strictly nearer."""
    keep = ids.shape[0] == depth.shape[0]
    depth[top:bottom] = f4(0)
    if keep:
        ids[top:bottom] = -1
    for chunk in range(len(chunks)):
        if chunks[chunk, 0] >= bottom or chunks[chunk, 1] < top:
            continue
        place, end = chunk * CHUNK, min((chunk + 1) * CHUNK, len(order))
        while place < end:
            t = index(order[place])
            place += 1
            first, last = max(rows[t, 0], top), min(rows[t, 1], bottom - 1)
            if first > last:
                continue
            if (
                keep
                and place < end
                and is_ribbon(triangles, t, order[place])
                and fill_ribbon(xy, key, triangles[t, 0], t, first, last, depth, ids)
            ):
                place += 1
            else:
                fill(xy, key, triangles, t, first, last, depth, ids, keep)
