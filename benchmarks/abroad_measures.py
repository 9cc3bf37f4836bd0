"""Measure lips, lower lip and teeth, lids, gaze and head on a mesh, for `abroad.py`.

All is measured on some vertices of the level-1 skin, the `wanted` ones, whose order is that of every array
here: what lips, lids and teeth need, and every eighth of those that the fit of ARKit weights counts.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from risorius.core.arrays import Array, BoolArray, IndexArray
from risorius.core.parameters import INDEX
from risorius.face.contact.mouth import Mouth
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.face.frame import FaceFrame
from risorius.face.head.head import Head

EVERY = 8  # of the visible vertices, those that the root mean square is taken over
SEALED = 0.1  # mm over rest that our own lips may stand open anywhere in a frame that counts as sealed
SOUGHT = 0.05  # a seal that is asked for: lips at rest touch, too, but nothing closes them
TUCKED = 0.9  # share of a tuck from which on the lower lip should be at the teeth
SHUT = 0.3  # mm that lids may be apart to count as shut
NEAR_MIDDLE = 8.0  # mm to either side over which the lower lip's distance from the teeth is taken


@dataclass(frozen=True)
class Seen:
    """A file as a program shows it: vertices (frames, k, 3) in the world, in mm.

    `head` (frames, 3, 3) is its rotation; `looks` (frames, 2, 3) are the directions of both eyes in the
    world, None if the file has no eyes.
    """

    skin: Array
    head: Array
    looks: Array | None


@dataclass(frozen=True)
class Own:
    """Our face: as `Seen`, and which frames are sealed, tucked, and have which lids (frames, 2) shut."""

    seen: Seen
    sealed: BoolArray
    tucked: BoolArray
    shut: BoolArray


@dataclass(frozen=True)
class Loss:
    """The differences between a file and our face.

    gap       mm over rest that lips stand open at a place, at most, in a frame in which ours are sealed
    overlap   mm by which they overlap there more than at rest, at most
    beyond    mm by which they stand farther open than ours, at most over all frames
    tuck      mm that the lower lip is farther from the upper teeth than ours at /f v/, at most
    lids      mm that lids stand farther open than ours where ours are shut, at most
    gaze      degrees between the eyes' directions in the head and ours, at most
    head      degrees between the head's rotation and ours, at most
    rms       mm between its skin and ours over the visible vertices of all frames
    """

    gap: float
    overlap: float
    beyond: float
    tuck: float
    lids: float
    gaze: float
    head: float
    rms: float


class Gauges:
    """Measures the faces of one head."""

    def __init__(self, head: Head) -> None:
        self.head = head
        mouth = Mouth.of(head)
        lids = head.lid_pairs
        counted = ArkitFit.of(head).counted[::EVERY]
        self.wanted: IndexArray = np.unique(
            np.concatenate([mouth.vertices, *(p.ravel() for p in lids), counted])
        )
        self._mouth, self._line = self._here(mouth.vertices), mouth.line
        self._counted = self._here(counted)
        self._lids = [self._here(pairs) for pairs in lids]
        self.share: Array = np.clip(head.skin.matrix @ head.neck_weight, 0.0, 1.0)[self.wanted, None]
        self.rest: Array = (head.skin.matrix @ head.rest)[self.wanted]
        self._rest_gaps = self._heights(self.rest[None])
        teeth = head.teeth_upper
        self._teeth = cKDTree(teeth.vertices[teeth.material < 0.5])
        lower = self._here(mouth.lip(upper=False))
        self._lower = lower[np.abs(self.rest[lower, 0]) < NEAR_MIDDLE]

    def _here(self, vertices: IndexArray) -> IndexArray:
        return np.searchsorted(self.wanted, vertices)

    def own(self, faces: Iterable[FaceFrame]) -> Own:
        """Return our face's frames."""
        skins, heads, looks, values = [], [], [], []
        for face in faces:
            skins.append(face.skin[self.wanted].astype(np.float64))
            heads.append(face.head_rotation)
            looks.append(face.head_rotation @ face.eye_rotation[:, :, 2].T)
            values.append(face.parameters)
        skin, head, parameters = np.array(skins), np.array(heads), np.array(values)
        sealed = (self.gaps(skin).max(axis=1) < SEALED) & (parameters[:, INDEX["lip_seal"]] > SOUGHT)
        tucked = parameters[:, INDEX["lip_tuck"]] * (1.0 - parameters[:, INDEX["lip_seal"]]) > TUCKED
        seen = Seen(self.turned(skin, head), head, np.swapaxes(looks, 1, 2))
        return Own(seen, sealed, tucked, self.openings(skin) < SHUT)

    def turned(self, skin: Array, head: Array) -> Array:
        """Return skins (frames, k, 3) as the heads' rotations carry them: each vertex by the neck's share."""
        pivot = self.head.head_pivot
        return skin + self.share * (np.einsum("fkj,fij->fki", skin - pivot, head) + pivot - skin)

    def in_head(self, seen: Seen) -> Array:
        """Return skins without the heads' rotations: right where the share is 1, as at lips and lids."""
        pivot = self.head.head_pivot
        return np.einsum("fkj,fji->fki", seen.skin - pivot, seen.head) + pivot

    def gaps(self, skin: Array) -> Array:
        """Return how far apart the lips are at each place from corner to corner, over rest (frames, 19)."""
        return self._heights(skin) - self._rest_gaps

    def _heights(self, skin: Array) -> Array:
        return skin[:, self._mouth, 1] @ self._line.T

    def openings(self, skin: Array) -> Array:
        """Return how far apart each eye's lids are where they are widest (frames, 2); overlap counts as 0."""
        apart = [skin[:, pairs[:, 0], 1] - skin[:, pairs[:, 1], 1] for pairs in self._lids]
        return np.stack([np.maximum(heights.max(axis=1), 0.0) for heights in apart], axis=1)

    def to_teeth(self, skin: Array) -> Array:
        """Return the least distance of the lower lip's middle from the upper teeth (frames,)."""
        return np.array([self._teeth.query(points[self._lower])[0].min() for points in skin])

    def loss(self, seen: Seen, own: Own) -> Loss:
        """Compare a file's face with ours, frame by frame."""
        skin, ours = self.in_head(seen), self.in_head(own.seen)
        gaps, our_gaps = self.gaps(skin), self.gaps(ours)
        sealed, beyond = gaps[own.sealed], gaps - np.maximum(our_gaps, 0.0)
        teeth = self.to_teeth(skin[own.tucked]) - self.to_teeth(ours[own.tucked])
        apart = (seen.skin - own.seen.skin)[:, self._counted]
        return Loss(
            gap=_most(sealed),
            overlap=_most(-sealed),
            beyond=_most(beyond),
            tuck=_most(teeth),
            lids=_most((self.openings(skin) - self.openings(ours))[own.shut]),
            gaze=np.nan if seen.looks is None else _most(_gaze_apart(seen, own.seen)),
            head=_most(_angles(seen.head, own.seen.head)),
            rms=float(np.sqrt((apart**2).sum(axis=2).mean())),
        )


def _gaze_apart(seen: Seen, own: Seen) -> Array:
    """Return the degrees between the eyes' directions in the head (frames, 2)."""
    assert seen.looks is not None
    assert own.looks is not None
    one, other = (np.einsum("fej,fji->fei", each.looks, each.head) for each in (seen, own))
    cross = np.linalg.norm(np.cross(one, other), axis=2)
    return np.degrees(np.arctan2(cross, (one * other).sum(axis=2)))


def _angles(one: Array, other: Array) -> Array:
    """Return the degrees between rotations (frames, 3, 3): exact for small ones, too."""
    between = np.einsum("fji,fjk->fik", one, other)
    across = between - between.swapaxes(1, 2)
    sine = 0.5 * np.sqrt(0.5 * (across**2).sum(axis=(1, 2)))
    return np.degrees(np.arctan2(sine, 0.5 * (np.trace(between, axis1=1, axis2=2) - 1.0)))


def _most(values: Array) -> float:
    return float(values.max()) if values.size else np.nan
