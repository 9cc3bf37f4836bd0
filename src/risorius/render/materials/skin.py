"""Skin: scattered light from below the surface, gloss on it, dark within the mouth.

Its patches are shaded in blocks (`shading_block`), each step for all patches of a block.
"""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...looks import attributes
from ...looks.attributes import SKIN
from ...machine.kernels.jit import device, f4, i8
from ...machine.kernels.vec import Vec, add, along, dot, rows_of, scale, smooth, tilted, times, turned, weigh
from ..grain import between, cell_of, heights_about
from ..inputs import Batch, Pose, PosedMesh, SceneLight, Screen, Tables
from ..shading_block import (
    ALBEDO,
    BUMPY,
    CLOTH,
    CURVATURE,
    FREE,
    GRAIN,
    INNER,
    LANES,
    NORMAL,
    OPENED,
    POSITION,
    REST,
    ROUGHNESS,
    SHADOW,
    SHARE,
    SHINE,
    SOFT,
    STRENGTH,
    TOTAL,
    VIEW,
    WAY,
    face,
    get,
    heights_in,
    put,
)
from .lit import ambient_of, ambient_on, read_reach
from .mouth import entering_light, lamps_past_lips, past_lips, spread_in_flesh
from .shading_sample import corners_of, weights_of
from .shading_sample import put as put_colour
from .shadows import shadow_at
from .skin_lamps import PORES_SOFT, edge_light, lamp_light
from .wrinkle_normals import bent, creased

FLESH = f4(0.85)
"""Share of a fold's slope that affects light scattered below the surface."""
FOLD_SHADES, FOLD_DULLS = f4(0.7), f4(0.6)
"""The shares by which the bottom of a fold lessens the ambient light and the strength of the gloss."""
INNER_MOUTH = f4(0.02)
"""Share of mouth interior up to which skin is lit as skin outside."""
PORES = f4(6.5 / 0.62)
"""Cells of the grain per mm: pores are 0.62 mm apart."""
PORES_DARKEN, PORES_DULL = f4(0.025), f4(0.2)
"""The shares by which pores change the albedo and the strength of the gloss."""


@device("fast")
def shade_skin(
    n: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, pose: Pose, tables: Tables
) -> None:
    """Colour the patches of bare skin among the first n of a row."""
    count = i8(0)
    for k in range(n):
        if mesh.surfaces[batch.triangle[k]] == SKIN and _read(k, count, batch, mesh, light, screen.detail):
            count += 1
            if count == LANES:
                _shade_block(count, batch, mesh, screen, light, pose, tables)
                count = i8(0)
    if count:
        _shade_block(count, batch, mesh, screen, light, pose, tables)


@device("fast")
def _shade_block(
    count: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, pose: Pose, tables: Tables
) -> None:
    block = batch.block
    face(block, (screen.eye[0], screen.eye[1], screen.eye[2]))
    _find_grain(count, block, tables.grain)
    _roughen(block, pose, screen.detail)
    _fold(count, batch, mesh, pose, tables, screen.detail)
    _shadow(count, block, pose)
    fill(block, light)
    _light_lining(block, entering_light(light, pose.rotation))
    for lamp in range(len(light.lamps)):
        lamp_light(count, lamp, block, light.lamps, tables.diffuse)
    edge_light(block, light.ambient)
    for k in range(count):
        put_colour(batch.colour, batch.chosen[k], add(get(block, TOTAL, k), get(block, SHINE, k)))


@device("fast", inlined=True)
def _read(k: int, lane: int, batch: Batch, mesh: PosedMesh, light: SceneLight, pixel: float) -> bool:
    """Read patch k of the mesh into a lane; return whether its skin is bare."""
    corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
    bent_by, inner, cloth = weigh(mesh.attributes, corners, weights, attributes.CURVATURE)
    if cloth > pixel:
        return False
    block = batch.block
    batch.chosen[lane] = k
    block[CURVATURE + lane], block[INNER + lane], block[CLOTH + lane] = bent_by, inner, cloth
    free, roughness, strength = weigh(mesh.attributes, corners, weights, attributes.OCCLUSION)
    block[FREE + lane], block[ROUGHNESS + lane], block[STRENGTH + lane] = free, roughness, strength
    put(block, ALBEDO, lane, weigh(mesh.attributes, corners, weights, attributes.ALBEDO))
    p = weigh(mesh.positions, corners, weights, 0)
    put(block, POSITION, lane, p)
    block[SHADOW + lane] = shadow_at(mesh, light, corners, weights, p)
    put(block, NORMAL, lane, weigh(mesh.normals, corners, weights, 0))
    put(block, REST, lane, weigh(mesh.rest, corners, weights, 0))
    read_reach(block, lane, mesh.reach, corners, weights)
    return True


@device("fast")
def _find_grain(count: int, block: Float32Array, tile: Float32Array) -> None:
    """Look up the pores."""
    for k in range(count):
        cell, way = cell_of(get(block, REST, k), PORES)
        put(block, WAY, k, way)
        heights = heights_about(tile, cell)
        for corner in range(8):
            block[GRAIN + corner * LANES + k] = heights[corner]


@device("fast")
def _roughen(block: Float32Array, pose: Pose, pixel: float) -> None:
    """Let the pores turn the normal and vary colour and gloss."""
    rotation = rows_of(pose.rotation)
    depth = pore_depth(pixel)
    for k in range(LANES):
        fine, gx, gy, gz = between(heights_in(block, k), get(block, WAY, k), PORES)
        normal, slope = get(block, NORMAL, k), turned(rotation, (gx, gy, gz))
        pores = scale(along(slope, normal, -dot(slope, normal)), depth * (block[INNER + k] - f4(1)))
        put(block, SOFT, k, tilted(normal, scale(pores, PORES_SOFT)))
        put(block, BUMPY, k, tilted(normal, pores))
        put(block, ALBEDO, k, scale(get(block, ALBEDO, k), f4(1) + PORES_DARKEN * fine))
        block[STRENGTH + k] *= f4(1) + PORES_DULL * min(fine, f4(1))
        block[FREE + k] *= collar_free(block[CLOTH + k])


@device("fast")
def pore_depth(pixel: float) -> float:
    """Return the depth of pores in mm: those smaller than two pixels would flicker as the head moves."""
    return f4(0.0075) * (f4(1) - smooth(f4(0.22), f4(0.7), pixel))


@device("fast")
def collar_free(cloth: float) -> float:
    """Return the share of light that the collar's edge leaves to the skin close above it."""
    return f4(1) - f4(0.5) * smooth(f4(-7), f4(0), cloth)


@device("fast")
def _fold(count: int, batch: Batch, mesh: PosedMesh, pose: Pose, tables: Tables, pixel: float) -> None:
    """Let wrinkles turn the normal and darken the skin."""
    block = batch.block
    for k in range(count):
        patch = batch.chosen[k]
        t = batch.triangle[patch]
        if mesh.crease_raised[t] == 0:
            continue
        corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, patch)
        normal, rest = get(block, NORMAL, k), get(block, REST, k)
        facing = dot(normal, get(block, VIEW, k))
        slope, deep = creased(tables, mesh, pose, t, corners, weights, rest, normal, facing, pixel)
        if deep > f4(0) or dot(slope, slope) > f4(0):
            put(block, SOFT, k, bent(get(block, SOFT, k), slope, FLESH))
            put(block, BUMPY, k, bent(get(block, BUMPY, k), slope, f4(1)))
            block[FREE + k] *= f4(1) - FOLD_SHADES * deep
            block[STRENGTH + k] *= f4(1) - FOLD_DULLS * deep
            put(block, ALBEDO, k, times(get(block, ALBEDO, k), fold_colour(deep)))


@device("fast")
def fold_colour(deep: float) -> Vec:
    """Return the factor of a fold on the albedo: darker and redder."""
    return f4(1) - f4(0.22) * deep, f4(1) - f4(0.36) * deep, f4(1) - f4(0.38) * deep


@device("fast")
def _shadow(count: int, block: Float32Array, pose: Pose) -> None:
    """Compute how much of the key lamp and of the ambient light arrives, and of the light in the mouth."""
    for k in range(count):
        free, inner = block[FREE + k], block[INNER + k]
        block[SHARE + k] = f4(0)
        if inner > INNER_MOUTH:
            p = get(block, POSITION, k)
            seen = spread_in_flesh(past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p))
            free += (seen - free) * inner
            block[SHADOW + k] *= f4(1) + (seen - f4(1)) * inner
            block[SHARE + k] = seen * inner * lamps_past_lips(pose.rotation, pose.pivot, pose.lips, p)
        block[OPENED + k] = free


@device("fast")
def _light_lining(block: Float32Array, entering: Vec) -> None:
    """Add the lamps' light that comes past the lips, whose SHARE the mouth's lining spreads to all sides."""
    for k in range(LANES):
        lit = times(get(block, ALBEDO, k), entering)
        put(block, TOTAL, k, along(get(block, TOTAL, k), lit, block[SHARE + k]))


@device("fast")
def fill(block: Float32Array, light: SceneLight) -> None:
    """Start with the ambient light."""
    ambient = ambient_of(light.ambient)
    for k in range(LANES):
        arriving = ambient_on(ambient, get(block, SOFT, k), block[OPENED + k])
        put(block, TOTAL, k, times(get(block, ALBEDO, k), arriving))
        put(block, SHINE, k, (f4(0), f4(0), f4(0)))
