"""The pictures of drafts: one sample a pixel; skin and cloth are lit at their vertices, as hairs always are.

Colours are interpolated between vertices and go straight into the picture. Eyes and mouth are shaded in full.
"""

from __future__ import annotations

from ..core.arrays import ByteArray
from ..core.kernels.jit import f4, fast_device, fast_inlined, index
from ..core.kernels.vec import Vec, at, scale, weigh
from ..looks.attributes import CURVATURE, HAIR, SKIN
from .collect import weights_at
from .inputs import Batch, Pose, PosedMesh, SceneLight, Screen, Tables
from .materials.cloth import collar_shade, light_cloth
from .materials.lit import key_share
from .materials.patch import corners_of, put
from .materials.skin import shade_skin
from .tone import developed

_WAITING, _LISTED = f4(-1), f4(-2)  # instead of a colour: of vertices to be lit


@fast_device
def light_vertices(
    batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, pose: Pose, tables: Tables
) -> None:
    """Light the vertices of all triangles of skin that are drawn, as patches of these triangles."""
    n = _list_vertices(batch, mesh, screen)
    for k in range(n):
        v = batch.column[k]
        mesh.shadow[v] = key_share(light, at(mesh.positions, v))
    shade_skin(n, batch, mesh, screen, light, pose, tables)
    for k in range(n):
        put(mesh.vertex_light, batch.column[k], at(batch.colour, k))
    light_cloth(n, batch, mesh, screen, light, tables)


@fast_device
def _list_vertices(batch: Batch, mesh: PosedMesh, screen: Screen) -> int:
    """Write a patch at each vertex, its `column`, of the drawn triangles of skin; return how many."""
    for v in range(len(mesh.cloth_light)):
        mesh.vertex_light[v, 0] = _WAITING
    n = 0
    for t in range(len(mesh.triangles)):
        if mesh.surfaces[t] != SKIN:
            break  # skin stands first
        if screen.rows[t, 0] > screen.rows[t, 1]:
            continue
        for corner in range(3):
            v = index(mesh.triangles[t, corner])
            if mesh.vertex_light[v, 0] == _WAITING:
                mesh.vertex_light[v, 0] = _LISTED
                batch.triangle[n], batch.column[n], batch.samples[n] = t, v, 1
                for c in range(3):
                    batch.weights[n, c] = f4(1) if c == corner else f4(0)
                n += 1
    return n


@fast_device
def shade_row(y: int, screen: Screen, mesh: PosedMesh, batch: Batch, tables: Tables, out: ByteArray) -> int:
    """Write all of row y but eyes and mouth, whose patches are collected; return how many these are."""
    n, middle = 0, f4(y) + f4(0.5)
    for x in range(out.shape[1]):
        t = screen.ids[index(y), index(x)]
        if t < 0:
            out[y, x, 0], out[y, x, 1], out[y, x, 2] = (
                screen.empty[y, x, 0],
                screen.empty[y, x, 1],
                screen.empty[y, x, 2],
            )
            continue
        surface = mesh.surfaces[t]
        weights = weights_at(f4(x) + f4(0.5), middle, t, mesh.triangles, mesh.xy, mesh.key)
        if surface == SKIN:
            _write(out, y, x, tables, _skin(mesh, t, weights))
        elif surface >= HAIR:
            _write(out, y, x, tables, weigh(mesh.vertex_light, corners_of(mesh.triangles, t), weights, 0))
        else:
            batch.triangle[n], batch.column[n], batch.samples[n] = t, x, 1
            batch.weights[n, 0], batch.weights[n, 1], batch.weights[n, 2] = weights
            n += 1
    return n


@fast_device
def write_patches(y: int, n: int, batch: Batch, tables: Tables, out: ByteArray) -> None:
    """Write the first n patches of row y, a pixel each."""
    for k in range(n):
        _write(out, y, batch.column[k], tables, at(batch.colour, k))


@fast_inlined
def _skin(mesh: PosedMesh, t: int, weights: Vec) -> Vec:
    """Return the light of skin or cloth at a place in triangle t."""
    corners = corners_of(mesh.triangles, t)
    depth = weigh(mesh.attributes, corners, weights, CURVATURE)[2]
    if depth < f4(0):
        return weigh(mesh.vertex_light, corners, weights, 0)
    return scale(weigh(mesh.cloth_light, corners, weights, 0), collar_shade(depth))


@fast_inlined
def _write(out: ByteArray, y: int, x: int, tables: Tables, colour: Vec) -> None:
    red, green, blue = colour
    out[y, x, 0] = developed(tables.direct, red)
    out[y, x, 1] = developed(tables.direct, green)
    out[y, x, 2] = developed(tables.direct, blue)
