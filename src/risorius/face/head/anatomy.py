"""The anatomical mode: fields of displacement from lines of pull, for heads that have no sculpted shapes.

A muscle pulls the points of its zone along its line, out of the skin and across the line, each with a weight
that varies smoothly over the zone; the spring network at rest turns these forces into displacements
(facts: face-model, section 1, column 3). `tools/fit_anatomy.py` fits the weights once to the sculpts of the
standard head, whose folder holds them: they belong to places on a face, not to vertices of a mesh.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.sparse.linalg import splu
from scipy.spatial.distance import cdist

from ...core.arrays import Array, Int32Array, IntArray
from ...errors import HeadError, Place
from ...machine.npz import read_arrays
from ..numerics.quads import quad_normals
from ..numerics.stiffness import spring_stiffness
from .muscle_table import FILE as TABLE
from .muscle_table import Force, ForceType, Muscle

FILE = "anatomy.npz"
REACH = 5.5  # mm over which the weights vary
JAW = 30.0  # mm that a share of 1 in the jaw's rotation counts: it separates the lips that touch
MIRROR = np.array([-1.0, 1.0, 1.0])
# Displacements below this share of a field's greatest one are left out.
NEGLIGIBLE = 0.002


@dataclass(frozen=True, slots=True)
class Pull:
    """The strength of one muscle: weights (k, directions) at `places` (k, 4), mm and the jaw's share."""

    places: Array
    weights: Array


@dataclass(frozen=True)
class Skin:
    """The skin of a head for the anatomical mode: `rest` (N, 3) mm, `quads` (Q, 4), `jaw_weight` (N,)."""

    rest: Array
    quads: IntArray
    jaw_weight: Array

    @cached_property
    def places(self) -> Array:
        """The points as (N, 4), mm and the jaw's share."""
        return np.column_stack([self.rest, JAW * self.jaw_weight])

    @cached_property
    def normals(self) -> Array:
        """Unit normals (N, 3) of the points."""
        return quad_normals(self.rest, self.quads)

    @cached_property
    def network(self) -> splu:
        """The factored stiffness of the whole skin."""
        stiffness = spring_stiffness(len(self.rest), self.quads)
        symmetric = {"SymmetricMode": True}
        return splu(stiffness, permc_spec="MMD_AT_PLUS_A", options=symmetric, diag_pivot_thresh=0.0)

    def displaced(self, muscle: Muscle, pull: Pull) -> Array:
        """Return the displacement (N, 3) in mm of the left muscle (or the only one) at activation 1.

        Raises HeadError if the zone of a gathered force holds no skin.
        """
        share = influence(self.places, pull.places) @ pull.weights
        share *= _within(muscle, self.rest)[:, None]
        force = np.einsum("nd,ndc->nc", share, directions(muscle, self.rest, self.normals))
        return np.asarray(self.network.solve(force) + sum(map(self._displaced_by, muscle.gathered)))

    def _displaced_by(self, force: Force) -> Array:
        """Return the displacement (N, 3) in mm by a gathered force, which is weaker away from its line."""
        ways = directions(force, self.rest, self.normals)
        way = _unit(ways[:, 0] + ways[:, 1]) if force.type == "bulge" else ways[:, 0]
        strength = np.clip(1.0 - (from_line(force, self.rest) / max(force.zone, 1e-9)) ** 2, 0.0, 1.0)
        if not strength.any():
            raise HeadError(
                f"no skin lies within {force.zone:g} mm of the line {force.line}; expected a larger zone"
            )
        field = self.network.solve(strength[:, None] * way)
        return np.asarray(field * (force.moves / np.linalg.norm(field, axis=1).max()))


def influence(points: Array, places: Array) -> Array:
    """Return the shares (n, k) of the weights at places (k, 4) for points (n, 4)."""
    return np.asarray(np.exp(-0.5 * (cdist(points, places) / REACH) ** 2))


def directions(muscle: Muscle | Force, points: Array, normals: Array) -> Array:
    """Return the unit directions (n, d, 3) in which a muscle's type pulls `points` (n, 3).

    The last direction lies in the skin, across the others: fibres fan out and gather the skin beside them.
    """
    origin, insertion = (np.array(p) for p in muscle.line)
    along = np.broadcast_to((origin - insertion) / np.linalg.norm(origin - insertion), points.shape)
    towards = _unit(origin - points)
    around = _unit(np.cross([1.0, 0.0, 0.0], points - origin))
    chosen: Mapping[ForceType, tuple[Array, ...]] = {
        "linear": (towards, normals),
        "sheet": (along, normals),
        "sphincter": (towards, normals),
        "rotation": (around, normals),
        "bulge": (along, normals),
        "protrusion": (-along, towards, normals),
    }
    ways = chosen[muscle.type]
    return np.stack([*ways, _unit(np.cross(normals, ways[0]))], axis=1)


def from_line(muscle: Muscle | Force, points: Array) -> Array:
    """Return the distances (n,) in mm of `points` (n, 3) from a muscle's line of pull."""
    start, end = (np.array(p) for p in muscle.line)
    share = np.clip((points - start) @ (end - start) / ((end - start) @ (end - start)), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - start - share[:, None] * (end - start), axis=1))


def _within(muscle: Muscle, points: Array) -> Array:
    """Return by how much (n,), 0..1, a muscle's zone holds `points` (n, 3): it ends over twice `REACH`."""
    beyond = from_line(muscle, points) - muscle.zone - REACH
    return np.clip(1.0 - beyond / (2.0 * REACH), 0.0, 1.0)


def anatomical_fields(
    skin: Skin,
    mirror: IntArray,
    muscles: Mapping[str, Muscle],
    pulls: Mapping[str, Pull],
    names: tuple[str, ...],
) -> dict[str, tuple[Int32Array, Array]]:
    """Return vertices (k,) and displacements (k, 3) in mm at activation 1 for parameters by name.

    `mirror` (N,) is the index of each vertex's mirror image; a right muscle mirrors the left one. Raises
    HeadError if a muscle's type pulls in more or fewer directions than its weights are for, or if the zone of
    a gathered force holds no skin.
    """
    fields = {}
    for name in names:
        base, _, side = name.partition(".")
        _check_type(base, muscles[base], pulls[base])
        try:
            field = skin.displaced(muscles[base], pulls[base])
        except HeadError as error:
            raise HeadError(f"muscle '{base}': {error.message}", Place(TABLE)) from None
        if side == "right":
            field = field[mirror] * MIRROR
        length = np.linalg.norm(field, axis=1)
        vertices = np.flatnonzero(length > NEGLIGIBLE * length.max()).astype(np.int32)
        fields[name] = (vertices, field[vertices])
    return fields


def _check_type(name: str, muscle: Muscle, pull: Pull) -> None:
    point = np.zeros((1, 3))
    ways, weighted = directions(muscle, point, point).shape[1], pull.weights.shape[1]
    if ways != weighted:
        raise HeadError(
            f"muscle '{name}': type '{muscle.type}' pulls in {ways} directions; expected a type that pulls "
            f"in {weighted}, as its weights were fitted (tools/fit_anatomy.py fits them anew)",
            Place(TABLE),
        )


def load_pulls(folder: Path, names: tuple[str, ...]) -> dict[str, Pull]:
    """Return the weights in a head's `folder` for muscles by name; raise HeadError if one is missing."""
    path = folder / FILE
    try:
        arrays = read_arrays(path)
        return {
            name: Pull(*(arrays[f"{name}/{part}"].astype(np.float64) for part in ("places", "weights")))
            for name in names
        }
    except (OSError, ValueError, KeyError) as error:
        raise HeadError(f"not a file of muscle weights: {error}", Place(str(path))) from error


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-9))
