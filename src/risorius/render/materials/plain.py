"""The plain material of diagrams: clay, on which muscles and the mesh may be drawn.

Skin is shaded in blocks (`shading_block`), each step for all patches of a block; `plain_parts` shades the
rest.
"""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...looks import attributes
from ...looks.attributes import SKIN, TONGUE
from ...machine.kernels.jit import device, f4, i8
from ...machine.kernels.vec import Vec, add, along, dot, mix, scale, times, weigh
from ..brdf import gloss
from ..inputs import Batch, Paint, Pose, PosedMesh, SceneLight, Screen, Tables
from ..shading_block import (
    ALBEDO,
    FREE,
    INNER,
    LAMPS,
    LANES,
    NORMAL,
    OPENED,
    POSITION,
    REACH,
    SHADOW,
    SHINE,
    TOTAL,
    VIEW,
    face,
    get,
    put,
)
from .lit import ambient_of, ambient_on, lamp_colour, lamp_direction, read_reach
from .mouth import past_lips
from .painted import line_share, painted
from .plain_parts import MIRRORED, ROUGH, facing, shade_part
from .shading_sample import corners_of, weights_of
from .shading_sample import put as put_colour
from .shadows import shadow_at
from .wrinkle_normals import bent, creased

_FLESH = f4(1.0)


@device("fast")
def shade_plain(
    n: int,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    paint: Paint,
) -> None:
    """Colour the patches of skin, eyes, teeth and tongue among the first n of a row."""
    count = i8(0)
    for k in range(n):
        surface = mesh.surfaces[batch.triangle[k]]
        if surface == SKIN:
            _read(k, count, batch, mesh, light)
            count += 1
            if count == LANES:
                _shade_block(count, batch, mesh, screen, light, pose, tables, paint)
                count = i8(0)
        elif surface <= TONGUE:
            put_colour(batch.colour, k, shade_part(k, surface, batch, mesh, screen, light, pose))
    if count:
        _shade_block(count, batch, mesh, screen, light, pose, tables, paint)


@device("fast", inlined=True)
def _read(k: int, lane: int, batch: Batch, mesh: PosedMesh, light: SceneLight) -> None:
    """Read patch k of the mesh into a lane."""
    corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
    block = batch.block
    batch.chosen[lane] = k
    block[FREE + lane] = weigh(mesh.attributes, corners, weights, attributes.OCCLUSION)[0]
    block[INNER + lane] = weigh(mesh.attributes, corners, weights, attributes.INNER)[0]
    put(block, ALBEDO, lane, weigh(mesh.attributes, corners, weights, attributes.ALBEDO))
    p = weigh(mesh.positions, corners, weights, 0)
    put(block, POSITION, lane, p)
    block[SHADOW + lane] = shadow_at(mesh, light, corners, weights, p)
    put(block, NORMAL, lane, weigh(mesh.normals, corners, weights, 0))
    read_reach(block, lane, mesh.reach, corners, weights)


@device("fast")
def _shade_block(
    count: int,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    paint: Paint,
) -> None:
    """Shade a block of clay: matt, creased like the skin, with the paint on it."""
    block = batch.block
    face(block, (screen.eye[0], screen.eye[1], screen.eye[2]))
    _fold(count, batch, mesh, pose, tables, screen.pixel)
    _shadow(count, block, pose)
    _paint(count, batch, mesh, paint, screen.pixel)
    _fill(block, light)
    for lamp in range(len(light.lamps)):
        _add_lamp(block, lamp, lamp_direction(light.lamps, lamp), lamp_colour(light.lamps, lamp))
    _add_gloss(block, lamp_direction(light.lamps, 0), lamp_colour(light.lamps, 0))
    ink = paint.ink[0], paint.ink[1], paint.ink[2]
    for lane in range(count):
        k, colour = batch.chosen[lane], get(block, TOTAL, lane)
        if paint.ink[3] > f4(0):
            corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
            line = line_share(mesh, paint, batch.triangle[k], corners, weights, screen.samples)
            colour = mix(colour, ink, line)
        put_colour(batch.colour, k, colour)


@device("fast")
def _fold(count: int, batch: Batch, mesh: PosedMesh, pose: Pose, tables: Tables, pixel: float) -> None:
    """Let wrinkles turn the normal and take the ambient light away."""
    block = batch.block
    for lane in range(count):
        k = batch.chosen[lane]
        t = batch.triangle[k]
        if mesh.crease_raised[t]:
            corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
            normal, rest = get(block, NORMAL, lane), weigh(mesh.rest, corners, weights, 0)
            turned = dot(normal, get(block, VIEW, lane))
            slope, deep = creased(tables, mesh, pose, t, corners, weights, rest, normal, turned, pixel)
            put(block, NORMAL, lane, bent(normal, slope, _FLESH))
            block[FREE + lane] *= f4(1) - f4(0.7) * deep


@device("fast")
def _shadow(count: int, block: Float32Array, pose: Pose) -> None:
    """Compute how much of the lamps and of the ambient light arrives."""
    for lane in range(count):
        free, inner = block[FREE + lane], block[INNER + lane]
        if inner > f4(0.02):
            p = get(block, POSITION, lane)
            seen = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
            free += (seen - free) * inner
            for lamp in range(LAMPS):
                block[REACH + lamp * LANES + lane] *= f4(1) + (seen - f4(1)) * inner
        block[OPENED + lane] = free


@device("fast")
def _paint(count: int, batch: Batch, mesh: PosedMesh, paint: Paint, pixel: float) -> None:
    """Colour the clay with muscles; those that rivals suppress glow."""
    block = batch.block
    for lane in range(LANES):
        put(block, SHINE, lane, (f4(0), f4(0), f4(0)))
    for lane in range(count):
        k = batch.chosen[lane]
        t = batch.triangle[k]
        if paint.covered[t]:
            corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
            albedo, light = painted(paint, t, corners, weights, get(block, ALBEDO, lane), pixel)
            put(block, ALBEDO, lane, albedo)
            put(block, SHINE, lane, scale(light, block[OPENED + lane]))


@device("fast")
def _fill(block: Float32Array, light: SceneLight) -> None:
    """Start with the ambient light and the glow."""
    ambient = ambient_of(light.ambient)
    for k in range(LANES):
        arriving = ambient_on(ambient, get(block, NORMAL, k), block[OPENED + k])
        put(block, TOTAL, k, add(get(block, SHINE, k), times(get(block, ALBEDO, k), arriving)))


@device("fast")
def _add_lamp(block: Float32Array, lamp: int, direction: Vec, colour: Vec) -> None:
    """Add the matt light of one lamp."""
    for k in range(LANES):
        share = block[REACH + lamp * LANES + k] * facing(get(block, NORMAL, k), direction)
        share *= block[SHADOW + k] if lamp == 0 else f4(1)
        put(block, TOTAL, k, along(get(block, TOTAL, k), times(get(block, ALBEDO, k), colour), share))


@device("fast")
def _add_gloss(block: Float32Array, direction: Vec, colour: Vec) -> None:
    """Add a broad, faint gloss of the key lamp."""
    for k in range(LANES):
        shine = gloss(get(block, NORMAL, k), get(block, VIEW, k), direction, ROUGH, MIRRORED)
        shine *= block[REACH + k] * block[SHADOW + k]
        put(block, TOTAL, k, along(get(block, TOTAL, k), colour, shine))
