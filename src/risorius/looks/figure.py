"""The pieces of a head for programs that draw it themselves: meshes with colours, and hairs as ribbons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array, ByteArray, Int64Array
from ..face.head import Head
from .anatomy import find_anatomy
from .attach import Surface
from .attributes import ALBEDO
from .brows import grow_brows
from .cuts import grow_hair
from .eyeball import IRIS, iris_image
from .garment import neckline
from .lashes import grow_lashes
from .parts import Part, eye_parts, skin_part, skin_surface, teeth_part, tongue_part
from .srgb import linear, srgb_encode
from .strands import Strands, root_frames

_IRIS, _PUPIL = float(IRIS), 0.36 * float(IRIS)  # of the eyeball's radius
HEM = 10.0  # mm over which skin becomes cloth: triangles there are that wide
_SCLERA = (228, 220, 212)


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A mesh in the head frame: points (n, 3) mm, triangles (m, 3), linear colours (n, 3), roughness 0..1.

    `roots` (n, 3) and `weights` (n, 3) are the skin's vertices with which a hair moves, None for what is no
    hair. `two_sided`: seen from both sides.
    """

    name: str
    points: Array
    triangles: Int64Array
    colours: Array
    roughness: float
    roots: Int64Array | None = None
    weights: Array | None = None
    two_sided: bool = False


def figure_of(head: Head) -> dict[str, Piece]:
    """Return the pieces by name: skin, eyes, teeth, tongue, brows, lashes, and hair where there is any."""
    anatomy, looks = find_anatomy(head), head.identity.looks
    surface = skin_surface(head, anatomy)
    hair, brows = linear(looks.hair), linear(looks.brows or looks.hair)
    skin = skin_part(head, anatomy, surface, looks, brows, hair)
    left, right = eye_parts(head)
    pieces = [
        _clothed(_piece("skin", skin, 0.5), neckline(anatomy), linear(looks.cloth)),
        _piece("eye_left", left, 0.1),
        _piece("eye_right", right, 0.1),
        _piece("teeth_upper", teeth_part(head.teeth_upper), 0.2),
        _piece("teeth_lower", teeth_part(head.teeth_lower), 0.2),
        _piece("tongue", tongue_part(head), 0.3),
        _ribbons("brows", grow_brows(anatomy, surface, brows, looks.brow_hairs), surface),
        _ribbons("lashes", grow_lashes(head, surface, 0.35 * hair), surface),
        *(_ribbons("hair", strands, surface) for strands in grow_hair(anatomy, surface, hair, looks)),
    ]
    return {piece.name: piece for piece in pieces}


def iris_picture(head: Head, side: int = 256) -> ByteArray:
    """Return the front of an eye seen straight on, sRGB (side, side, 3), as wide as the eyeball."""
    image = iris_image(*head.identity.looks.iris)
    x = (np.arange(side) + 0.5) / side * 2.0 - 1.0
    across, down = np.meshgrid(x, x)
    radius, angle = np.hypot(across, down), np.arctan2(-down, across) % (2.0 * np.pi)
    way = (radius - _PUPIL) / (_IRIS - _PUPIL)
    rows = np.clip(way * (len(image) - 1), 0, len(image) - 1).round().astype(int)
    columns = (angle / (2.0 * np.pi) * image.shape[1]).astype(int) % image.shape[1]
    picture = image[rows, columns].astype(np.float64)
    picture[way < 0.0] = 0.005
    edge = np.clip((way - 1.0) / 0.06, 0.0, 1.0)[..., None]
    picture = picture + edge * (linear(_SCLERA) - picture)
    return np.asarray(np.round(255.0 * srgb_encode(np.clip(picture, 0.0, 1.0))), np.uint8)


def _piece(name: str, part: Part, roughness: float) -> Piece:
    colours = np.clip(part.attributes[:, ALBEDO : ALBEDO + 3].astype(np.float64), 0.0, 1.0)
    return Piece(
        name, np.asarray(part.vertices, np.float64), part.triangles.astype(np.int64), colours, roughness
    )


def _clothed(skin: Piece, inside: Array, cloth: Array) -> Piece:
    """Return the skin in the colour of the cloth where it is worn; `inside` (n,) mm from its edge."""
    share = np.clip(0.5 + inside / HEM, 0.0, 1.0)[:, None]
    colours = skin.colours + share * (cloth - skin.colours)
    return Piece(skin.name, skin.points, skin.triangles, colours, skin.roughness)


def _ribbons(name: str, hairs: Strands, skin: Surface) -> Piece:
    """Return hairs as ribbons that lie flat on the skin."""
    points, normals = skin.points, skin.normals
    frames = root_frames(points, normals, hairs.roots, hairs.weights)
    origin = np.einsum("sk,skc->sc", hairs.weights, points[hairs.roots])
    line = origin[:, None] + np.einsum("spf,sfc->spc", hairs.curves, frames)
    ahead = np.gradient(line, axis=1)
    across = np.cross(ahead, frames[:, None, 2])
    across /= np.maximum(np.linalg.norm(across, axis=2, keepdims=True), 1e-9)
    half = 0.5 * hairs.widths[:, :, None] * across
    ribbon = np.stack([line - half, line + half], axis=2)
    each = ribbon.shape[1] * 2
    colours = np.repeat(np.clip(hairs.colours.astype(np.float64), 0.0, 1.0), each, axis=0)
    return Piece(
        name,
        ribbon.reshape(-1, 3),
        hairs.triangles().astype(np.int64),
        colours,
        0.6,
        np.repeat(hairs.roots.astype(np.int64), each, axis=0),
        np.repeat(hairs.weights.astype(np.float64), each, axis=0),
        True,
    )
