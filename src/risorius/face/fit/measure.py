"""Measures of the face in millimetres, taken on the mesh in the head frame (the head's rotation removed)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, BoolArray, IndexArray, Int32Array
from ...core.parameters import INDEX
from ..contact.mouth import Mouth
from ..frame import FaceFrame
from ..head.head import Head

MIDLINE = 0.75  # mm from the middle at rest; vertices that are nearer form the lips' profile
# iBUG points (left and right are the subject's).
CHIN, CORNERS, LIPS = 8, (48, 54), (51, 57)
BROW_INNER, BROW_OUTER = (22, 21), (25, 18)


@dataclass(frozen=True, slots=True)
class Measures:
    """The measures of one frame; the fields are the columns of `.landmarks.csv`, in their order.

    lip_gap_mm                 opening between the inner lips at the midline; 0 if they touch as at rest
    lip_protrusion_mm          how far the middle of both lips is before its place at rest
    mouth_width_mm             from corner to corner
    jaw_drop_mm                how far the chin is below its place at rest
    eye_gap_{left,right}_mm    opening between the lids' margins over the middle of the eye
    brow_{inner,outer}_{left,right}_mm   height above the centre of the eyeballs
    head_*_deg, gaze_*_deg     as the frame was solved (gaze: eye in head)
    """

    lip_gap_mm: float
    lip_protrusion_mm: float
    mouth_width_mm: float
    jaw_drop_mm: float
    eye_gap_left_mm: float
    eye_gap_right_mm: float
    brow_inner_left_mm: float
    brow_inner_right_mm: float
    brow_outer_left_mm: float
    brow_outer_right_mm: float
    head_pitch_deg: float
    head_yaw_deg: float
    head_roll_deg: float
    gaze_pitch_deg: float
    gaze_yaw_deg: float


_ANGLES = ("head_pitch", "head_yaw", "head_roll", "gaze_pitch", "gaze_yaw")


class Gauge:
    """Measures the frames of one head."""

    def __init__(self, head: Head) -> None:
        self._head = head
        rest: Array = head.skin.matrix @ head.rest
        self._upper, self._lower = _profiles(head, rest)
        self._rest_gap = self._lip_gap(rest)
        self._lids = [_middle(pairs, rest) for pairs in head.lid_pairs]
        points = head.landmarks(rest)
        self._rest_lips, self._rest_chin = points[list(LIPS), 2].mean(), points[CHIN, 1]

    def landmarks(self, frame: FaceFrame) -> Array:
        """Return the 68 iBUG points (68, 3) in mm."""
        return self._head.landmarks(frame.skin)

    def measure(self, frame: FaceFrame) -> Measures:
        """Return the measures of `frame`."""
        skin = frame.skin.astype(np.float64)
        points = self._head.landmarks(skin)
        eyes = [_mean_length(skin[pairs[:, 0]] - skin[pairs[:, 1]]) for pairs in self._lids]
        brows = points[[*BROW_INNER, *BROW_OUTER], 1] - self._head.eye_centre[:, 1].mean()
        return Measures(
            max(self._lip_gap(skin) - self._rest_gap, 0.0),
            float(points[list(LIPS), 2].mean() - self._rest_lips),
            float(np.linalg.norm(points[CORNERS[0]] - points[CORNERS[1]])),
            float(self._rest_chin - points[CHIN, 1]),
            *eyes,
            *(float(height) for height in brows),
            *(float(frame.parameters[INDEX[name]]) for name in _ANGLES),
        )

    def _lip_gap(self, skin: Array) -> float:
        """Return the least distance between the two lips' profiles on the midline."""
        upper, lower = skin[self._upper], skin[self._lower]
        return float(min(_nearest(upper[:, 0], lower), _nearest(lower[:, 0], upper)))


def _profiles(head: Head, rest: Array) -> tuple[Int32Array, Int32Array]:
    """Return the edges (k, 2), both ways round, of the upper and the lower lip's profile on the midline."""
    mouth = Mouth.of(head)
    quads = head.skin.quads
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    middle = np.abs(rest[:, 0]) < MIDLINE
    upper, lower = (_mask(mouth.lip(above), len(rest)) & middle for above in (True, False))
    return sides[upper[sides].all(axis=1)], sides[lower[sides].all(axis=1)]


def _mask(vertices: IndexArray, count: int) -> BoolArray:
    mask = np.zeros(count, bool)
    mask[vertices] = True
    return mask


def _middle(pairs: Int32Array, rest: Array) -> Int32Array:
    """Return the lid pairs (k, 2) whose opening at rest is nearly the greatest."""
    opening = np.linalg.norm(rest[pairs[:, 0]] - rest[pairs[:, 1]], axis=1)
    return np.asarray(pairs[opening > 0.9 * opening.max()])


def _mean_length(vectors: Array) -> float:
    return float(np.linalg.norm(vectors, axis=1).mean())


def _nearest(points: Array, segments: Array) -> float:
    """Return the least distance from any of `points` (n, 3) to any of `segments` (m, 2, 3)."""
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    from_start = points[:, None] - start
    share = np.clip((from_start * along).sum(axis=-1) / (along**2).sum(axis=-1), 0.0, 1.0)
    return float(np.linalg.norm(from_start - share[..., None] * along, axis=-1).min())
