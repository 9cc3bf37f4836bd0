"""What the stage is made of, by itself, in the browser that runs it."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.face.solve import FaceSolver
from risorius.render.aperture import lip_edges
from risorius.render.materials.mouth import LIP_STEPS
from risorius.rules.poses import pose_values
from risorius.studio.solvers import stage_of

from .driving import Page


@pytest.fixture
def page(any_page: Page) -> Page:
    return any_page


# A square of 20 by 20 mm with a vertex each millimetre.
GRID = """
  const points = [], triangles = [];
  for (let y = 0; y <= 20; y++) for (let x = 0; x <= 20; x++) points.push(x, y, 0);
  for (let y = 0; y < 20; y++) for (let x = 0; x < 20; x++) {
    const k = 21 * y + x;
    triangles.push(k, k + 1, k + 22, k, k + 22, k + 21);
  }
  const { coarser } = await import("/web/stage/coarse.js");
  const { order, index } = coarser(points, Uint32Array.from(triangles), () => reach);
  const at = (k) => points.slice(3 * order[k], 3 * order[k] + 3);
"""
AREA = """
  let area = 0;
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [at(index[k]), at(index[k + 1]), at(index[k + 2])];
    area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
"""


def test_a_coarser_mesh_covers_what_the_fine_one_does(page: Page) -> None:
    area, triangles = page.run(f"const reach = 3; {GRID} {AREA} return [area, index.length / 3]")
    assert area == pytest.approx(400.0)
    assert triangles < 300


def test_a_mesh_whose_vertices_gather_none_is_the_same(page: Page) -> None:
    area, triangles = page.run(f"const reach = 0; {GRID} {AREA} return [area, index.length / 3]")
    assert (area, triangles) == (pytest.approx(400.0), 800)


def test_the_border_of_a_coarser_mesh_stays(page: Page) -> None:
    border = page.run(f"""
      const reach = 5; {GRID}
      return order.map((_, k) => at(k)).filter(([x, y]) => x % 20 === 0 || y % 20 === 0).length
    """)
    assert border == 80


@pytest.mark.parametrize(
    ("length", "bends"), [(20, [0, 1, 8, 9, 14, 15]), (200, [0, 1, 2, 3, 4, 5, 6, 7, 10, 11, 14, 15])]
)
def test_fewer_strands_keep_root_and_tip_and_long_ones_most_of_their_bends(
    page: Page, length: float, bends: list[int]
) -> None:
    order, triangles = page.run(
        """
        const { fewer } = await import("/web/stage/strands.js");
        const [strands, pairs] = [100, 8];
        const index = [], points = [];
        for (let s = 0; s < strands; s++) for (let p = 0; p < pairs; p++) {
          const [k, along] = [2 * (s * pairs + p), (arguments[0] * p) / (pairs - 1)];
          points.push(0, along, s, 1, along, s);
          if (p < pairs - 1) index.push(k, k + 1, k + 2, k + 1, k + 3, k + 2);
        }
        const found = fewer(Uint32Array.from(index), 0.25, points);
        return [found.order, found.index.length / 3];
        """,
        length,
    )
    each = len(bends)
    strands = len(order) / each
    assert strands == pytest.approx(25, abs=2)
    assert triangles == (each - 2) * strands
    for k in range(0, len(order), each):
        assert [v % 16 for v in order[k : k + each]] == bends


def test_the_slit_of_the_lips_is_that_of_the_library(page: Page) -> None:
    stage = stage_of("standard")
    face = FaceSolver(stage.head).solve(pose_values({"AU12": 0.5, "AU25": 1.0, "AU26": 0.6}, {}))
    pairs = face.skin[stage.head.lip_pairs].astype(np.float64)
    found = page.run(
        """
        const THREE = await import("/web/vendor/three/three.module.min.js");
        const { findSlit } = await import("/web/stage/lips.js");
        const [points, steps] = arguments;
        const pairs = Array.from({ length: points.length / 6 }, (_, k) => [2 * k, 2 * k + 1]);
        const [span, edges] = [new THREE.Vector2(), Array.from({ length: steps }, () => new THREE.Vector4())];
        findSlit(pairs, points, span, edges);
        return [span.toArray(), edges.map((edge) => edge.toArray())];
        """,
        pairs.ravel().tolist(),
        LIP_STEPS,
    )
    for own, expected in zip(found, lip_edges(pairs), strict=True):
        np.testing.assert_allclose(own, expected, atol=1e-9)


SCRUBBED = """
  const { Player } = await import("/web/studio/player.js");
  const { KINDS } = await import("/web/stage/faces.js");
  const asked = [], shown = [], answers = [];
  const connection = { up: true, on() {}, request: (verb, { first, time }) => {
    asked.push([verb, first ?? (time === undefined ? null : Math.round(30 * time))]);
    return new Promise((go) => answers.push(go));
  } };
  const clock = { time: 0, playing: false, on() {} };
  const player = new Player(connection, clock, (a) => shown.push(a.name));
  player.load({ take: 1, frames: 9000, rate: 30 });
  const seek = (time) => { clock.time = time; player.update(); };
  const send = (first, kind = KINDS.take) =>
    player.receive({ kind, take: 1, first, faces: [{ name: first }] });
  const wait = (ms) => new Promise((go) => setTimeout(go, ms));
"""


def test_who_scrubs_sees_one_face_after_another_and_all_where_the_hand_rests(page: Page) -> None:
    asked, shown = page.run(f"""
      {SCRUBBED}
      [100, 150, 200].forEach(seek);
      send(3000, KINDS.moment);
      answers[2]();
      await wait(0);
      send(6000, KINDS.moment);
      answers[3]();
      send(0); // of the stretch that the take begins with: it is not where the playhead is
      await wait(700);
      send(6000);
      return [asked, shown];
    """)
    stretches = [["faces", 0], ["faces", 6000]]
    assert asked == [stretches[0], ["cancel", None], ["face_at", 3000], ["face_at", 6000], stretches[1]]
    assert shown == [3000, 6000, 6000]


def test_while_a_change_is_tried_its_face_is_seen_and_then_the_takes_own(page: Page) -> None:
    shown = page.run(f"""
      {SCRUBBED}
      send(0);
      player.previewing = true;
      send(0, KINDS.moment);
      send(1);
      player.update();
      const tried = shown.length;
      player.previewing = false;
      return [shown.slice(0, tried), shown.slice(tried)];
    """)
    assert shown == [[0, 0], [0]]


def test_triangles_swept_are_the_same_and_come_by_few_vertices_twice(page: Page) -> None:
    # A grid of 60 by 60 squares whose triangles come in no order.
    before, after, same = page.run("""
      const { swept } = await import("/web/stage/sweep.js");
      const triangles = [];
      for (let y = 0; y < 60; y++) for (let x = 0; x < 60; x++) {
        const k = 61 * y + x;
        triangles.push([k, k + 1, k + 62], [k, k + 62, k + 61]);
      }
      const mixed = triangles.map((_, k) => triangles[(k * 1009) % triangles.length]);
      const given = Uint32Array.from(mixed.flat());
      const { order, index } = swept(given);
      const missed = (list) => {
        const held = new Map();
        let count = 0;
        for (const vertex of list) {
          if (held.get(vertex & 63) !== vertex) count += 1;
          held.set(vertex & 63, vertex);
        }
        return count / (list.length / 3);
      };
      const triples = (list) => list.flatMap((_, k) => (k % 3 ? [] : [list.slice(k, k + 3)]));
      const back = [...index].map((vertex) => order[vertex]);
      const turned = ([a, b, c]) => [[a, b, c], [b, c, a], [c, a, b]].map(String).sort()[0];
      const sorted = (list) => triples(list).map(turned).sort().join(" ");
      return [missed(given), missed(index), sorted(back) === sorted([...given])];
    """)
    assert same
    assert before > 2.0
    assert after < 0.8


def test_strands_farthest_from_who_looks_come_first_and_stay_whole(page: Page) -> None:
    found = page.run("""
      const THREE = await import("/web/vendor/three/three.module.min.js");
      const { Order } = await import("/web/stage/strands.js");
      // Four strands of two pairs, at depths 3, 1, 4 and 2.
      const points = [3, 1, 4, 2].flatMap((z) => [0, 0, z, 1, 0, z, 0, 1, z, 1, 1, z]);
      const index = [0, 1, 2, 3].flatMap((s) => [0, 1, 2, 1, 3, 2].map((k) => 4 * s + k));
      const triangles = new THREE.BufferAttribute(Uint32Array.from(index), 1);
      const geometry = new THREE.BufferGeometry().setIndex(triangles);
      geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(points), 3));
      const order = new Order(geometry);
      const seen = (z) => {
        order.sort(new THREE.Vector3(0, 0, z));
        return [...geometry.index.array];
      };
      return [seen(-1), seen(1)];
    """)
    strands = [[v // 4 for v in index[::6]] for index in found]
    assert strands == [[1, 3, 0, 2], [2, 0, 3, 1]]
    for index in found:
        for k in range(0, 24, 6):
            assert [v % 4 for v in index[k : k + 6]] == [0, 1, 2, 1, 3, 2]


def test_strands_are_left_out_where_the_head_or_other_hair_hides_them(page: Page) -> None:
    """From the front those behind a board or a curtain of hair, but none beside them; from the side none."""
    shown = page.run("""
      const THREE = await import("/web/vendor/three/three.module.min.js");
      const { Cover } = await import("/web/stage/cover.js");
      const { Order } = await import("/web/stage/strands.js");
      const row = (from, z, y) => Array.from({ length: 30 }, (_, k) => [from + 4 * k, y, z]).flat();
      const wall = (from, z) => Array.from({ length: 30 }, (_, k) => row(from, z, 4 * k)).flat();
      const cover = new Cover(wall(-130, 0), wall(10, 0));
      // Before and behind the board, behind the curtain, and beside it.
      const places = [[-70, 9], [-70, -9], [-120, -9], [70, -9], [70, -29], [160, -29]];
      const points = places.flatMap(([x, z]) => [40, 60].flatMap((y) => [x, y, z, x + 1, y, z]));
      const index = places.flatMap((_, s) => [0, 1, 2, 1, 3, 2].map((v) => 4 * s + v));
      const geometry = new THREE.BufferGeometry();
      geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(index), 1));
      geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(points), 3));
      const order = new Order(geometry, cover);
      return [[0, 0, -1], [1, 0, 0]].map((sight) => {
        order.sort(new THREE.Vector3(...sight));
        const { array } = geometry.index;
        return places.map((_, s) => array.includes(4 * s + 3));
      });
    """)
    assert shown == [[True, False, True, True, False, True], [True] * 6]


def test_strands_know_where_they_run_and_their_breadth(page: Page) -> None:
    """By both they turn their breadth to who looks: seen from the side, hair was full of holes."""
    along, breadth, points = page.run("""
      const THREE = await import("/web/vendor/three/three.module.min.js");
      const { asStrands } = await import("/web/stage/strands.js");
      // Two strands of three pairs, 2 wide: one runs up, then to the left, the other to the front.
      const one = [-1, 0, 0, 1, 0, 0, -1, 5, 0, 1, 5, 0, -4, 5, 0, -2, 5, 0];
      const other = [0, 1, 2].flatMap((k) => [-1, 9, 3 * k, 1, 9, 3 * k]);
      const index = [0, 2, 6, 8].flatMap((from) => [0, 1, 2, 1, 3, 2].map((v) => from + v));
      const triangles = new THREE.BufferAttribute(Uint32Array.from(index), 1);
      const points = new THREE.BufferAttribute(Float32Array.from([...one, ...other]), 3);
      const geometry = new THREE.BufferGeometry().setIndex(triangles);
      geometry.setAttribute("position", points);
      asStrands(new THREE.Mesh(geometry));
      return ["along", "breadth", "position"].map((name) => [...geometry.attributes[name].array]);
    """)
    up, left, front = [0, 1, 0], [-1, 0, 0], [0, 0, 1]
    assert along == [*up * 2, *left * 4, *front * 6]
    # The first of both is never left out, the other where the thinnest hairs are wider than 1 / .618 of it.
    first, other = ([1, least] for least in (1e6, 1 / 0.6180339887))
    assert np.reshape(breadth, (12, 2)) == pytest.approx(np.array([first] * 6 + [other] * 6))
    assert points[:18] == [*[0, 0, 0] * 2, *[0, 5, 0] * 2, *[-3, 5, 0] * 2]


def test_the_skin_in_motion_has_its_vertices_where_lashes_darken_it(page: Page) -> None:
    """With fewer, their shade was drawn as dark spikes on the lids."""
    found = page.run("""
      const THREE = await import("/web/vendor/three/three.module.min.js");
      const { lighterOf } = await import("/web/stage/detail.js");
      const geometry = new THREE.PlaneGeometry(20, 20, 20, 20);
      const index = new THREE.BufferAttribute(Uint32Array.from(geometry.index.array), 1);
      const skin = new THREE.Mesh(geometry.setIndex(index), new THREE.MeshBasicMaterial());
      const spots = { eyes: [[0, 0, -15]], edges: [[0, 0, 0]], mouth: [0, -80, 0] };
      return [...lighterOf("skin", skin, spots).mesh.geometry.attributes.position.array];
    """)
    near = [np.hypot(x, y) < 2.5 for x, y in np.reshape(found, (-1, 3))[:, :2]]
    assert sum(near) == 21
    assert len(near) < 300


def test_a_head_that_is_held_does_not_come_to_rest(page: Page) -> None:
    found = page.run("""
      const { Sharpness } = await import("/web/stage/sharpness.js");
      let rested = 0;
      const waiting = [];
      const { setTimeout, clearTimeout } = window;
      window.setTimeout = (call) => waiting.push(call);
      window.clearTimeout = (number) => delete waiting[number - 1];
      try {
        const sharpness = new Sharpness(true, () => (rested += 1));
        const press = (name) => document.dispatchEvent(new PointerEvent(name));
        const later = () => waiting.forEach((call, number) => { delete waiting[number]; call(); });
        sharpness.moves();
        press("pointerdown");
        sharpness.moves();
        later();
        const held = rested;
        press("pointerup");
        later();
        return [held, rested];
      } finally {
        Object.assign(window, { setTimeout, clearTimeout });
      }
    """)
    assert found == [0, 1]


def test_who_waits_for_pictures_gets_coarser_ones_until_it_plays(page: Page) -> None:
    found = page.run("""
      const { Sharpness } = await import("/web/stage/sharpness.js");
      const sharpness = new Sharpness(true, () => {});
      const ratios = [sharpness.ratio];
      for (let k = 0; k < 2; k++) sharpness.kept();
      ratios.push(sharpness.ratio);
      sharpness.playing = true;
      ratios.push(sharpness.ratio);
      return ratios;
    """)
    assert found[1] < found[0] == found[2]


STILL = "!document.querySelector('#stage .still').hidden"


def test_at_rest_the_head_is_shown_as_finely_as_can_be_and_in_motion_it_gives_way(page: Page) -> None:
    page.make_stills(True)
    page.wait(STILL)
    size, coarse, colours, same = page.run("""
      const [head, still] = document.querySelectorAll("#stage canvas");
      const { stage, figures } = studio.headPlayers;
      const shown = still.getContext("2d").getImageData(0, 0, still.width, still.height).data;
      const own = new OffscreenCanvas(head.width, head.height).getContext("2d");
      stage.invalidate();
      own.drawImage(head, 0, 0);
      const hidden = still.hidden;
      const moved = own.getImageData(0, 0, head.width, head.height).data;
      const at = (x, y) => {
        const colour = (data, { width, height }) => {
          const k = 4 * (Math.floor(y * height) * width + Math.floor(x * width));
          return [...data.subarray(k, k + 3)];
        };
        return [colour(shown, still), colour(moved, head)];
      };
      return [[still.width / head.clientWidth, still.height / head.clientHeight], hidden,
        [at(0.05, 0.1), at(0.05, 0.9), at(0.5, 0.4)], head.width < still.width];
    """)
    assert size == [2, 2]
    assert coarse
    assert same
    # Ground and forehead are of the same colours in both.
    for fine, rough in colours:
        assert max(abs(a - b) for a, b in zip(fine, rough, strict=True)) <= 6
    page.wait(STILL)


def test_a_fine_picture_is_given_up_when_something_moves(page: Page) -> None:
    page.make_stills(True)
    page.wait(STILL)
    shown = page.run("""
      const { stage } = studio.headPlayers;
      const still = document.querySelector("#stage .still");
      stage.invalidate();
      let seen = 0;
      for (let k = 0; k < 40; k++) {
        await new Promise((go) => setTimeout(go, 50));
        stage.stir();
        seen += still.hidden ? 0 : 1;
      }
      return seen;
    """)
    assert shown == 0
