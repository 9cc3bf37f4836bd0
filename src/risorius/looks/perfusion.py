"""Blood in the skin of a moving face: skin where it gathers reddens, skin that it is pressed out of pales.

Skin is coloured by melanin, which stays, and by haemoglobin, which moves with an expression (Jimenez et al.
2010, "A practical appearance model for dynamic facial color"). The blood of a patch of skin is taken as
constant: if the patch shrinks to the share λ of its area, its haemoglobin rises to 1/λ. Where skin folds, the
ridges are squeezed instead, and the furrows, which the shader draws, are dark. Lips that are pressed together
lose blood. Colours change as light is absorbed: the albedo times exp(−absorption · change).
"""

from __future__ import annotations

import math
from copy import copy
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..core.arrays import Array, Float32Array, UInt32Array, UIntArray
from ..core.parameters import INDEX
from ..face.frame import FaceFrame
from ..face.head.head import Head
from ..face.head.identity import Looks
from ..face.numerics.sparse import SparseRows
from ..face.skin.wrinkle_regions import place_regions
from ..machine.kernels.jit import f4, kernel
from ..machine.kernels.vec import at, cross, dot, sub
from .anatomy import smoothstep
from .attributes import ALBEDO

# How much the usual haemoglobin absorbs in red, green and blue: twice of it darkens green by a quarter, about
# as the flush of the cheeks does (`complexion`); lips have more of it under a thinner skin. Numbers are ours.
SKIN_ABSORBS = f4(0.03), f4(0.29), f4(0.25)
LIPS_ABSORB = f4(0.10), f4(0.46), f4(0.36)
# Part of the gain that the skin of wrinkle regions gets: ridges lose blood; deep folds the shader reddens.
_FOLDED = {"forehead": -0.8, "glabella": -0.4, "nose_root": 0.0, "wing": 0.0, "sneer": 0.0}
LEAST, MOST = f4(-0.12), f4(0.45)  # of the usual haemoglobin that skin gains, whatever its area
_PRESSED = 0.45  # of the lips' blood that the greatest pressure drives out
_YIELDING = 0.35  # activation of the presser at which two thirds of that is gone
_PRESSER = INDEX["orbicularis_oris_presser"]
ROUNDS = 2  # of smoothing on the coarse skin
_HIDDEN = ("inner_mouth", "lids", "garment")
_NEGLIGIBLE = 0.004  # a quad with a smaller share of a vertex's area is left out


class SkinBlood(NamedTuple):
    """The visibility of blood at each vertex of the skin (N1,).

    flesh   how much of the change is seen, outside the lips; `lips` on them
    folded  the part of its gain that skin gets where it is bunched, -1 to 1
    """

    flesh: Array
    lips: Array
    folded: Array


class Perfusion:
    """The colours of one head's skin as its blood moves; keeps a workspace."""

    def __init__(self, head: Head, looks: Looks, albedo: Float32Array) -> None:
        """Prepare for the skin's `albedo` (N1, 3) at rest; the looks' `flush` scales the change."""
        blood = skin_blood(head, looks)
        here = np.flatnonzero(blood.flesh + blood.lips > 0.0)
        quads = head.quads.astype(np.uint32)
        area = np.zeros(len(quads), np.float32)
        _measure(np.asarray(head.skin.matrix @ head.rest, np.float32), quads, np.ones_like(area), area)
        fine = head.skin.matrix.tocsr()[here]
        near = np.unique(fine.indices)  # the coarse vertices that count
        tables = _smoothed(head, area)[near], fine[:, near]
        self._to_coarse, self._to_fine = (SparseRows.of(table, np.float32) for table in tables)
        self._quads, self._area, self._vertices = quads, area, here.astype(np.uint32)
        self._flesh, self._lips, self._folded = (part[here].astype(np.float32) for part in blood)
        self._albedo = np.ascontiguousarray(albedo[here])
        self._share, self._gain = np.zeros(len(quads), np.float32), np.zeros(len(near), np.float32)

    def clone(self) -> Perfusion:
        """Return the same with a workspace of its own."""
        other = copy(self)
        other._share, other._gain = self._share.copy(), self._gain.copy()
        return other

    def colour(self, frame: FaceFrame, attributes: Float32Array) -> None:
        """Write the albedo of the skin in a frame to its `attributes` (N1 or more, ATTRIBUTES)."""
        _measure(frame.skin, self._quads, self._area, self._share)
        _average(*self._to_coarse, self._share, self._gain)
        _paint(
            *self._to_fine,
            self._gain,
            self._vertices,
            self._folded,
            self._flesh,
            self._lips,
            f4(gained_by_lips(frame)),
            self._albedo,
            attributes,
        )


def skin_blood(head: Head, looks: Looks) -> SkinBlood:
    """Return how blood shows; the looks' `flush` scales it."""
    shown = looks.flush * _shown(head)
    lips = smoothstep(0.25, 0.75, np.asarray(head.skin.matrix @ head.masks["lips"]))
    return SkinBlood(shown * (1.0 - lips), shown * lips, _folded(head))


def gained_by_lips(frame: FaceFrame) -> float:
    """Return how much of their usual blood lips gain: less than 0 where they are pressed together."""
    pressure = max(float(frame.parameters[_PRESSER]), 0.0)
    return _PRESSED * math.expm1(-pressure / _YIELDING)


def _shown(head: Head) -> Array:
    """Return how much of the change (N1,) is seen: none within the mouth, on lids and below the cloth."""
    hidden = np.max([head.masks[name] for name in _HIDDEN], axis=0)
    shown = 1.0 - smoothstep(0.0, 0.6, np.asarray(head.skin.matrix @ hidden))
    return np.where(shown < _NEGLIGIBLE, 0.0, shown)


def _folded(head: Head) -> Array:
    """Return the part (N1,) of the gain of blood that skin gets where it is bunched."""
    part = np.ones(head.skin.matrix.shape[0])
    for placed in place_regions(head):
        if placed.region.name in _FOLDED:
            mask = placed.zone.mask
            part = np.minimum(part, 1.0 + mask * (_FOLDED[placed.region.name] - 1.0))
    return part


def _smoothed(head: Head, area: Float32Array) -> sp.csr_matrix:
    """Return the matrix (N0, Q0) from values of quads to smooth values of vertices, weighted by area."""
    quads, count = head.quads, len(head.rest)
    owner = np.repeat(np.arange(len(quads)), 4)
    around = sp.csr_matrix((np.ones(len(owner)), (quads.ravel(), owner)), shape=(count, len(quads)))
    beside = sp.csr_matrix(around @ around.T > 0, dtype=np.float64)
    total = around
    for _ in range(ROUNDS):
        total = beside @ total
    total = sp.csr_matrix(total @ sp.diags(area.astype(np.float64)))
    total = sp.diags(1.0 / np.asarray(total.sum(axis=1)).ravel()) @ total
    total.data[total.data < _NEGLIGIBLE] = 0.0
    total.eliminate_zeros()
    return (sp.diags(1.0 / np.asarray(total.sum(axis=1)).ravel()) @ total).tocsr()


@kernel("f4[:, :], u4[:, :], f4[:], f4[:]", arithmetic="fast")
def _measure(skin: Float32Array, quads: UInt32Array, area: Float32Array, out: Float32Array) -> None:
    """Write the share of its `area` (Q0,) that each quad has; the coarse vertices are the first of `skin`."""
    for q in range(len(quads)):
        first = sub(at(skin, quads[q, 2]), at(skin, quads[q, 0]))
        second = sub(at(skin, quads[q, 3]), at(skin, quads[q, 1]))
        normal = cross(first, second)
        out[q] = np.sqrt(dot(normal, normal)) / area[q]


@kernel("u4[:], u2[:], f4[:], f4[:], f4[:]", "u4[:], u4[:], f4[:], f4[:], f4[:]", arithmetic="fast")
def _average(
    start: UInt32Array, column: UIntArray, weight: Float32Array, share: Float32Array, out: Float32Array
) -> None:
    """Write how much haemoglobin each coarse vertex gains, of the usual."""
    for i in range(len(out)):
        mean = f4(0)
        for e in range(start[i], start[i + 1]):
            mean += weight[e] * share[column[e]]
        out[i] = min(max(f4(1) / max(mean, f4(0.1)) - f4(1), LEAST), MOST)


@kernel(
    "u4[:], u2[:], f4[:], f4[:], u4[:], f4[:], f4[:], f4[:], f4, f4[:, :], f4[:, :]",
    "u4[:], u4[:], f4[:], f4[:], u4[:], f4[:], f4[:], f4[:], f4, f4[:, :], f4[:, :]",
    arithmetic="fast",
)
def _paint(
    start: UInt32Array,
    column: UIntArray,
    weight: Float32Array,
    gain: Float32Array,
    vertices: UInt32Array,
    folded: Float32Array,
    flesh: Float32Array,
    lips: Float32Array,
    pressed: float,
    albedo: Float32Array,
    attributes: Float32Array,
) -> None:
    for k in range(len(vertices)):
        more = f4(0)
        for e in range(start[k], start[k + 1]):
            more += weight[e] * gain[column[e]]
        if more > f4(0):
            more *= folded[k]
        of_skin, of_lips = flesh[k] * more, lips[k] * pressed
        for c in range(3):
            half = f4(0.5) * (SKIN_ABSORBS[c] * of_skin + LIPS_ABSORB[c] * of_lips)
            # Nearly exp(−2 half), for a fraction of its cost.
            attributes[vertices[k], ALBEDO + c] = albedo[k, c] * (f4(1) - half) / (f4(1) + half)
