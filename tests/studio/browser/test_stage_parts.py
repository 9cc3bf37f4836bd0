"""What the stage is made of, by itself, in the browser that runs it."""

from __future__ import annotations

import pytest

from .driving import Page


@pytest.fixture(scope="module")
def page(browser_page: Page) -> Page:
    """A page that no test changes."""
    browser_page.open("stage-parts")
    return browser_page


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


def test_fewer_strands_are_straighter_and_keep_root_and_tip(page: Page) -> None:
    order, triangles = page.run("""
      const { fewer } = await import("/web/stage/strands.js");
      const [strands, pairs] = [100, 6];
      const index = [];
      for (let s = 0; s < strands; s++) for (let p = 0; p < pairs - 1; p++) {
        const k = 2 * (s * pairs + p);
        index.push(k, k + 1, k + 2, k + 1, k + 3, k + 2);
      }
      const found = fewer(Uint32Array.from(index), 0.25);
      return [found.order, found.index.length / 3];
    """)
    strands = len(order) / 6
    assert strands == pytest.approx(25, abs=2)
    assert triangles == 4 * strands
    for k in range(0, len(order), 6):
        assert [v % 12 for v in order[k : k + 6]] == [0, 1, 6, 7, 10, 11]


@pytest.mark.parametrize(("gap", "light"), [(0.0, 0.0), (0.7, 0.0), (2.4, 0.5), (4.0, 1.0), (20.0, 1.0)])
def test_light_comes_between_lips_as_far_as_they_part(page: Page, gap: float, light: float) -> None:
    found = page.run(
        """
        const { slitsOf, lightBetween } = await import("/web/stage/lips.js");
        // Two pairs stand over one another in the middle: the nearer bounds the light.
        const points = [0, 1, 0, 0, 1, 0, 0, 5, 0, 0, -9, 0, 20, 1, 0, 20, 1, 0];
        const slits = slitsOf([[0, 1], [2, 3], [4, 5]], points);
        points[1] += arguments[0];
        return lightBetween(slits, points);
        """,
        gap,
    )
    assert found == pytest.approx(light, abs=1e-6)


SCRUBBED = """
  const { Player } = await import("/web/player.js");
  const { KINDS } = await import("/web/stage/faces.js");
  const asked = [], shown = [];
  const connection = { up: true, on() {}, request: (verb, fields) => {
    asked.push(fields.first);
    return new Promise(() => {});
  } };
  const clock = { time: 0, playing: false, on() {} };
  const player = new Player(connection, clock, (a) => shown.push(a.name));
  player.load({ take: 1, frames: 9000, rate: 30 });
  const seek = (time) => { clock.time = time; player.update(); };
  const send = (first) => player.receive({ kind: KINDS.take, take: 1, first, faces: [{ name: first }] });
"""


def test_while_faces_do_not_come_no_other_place_is_asked_for(page: Page) -> None:
    asked, shown = page.run(f"""
      {SCRUBBED}
      [100, 150, 200].forEach(seek);
      send(0);
      return [asked, shown];
    """)
    assert asked == [0, 6000]
    assert shown == [0]
