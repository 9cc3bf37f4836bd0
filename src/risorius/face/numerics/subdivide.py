"""Catmull-Clark subdivision of a quad mesh as one sparse matrix (Catmull and Clark 1978)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ...core.arrays import Int32Array, Int64Array, IntArray
from .mesh_sides import MeshSides, mesh_sides


@dataclass(frozen=True, slots=True)
class Subdivision:
    """The next finer level of a quad mesh.

    `matrix` is CSR (N1, N0) and its rows sum to 1, so `matrix @ values` carries positions (N0, 3) or masks
    (N0,) to the finer level; `quads` is (4 Q0, 4) and `triangles` (8 Q0, 3), both int32, wound as the coarse
    faces. The first N0 fine vertices are the moved coarse ones, then one per edge, then one per face.
    """

    matrix: sp.csr_matrix
    quads: Int32Array
    triangles: Int32Array


def catmull_clark(vertices: int, quads: IntArray) -> Subdivision:
    """Subdivide a mesh of `vertices` vertices and `quads` (Q, 4) once.

    Borders follow the cubic B-spline rule. Every vertex must belong to a face, and every edge to one face (on
    a border) or two.
    """
    faces = np.asarray(quads, dtype=np.int64)
    edges = mesh_sides(faces)
    face_points = _incidence(np.repeat(np.arange(len(faces)), 4), faces.ravel(), len(faces), vertices) / 4.0
    middles = (
        _incidence(np.repeat(np.arange(len(edges.ends)), 2), edges.ends.ravel(), len(edges.ends), vertices)
        / 2.0
    )
    edge_points = _edge_points(edges, faces, face_points, middles)
    vertex_points = _vertex_points(vertices, edges, faces, face_points, middles)
    matrix = sp.vstack([vertex_points, edge_points, face_points]).tocsr()
    fine = _fine_quads(vertices, faces, edges)
    return Subdivision(matrix, fine, triangulate(fine))


def triangulate(quads: IntArray) -> Int32Array:
    """Split quads (Q, 4) along the first diagonal into triangles (2 Q, 3), in the order of the quads."""
    return np.asarray(quads)[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3).astype(np.int32)


def _incidence(rows: IntArray, columns: IntArray, height: int, width: int) -> sp.csr_matrix:
    return sp.csr_matrix((np.ones(len(rows)), (rows, columns)), shape=(height, width))


def _edge_points(
    edges: MeshSides, quads: Int64Array, face_points: sp.csr_matrix, middles: sp.csr_matrix
) -> sp.csr_matrix:
    faces = _incidence(
        edges.of_corner.ravel(), np.repeat(np.arange(len(quads)), 4), len(edges.ends), len(quads)
    )
    border = edges.quads == 1
    inner = sp.diags(np.where(border, 1.0, 0.5)) @ middles
    return inner + sp.diags(np.where(border, 0.0, 0.25)) @ (faces @ face_points)


def _vertex_points(
    vertices: int,
    edges: MeshSides,
    quads: Int64Array,
    face_points: sp.csr_matrix,
    middles: sp.csr_matrix,
) -> sp.csr_matrix:
    count = len(edges.ends)
    faces = _incidence(quads.ravel(), np.repeat(np.arange(len(quads)), 4), vertices, len(quads))
    spokes = _incidence(edges.ends.ravel(), np.repeat(np.arange(count), 2), vertices, count)
    valence = np.asarray(spokes.sum(axis=1)).ravel()
    ring = np.asarray(faces.sum(axis=1)).ravel()
    inner = (
        sp.diags(1.0 / (valence * ring)) @ faces @ face_points
        + sp.diags(2.0 / valence**2) @ spokes @ middles
        + sp.diags((valence - 3.0) / valence)
    )
    open_edges = np.flatnonzero(edges.quads == 1)
    on_border = np.zeros(vertices)
    on_border[edges.ends[open_edges].ravel()] = 1.0
    border = 0.5 * sp.identity(vertices) + 0.25 * (spokes[:, open_edges] @ middles[open_edges])
    return sp.diags(1.0 - on_border) @ inner + sp.diags(on_border) @ border


def _fine_quads(vertices: int, quads: Int64Array, edges: MeshSides) -> Int32Array:
    centre = vertices + len(edges.ends) + np.arange(len(quads))
    corner = vertices + edges.of_corner
    parts = [np.stack([quads[:, k], corner[:, k], centre, corner[:, k - 1]], axis=1) for k in range(4)]
    return np.stack(parts, axis=1).reshape(-1, 4).astype(np.int32)
