"""The inputs of the shading kernels, grouped by how often they change."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from ..core.arrays import ByteArray, Float32Array, Int32Array, Int64Array
from .linear_block import COLUMNS, MEANS
from .shading_block import LANES, empty_block


class PosedMesh(NamedTuple):
    """The posed scene: vertices (n, …), triangles (m, 3), and the surface (m,) of each triangle.

    `attributes` (n, ATTRIBUTES) are those of `looks.attributes`. `rest` (n, 3) are positions at rest. `reach`
    (n, LAMPS or more) is the share of each lamp that the head at rest does not block; `shadow`, for the
    skin's vertices, is the share of the key lamp that reaches them in this frame. `vertex_light` (n, 3) is
    the light of hairs and, in drafts, of skin, computed before the picture is shaded, `cloth_light` that of
    cloth; `crease_…` are those of `creases.Creases`.
    """

    xy: Annotated[Int32Array, "i4[:, :]"]
    key: Annotated[Float32Array, "f4[:]"]
    positions: Annotated[Float32Array, "f4[:, :]"]
    normals: Annotated[Float32Array, "f4[:, :]"]
    attributes: Annotated[Float32Array, "f4[:, :]"]
    rest: Annotated[Float32Array, "f4[:, :]"]
    reach: Annotated[Float32Array, "f4[:, :]"]
    shadow: Annotated[Float32Array, "f4[:]"]
    vertex_light: Annotated[Float32Array, "f4[:, :]"]
    cloth_light: Annotated[Float32Array, "f4[:, :]"]
    triangles: Annotated[Int32Array, "i4[:, :]"]
    surfaces: Annotated[Int32Array, "i4[:]"]
    crease_raised: Annotated[Int32Array, "i4[:]"]
    crease_place: Annotated[Float32Array, "f4[:, :, :]"]
    crease_height: Annotated[Float32Array, "f4[:, :]"]
    crease_style: Annotated[Float32Array, "f4[:, :]"]


class SceneLight(NamedTuple):
    """The light on the head.

    `lamps` (n, 7) are direction, colour and softness, `ambient` (2, 3) the light from above and below;
    `shadow…` and `bias` are the key lamp's shadow map; `pupil` is the radius of the pupils in this light, in
    radii of the iris.
    """

    lamps: Annotated[Float32Array, "f4[:, :]"]
    ambient: Annotated[Float32Array, "f4[:, :]"]
    shadow: Annotated[Float32Array, "f4[:, :]"]
    shadow_low: Annotated[Float32Array, "f4[:, :]"]
    shadow_high: Annotated[Float32Array, "f4[:, :]"]
    shadow_matrix: Annotated[Float32Array, "f4[:, :]"]
    bias: Annotated[float, "f4"]
    pupil: Annotated[float, "f4"]


class Pose(NamedTuple):
    """The positions of head, eyes, lids and lips in a frame.

    `rotation` (3, 3) and `pivot` (3,) are the head's; `eyes` (2, 3) centres in the world, `eye_axes`
    (2, 3, 3) eye to world, `eye_radius` (2,); `lids` (2, LID_STEPS, 2) are the heights of the upper and lower
    margins over the eye's centre, at x from `lid_span[:, 0]` to `lid_span[:, 1]`, in the head frame; `lips`
    (LIP_STEPS, 4) upper y and z, lower y and z, at x from `lip_span[0]` to `lip_span[1]`.
    """

    rotation: Annotated[Float32Array, "f4[:, :]"]
    pivot: Annotated[Float32Array, "f4[:]"]
    eyes: Annotated[Float32Array, "f4[:, :]"]
    eye_axes: Annotated[Float32Array, "f4[:, :, :]"]
    eye_radius: Annotated[Float32Array, "f4[:]"]
    lids: Annotated[Float32Array, "f4[:, :, :]"]
    lid_span: Annotated[Float32Array, "f4[:, :]"]
    lips: Annotated[Float32Array, "f4[:, :]"]
    lip_span: Annotated[Float32Array, "f4[:]"]


class Tables(NamedTuple):
    """Tables that never change.

    Light under the skin, grain, the iris (rings, angles, 3), the cloth's albedo (3,), and the two steps from
    scene light to bytes, one after the other and `direct`.
    """

    diffuse: Annotated[Float32Array, "f4[:, :, :]"]
    grain: Annotated[Float32Array, "f4[:, :, :]"]
    iris: Annotated[Float32Array, "f4[:, :, :]"]
    cloth: Annotated[Float32Array, "f4[:]"]
    film: Annotated[Float32Array, "f4[:]"]
    bytes: Annotated[ByteArray, "u1[:]"]
    direct: Annotated[ByteArray, "u1[:]"]


class Paint(NamedTuple):
    """The drawing of a diagram on the skin.

    `covered` (m,), `place` (N1, M, 2) are those of `muscle_paint.MusclePaint`, `colours` (M, 4) their linear
    colours and opacities in this frame; `edges` (m, 3) the strength of the line opposite each corner; `ink`
    (4,) the lines' colour and opacity.
    """

    covered: Annotated[Int64Array, "i8[:]"]
    place: Annotated[Float32Array, "f4[:, :, :]"]
    colours: Annotated[Float32Array, "f4[:, :]"]
    edges: Annotated[Float32Array, "f4[:, :]"]
    ink: Annotated[Float32Array, "f4[:]"]


class Screen(NamedTuple):
    """The visibility buffer, samples per pixel and side, camera's place (3,), mm per pixel, background.

    `detail` is the least width in mm of what is shaded on the skin: a pixel, or in drafts, in which skin and
    cloth are lit at their vertices alone, more.

    `order`, `rows` and `chunks` are those of `visibility.Visibility`, whose `ids` and `depth` are drawn with
    the picture; `empty` (height, width, 3) uint8 is the picture of the background alone.
    """

    ids: Annotated[Int32Array, "i4[:, :]"]
    depth: Annotated[Float32Array, "f4[:, :]"]
    order: Annotated[Int32Array, "i4[:]"]
    rows: Annotated[Int32Array, "i4[:, :]"]
    chunks: Annotated[Int32Array, "i4[:, :]"]
    samples: Annotated[int, "i8"]
    eye: Annotated[Float32Array, "f4[:]"]
    pixel: Annotated[float, "f4"]
    detail: Annotated[float, "f4"]
    background: Annotated[Float32Array, "f4[:, :, :]"]
    empty: Annotated[ByteArray, "u1[:, :, :]"]


class Batch(NamedTuple):
    """The patches of one row of pixels, up to `capacity` of them.

    A patch is a set of samples of one pixel on one surface: `triangle`, `column` and `samples` (capacity,)
    int32 are its triangle, its pixel in the row and its number of samples; `weights` (capacity, 3) is the
    place in the triangle; materials write the scene light into `colour` (capacity, 3). Patches that are
    shaded in blocks have their numbers in `chosen` (LANES,) and all else in `block` (see `lanes`).
    """

    triangle: Annotated[Int32Array, "i4[:]"]
    column: Annotated[Int32Array, "i4[:]"]
    samples: Annotated[Int32Array, "i4[:]"]
    weights: Annotated[Float32Array, "f4[:, :]"]
    colour: Annotated[Float32Array, "f4[:, :]"]
    chosen: Annotated[Int32Array, "i4[:]"]
    block: Annotated[Float32Array, "f4[:]"]


class Facets(NamedTuple):
    """The colours of a draft's triangles (m,), linear in the picture.

    `kind` (m,) is one of `draft`'s; `plane` (m, 9) is the colour in sRGB bytes at the picture's upper left
    corner, what it gains from pixel to pixel to the right, and what it gains downwards.
    """

    kind: Annotated[ByteArray, "u1[:]"]
    plane: Annotated[Float32Array, "f4[:, :]"]


class LinearTriangles(NamedTuple):
    """The triangles of a picture within which the display light is linear.

    `row` (m + 1,) is the row in `planes` of triangle t at t + 1, 0 if its light is not linear; the background
    stands first. `planes` (k, COLUMNS) float32 is what `linear_block.mean_at` reads: of the columns of a
    group, 0 to 2 are the display light, 3 to 5 the skin's place at rest, 6 the share that is covered, and 7
    the share of skin; the last group has the shares by which a height and a slope of the pores change the
    light. `display` (n, 3) is the display light of vertices, `pores` (N1, 4) are these shares; `others`
    (width,) are the pixels of a row that show other triangles; `means` (MEANS,) is scratch.
    """

    row: Annotated[Int32Array, "i4[:]"]
    planes: Annotated[Float32Array, "f4[:, :]"]
    display: Annotated[Float32Array, "f4[:, :]"]
    pores: Annotated[Float32Array, "f4[:, :]"]
    others: Annotated[Int32Array, "i4[:]"]
    means: Annotated[Float32Array, "f4[:]"]


def empty_linear(triangles: int, vertices: int, skin: int, width: int) -> LinearTriangles:
    """Return arrays for triangles and vertices, of which the skin has the first, in pictures of a width."""
    planes = np.zeros((triangles + 2, COLUMNS), np.float32)
    display, pores = np.zeros((vertices, 3), np.float32), np.zeros((skin, 4), np.float32)
    row, others = np.zeros(triangles + 1, np.int32), np.zeros(width, np.int32)
    return LinearTriangles(row, planes, display, pores, others, np.zeros(MEANS, np.float32))


def empty_facets(count: int) -> Facets:
    """Return arrays for `count` triangles."""
    return Facets(np.zeros(count, np.uint8), np.zeros((count, 9), np.float32))


def empty_batch(capacity: int) -> Batch:
    """Return empty arrays for rows of up to `capacity` patches."""
    triangle, column, samples = (np.zeros(capacity, np.int32) for _ in range(3))
    weights, colour = (np.zeros((capacity, 3), np.float32) for _ in range(2))
    return Batch(triangle, column, samples, weights, colour, np.zeros(LANES, np.int32), empty_block())
