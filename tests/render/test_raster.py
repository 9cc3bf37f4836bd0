import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.render.raster import SUBPIXEL
from risorius.render.visibility import Visibility
from tests.profiles import examples

SIZE = 24
NARROW, WIDE = 12, 40
"""Pictures that are drawn sample by sample, and by several blocks of samples in a row."""
PLACES = st.tuples(*[st.integers(-4 * SUBPIXEL, (SIZE + 4) * SUBPIXEL)] * 2)


def drawn(xy, key, triangles, two_sided=1, size=SIZE):
    triangles = np.asarray(triangles, np.int32)
    buffer = Visibility(size, size, len(triangles))
    sides = np.full(len(triangles), two_sided, np.uint8)
    buffer.draw(np.asarray(xy, np.int32), np.asarray(key, np.float32), triangles, sides)
    return buffer


def inside(corners, size=SIZE):
    """Which samples a triangle covers, by the definition of the top-left rule in whole numbers."""
    corners = [tuple(int(v) for v in c) for c in corners]
    (ax, ay), (bx, by), (cx, cy) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area < 0:
        corners = [corners[0], corners[2], corners[1]]
    covered = np.full((size, size), area != 0)
    centres = np.arange(size, dtype=np.int64) * SUBPIXEL + SUBPIXEL // 2
    x, y = centres[None, :], centres[:, None]
    for (px, py), (qx, qy) in itertools.pairwise([*corners, corners[0]]):
        edge = (qx - px) * (y - py) - (qy - py) * (x - px)
        top_or_left = qy < py or (qy == py and qx > px)
        covered &= edge >= 0 if top_or_left else edge > 0
    return covered


@pytest.mark.parametrize(
    "corners",
    [
        [(100, 100), (100, 100), (100, 100)],
        [(0, 0), (1000, 1000), (2000, 2000)],
        [(-9000, 0), (-8000, 0), (-8500, 500)],
        [(0, SIZE * 256), (900, SIZE * 256 + 200), (0, SIZE * 256 + 900)],
        [(130, 130), (200, 130), (130, 200)],
    ],
    ids=["a point", "a line", "left of the picture", "below the picture", "between the samples"],
)
def test_what_covers_no_sample_is_not_drawn(corners):
    assert (drawn(corners, [1, 1, 1], [[0, 1, 2]]).ids == -1).all()


@pytest.mark.parametrize("size", [NARROW, SIZE, WIDE])
@examples(60)
@given(corners=st.tuples(PLACES, PLACES, PLACES), stretched=st.integers(1, 2))
def test_coverage_of_a_triangle_is_exact(size, corners, stretched):
    corners = [(stretched * x, y) for x, y in corners]
    buffer = drawn(corners, [1, 1, 1], [[0, 1, 2]], size=size)
    assert np.array_equal(buffer.ids == 0, inside(corners, size))


@pytest.mark.parametrize(
    "corners",
    [
        [(-90000, 30), (100, 70000), (64000, -500)],
        [(-500, -500), (10, 61000), (60999, 128)],
        [(0, 0), (256 * 4000, 256 * 3999), (256 * 3999, 256 * 4000)],
        [(0, 128), (5, 129), (256 * 4000, 512)],
    ],
    ids=["past all sides", "half of the picture", "a needle across", "a needle level"],
)
def test_coverage_is_exact_where_edge_functions_need_more_than_32_bits(corners):
    buffer = drawn(corners, [1, 1, 1], [[0, 1, 2]], size=250)
    assert np.array_equal(buffer.ids == 0, inside(corners, 250))


@examples(40)
@given(PLACES, st.lists(PLACES, min_size=4, max_size=9, unique=True))
def test_triangles_around_a_point_share_no_sample_and_leave_none_out(middle, ring):
    angle = [np.arctan2(y - middle[1], x - middle[0]) for x, y in ring]
    if len({round(a, 9) for a in angle}) < len(ring) or middle in ring:
        return
    ring = [ring[i] for i in np.argsort(angle)]
    turns = np.diff(np.sort(angle), append=np.sort(angle)[0] + 2 * np.pi)
    if turns.max() >= np.pi:
        return
    fan = [(middle, p, q) for p, q in itertools.pairwise([*ring, ring[0]])]
    times = sum((drawn(t, [1, 1, 1], [[0, 1, 2]]).ids == 0).astype(int) for t in fan)
    outline = np.zeros((SIZE, SIZE), int)
    for p, q in itertools.pairwise([*ring, ring[0]]):
        outline += inside((ring[0], p, q)) * (1 if _turn(ring[0], p, q) > 0 else -1)
    assert np.array_equal(times, outline)


def _turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


@pytest.mark.parametrize("size", [NARROW, SIZE, WIDE])
def test_the_nearer_triangle_shows_in_either_order(size):
    xy = [(0, 0), (0, 6000), (6000, 0)] * 2
    for far, near in (((0, 1, 2), (3, 4, 5)), ((3, 4, 5), (0, 1, 2))):
        key = np.full(6, 0.5)
        key[list(near)] = 0.8
        buffer = drawn(xy, key, [far, near], size=size)
        assert set(np.unique(buffer.ids)) == {-1, 1} if size > 12 else {1}
        assert buffer.depth.max() == pytest.approx(0.8)


def test_crossing_triangles_show_each_on_its_own_side():
    xy = [(0, 0), (0, 6000), (6000, 0)] * 2
    buffer = drawn(xy, [0.2, 0.2, 0.9, 0.5, 0.5, 0.5], [[0, 1, 2], [3, 4, 5]])
    assert buffer.ids[3, 0] == 1
    assert buffer.ids[0, 20] == 0


@pytest.mark.parametrize("size", [NARROW, SIZE, WIDE])
def test_a_triangle_drawn_again_does_not_win_over_itself(size):
    xy = [(10, 20), (500, 5900), (5800, 700)]
    assert set(np.unique(drawn(xy, [0.3, 0.55, 0.71], [[0, 1, 2], [0, 1, 2]], size=size).ids)) == {-1, 0}


def test_depth_alone_is_the_same_without_ids():
    xy, key = [(10, 20), (500, 5900), (5800, 700), (9000, 9000)], np.array([0.3, 0.5, 0.7, 0.9], np.float32)
    triangles, sides = np.array([[0, 1, 2], [1, 2, 3]], np.int32), np.ones(2, np.uint8)
    alone = Visibility(WIDE, WIDE, 2, keep_ids=False)
    alone.draw(np.asarray(xy, np.int32), key, triangles, sides)
    assert np.array_equal(alone.depth, drawn(xy, key, triangles, size=WIDE).depth)
    assert (alone.ids == -1).all()


def test_depth_is_affine_in_the_picture():
    buffer = drawn([(0, 0), (0, 6144), (6144, 0)], [0.25, 0.5, 0.75], [[0, 1, 2]])
    y, x = np.nonzero(buffer.ids == 0)
    expected = 0.25 + 0.25 * (y + 0.5) / 24 + 0.5 * (x + 0.5) / 24
    assert buffer.depth[y, x] == pytest.approx(expected, abs=1e-6)


def test_backs_are_drawn_only_where_asked():
    front, back = [(0, 0), (0, 4000), (4000, 0)], [(0, 0), (4000, 0), (0, 4000)]
    assert (drawn(front, [1, 1, 1], [[0, 1, 2]], two_sided=0).ids == 0).any()
    assert (drawn(back, [1, 1, 1], [[0, 1, 2]], two_sided=0).ids == -1).all()
    assert np.array_equal(
        drawn(back, [1, 1, 1], [[0, 1, 2]]).ids, drawn(front, [1, 1, 1], [[0, 1, 2]], two_sided=0).ids
    )


def test_a_new_drawing_forgets_the_last():
    buffer = drawn([(0, 0), (0, 6000), (6000, 0)], [1, 1, 1], [[0, 1, 2]])
    nothing = np.zeros((3, 2), np.int32)
    buffer.draw(nothing, np.ones(3, np.float32), np.array([[0, 1, 2]], np.int32), np.ones(1, np.uint8))
    assert (buffer.ids == -1).all()
    assert (buffer.depth == 0).all()


@pytest.mark.parametrize("size", [NARROW, SIZE, WIDE])
@examples(60)
@given(corners=st.tuples(PLACES, PLACES, PLACES, PLACES))
def test_a_segment_of_a_hair_shows_its_two_triangles(corners, size):
    """A convex segment is drawn at once: each sample shows the triangle that covers it."""
    segment = [[0, 1, 2], [1, 3, 2]]
    ids = drawn(corners, [1] * 4, segment, size=size).ids
    first, second = (inside([corners[k] for k in triangle], size) for triangle in segment)
    assert np.array_equal(ids >= 0, first | second)
    assert (ids[first & ~second] == 0).all()
    assert (ids[second & ~first] == 1).all()
