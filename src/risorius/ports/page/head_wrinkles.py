"""The fine wrinkles of a head as the page shades them: where creases lie, and how high they are in a face.

At each vertex of the skin there is room for SLOTS regions of wrinkles. A region has the same slot at all its
vertices, and regions that share a triangle have different ones, so that a page can interpolate each slot.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, ByteArray, Float32Array, IntArray
from ...face.head.head import Head
from ...face.skin.wrinkle_regions import place_regions
from ...render.wrinkle_table import WrinkleTable, lay_creases
from .stage_table import StageFolds

SLOTS = 4
STEP = 0.01
"""mm of height to one of a face's whole numbers, of which 255 is the highest."""


class HeadWrinkles:
    """The places of a head's wrinkles.

    If more than SLOTS regions meet, the two that share the fewest vertices have one slot: there, at the
    borders of both, where they fade, the weaker of them is left out. `left_out` counts these vertices.
    """

    def __init__(self, head: Head) -> None:
        self._creases = lay_creases(head, len(head.skin.triangles))
        near = _near(self._creases, head.skin.triangles)
        self._slots = _slots(near)
        masks = np.array([region.zone.mask for region in place_regions(head)])
        self._near = _apart(near, self._slots, masks)
        self.left_out = int((near & ~self._near).sum())
        self._rows, self._regions = np.nonzero(((masks > 0.0) & self._near).T)

    def described(self) -> StageFolds:
        """Return the table of them that a page needs."""
        styles = tuple(tuple(row) for row in self._creases.style.astype(float).tolist())
        return StageFolds(len(self._rows), STEP, SLOTS, styles)

    def heights(self, wrinkles: Float32Array) -> ByteArray:
        """Return the heights (N1, R) mm of a face in steps, as many as are `described`."""
        steps = np.round(wrinkles[self._rows, self._regions] / STEP)
        return np.asarray(steps.clip(0, 255), np.uint8)

    def places(self) -> bytes:
        """Return where they lie, little-endian.

        First uint32, as many as a face has heights: SLOTS times the vertex of each, plus its slot. Then for
        each vertex and slot the number of the region plus 1, or 0 for none, uint8 (N1, SLOTS). Then the phase
        there and its slope in 1/mm at rest, float16 (N1, SLOTS, 4).
        """
        count = self._near.shape[1]
        regions = np.zeros((count, SLOTS), np.uint8)
        places = np.zeros((count, SLOTS, 4), "<f2")
        for region, (slot, own) in enumerate(zip(self._slots, self._near, strict=True)):
            regions[own, slot] = region + 1
            places[own, slot] = self._creases.place[own, region]
        targets = (SLOTS * self._rows + self._slots[self._regions]).astype("<u4")
        return targets.tobytes() + regions.tobytes() + places.tobytes()


def _near(creases: WrinkleTable, triangles: IntArray) -> ByteArray:
    """Return which vertices the triangles of each region have, bool (R, N1)."""
    near = np.zeros((len(creases.style), len(creases.place)), bool)
    for region, own in enumerate(near):
        own[triangles[(creases.regions >> region) & 1 == 1]] = True
    return near


def _slots(near: ByteArray) -> IntArray:
    """Return each region's slot (R,): that whose regions it meets the least; the busiest choose first."""
    meets = near.astype(np.int64) @ near.T
    slots = np.full(len(near), -1)
    for region in np.argsort(-(meets > 0).sum(axis=1), kind="stable"):
        costs = [meets[region][slots == slot].sum() for slot in range(SLOTS)]
        slots[region] = np.argmin(costs)
    return slots


def _apart(near: ByteArray, slots: IntArray, masks: Array) -> ByteArray:
    """Return `near` (R, N1) with no vertex in two regions of one slot: that with the greater mask has it."""
    apart = np.zeros_like(near)
    for slot in range(SLOTS):
        own = np.flatnonzero(slots == slot)
        if own.size:
            strongest = own[np.where(near[own], masks[own], -1.0).argmax(axis=0)]
            apart[own] = near[own] & (strongest == own[:, None])
    return apart
