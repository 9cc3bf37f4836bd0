"""Bare skin lit at its vertices, and how much its pores change that light.

Pores are much smaller than triangles: they turn the normal a little, and the light changes in proportion.
Between vertices the light and that change are interpolated, and only the pores are looked up.
"""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...looks import attributes
from ...machine.kernels.jit import device, f4, i8
from ...machine.kernels.vec import add, along, at, dot, scale, unrotate
from ..inputs import Batch, LinearTriangles, Pose, PosedMesh, SceneLight, Screen, Tables
from ..shading_block import (
    ALBEDO,
    BUMPY,
    CURVATURE,
    FREE,
    INNER,
    LAMPS,
    LANES,
    NORMAL,
    OPENED,
    POSITION,
    REACH,
    ROUGHNESS,
    SHADOW,
    SHINE,
    SOFT,
    STRENGTH,
    TOTAL,
    WAY,
    face,
    get,
    put,
)
from .exposure import expose
from .skin import PORES, PORES_DARKEN, PORES_DULL, collar_free, fill, pore_depth
from .skin_lamps import edge_light, lamp_change, lamp_light


@device("fast")
def light_vertices(
    n: int,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    linear: LinearTriangles,
) -> None:
    """Write the display light at the first n vertices of `batch.column`, and its change by pores."""
    depth = pore_depth(screen.detail)
    for first in range(0, n, LANES):
        count = min(n - first, i8(LANES))
        for lane in range(count):
            _read(batch.column[first + lane], lane, batch.block, mesh)
        _light_block(count, batch.block, screen, light, tables)
        for lane in range(count):
            _write(batch.column[first + lane], lane, batch.block, depth, pose, tables, linear)


@device("fast", inlined=True)
def _read(v: int, lane: int, block: Float32Array, mesh: PosedMesh) -> None:
    """Read vertex v into a lane."""
    put(block, ALBEDO, lane, at(mesh.attributes, v))
    block[FREE + lane] = mesh.attributes[v, attributes.OCCLUSION] * collar_free(
        mesh.attributes[v, attributes.EXTRA]
    )
    block[ROUGHNESS + lane] = mesh.attributes[v, attributes.ROUGHNESS]
    block[STRENGTH + lane] = mesh.attributes[v, attributes.SPECULAR]
    block[CURVATURE + lane] = mesh.attributes[v, attributes.CURVATURE]
    block[INNER + lane] = mesh.attributes[v, attributes.INNER]
    block[SHADOW + lane] = mesh.shadow[v]
    put(block, POSITION, lane, at(mesh.positions, v))
    put(block, NORMAL, lane, at(mesh.normals, v))
    for lamp in range(LAMPS):
        block[REACH + lamp * LANES + lane] = mesh.reach[v, lamp]


@device("fast")
def _light_block(count: int, block: Float32Array, screen: Screen, light: SceneLight, tables: Tables) -> None:
    """Light a block of vertices; write into WAY how the light of green changes with the normal."""
    face(block, (screen.eye[0], screen.eye[1], screen.eye[2]))
    for k in range(LANES):
        put(block, SOFT, k, get(block, NORMAL, k))
        put(block, BUMPY, k, get(block, NORMAL, k))
        put(block, WAY, k, (f4(0), f4(0), f4(0)))
        block[OPENED + k] = block[FREE + k]
    fill(block, light)
    for lamp in range(len(light.lamps)):
        lamp_light(count, lamp, block, light.lamps, tables.diffuse)
        lamp_change(count, lamp, block, light.lamps, tables.diffuse)
    edge_light(block, light.ambient)


@device("fast", inlined=True)
def _write(
    v: int,
    lane: int,
    block: Float32Array,
    depth: float,
    pose: Pose,
    tables: Tables,
    linear: LinearTriangles,
) -> None:
    """Write the results of vertex v."""
    total, shine = get(block, TOTAL, lane), get(block, SHINE, lane)
    answer = expose(v, add(total, shine), tables.film, linear)
    normal, change = get(block, NORMAL, lane), get(block, WAY, lane)
    slope = scale(along(change, normal, -dot(change, normal)), depth * (block[INNER + lane] - f4(1)))
    linear.pores[v, 0] = (PORES_DARKEN * total[1] + PORES_DULL * shine[1]) * answer
    slope = scale(unrotate(pose.rotation, slope), PORES * answer)
    linear.pores[v, 1], linear.pores[v, 2], linear.pores[v, 3] = slope
