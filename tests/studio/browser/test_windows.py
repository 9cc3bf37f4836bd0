"""Windows of all sizes, and the states of what is pressed: what a page may not do to people."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .driving import SIZE, Page
from .test_page import resize

SEEN = """['#script', '#perform', '#play', '#head', '#timeline canvas', '#explanation'].filter((name) => {
  const { left, right, width, height } = document.querySelector(name).getBoundingClientRect();
  return width < 20 || height < 15 || left < 0 || right > innerWidth + 1;
})"""

DRAWN = """(await (async ({ stage }, drawn) => {
  await new Promise((go) => setTimeout(go, 100));
  return drawn === stage.drawn;
})(studio.headPlayers, studio.headPlayers.stage.drawn))"""
"""Whether the stage has come to rest."""


@pytest.fixture
def sized(performed: Page) -> Iterator[Page]:
    performed.wait("studio.headPlayers.figures[0] !== null")
    yield performed
    resize(performed, *SIZE)


# A telephone, a tablet, a small notebook, and the usual one at 200 %.
@pytest.mark.parametrize(
    "size",
    [
        (390, 844),
        *(pytest.param(size, marks=pytest.mark.full) for size in ((768, 1024), (1024, 600), (640, 360))),
    ],
)
def test_all_parts_can_be_reached_in_a_small_window(sized: Page, size: tuple[int, int]) -> None:
    resize(sized, *size)
    sized.wait(f"innerWidth === {size[0]} && {DRAWN}")
    sized.picture(f"window-{size[0]}")
    assert sized.get(SEEN) == []
    assert sized.get("document.documentElement.scrollWidth") <= size[0]
    assert sized.get("document.getElementById('head').getBoundingClientRect().height") > 150


def test_several_lanes_are_seen_in_a_usual_window(sized: Page) -> None:
    resize(sized, 1280, 720)
    sized.wait(f"innerHeight === 720 && {DRAWN}")
    timeline = "document.getElementById('timeline').timeline"
    lanes = sized.get(f"{timeline}.scene.height - {timeline}.scene.headHeight")
    assert lanes >= 160  # pixels: six lanes of the least height
    assert sized.get("document.getElementById('head').clientHeight") >= 300


def test_a_backdrop_has_no_stripes_at_any_scale(performed: Page) -> None:
    left_out = performed.run("""
      const { Backdrop } = await import("/web/stage/backdrop.js");
      const backdrop = new Backdrop(document.getElementById("head"));
      const found = [];
      for (const ratio of [0.31, 0.5, 0.77, 1, 1.25, 2]) for (const height of [90, 211, 266, 700]) {
        const rows = new Uint8Array(Math.floor(height * ratio));
        const renderer = { getPixelRatio: () => ratio, setClearColor() {}, clear() {} };
        backdrop.paint(renderer, 0, 100, height, (x, y, width, high) => {
          const from = Math.round(y * ratio);
          rows.fill(1, from, from + Math.round(high * ratio));
          if (y + high > height) found.push(["too high", ratio, height]);
        });
        if (rows.includes(0)) found.push([ratio, height]);
      }
      return found;
    """)
    assert left_out == []


def test_the_splitter_says_its_height_before_it_is_moved(performed: Page) -> None:
    performed.run("localStorage.removeItem('risorius-timeline')")
    now = performed.run("""
      const { mountSplitter } = await import("/web/studio/splitter.js");
      const bar = document.createElement("div");
      mountSplitter(bar);
      return ["valuemin", "valuenow", "valuemax"].map((name) => Number(bar.getAttribute(`aria-${name}`)));
    """)
    assert 0 < now[0] <= now[1] <= now[2]


def test_the_scrubber_stays_where_it_is(performed: Page) -> None:
    left = "document.querySelector('.scrubber').getBoundingClientRect().left"
    places = []
    for time in (0, 0.5, 3.1):
        performed.run("studio.clock.seek(arguments[0])", time)
        places.append(performed.get(left))
    assert max(places) - min(places) < 0.1  # rounding of widths


def test_the_camera_that_is_chosen_is_pressed(performed: Page) -> None:
    pressed = "[...document.querySelectorAll('#views [aria-pressed=true]')].map((it) => it.textContent)"
    assert performed.get(pressed) == ["Front"]
    performed.run("studio.view.choose('side')")
    assert performed.get(pressed) == ["Side"]
    performed.run("studio.view.orbit(5, 0)")
    assert performed.get(pressed) == []


def test_a_movement_that_was_moved_is_explained_where_it_is(performed: Page) -> None:
    time, start, end = performed.run("""
      const { actions, store } = studio;
      const timeline = document.getElementById("timeline").timeline;
      const block = store.get("take").blocks.find(({ channel }) => channel === "signals");
      timeline.controller.choose(block);
      await actions.edit("move", { movement: block.id, start: block.start + 1 });
      const now = store.get("take").blocks.find(({ id }) => id === block.id);
      return [store.get("selection").time, now.start, now.end];
    """)
    assert start < time < end


def test_a_label_says_what_moves_where_there_is_no_room_for_more(performed: Page) -> None:
    labels = performed.run("""
      const { labelWithin } = await import("/web/timeline/paint/paint_lanes.js");
      const context = { measureText: (text) => ({ width: 6 * text.length }) };
      const block = { layer: "brows", label: '"Oh really"' };
      return [200, 40, 20].map((room) => labelWithin(context, block, room));
    """)
    assert labels == ['brows "Oh really"', "brows", "br…"]
