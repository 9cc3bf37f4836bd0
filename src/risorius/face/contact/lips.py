"""The lips' contact: they never pass through each other, close on `lip_seal`, and tuck in on `lip_tuck`.

All three are constraints on the plate of skin around the mouth (facts: face-model, section 5). They are
solved after muscles and jaw, so that no expression can open a closure.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ...core.arrays import Array
from ...core.lips.articulators import SEAL_MM, WIDEST_MM
from ..head.head import Head
from ..muscles.jaw import Jaw
from ..numerics.complementarity import Gaps, Workspace, solve_gaps
from ..numerics.sparse import SparseRows, carry, carry_upwards
from .contact import Contacts, find_contacts, keep_tight
from .mouth import OVERLAP, Mouth, TeethEdge
from .plate import PlateCompliance, nearby, plate_compliance

NEAR = 0.12  # mm; wider gaps are left out of the solution after closing
SHUT = 0.005  # mm that a full seal may leave open
BEYOND = 2.0  # mm beyond the gap from which on a seal that is not full closes the lips as a full one does
LEFT = 1.0  # mm that may stay open if a seal just reaches: facets keep the lips apart by less
PRESS = 0.05  # mm by which a seal presses the lips together, because facets would keep them apart
SLACK = 0.005  # mm outside its bounds that a gap may have
PASSES = 3
PLACES, WIDTH = 61, 0.042  # places at which a seal closes the lips; the share of the mouth about each
SWEEPS = 300  # the most; most faces need only a few
TUCK_WIDTH = 11.0  # mm to either side of the midline over which the lip meets the teeth
TUCK_ABOVE, TUCK_BEFORE = 0.7, 2.2  # mm of the tucked lip above and before the teeth's edge
APART = 2.0  # mm that profiles may be apart for each mm that a seal does not reach: it begins without a step
OPEN = 0.5  # mm between lips from which on they keep to the line when their corners are pushed apart
TUCK_ROOM = 1.2  # mm of the upper lip above the teeth's edge, so that it does not meet the tucked lip


class Handles:
    """Places on the lips, each a weighted sum of the mouth's points, that can be moved one by one."""

    def __init__(self, weights: Array, plate: PlateCompliance) -> None:
        """Take the places `weights` (s, n)."""
        self._rows = SparseRows.of(sp.csr_matrix(weights))
        self._region = plate.region
        inverse = np.linalg.inv(weights @ plate.compliance @ weights.T)
        self._motion = np.ascontiguousarray((weights.T @ inverse).T @ plate.motion)
        self._sums = np.empty((3, len(plate.region)))

    def places(self, points: Array) -> Array:
        """Return the places (s, 4) on `points` (n, 4)."""
        return self._rows.times(points, np.empty((len(self._motion), 4)))

    def move(self, skin: Array, way: Array) -> None:
        """Move the places by `way` (s, 4) mm, together with the level-0 `skin` (N0, 4) around them."""
        carry(self._region, self._motion, way, self._sums, skin)


class Lips:
    """The lips' constraints of one head, with the workspace of one solver: not for two threads at a time."""

    def __init__(self, head: Head, jaw: Jaw | None = None) -> None:
        mouth = Mouth.of(head, jaw)
        rest: Array = mouth.matrix @ head.rest
        plate = plate_compliance(head.quads, mouth.matrix, nearby(head.rest, rest))
        self._region, self._motion = plate.region, plate.motion
        # How far gaps open is solved to micrometres; half as many bytes are fetched from memory.
        self._compliance = plate.compliance.astype(np.float32)
        self._facing = mouth.facing
        self._matrix, self._points = SparseRows.of(mouth.matrix), np.zeros((len(rest), 4))
        self._line = Handles(mouth.line, plate)
        self._ends = SparseRows.of(sp.csr_matrix(0.5 * np.abs(mouth.line[[0, -1]])))
        self._corners = np.zeros((2, 4))
        upper, lower = np.maximum(mouth.line, 0.0), np.maximum(-mouth.line, 0.0)
        central = np.abs(lower @ rest[:, 0]) <= TUCK_WIDTH
        self._tucked = Handles(np.vstack([upper[central], lower[central]]), plate)
        self._teeth = TeethEdge.of(head.teeth_upper, TUCK_WIDTH + 4.0, 16)
        most = len(mouth.facing.vertices)
        self._contacts = Contacts.allocate(most)
        self._work = Workspace.allocate(most, len(rest))
        self._low, self._high = np.full(most, -OVERLAP), np.full(most, np.inf)
        self._narrowest = np.zeros(PLACES, np.int32)
        self._force = np.zeros(len(rest))
        self._sums = np.empty(len(plate.region))

    def solve(self, skin: Array, seal: float, tuck: float) -> None:
        """Move the level-0 `skin` (N0, 4) in place.

        The lower lip goes the share `tuck` (0..1) of its way to the upper teeth, and the lips come
        together by `seal`: by `SEAL_MM`·seal mm, or wholly if it is 1, which leaves no tuck. Then lips that
        overlap are moved apart.
        """
        if tuck > 0.0 and seal < 1.0:
            self._tuck(skin, tuck * (1.0 - seal))
        opening = WIDEST_MM
        if seal > 0.0:
            beyond = self._close(skin, seal)
            left = LEFT * min(max(1.0 - beyond / BEYOND, 0.0), 1.0) - APART * min(beyond, 0.0)
            opening = min((1.0 - seal) * WIDEST_MM + seal * SHUT, max(left, SHUT))
        apart = self._line.places(self._matrix.times(skin, self._points))
        length = np.sqrt((apart * apart).sum(axis=1, keepdims=True))
        left = np.minimum(length, opening)
        apart *= left / np.maximum(length, PRESS)
        open_by = np.clip(left / OPEN, 0.0, 1.0)
        eased = open_by * open_by * (3.0 - 2.0 * open_by)
        for passes_left in reversed(range(PASSES)):
            if not self._push_apart(skin, opening):
                break
            if passes_left:
                self._restore(skin, apart, eased)
                self._matrix.times(skin, self._points)

    def _restore(self, skin: Array, apart: Array, shares: Array) -> None:
        """Restore `shares` (s, 1) of the distances `apart` (s, 4) between the lips along the line.

        Lips that are pushed apart at the corners would else move at their middle, too, by some tenths of a
        millimetre from frame to frame. What is left goes to `apart`: brought back by their share again and
        again, places that are hardly open would be pushed into the other lip.
        """
        moved = self._line.places(self._matrix.times(skin, self._points))
        way = (apart - moved) * shares
        self._line.move(skin, way)
        np.add(moved, way, out=apart)

    def _tuck(self, skin: Array, tuck: float) -> None:
        """Move the lower lip to the upper teeth by the share `tuck`, and the upper lip away from it."""
        here = self._tucked.places(self._matrix.times(skin, self._points))
        upper, lower = here[: len(here) // 2], here[len(here) // 2 :]
        goal = here.copy()
        goal_upper, goal_lower = goal[: len(upper)], goal[len(upper) :]
        goal_upper[:, 1] = np.maximum(upper[:, 1], self._teeth.at(upper[:, 0])[0] + TUCK_ROOM)
        edge_y, edge_z = self._teeth.at(lower[:, 0])
        goal_lower[:, 1], goal_lower[:, 2] = edge_y + TUCK_ABOVE, edge_z + TUCK_BEFORE
        self._tucked.move(skin, tuck * (goal - here))

    def _close(self, skin: Array, seal: float) -> float:
        """Move the points of the line together, so far as a seal reaches: narrow places meet first.

        Return how many mm it reaches beyond the widest; below 0: it does not close that.
        """
        apart = self._line.places(self._matrix.times(skin, self._points))
        apart[:, 1] += PRESS
        beyond = np.inf
        if seal < 1.0:
            length = np.sqrt((apart * apart).sum(axis=1, keepdims=True))
            beyond = SEAL_MM * seal - float(length.max())
            apart *= np.minimum(SEAL_MM * seal / np.maximum(length, PRESS), 1.0)
        self._line.move(skin, -apart)
        return beyond

    def _push_apart(self, skin: Array, opening: float) -> bool:
        """Push along y until no gap overlaps or is wider than `opening` mm; return False if none did.

        The mouth's points are those of `skin`.
        """
        points, contacts = self._points, self._contacts
        free = opening >= WIDEST_MM
        count = find_contacts(self._facing, points, NEAR if free else np.inf, contacts)
        ends = self._ends.times(points, self._corners)
        bounds = -OVERLAP, np.inf if free else opening
        count = keep_tight(contacts, count, NEAR, bounds, SLACK, ends, WIDTH, self._narrowest, self._high)
        if count == 0:
            return False
        self._force[:] = 0.0
        tight = contacts.points[:count], contacts.weight[:count], contacts.gap[:count]
        gaps = Gaps(*tight, self._low[:count], self._high[:count])
        solve_gaps(gaps, self._compliance, SWEEPS, self._work, self._force)
        carry_upwards(self._region, self._motion, self._force, self._sums, skin)
        return True
