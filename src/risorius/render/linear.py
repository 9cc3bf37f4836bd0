"""Triangles within which the light is linear: hairs, and skin that is lit evenly.

Their pixels are not collected into patches: each sample reads the light of its triangle, and a pixel is the
mean of its samples. On the skin a pixel looks up the pores besides. Which triangles these are depends on the
frame alone, so that pictures do not depend on which others are drawn.
"""

from __future__ import annotations

from ..core.arrays import ByteArray, Float32Array, Int32Array
from ..looks.attributes import EXTRA, HAIR, INNER, ROUGHNESS, SKIN
from ..machine.kernels.jit import device, f4, i8, index
from ..machine.kernels.vec import Vec, along, at, dot, scale
from .adaptive_samples import collect_pixel
from .grain import between, cell_of, heights_about
from .inputs import Batch, LinearTriangles, Pose, PosedMesh, SceneLight, Screen, Tables
from .linear_block import GROUP, mean_at
from .materials.cloth import STITCHES, covers, light_cloth_vertices
from .materials.shading_sample import Corners, corners_of
from .materials.shading_sample import put as put_light
from .materials.shadows import EVEN
from .materials.skin import INNER_MOUTH, PORES
from .materials.skin_vertices import light_vertices
from .raster import SUBPIXEL
from .shading_block import (
    BELOW,
    FREE,
    GRAIN,
    LANES,
    REST,
    SHARE,
    SOFT,
    STRENGTH,
    TOTAL,
    VIEW,
    WAY,
    get,
    heights_in,
    put,
)
from .tone import byte_place, exposed

SIDE = 2
"""Samples a pixel and side of the pictures that are drawn so."""
_NONE, _BACKGROUND = 0, 1  # the first rows of planes
_CANDIDATE = -1  # a row to come
_UNLIT, _LISTED = f4(-1), f4(-2)  # in place of a vertex' display light
_ALIKE = f4(0.6)
"""Share by which the light at the corners of a triangle of skin may differ."""
_GRADUAL, _SMALL = f4(0.4), 14
"""Share of the key lamp by which the corners of a triangle of fewer rows than _SMALL may differ."""
_WET = f4(0.12)  # roughness of lips, whose gloss is sharper than triangles are small
_SLIVER = f4(0.02)  # area in samples of triangles too thin to have a slope
_SAMPLE = f4(1 / SUBPIXEL)
_RIGHT, _DOWN, _SAME = GROUP, 2 * GROUP, 3 * GROUP
_ONE = index(1)


@device("fast")
def find_linear(
    linear: LinearTriangles,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    hair_pairs: Int32Array,
) -> None:
    """Find the triangles whose light is linear, and their planes."""
    linear.row[0] = _BACKGROUND
    bare, clothed = _list_vertices(linear, batch, mesh, screen)
    light_vertices(bare, batch, mesh, screen, light, pose, tables, linear)
    light_cloth_vertices(clothed, batch, mesh, screen, light, tables, linear)
    for i in hair_pairs:
        lit = _exposed(tables.film, at(mesh.vertex_light, i))
        put_light(linear.display, i, lit)
        put_light(linear.display, i + 1, lit)
    rows = i8(_BACKGROUND + 1)
    for place in range(len(screen.order)):
        t = index(screen.order[place])
        number = i8(_NONE)
        if linear.row[t + _ONE] == _CANDIDATE and _write_planes(rows, t, linear, mesh):
            number = rows
            rows += 1
        linear.row[t + _ONE] = number


@device("fast")
def _list_vertices(linear: LinearTriangles, batch: Batch, mesh: PosedMesh, screen: Screen) -> tuple[int, int]:
    """Mark the triangles that may be linear; list their vertices of skin and cloth in `batch.column`.

    Return how many are bare, and how many are covered by cloth. These stand at the list's end.
    """
    count = index(len(linear.pores))
    for v in range(count):
        linear.display[v, 0] = _UNLIT
    bare, clothed = i8(0), i8(0)
    for place in range(len(screen.order)):
        t = index(screen.order[place])
        linear.row[t + _ONE] = _NONE
        if screen.rows[t, 0] > screen.rows[t, 1]:
            continue
        if mesh.surfaces[t] >= HAIR:
            linear.row[t + _ONE] = _CANDIDATE
            continue
        corners = corners_of(mesh.triangles, t)
        if mesh.surfaces[t] != SKIN or not _even(t, corners, mesh, screen):
            continue
        is_clothed = covers(mesh, corners)
        if not (is_clothed or _bare(t, corners, mesh, screen.pixel)):
            continue
        linear.row[t + _ONE] = _CANDIDATE
        for v in corners:
            if linear.display[v, 0] == _UNLIT:
                linear.display[v, 0] = _LISTED
                if is_clothed:
                    clothed += 1
                    batch.column[count - index(clothed)] = v
                else:
                    batch.column[bare] = v
                    bare += 1
    return bare, clothed


@device("fast", inlined=True)
def _even(t: int, corners: Corners, mesh: PosedMesh, screen: Screen) -> bool:
    """Return whether no shadow ends within triangle t, or one whose edge is wide beside the triangle."""
    a, b, c = mesh.shadow[corners[0]], mesh.shadow[corners[1]], mesh.shadow[corners[2]]
    apart = max(a, b, c) - min(a, b, c)
    return bool(apart <= EVEN or (apart <= _GRADUAL and screen.rows[t, 1] - screen.rows[t, 0] < _SMALL))


@device("fast", inlined=True)
def _bare(t: int, corners: Corners, mesh: PosedMesh, pixel: float) -> bool:
    """Return whether triangle t of skin is bare, neither wet nor within the mouth, and has no folds."""
    a, b, c = corners
    cloth = max(mesh.attributes[a, EXTRA], mesh.attributes[b, EXTRA], mesh.attributes[c, EXTRA])
    inner = max(mesh.attributes[a, INNER], mesh.attributes[b, INNER], mesh.attributes[c, INNER])
    rough = min(mesh.attributes[a, ROUGHNESS], mesh.attributes[b, ROUGHNESS], mesh.attributes[c, ROUGHNESS])
    return bool(mesh.crease_raised[t] == 0 and cloth < -pixel and inner <= INNER_MOUTH and rough >= _WET)


@device("fast", inlined=True)
def _write_planes(r: int, t: int, linear: LinearTriangles, mesh: PosedMesh) -> bool:
    """Write row r of the planes for triangle t; return whether its light is linear."""
    corners, skin = corners_of(mesh.triangles, t), mesh.surfaces[t] == SKIN
    a, b, c = corners
    green = linear.display[a, 1], linear.display[b, 1], linear.display[c, 1]
    if skin and max(green[0], green[1], green[2]) > (f4(1) + _ALIKE) * min(green[0], green[1], green[2]):
        return False
    ax, ay = f4(mesh.xy[a, 0]) * _SAMPLE, f4(mesh.xy[a, 1]) * _SAMPLE
    bx, by = f4(mesh.xy[b, 0] - mesh.xy[a, 0]) * _SAMPLE, f4(mesh.xy[b, 1] - mesh.xy[a, 1]) * _SAMPLE
    cx, cy = f4(mesh.xy[c, 0] - mesh.xy[a, 0]) * _SAMPLE, f4(mesh.xy[c, 1] - mesh.xy[a, 1]) * _SAMPLE
    area = bx * cy - by * cx
    share = f4(1) / area if abs(area) > _SLIVER else f4(0)
    frame = (ax, ay), (bx * share, by * share), (cx * share, cy * share)
    for k in range(3):
        _spread(linear.planes, r, k, frame, linear.display[a, k], linear.display[b, k], linear.display[c, k])
    if skin:
        cells = STITCHES if covers(mesh, corners) else (PORES, PORES, PORES)
        for k in range(3):
            cell = cells[k]
            at_a, at_b, at_c = mesh.rest[a, k] * cell, mesh.rest[b, k] * cell, mesh.rest[c, k] * cell
            _spread(linear.planes, r, k + 3, frame, at_a, at_b, at_c)
        for k in range(4):
            total = linear.pores[a, k] + linear.pores[b, k] + linear.pores[c, k]
            linear.planes[r, _SAME + k] = total * f4(1 / 3)
    else:
        for k in range(3, 6):
            linear.planes[r, k] = linear.planes[r, _RIGHT + k] = linear.planes[r, _DOWN + k] = f4(0)
        for k in range(4):
            linear.planes[r, _SAME + k] = f4(0)
    linear.planes[r, 6], linear.planes[r, 7] = f4(1), f4(1) if skin else f4(0)
    return True


@device("fast", inlined=True)
def _spread(
    planes: Float32Array,
    r: int,
    column: int,
    frame: tuple[tuple[float, float], tuple[float, float], tuple[float, float]],
    at_a: float,
    at_b: float,
    at_c: float,
) -> None:
    """Write the plane of a value at three corners."""
    (ax, ay), (bx, by), (cx, cy) = frame
    to_b, to_c = at_b - at_a, at_c - at_a
    right, down = to_b * cy - to_c * by, to_c * bx - to_b * cx
    planes[r, column] = at_a - ax * right - ay * down
    planes[r, _RIGHT + column] = right
    planes[r, _DOWN + column] = down


@device("fast", inlined=True)
def _exposed(film: Float32Array, light: Vec) -> Vec:
    """Return the display light of scene light."""
    return exposed(film, light[0]), exposed(film, light[1]), exposed(film, light[2])


@device("fast")
def draw_row(
    y: int,
    screen: Screen,
    mesh: PosedMesh,
    linear: LinearTriangles,
    batch: Batch,
    tables: Tables,
    out: ByteArray,
) -> int:
    """Write the pixels of row y that show linear triangles alone; return how many patches the others have."""
    count, others, top = i8(0), i8(0), index(y * SIDE)
    for x in range(out.shape[1]):
        left = index(x * SIDE)
        one, two = screen.ids[top, left], screen.ids[top, left + _ONE]
        three, four = screen.ids[top + _ONE, left], screen.ids[top + _ONE, left + _ONE]
        if one & two & three & four == -1:
            continue
        rows = _rows(linear.row, one, two, three, four)
        if min(rows[0], rows[1], rows[2], rows[3]) == _NONE:
            linear.others[others] = x
            others += 1
            continue
        batch.chosen[count] = x
        count += 1
        if count == LANES:
            _draw_block(y, count, screen, linear, batch, tables, out)
            count = i8(0)
    _draw_block(y, count, screen, linear, batch, tables, out)
    n = 0
    for k in range(others):
        n = collect_pixel(n, i8(linear.others[k]), y, SIDE, screen, mesh, batch)
    return n


@device("fast", inlined=True)
def _rows(row: Int32Array, one: int, two: int, three: int, four: int) -> tuple[int, int, int, int]:
    """Return the rows of planes of four triangles, −1 being the background."""
    return (
        i8(row[index(one + 1)]),
        i8(row[index(two + 1)]),
        i8(row[index(three + 1)]),
        i8(row[index(four + 1)]),
    )


@device("fast", inlined=True)
def _put(block: Float32Array, lane: int, mean: Float32Array) -> None:
    """Put the means of `mean_at` into a lane."""
    put(block, TOTAL, lane, (mean[0], mean[1], mean[2]))
    put(block, REST, lane, (mean[3], mean[4], mean[5]))
    block[FREE + lane], block[SHARE + lane], block[STRENGTH + lane] = mean[6], mean[7], mean[8]
    put(block, SOFT, lane, (mean[9], mean[10], mean[11]))


@device("fast")
def _draw_block(
    y: int, count: int, screen: Screen, linear: LinearTriangles, batch: Batch, tables: Tables, out: ByteArray
) -> None:
    """Write the first pixels of a block: light with the pattern of its material, and the background."""
    block, top = batch.block, index(y * SIDE)
    for k in range(count):
        x = batch.chosen[k]
        left = index(x * SIDE)
        one, two = screen.ids[top, left], screen.ids[top, left + _ONE]
        three, four = screen.ids[top + _ONE, left], screen.ids[top + _ONE, left + _ONE]
        rows = _rows(linear.row, one, two, three, four)
        mean_at(linear.planes, rows, f4(SIDE * x) + f4(0.5), f4(SIDE * y) + f4(0.5), linear.means)
        _put(block, k, linear.means)
    for k in range(LANES):
        part = f4(1) / max(block[SHARE + k], f4(0.1))  # the share is a number of quarters
        cell, way = cell_of(scale(get(block, REST, k), part), f4(1))
        put(block, VIEW, k, (f4(cell[0]), f4(cell[1]), f4(cell[2])))
        put(block, WAY, k, way)
    for k in range(count):
        i, j, deep = get(block, VIEW, k)
        heights = heights_about(tables.grain, (index(i), index(j), index(deep)))
        for corner in range(8):
            block[GRAIN + corner * LANES + k] = heights[corner]
        x, left = index(batch.chosen[k]), f4(1) - block[FREE + k]
        for c in range(3):
            block[BELOW + c * LANES + k] = left * screen.background[index(y), x, c]
    for k in range(LANES):
        fine, gx, gy, gz = between(heights_in(block, k), get(block, WAY, k), f4(1))
        more = f4(1) + fine * block[STRENGTH + k] + dot((gx, gy, gz), get(block, SOFT, k))
        light = along(get(block, BELOW, k), get(block, TOTAL, k), more)
        put(block, TOTAL, k, (byte_place(light[0]), byte_place(light[1]), byte_place(light[2])))
    for k in range(count):
        x, places = index(batch.chosen[k]), get(block, TOTAL, k)
        for c in range(3):
            out[y, x, c] = tables.bytes[index(places[c])]
