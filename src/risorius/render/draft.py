"""The pictures of drafts: one sample a pixel; skin and cloth are lit at their vertices, as hairs always are.

Only the vertices of visible triangles are lit. Within a triangle the colour is linear in the picture, so that
a pixel costs three products and sums for each channel. Eyes and mouth are shaded in full.
"""

from __future__ import annotations

from ..core.arrays import ByteArray
from ..looks.attributes import EXTRA, HAIR, SKIN
from ..looks.garment import COLLAR
from ..machine.kernels.jit import device, f4, i4, index
from ..machine.kernels.vec import Vec, at, scale, weigh
from .adaptive_samples import weights_at
from .inputs import Batch, Facets, Pose, PosedMesh, SceneLight, Screen, Tables
from .materials.cloth import SEAM, collar_shade, light_cloth
from .materials.lit import key_share
from .materials.shading_sample import Corners, corners_of, put
from .materials.skin import shade_skin
from .raster import SUBPIXEL
from .tone import developed

_UNSEEN, _SEEN, _LINEAR, _HEM, _WHOLE = 0, 1, 2, 3, 4
"""Kinds of triangles: not visible; visible; of a linear colour; at the neckline; shaded in full."""
_WAITING, _LISTED = f4(-1), f4(-2)  # instead of a colour: of vertices to be lit
_PIXEL = f4(1 / SUBPIXEL)


@device("fast")
def find_facets(
    facets: Facets,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
) -> None:
    """Light the vertices of all visible triangles of skin, and find the colours of all visible triangles."""
    _mark_visible(facets, screen)
    n = _list_vertices(facets, batch, mesh)
    for k in range(n):
        v = batch.column[k]
        mesh.shadow[v] = key_share(light, at(mesh.positions, v))
    shade_skin(n, batch, mesh, screen, light, pose, tables)
    for k in range(n):
        put(mesh.vertex_light, batch.column[k], at(batch.colour, k))
    light_cloth(n, batch, mesh, screen, light, tables)
    for t in range(len(facets.kind)):
        if facets.kind[t] == _SEEN:
            _find_facet(t, facets, mesh, tables)


@device("fast")
def _mark_visible(facets: Facets, screen: Screen) -> None:
    """Mark the visible triangles; the first counts as visible, too, because a test would take longer."""
    for t in range(len(facets.kind)):
        facets.kind[t] = _UNSEEN
    for y in range(screen.ids.shape[0]):
        for x in range(screen.ids.shape[1]):
            facets.kind[index(max(screen.ids[y, x], 0))] = _SEEN


@device("fast")
def _list_vertices(facets: Facets, batch: Batch, mesh: PosedMesh) -> int:
    """Write a patch at each vertex, its `column`, of the visible triangles of skin; return how many."""
    for v in range(len(mesh.cloth_light)):
        mesh.vertex_light[v, 0] = _WAITING
    n = 0
    for t in range(len(mesh.triangles)):
        if mesh.surfaces[t] != SKIN:
            break  # skin stands first
        if facets.kind[t] == _UNSEEN:
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


@device("fast")
def _find_facet(t: int, facets: Facets, mesh: PosedMesh, tables: Tables) -> None:
    """Find the kind and colour of a visible triangle."""
    surface, corners = mesh.surfaces[t], corners_of(mesh.triangles, t)
    a, b, c = corners
    if surface >= HAIR:
        facets.kind[t] = _LINEAR
        lights = at(mesh.vertex_light, a), at(mesh.vertex_light, b), at(mesh.vertex_light, c)
    elif surface == SKIN:
        depths = mesh.attributes[a, EXTRA], mesh.attributes[b, EXTRA], mesh.attributes[c, EXTRA]
        if max(depths[0], depths[1], depths[2]) < f4(0):
            facets.kind[t] = _LINEAR
            lights = at(mesh.vertex_light, a), at(mesh.vertex_light, b), at(mesh.vertex_light, c)
        elif min(depths[0], depths[1], depths[2]) > COLLAR + SEAM:
            facets.kind[t] = _LINEAR
            lights = at(mesh.cloth_light, a), at(mesh.cloth_light, b), at(mesh.cloth_light, c)
        else:
            facets.kind[t] = _HEM
            return
    else:
        facets.kind[t] = _WHOLE
        return
    _spread(t, corners, lights, facets, mesh, tables)


@device("fast", inlined=True)
def _spread(
    t: int, corners: Corners, lights: tuple[Vec, Vec, Vec], facets: Facets, mesh: PosedMesh, tables: Tables
) -> None:
    """Write the plane of a triangle with these lights at its corners."""
    a, b, c = corners
    ax, ay = f4(mesh.xy[a, 0]) * _PIXEL, f4(mesh.xy[a, 1]) * _PIXEL
    bx, by = f4(mesh.xy[b, 0] - mesh.xy[a, 0]) * _PIXEL, f4(mesh.xy[b, 1] - mesh.xy[a, 1]) * _PIXEL
    cx, cy = f4(mesh.xy[c, 0] - mesh.xy[a, 0]) * _PIXEL, f4(mesh.xy[c, 1] - mesh.xy[a, 1]) * _PIXEL
    share = f4(1) / (bx * cy - by * cx)
    for channel in range(3):
        start = f4(developed(tables.direct, lights[0][channel]))
        to_b = f4(developed(tables.direct, lights[1][channel])) - start
        to_c = f4(developed(tables.direct, lights[2][channel])) - start
        right, down = (to_b * cy - to_c * by) * share, (to_c * bx - to_b * cx) * share
        # Half a pixel to its middle, and half a step to round.
        facets.plane[t, channel] = start + (f4(0.5) - ax) * right + (f4(0.5) - ay) * down + f4(0.5)
        facets.plane[t, 3 + channel] = right
        facets.plane[t, 6 + channel] = down


@device("fast")
def shade_row(
    y: int, screen: Screen, mesh: PosedMesh, facets: Facets, batch: Batch, tables: Tables, out: ByteArray
) -> int:
    """Write all of row y but eyes and mouth, whose patches are collected; return how many these are."""
    n = 0
    for x in range(out.shape[1]):
        t = screen.ids[index(y), index(x)]
        if t < 0:
            out[y, x, 0], out[y, x, 1], out[y, x, 2] = (
                screen.empty[y, x, 0],
                screen.empty[y, x, 1],
                screen.empty[y, x, 2],
            )
            continue
        kind = facets.kind[index(t)]
        if kind == _LINEAR:
            for channel in range(3):
                out[y, x, channel] = _linear(facets, index(t), channel, f4(x), f4(y))
            continue
        weights = weights_at(f4(x) + f4(0.5), f4(y) + f4(0.5), t, mesh.triangles, mesh.xy, mesh.key)
        if kind == _HEM:
            _write(out, y, x, tables, _hem(mesh, t, weights))
        else:
            batch.triangle[n], batch.column[n], batch.samples[n] = t, x, 1
            batch.weights[n, 0], batch.weights[n, 1], batch.weights[n, 2] = weights
            n += 1
    return n


@device("fast", inlined=True)
def _linear(facets: Facets, t: int, channel: int, x: float, y: float) -> int:
    """Return a channel's byte at a pixel of a triangle of linear colour."""
    value = (
        facets.plane[t, channel]
        + x * facets.plane[t, index(channel + 3)]
        + y * facets.plane[t, index(channel + 6)]
    )
    return i4(min(max(value, f4(0)), f4(255)))


@device("fast")
def write_patches(y: int, n: int, batch: Batch, tables: Tables, out: ByteArray) -> None:
    """Write the first n patches of row y, a pixel each."""
    for k in range(n):
        _write(out, y, batch.column[k], tables, at(batch.colour, k))


@device("fast", inlined=True)
def _hem(mesh: PosedMesh, t: int, weights: Vec) -> Vec:
    """Return the light of skin or cloth at a place in triangle t."""
    corners = corners_of(mesh.triangles, t)
    a, b, c = corners
    depth = (
        weights[0] * mesh.attributes[a, EXTRA]
        + weights[1] * mesh.attributes[b, EXTRA]
        + weights[2] * mesh.attributes[c, EXTRA]
    )
    if depth < f4(0):
        return weigh(mesh.vertex_light, corners, weights, 0)
    return scale(weigh(mesh.cloth_light, corners, weights, 0), collar_shade(depth))


@device("fast", inlined=True)
def _write(out: ByteArray, y: int, x: int, tables: Tables, colour: Vec) -> None:
    red, green, blue = colour
    out[y, x, 0] = developed(tables.direct, red)
    out[y, x, 1] = developed(tables.direct, green)
    out[y, x, 2] = developed(tables.direct, blue)
