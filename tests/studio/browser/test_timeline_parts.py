"""The timeline's parts by themselves, in the browser that runs them."""

from __future__ import annotations

import pytest

from .driving import Page


@pytest.fixture
def page(any_page: Page) -> Page:
    return any_page


# A take of any length, as the wire has it: blocks twice a second in three layers, a curve, words and phones.
LONG_TAKE = """
  const rate = 30, frames = seconds * rate + 1;
  const curve = Float32Array.from({ length: frames }, (_, k) => Math.abs(Math.sin(k / 9)));
  const each = (step, make) =>
    Array.from({ length: Math.floor(seconds / step) }, (_, k) => make(k * step, k));
  const blocks = each(0.5, (start, k) => ({
    id: `b${k}`, channel: ["signals", "head", "emotion"][k % 3], layer: `l${k % 2}`, label: "block", start,
    apex_start: start + 0.1, apex_end: start + 0.5, end: start + 0.9, targets: { masseter: 0.5 },
    priority: 40,
    function: "exponential", cause: "", rule: "", editable: true, edited: false }));
  const words = each(0.4, (start) => ({ text: "word", start, end: start + 0.4, first: 0, last: 0 }));
  const phones = each(0.1, (start) => ({ symbol: "AA", start, end: start + 0.1, stress: 1, word: 0 }));
  const tones = each(0.8, (time) => ({ time, label: "H*", word: 0, accent: true, nuclear: false }));
  const peaks = Int8Array.from({ length: 2 * Math.floor(seconds / 0.004) }, (_, k) => (k % 2 ? 90 : -90));
  const waves = [{ seconds_per_bucket: 0.004, peaks }];
  const speech = { text: "", language: "en", sound: "", words, phones, tones, pauses: [], waves };
  const take = { take: 1, duration: seconds, fps: "30", rate, frames, speech, blocks, drawn: [], markers: [],
    lanes: { muted: [], solo: [], locked: [] },
    curves: { masseter: curve }, made: {} };
"""

MOUNT = """
  const [{ mountTimeline }, { Store }, { Clock }] = await Promise.all(
    ["timeline/index.js", "studio/store.js", "player/clock.js"].map((name) => import(`/web/${name}`)));
  const catalogue = await (await fetch("/api/catalogue")).json();
  const element = document.createElement("div");
  Object.assign(element.style, { position: "fixed", inset: "0", height: "600px", zIndex: "9" });
  document.body.append(element);
  const nowhere = { time: null, parameter: null, movement: null };
  const store = new Store({ catalogue, take: null, selection: nowhere });
  const actions = { ask: async () => null, select: (selection) => store.set({ selection }) };
  const timeline = mountTimeline(element, { store, clock: new Clock(), actions,
    explanation: document.createElement("div") });
"""


def drawn(page: Page, seconds: int, view: str) -> dict[str, int]:
    """Return how much is drawn of a take of so many seconds, seen as `view` has it."""
    found: dict[str, int] = page.run(f"""
      const seconds = {seconds};
      {LONG_TAKE} {MOUNT}
      store.set({{ take }});
      const {{ scene, controller }} = timeline;
      await new Promise(requestAnimationFrame);
      {view};
      scene.paint();
      element.remove();
      return scene.count;
    """)
    return found


def test_what_is_drawn_does_not_grow_with_the_length(page: Page) -> None:
    near = "scene.view.zoom(100 / scene.view.scale, 0)"
    assert drawn(page, 300, near) == drawn(page, 30, near)


@pytest.mark.parametrize("seconds", [300, 1200])
def test_a_long_take_seen_whole_is_drawn_by_the_pixel(page: Page, seconds: int) -> None:
    width = int(page.run("return innerWidth"))
    count = drawn(page, seconds, "controller.fit()")
    assert 0 < count["columns"] <= width
    assert count["points"] <= 2 * (width + 1)
    assert count["blocks"] <= 8 * width


def test_a_take_in_which_nothing_is_said_is_drawn(page: Page) -> None:
    view = "store.set({ take: { ...take, take: 2, speech: null } }); await new Promise(requestAnimationFrame)"
    count = drawn(page, 5, view)
    assert count["blocks"] == 10
    assert (count["columns"], count["texts"]) == (0, 10)


def test_a_take_without_any_movement_is_drawn(page: Page) -> None:
    rest = "{ ...take, take: 2, speech: null, blocks: [], curves: {}, duration: 0.2, frames: 7 }"
    count = drawn(page, 5, f"store.set({{ take: {rest} }}); await new Promise(requestAnimationFrame)")
    assert (count["blocks"], count["points"]) == (0, 0)


def test_names_stay_beside_their_lanes_when_the_page_s_text_grows(page: Page) -> None:
    tops, rows = page.run(f"""
      const seconds = 5;
      {LONG_TAKE} {MOUNT}
      store.set({{ take }});
      const settle = async () => {{
        for (let k = 0; k < 4; k++) await new Promise(requestAnimationFrame);
      }};
      await settle();
      document.documentElement.style.fontSize = "24px";
      element.style.height = "500px";
      await settle();
      const {{ body, unit }} = timeline.scene;
      const tops = [...element.querySelectorAll(".tl-name")].map((name) => parseFloat(name.style.top));
      document.documentElement.style.fontSize = "";
      element.remove();
      return [tops, body.map(({{ y }}) => y * unit)];
    """)
    assert len(rows) > 2
    assert tops == pytest.approx(rows, abs=0.01)
