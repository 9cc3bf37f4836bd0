"""The timeline's parts by themselves, in the browser that runs them."""

from __future__ import annotations

from typing import Any

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


EDGES = "new Float64Array([0, 0.5, 1.0, 1.5, 2.0])"


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        ("moved([1, 1.2, 1.5, 2], 0.5, 3)", [1.5, 1.7, 2.0, 2.5]),
        ("moved([1, 1.2, 1.5, 2], -9, 3)", [0, 0.2, 0.5, 1.0]),
        ("moved([1, 1.2, 1.5, 2], 9, 3)", [2.0, 2.2, 2.5, 3.0]),
        ("pulled([1, 1.2, 1.5, 2], 0, 0.5, 3)", [0.5, 0.7, 1.5, 2]),
        ("pulled([1, 1.2, 1.5, 2], 3, 2.5, 3)", [1, 1.2, 2.0, 2.5]),
        ("pulled([1, 1.2, 1.5, 2], 1, 1.8, 3)", [1, 1.5, 1.5, 2]),
        ("pulled([1, 1.2, 1.5, 2], 2, 1.0, 3)", [1, 1.2, 1.2, 2]),
        ("pulled([1, 1.2, 1.5, 2], 3, 1.35, 3)", [1, 1.1, 1.1, 1.35]),
        (f"snappedBy({EDGES}, [0.9, 1, 1.1, 1.48], 0.05)", 0.02),
        (f"snappedBy({EDGES}, [0.7, 1, 1.1, 1.3], 0.05)", 0),
        ("editOf([1, 1.2, 1.5, 2], [1.5, 1.7, 2, 2.5])", {"kind": "move", "fields": {"start": 1.5}}),
        ("editOf([1, 1.2, 1.5, 2], [1, 1.2, 2, 2.5])", {"kind": "stretch", "fields": {"end": 2.5}}),
        ("editOf([1, 1.2, 1.5, 2], [1, 1.4, 1.5, 2])", {"kind": "stretch", "fields": {"onset": 0.4}}),
        ("editOf([1, 1.2, 1.5, 2], [1, 1.2, 1.5, 2])", None),
    ],
)
def test_times_of_a_block(page: Page, asked: str, expected: Any) -> None:
    names = "{ moved, pulled, snappedBy, editOf }"
    found = page.run(f"const {names} = await import('/web/timeline/model/times.js'); return {asked}")
    assert _near(found, expected), found


def _near(found: Any, expected: Any) -> bool:
    if isinstance(expected, dict):
        return found["kind"] == expected["kind"] and found["fields"] == pytest.approx(expected["fields"])
    return bool(found == expected if expected is None else found == pytest.approx(expected))


def test_stacked_spans_do_not_hide_each_other(page: Page) -> None:
    clashes = page.run("""
      const { stacked } = await import("/web/timeline/model/spans.js");
      let seed = 7;
      const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
      const items = Array.from({ length: 400 }, (_, k) => {
        const start = 60 * random();
        return { start, end: start + 3 * random(), layer: `l${k % 7}` };
      });
      const { rows } = stacked(items);
      return items.flatMap((a, i) => items.slice(i + 1).filter((b) =>
        rows.get(a) === rows.get(b) && a.start < b.end - 1e-6 && b.start < a.end - 1e-6)).length;
    """)
    assert clashes == 0


def test_spans_in_sight_are_those_that_touch_it(page: Page) -> None:
    agreed = page.run("""
      const { Spans } = await import("/web/timeline/model/spans.js");
      let seed = 3;
      const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
      const items = Array.from({ length: 300 }, () => {
        const start = 50 * random();
        return { start, end: start + (random() < 0.1 ? 30 : 1) * random() };
      });
      const spans = new Spans(items);
      return Array.from({ length: 60 }, (_, k) => {
        const found = [...spans.within(k, k + 1)];
        const wanted = items.filter(({ start, end }) => start <= k + 1 && end >= k);
        return found.length === wanted.length && wanted.every((item) => found.includes(item));
      }).every(Boolean);
    """)
    assert agreed


def test_a_pyramid_finds_the_extremes_of_any_stretch(page: Page) -> None:
    worst = page.run("""
      const { Pyramid } = await import("/web/timeline/model/pyramid.js");
      const values = Float32Array.from({ length: 5000 }, (_, k) => Math.sin(k * k));
      const pyramid = new Pyramid(values);
      let worst = 0;
      for (const [first, last] of [[0, 5000], [17, 18], [100, 900], [4000, 4999], [4999, 5000]]) {
        const [low, high] = pyramid.range(first, last);
        const part = values.slice(first, last);
        worst = Math.max(worst, low - Math.min(...part), Math.max(...part) - high);
      }
      return worst;
    """)
    assert worst <= 0


def test_a_line_is_simplified_within_its_tolerance(page: Page) -> None:
    kept, far = page.run("""
      const { simplified } = await import("/web/timeline/model/keys.js");
      const line = Array.from({ length: 400 }, (_, k) => [k / 100, Math.sin(k / 40)]);
      const kept = simplified(line, 0.01);
      const far = Math.max(...line.map(([time, value]) => {
        const k = kept.findIndex(([t]) => t >= time);
        const [[t0, v0], [t1, v1]] = [kept[Math.max(k - 1, 0)], kept[Math.max(k, 1)]];
        return Math.abs(value - (v0 + ((v1 - v0) * (time - t0)) / (t1 - t0)));
      }));
      return [kept.length, far];
    """)
    assert kept < 60
    assert far <= 0.01 + 1e-9


def test_a_first_key_is_tied_to_the_curve_around_it(page: Page) -> None:
    keys = page.run("""
      const { withKey } = await import("/web/timeline/model/keys.js");
      return withKey([], 1, 0.9, { duration: 3, valueAt: (time) => time / 10 });
    """)
    assert keys == [pytest.approx([0.85, 0.085]), [1, 0.9], pytest.approx([1.15, 0.115])]


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
