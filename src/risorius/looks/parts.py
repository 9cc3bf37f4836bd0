"""The pieces of the scene: skin, eyes, teeth, tongue, each with its attributes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array, Float32Array, Int32Array
from ..face.head import Head
from ..face.head import Mesh as RigidMesh
from ..face.identity import Looks
from .anatomy import Anatomy
from .attach import Surface
from .attributes import (
    ALBEDO,
    ATTRIBUTES,
    EXTRA,
    EYE_LEFT,
    INNER,
    OCCLUSION,
    ROUGHNESS,
    SKIN,
    SPECULAR,
    TEETH,
    TONGUE,
)
from .brows import brow_shade
from .complexion import paint_skin
from .curvature import mean_curvature
from .eyeball import cap
from .garment import neckline
from .normals import Normals, triangles_as_faces
from .scalp import scalp_shade
from .srgb import linear

_TOOTH, _GUM, _TONGUE = (244, 234, 214), (186, 98, 92), (206, 122, 114)


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """Vertices (n, 3) mm at rest, faces (f, 4), triangles (m, 3), attributes (n, ATTRIBUTES), and surface."""

    vertices: Array
    faces: Int32Array
    triangles: Int32Array
    attributes: Float32Array
    surface: int


def skin_surface(head: Head, anatomy: Anatomy) -> Surface:
    """Return the skin at rest with its smooth normals."""
    points = anatomy.skin.astype(np.float32)
    normals = np.zeros_like(points)
    Normals(head.skin.quads, len(points)).update(points, normals)
    return Surface(anatomy.skin, normals.astype(np.float64), head.skin.triangles)


def skin_part(
    head: Head, anatomy: Anatomy, surface: Surface, looks: Looks, brows: Array, hair: Array
) -> Part:
    """Return the skin, darkened under the brows by their albedo (3,) and under the hair by its own."""
    quads = head.skin.quads
    curvature = mean_curvature(surface.points, surface.normals, quads)
    attributes = paint_skin(anatomy, looks, neckline(anatomy), curvature)
    under = attributes[:, ALBEDO : ALBEDO + 3]
    for shade, colour in (
        (0.42 * brow_shade(anatomy), brows),
        (scalp_shade(anatomy, looks.hair_style), hair),
    ):
        under += shade[:, None].astype(np.float32) * (1.3 * colour.astype(np.float32) - under)
        attributes[:, SPECULAR] *= 1.0 - 0.9 * shade
    return Part(anatomy.skin, quads, head.skin.triangles, attributes, SKIN)


def eye_parts(head: Head) -> list[Part]:
    """Return the left and the right eye; their colours come from the shader."""
    sphere, triangles = cap()
    attributes = _attributes(len(sphere), (255, 255, 255), 0.02, 1.0)
    return [
        Part(
            head.eye_centre[side] + head.eye_radius[side] * sphere,
            triangles_as_faces(triangles),
            triangles,
            attributes,
            EYE_LEFT + side,
        )
        for side in range(2)
    ]


def teeth_part(mesh: RigidMesh) -> Part:
    """Return a row of teeth with its gum."""
    triangles = _outward(mesh.vertices, mesh.triangles)
    attributes = _attributes(len(mesh.vertices), _TOOTH, 0.035, 1.3)
    gum = mesh.material[:, None]
    attributes[:, ALBEDO : ALBEDO + 3] += gum * (linear(_GUM) - attributes[:, ALBEDO : ALBEDO + 3])
    attributes[:, EXTRA] = mesh.material
    return Part(mesh.vertices, triangles_as_faces(triangles), triangles, attributes, TEETH)


def tongue_part(head: Head) -> Part:
    """Return the tongue at its level 1."""
    fine = head.tongue.subdivision
    vertices = np.asarray(fine.matrix @ head.tongue.rest)
    triangles = _outward(vertices, fine.triangles)
    faces = fine.quads if triangles is fine.triangles else fine.quads[:, ::-1]
    return Part(
        vertices,
        np.ascontiguousarray(faces),
        triangles,
        _attributes(len(vertices), _TONGUE, 0.09, 1.0),
        TONGUE,
    )


def _attributes(count: int, colour: tuple[int, int, int], roughness: float, strength: float) -> Float32Array:
    result = np.zeros((count, ATTRIBUTES), np.float32)
    result[:, ALBEDO : ALBEDO + 3] = linear(colour)
    result[:, OCCLUSION] = 1.0
    result[:, ROUGHNESS] = roughness
    result[:, SPECULAR] = strength
    result[:, INNER] = 1.0
    return result


def _outward(vertices: Array, triangles: Int32Array) -> Int32Array:
    """Return triangles wound so that they enclose a positive volume."""
    a, b, c = (vertices[triangles[:, k]] - vertices.mean(axis=0) for k in range(3))
    return (
        triangles
        if np.einsum("ij,ij->", a, np.cross(b, c)) >= 0
        else np.ascontiguousarray(triangles[:, ::-1])
    )
