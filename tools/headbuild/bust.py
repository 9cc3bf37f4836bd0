"""The part of the body that the head file holds: all skin above the chest, cut along edge loops."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray
from risorius.face.head.identity import Identity

from .identity import body
from .local import local_maps
from .loops import Loops
from .source import Source

# One edge of each loop that bounds the bust, and one vertex inside: chest, left arm, right arm.
_CUTS = ((1383, 1393), (1677, 1678), (8349, 8350))
_SEED = 755


@dataclass(frozen=True)
class Bust:
    """The bust in its own numbering and frame (mm, origin midway between the eyes).

    `ids` (N0,) are the base mesh's vertices in ascending order, `rest` (N0, 3), `quads` (Q0, 4) local,
    `uv_quads` (Q0, 4) texture indices; `body` (n, 3) is the whole base mesh in the same frame; eyes are left,
    right.
    """

    source: Source
    ids: AnyArray
    quads: AnyArray
    uv_quads: AnyArray
    body: AnyArray
    eye_centre: AnyArray
    eye_radius: AnyArray
    template: Bust | None = None

    @cached_property
    def places(self) -> AnyArray:
        """Positions (N0, 3) by which vertices are told apart: the template's, for every identity."""
        return self.rest if self.template is None else self.template.rest

    def reshaped(self, points: AnyArray) -> Bust:
        """The same bust with the skin at `points` (N0, 3)."""
        whole = self.body.copy()
        whole[self.ids] = points
        return replace(self, body=whole)

    @cached_property
    def rest(self) -> AnyArray:
        """Positions (N0, 3) of the identity before the lips are sealed."""
        return self.body[self.ids]

    @cached_property
    def loops(self) -> Loops:
        """The loops of the bust, in its own numbering."""
        return Loops(self.quads)

    @cached_property
    def mirror(self) -> AnyArray:
        """(N0,) local index of each vertex's mirror image."""
        return self.local(self.source.mirror()[self.ids])

    @cached_property
    def edges(self) -> AnyArray:
        """(E, 2) unique edges."""
        sides = np.stack([self.quads, np.roll(self.quads, -1, axis=1)], axis=-1).reshape(-1, 2)
        return np.unique(np.sort(sides, axis=1), axis=0)

    @cached_property
    def laplacian(self) -> sp.csr_matrix:
        """(N0, N0) graph Laplacian with unit edges."""
        (a, b), count = self.edges.T, len(self.ids)
        graph = sp.csr_matrix((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, a])), shape=(count, count))
        return (sp.diags(np.asarray(graph.sum(axis=1)).ravel()) - graph).tocsr()

    def spread(self, held: AnyArray, values: AnyArray, hold: float = 2.0, fade: float = 0.02) -> AnyArray:
        """`values` (N0,) nearly kept where `held` is 1, fading off smoothly elsewhere, the sooner the
        larger `fade`.
        """
        system = self.laplacian + fade * sp.identity(len(held)) + sp.diags(hold * held)
        return np.asarray(splu(system.tocsc()).solve(hold * held * values))

    def local(self, ids: AnyArray) -> AnyArray:
        """Local indices of base-mesh vertices `ids`, all of which the bust must hold."""
        return np.searchsorted(self.ids, ids)

    def loop(self, a: int, b: int) -> list[int]:
        """The closed loop through the base mesh's edge a → b, in local indices."""
        start, end = self.local(np.array([a, b]))
        return self.loops.walk(int(start), int(end))

    def shape(self, name: str) -> AnyArray:
        """Displacement (N0, 3) of a sculpted shape, turned and scaled from the template to this face."""
        sculpt = self.source.shape(name)[self.ids]
        if self.template is None:
            return sculpt
        return np.asarray(np.einsum("nij,nj->ni", self.maps, sculpt))

    @cached_property
    def maps(self) -> AnyArray:
        """Linear maps (N0, 3, 3) from the template's surroundings of a vertex to those on this face."""
        return local_maps(self.places, self.rest, self.edges, self.laplacian)

    def moved(self, part: str) -> AnyArray:
        """How far (3,) the middle of a part of the body stands from its place on the template."""
        if self.template is None:
            return np.zeros(3)
        ids = self.source.parts[part].vertices
        return np.asarray((self.body[ids] - self.template.body[ids]).mean(axis=0))

    def texture(self, name: str) -> AnyArray:
        """A mask image sampled at the vertices (N0,), averaged over the faces' corners and the two sides."""
        image, corners = self.source.texture(name), self.source.uv[self.uv_quads.ravel()]
        height, width = image.shape
        rows = np.clip(((1.0 - corners[:, 1]) * height).astype(int), 0, height - 1)
        columns = np.clip((corners[:, 0] * width).astype(int), 0, width - 1)
        flat = self.quads.ravel()
        mean = np.bincount(flat, image[rows, columns], len(self.ids)) / np.bincount(
            flat, minlength=len(self.ids)
        )
        return 0.5 * (mean + mean[self.mirror])

    @cached_property
    def uv(self) -> AnyArray:
        """(N0, 2) texture coordinates; a vertex on a seam takes those of its last face."""
        result = np.zeros((len(self.ids), 2))
        result[self.quads.ravel()] = self.source.uv[self.uv_quads.ravel()]
        return result


def cut_bust(source: Source, identity: Identity, template: Bust | None = None) -> Bust:
    """Build the identity and cut the bust out of its body."""
    part = source.parts["body"]
    loops = Loops(part.quads)
    faces = loops.fill(_SEED, [loops.walk(a, b) for a, b in _CUTS])
    ids = np.unique(part.quads[faces])
    whole = body(source, identity)
    eyes = [_sphere(whole[source.parts[f"helper-{side}-eye"].vertices]) for side in "lr"]
    origin = (eyes[0][0] + eyes[1][0]) / 2.0
    return Bust(
        source=source,
        ids=ids,
        quads=np.searchsorted(ids, part.quads[faces]),
        uv_quads=part.uv_quads[faces],
        body=whole - origin,
        eye_centre=np.array([centre - origin for centre, _ in eyes]),
        eye_radius=np.array([radius for _, radius in eyes]),
        template=template,
    )


def _sphere(points: AnyArray) -> tuple[AnyArray, float]:
    matrix = np.column_stack([2.0 * points, np.ones(len(points))])
    solution = np.linalg.lstsq(matrix, (points**2).sum(axis=1), rcond=None)[0]
    centre = solution[:3]
    return centre, float(np.sqrt(solution[3] + centre @ centre))
