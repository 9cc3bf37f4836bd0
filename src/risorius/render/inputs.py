"""What the shading kernel reads, grouped by what changes together."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .lanes import LANES, empty_block
from .raster import ByteArray, FloatArray, IntArray

BitArray = npt.NDArray[np.int64]

# Columns of a vertex's attributes.
ALBEDO, OCCLUSION, ROUGHNESS, SPECULAR, CURVATURE, INNER, EXTRA = 0, 3, 4, 5, 6, 7, 8
ATTRIBUTES = 9

# Surfaces: what a triangle belongs to. Hairs are numbered from HAIR on, one number each.
SKIN, EYE_LEFT, EYE_RIGHT, TEETH, TONGUE, HAIR = 0, 1, 2, 3, 4, 16


class Mesh(NamedTuple):
    """The posed scene: vertices (n, …), triangles (m, 3), and the surface (m,) of each triangle.

    `attributes` (n, ATTRIBUTES) are albedo (3, linear), free share of the surroundings, roughness squared,
    strength of the gloss, curvature in 1/mm, share of mouth interior, and one of the material's own: cloth on
    the skin (mm from the neckline), gum on teeth, the way from root to tip on hairs. `rest` (n, 3) are
    positions at rest; `reach` (n, LAMPS or more) is the share of each lamp that the head at rest lets by,
    `shadow` (n of the skin,) the share of the key lamp that its shadow in this frame does;
    `hair_light` (n, 3) is the light of hairs, found before the picture is; `crease_…` are those of
    `creases.Creases`, the skin's wrinkles.
    """

    xy: IntArray
    key: FloatArray
    positions: FloatArray
    normals: FloatArray
    attributes: FloatArray
    rest: FloatArray
    reach: FloatArray
    shadow: FloatArray
    hair_light: FloatArray
    triangles: IntArray
    surfaces: IntArray
    crease_raised: IntArray
    crease_place: FloatArray
    crease_height: FloatArray
    crease_style: FloatArray


class Light(NamedTuple):
    """Lamps (n, 7): direction, colour, softness; room (2, 3) from above and below; the key's shadow map.

    `pupil` is the radius that the pupils take in this light, in radii of the iris.
    """

    lamps: FloatArray
    room: FloatArray
    shadow: FloatArray
    shadow_low: FloatArray
    shadow_high: FloatArray
    shadow_matrix: FloatArray
    bias: float
    pupil: float


class Pose(NamedTuple):
    """Where the head, eyes, lids and lips stand.

    `rotation` (3, 3) and `pivot` (3,) are the head's; `eyes` (2, 3) centres in the world, `eye_axes`
    (2, 3, 3) eye to world, `eye_radius` (2,); `lids` (2, LID_STEPS, 2) are the heights of the upper and lower
    margins over the eye's centre, at x from `lid_span[:, 0]` to `lid_span[:, 1]`, in the head frame; `lips`
    (LIP_STEPS, 4) upper y and z, lower y and z, at x from `lip_span[0]` to `lip_span[1]`.
    """

    rotation: FloatArray
    pivot: FloatArray
    eyes: FloatArray
    eye_axes: FloatArray
    eye_radius: FloatArray
    lids: FloatArray
    lid_span: FloatArray
    lips: FloatArray
    lip_span: FloatArray


class Tables(NamedTuple):
    """What never changes.

    Light under the skin, grain, the iris (rings, angles, 3), the cloth's albedo (3,), and the two steps from
    scene light to bytes, one after the other and `direct`.
    """

    diffuse: FloatArray
    grain: FloatArray
    iris: FloatArray
    cloth: FloatArray
    film: FloatArray
    bytes: ByteArray
    direct: ByteArray


class Paint(NamedTuple):
    """What an explaining picture shows on the skin.

    `covered` (m,), `place` (N1, M, 2) are those of `muscle_paint.MusclePaint`, `colours` (M, 4) their linear
    colours and opacities in this frame; `edges` (m, 3) the strength of the line opposite each corner; `ink`
    (4,) the lines' colour and opacity.
    """

    covered: BitArray
    place: FloatArray
    colours: FloatArray
    edges: FloatArray
    ink: FloatArray


class Sight(NamedTuple):
    """The visibility buffer, samples per pixel and side, the camera's place (3,), mm a pixel, background.

    `rows` and `chunks` are those of `raster.Visibility`, whose `ids` and `depth` are drawn with the picture;
    `empty` (height, width, 3) uint8 is the picture of the background alone.
    """

    ids: IntArray
    depth: FloatArray
    rows: IntArray
    chunks: IntArray
    samples: int
    eye: FloatArray
    pixel: float
    background: FloatArray
    empty: ByteArray


class Batch(NamedTuple):
    """What one row of pixels shows: up to `capacity` patches.

    A patch is a set of samples of one pixel on one surface: `triangle`, `column` and `samples` (capacity,)
    int32 say which triangle, which pixel of the row and how many samples; `weights` and `colour`
    (capacity, 3) where in the triangle, and the scene light that the materials fill in. Of patches that are
    shaded in blocks, `chosen` (LANES,) are the numbers and `block` is the rest (`lanes`).
    """

    triangle: IntArray
    column: IntArray
    samples: IntArray
    weights: FloatArray
    colour: FloatArray
    chosen: IntArray
    block: FloatArray


def empty_batch(capacity: int) -> Batch:
    """Return room for rows of up to `capacity` patches."""
    triangle, column, samples = (np.zeros(capacity, np.int32) for _ in range(3))
    weights, colour = (np.zeros((capacity, 3), np.float32) for _ in range(2))
    return Batch(triangle, column, samples, weights, colour, np.zeros(LANES, np.int32), empty_block())
