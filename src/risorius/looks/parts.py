"""The parts of a head model: skin, eyes, teeth, tongue and hairs, each a mesh with its attributes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array, Float32Array, Int32Array, Int64Array
from ..core.look import ByteColour
from ..face.head.head import Head, TeethMesh
from ..face.head.identity import Looks
from .anatomy import Anatomy
from .attributes import (
    ALBEDO,
    ATTRIBUTES,
    EXTRA,
    EYE_LEFT,
    EYE_RIGHT,
    HAIR,
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
from .lashes import lash_shade
from .normals import Normals, triangles_as_faces
from .scalp import scalp_shade
from .srgb import linear
from .strands import Strands, flat_ribbons
from .surface import Surface
from .tongue_paint import tongue_colours

HEM = 10.0  # mm over which skin blends into cloth: the width of triangles there
_TOOTH, _GUM = (244, 234, 214), (206, 138, 130)
TEETH_GLOSS, TONGUE_GLOSS = (0.035, 1.3), (0.09, 1.0)
"""Roughness and strength."""


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """One mesh of a head at rest, in the head frame.

    points      (n, 3) mm
    faces       (f, 4) vertices of quads, from which smooth normals follow; triangles repeat their last
    triangles   (m, 3) vertices, wound outwards
    attributes  (n, ATTRIBUTES) float32, see `attributes`
    surface     one of the surfaces in `attributes`
    colours     (n, 3) linear, 0..1: the albedo, and the cloth's where it covers the skin
    roughness   0..1, one for the whole part
    roots       (n, 3) vertices of the skin with which each point of a hair moves, None for solid parts
    weights     (n, 3) their weights, None for solid parts
    """

    name: str
    points: Array
    faces: Int32Array
    triangles: Int32Array
    attributes: Float32Array
    surface: int
    colours: Array
    roughness: float
    roots: Int64Array | None = None
    weights: Array | None = None

    @property
    def two_sided(self) -> bool:
        """Whether the part is seen from both sides, as hairs are."""
        return self.roots is not None


def skin_surface(head: Head, anatomy: Anatomy) -> Surface:
    """Return the skin at rest with its smooth normals."""
    points = anatomy.skin.astype(np.float32)
    normals = np.zeros_like(points)
    Normals(head.skin.quads, len(points)).update(points, normals)
    return Surface(anatomy.skin, normals.astype(np.float64), head.skin.triangles)


def skin_part(
    head: Head, anatomy: Anatomy, surface: Surface, looks: Looks, brows: Array, hair: Array
) -> Part:
    """Return the skin, darkened under brows and hair; `brows` and `hair` (3,) are their linear albedos."""
    quads, inside = head.skin.quads, neckline(anatomy)
    curvature = mean_curvature(surface.points, surface.normals, quads)
    attributes = paint_skin(anatomy, looks, inside, curvature)
    under = attributes[:, ALBEDO : ALBEDO + 3]
    for shade, colour in (
        (0.78 * brow_shade(anatomy), brows),
        (0.8 * lash_shade(head, anatomy.skin), 0.35 * hair),
        (scalp_shade(anatomy, looks.hair_style), hair),
    ):
        under += shade[:, None].astype(np.float32) * (1.3 * colour.astype(np.float32) - under)
        attributes[:, SPECULAR] *= 1.0 - 0.9 * shade
    worn = np.clip(0.5 + inside / HEM, 0.0, 1.0)[:, None]
    colours = _albedo(attributes)
    colours = colours + worn * (linear(looks.cloth) - colours)
    return Part("skin", anatomy.skin, quads, head.skin.triangles, attributes, SKIN, colours, 0.5)


def eye_parts(head: Head) -> list[Part]:
    """Return the left and the right eye, both white: renderers draw the iris by a texture or a shader."""
    sphere, triangles = cap()
    attributes = _attributes(len(sphere), (255, 255, 255), 0.02, 1.0)
    faces, colours = triangles_as_faces(triangles), _albedo(attributes)
    return [
        Part(name, centre + radius * sphere, faces, triangles, attributes, surface, colours, 0.1)
        for name, surface, centre, radius in zip(
            ("eye_left", "eye_right"), (EYE_LEFT, EYE_RIGHT), head.eye_centre, head.eye_radius, strict=True
        )
    ]


def teeth_part(name: str, mesh: TeethMesh) -> Part:
    """Return a row of teeth with its gum."""
    triangles = _outward(mesh.vertices, mesh.triangles)
    attributes = _attributes(len(mesh.vertices), _TOOTH, *TEETH_GLOSS)
    gum = mesh.material[:, None]
    attributes[:, ALBEDO : ALBEDO + 3] += gum * (linear(_GUM) - attributes[:, ALBEDO : ALBEDO + 3])
    attributes[:, EXTRA] = mesh.material
    faces, colours = triangles_as_faces(triangles), _albedo(attributes)
    return Part(name, mesh.vertices, faces, triangles, attributes, TEETH, colours, 0.2)


def tongue_part(head: Head) -> Part:
    """Return the tongue at its level 1."""
    fine = head.tongue.subdivision
    points = np.asarray(fine.matrix @ head.tongue.rest)
    triangles = _outward(points, fine.triangles)
    faces = np.ascontiguousarray(fine.quads if triangles is fine.triangles else fine.quads[:, ::-1])
    attributes = _attributes(len(points), (255, 255, 255), *TONGUE_GLOSS)
    attributes[:, ALBEDO : ALBEDO + 3] = tongue_colours(points)
    return Part("tongue", points, faces, triangles, attributes, TONGUE, _albedo(attributes), 0.3)


def hair_part(name: str, hairs: Strands, skin: Surface) -> Part:
    """Return hairs as ribbons that lie flat on the skin."""
    vertices_per_hair = 2 * hairs.widths.shape[1]
    triangles, attributes = hairs.triangles(), hair_attributes(hairs)
    return Part(
        name,
        flat_ribbons(hairs, skin.points, skin.normals),
        triangles_as_faces(triangles),
        triangles,
        attributes,
        HAIR,
        _albedo(attributes),
        0.6,
        np.repeat(hairs.roots.astype(np.int64), vertices_per_hair, axis=0),
        np.repeat(hairs.weights.astype(np.float64), vertices_per_hair, axis=0),
    )


def hair_attributes(hairs: Strands) -> Float32Array:
    """Return attributes (n, ATTRIBUTES) of the ribbons' vertices, hair by hair from root to tip.

    They are colour, the share of light that reaches the hair, and gloss. Roots lie in the shade of the hairs
    above them, which is the lighter the lighter these are: light goes on from hair to hair.
    """
    strands, points = hairs.widths.shape
    lit = np.maximum(0.25 + 0.6 * np.clip(hairs.colours.mean(axis=1), 0.0, 1.0), hairs.bare)[:, None]
    free = (1.0 - hairs.depths)[:, None] * (lit + (1.0 - lit) * np.linspace(0.0, 1.0, points))
    result = np.zeros((strands, points, 2, ATTRIBUTES), np.float32)
    result[..., ALBEDO : ALBEDO + 3] = hairs.colours[:, None, None, :]
    result[..., OCCLUSION] = free[..., None]
    result[..., SPECULAR] = hairs.gloss
    return result.reshape(-1, ATTRIBUTES)


def _albedo(attributes: Float32Array) -> Array:
    """Return the albedo (n, 3) of vertices within 0..1."""
    return np.clip(attributes[:, ALBEDO : ALBEDO + 3].astype(np.float64), 0.0, 1.0)


def _attributes(count: int, colour: ByteColour, roughness: float, strength: float) -> Float32Array:
    result = np.zeros((count, ATTRIBUTES), np.float32)
    result[:, ALBEDO : ALBEDO + 3] = linear(colour)
    result[:, OCCLUSION] = 1.0
    result[:, ROUGHNESS] = roughness
    result[:, SPECULAR] = strength
    result[:, INNER] = 1.0
    return result


def _outward(vertices: Array, triangles: Int32Array) -> Int32Array:
    """Return triangles wound outwards: they enclose a positive volume."""
    a, b, c = (vertices[triangles[:, k]] - vertices.mean(axis=0) for k in range(3))
    return (
        triangles
        if np.einsum("ij,ij->", a, np.cross(b, c)) >= 0
        else np.ascontiguousarray(triangles[:, ::-1])
    )
