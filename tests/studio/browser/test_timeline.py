"""The timeline with the real server: blocks and curves changed by mouse and by keys, and explained."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from selenium.webdriver.common.keys import Keys

from .acts import MOVED, remember_face
from .driving import Page
from .timeline import BROWS, FRAME, JUMP, TIMELINE, Timeline


@pytest.fixture(scope="module")
def performed(browser_page: Page) -> Timeline:
    browser_page.open("timeline")
    return Timeline(browser_page)


@pytest.fixture
def timeline(performed: Timeline) -> Iterator[Timeline]:
    """The timeline as it was after performing: what a test changes is taken back."""
    performed.page.complaints()
    yield performed
    assert performed.page.complaints() == []
    performed.restore()


def moved(block: dict[str, Any], delta: float) -> Any:
    return pytest.approx(block["start"] + delta, abs=0.02)


def test_a_take_is_drawn_and_listed(timeline: Timeline) -> None:
    page = timeline.page
    count = page.get("timeline.scene.count")
    assert min(count["blocks"], count["columns"], count["texts"]) > 20
    names = page.get("[...document.querySelectorAll('.tl-lane-name')].map((name) => name.textContent)")
    assert {"lips", "signals", "punctuators"} <= set(names)
    option = "document.querySelector('.tl-blocks [tabindex=\"0\"]')"
    assert page.get(f"{option}.getAttribute('aria-setsize')") == str(
        page.get("timeline.scene.model.take.blocks.length")
    )
    page.picture("timeline-light")
    page.run("document.documentElement.dataset.theme = 'dark'")
    timeline.settle()
    page.picture("timeline-dark")


def test_a_block_is_dragged_and_the_change_taken_back_and_made_again(timeline: Timeline) -> None:
    before, take = timeline.block(), timeline.take
    middle = (before["apex_start"] + before["apex_end"]) / 2
    timeline.drag(timeline.place(before, middle), timeline.pixels(JUMP))
    timeline.changed(take)
    there = timeline.block()
    assert there["start"] > before["start"] + JUMP / 2
    assert there["end"] - there["start"] == pytest.approx(before["end"] - before["start"])
    assert there["edited"]
    take = timeline.take
    timeline.press("z", held=Keys.CONTROL)
    timeline.changed(take)
    assert timeline.block()["start"] == before["start"]
    take = timeline.take
    timeline.press("z", held=Keys.CONTROL + Keys.SHIFT)
    timeline.changed(take)
    assert timeline.block()["start"] == there["start"]


@pytest.mark.parametrize(
    ("time", "depth", "same", "other"),
    [
        ("start", 1.0, "end", "start"),
        pytest.param("end", 1.0, "start", "end", marks=pytest.mark.full),
        pytest.param("apex_end", 0.0, "start", "apex_end", marks=pytest.mark.full),
    ],
)
def test_a_block_is_stretched_by_its_handles(
    timeline: Timeline, time: str, depth: float, same: str, other: str
) -> None:
    block = timeline.block()
    timeline.select(block)
    take = timeline.take
    by = 40 if time != "apex_end" else timeline.pixels((block["end"] - block["apex_end"]) / 2)
    timeline.drag(timeline.place(block, block[time], depth), by)
    timeline.changed(take)
    after = timeline.block()
    assert after[same] == pytest.approx(block[same])
    assert after[other] > block[other] + 0.01


def test_a_drag_is_given_up_by_escape(timeline: Timeline) -> None:
    block, take = timeline.block(), timeline.take
    middle = (block["apex_start"] + block["apex_end"]) / 2
    # Faces are asked for from the playhead on: at the start that is all of them.
    timeline.page.run("studio.clock.seek(0)")
    timeline.page.wait("studio.headPlayers.players[0].held === studio.store.get('take').frames")
    timeline.page.run("studio.clock.seek(arguments[0])", middle)
    remember_face(timeline.page)
    chain = timeline.page.actions()
    pointer = chain.w3c_actions.pointer_action
    x, y = timeline.place(block, middle)
    pointer.move_to_location(x, y)
    pointer.pointer_down()
    pointer.move_to_location(x + 80, y)
    chain.perform()
    assert timeline.page.get("[...timeline.scene.edits.held].length") == 1
    # The curves follow before the block is let go of, and are the take's own again when it is given up.
    timeline.page.wait("timeline.scene.model.previewed.size > 0")
    name = timeline.page.get("[...timeline.scene.model.previewed.keys()][0]")
    follows = (
        "timeline.scene.model.curve(arguments[0])?.values !== timeline.scene.model.take.curves[arguments[0]]"
    )
    assert timeline.page.run(f"return {follows}", name)
    # So does the face where the playhead stands.
    timeline.page.wait(f"{MOVED} > 0.5")
    timeline.press(Keys.ESCAPE)
    timeline.page.wait(f"{MOVED} === 0")
    assert timeline.page.get("[...timeline.scene.edits.held].length") == 0
    assert not timeline.page.run(f"return {follows}", name)
    release = timeline.page.actions()
    release.w3c_actions.pointer_action.pointer_up()
    release.perform()
    timeline.settle()
    assert timeline.take == take


def test_a_block_is_moved_and_stretched_by_keys_alone(timeline: Timeline) -> None:
    page, block = timeline.page, timeline.block()
    timeline.tool("Movements").send_keys("")
    timeline.press(Keys.ENTER)
    for _ in range(page.get("timeline.scene.model.take.blocks.length")):
        if page.get("document.activeElement.dataset.id") == block["id"]:
            break
        timeline.press(Keys.ARROW_DOWN)
    assert page.get("document.activeElement.dataset.id") == block["id"]
    take = timeline.take
    timeline.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    timeline.changed(take)
    assert timeline.block()["start"] == pytest.approx(block["start"] + 3 * FRAME, abs=1e-6)
    assert page.get("document.activeElement.dataset.id") == block["id"]
    take = timeline.take
    timeline.press(Keys.ARROW_LEFT, held=Keys.SHIFT)
    timeline.changed(take)
    assert timeline.block()["end"] == pytest.approx(block["end"] + 2 * FRAME, abs=1e-6)
    take = timeline.take
    timeline.press("z", held=Keys.CONTROL)
    timeline.changed(take)
    assert timeline.block()["end"] == pytest.approx(block["end"] + 3 * FRAME, abs=1e-6)


@pytest.mark.parametrize(
    ("held", "start", "apex_start", "apex_end", "end"),
    [
        pytest.param(Keys.ALT, 1, 1, 0, 0, marks=pytest.mark.full),
        pytest.param(Keys.CONTROL, 0, 1, 0, 0, marks=pytest.mark.full),
        (Keys.CONTROL + Keys.SHIFT, 0, 0, 1, 0),
        pytest.param(Keys.SHIFT, 0, 0, 1, 1, marks=pytest.mark.full),
    ],
)
def test_keys_with_modifiers_pull_one_of_the_times(
    timeline: Timeline, held: str, start: int, apex_start: int, apex_end: int, end: int
) -> None:
    block = timeline.block()
    timeline.select(block)
    take = timeline.take
    timeline.press(Keys.ARROW_RIGHT, held=held)
    timeline.changed(take)
    after = timeline.block()
    for name, frames in {"start": start, "apex_start": apex_start, "apex_end": apex_end, "end": end}.items():
        assert after[name] == pytest.approx(block[name] + frames * FRAME, abs=1e-6), name


def test_a_word_is_looped(timeline: Timeline) -> None:
    page = timeline.page
    word = page.get("timeline.scene.model.take.speech.words[1]")
    box = page.get("timeline.scene.canvas.getBoundingClientRect().toJSON()")
    middle = page.run("return timeline.scene.view.x(arguments[0])", (word["start"] + word["end"]) / 2)
    timeline.double_click((round(box["left"] + middle), round(box["top"] + 60)))
    assert page.get("timeline.scene.loop") == pytest.approx([word["start"], word["end"]])
    page.run("timeline.controller.clock.setLoop(null)")


def test_a_block_is_deleted_and_comes_back(timeline: Timeline) -> None:
    block, take = timeline.block(), timeline.take
    timeline.select(block)
    timeline.press(Keys.DELETE)
    timeline.changed(take)
    assert timeline.block(block["id"]) is None
    take = timeline.take
    timeline.press("z", held=Keys.CONTROL)
    timeline.changed(take)
    assert timeline.block(block["id"]) == block


def test_a_movement_is_added(timeline: Timeline) -> None:
    page, take = timeline.page, timeline.take
    timeline.tool("Add…").click()
    page.wait("document.querySelector('.tl dialog').open")
    page.run("""
      const set = (name, value) => {
        const field = document.querySelector(`#tl-add-${name}`);
        field.value = value;
        field.dispatchEvent(new Event("change"));
      };
      set("kind", "unit"); set("name", "AU1"); set("amount", 0.8); set("start", 1.5); set("length", 0.6);
    """)
    page.picture("timeline-add")
    page.run("document.querySelector('.tl dialog .primary').click()")
    timeline.changed(take)
    added = timeline.block("hand.")
    assert (added["start"], added["end"]) == pytest.approx((1.5, 2.1))
    assert added["targets"] == {"frontalis_medialis.left": 0.8, "frontalis_medialis.right": 0.8}
    page.wait("timeline.scene.selected?.startsWith('hand.')")
    assert not page.get("document.querySelector('.tl dialog').open")
    shown = page.run("return timeline.scene.model.valueAt('frontalis_medialis.left', 1.75)")
    assert shown == pytest.approx(0.8, abs=0.02)


def test_a_key_set_on_a_graph_lowers_a_muscle_and_is_explained(timeline: Timeline) -> None:
    page, take = timeline.page, timeline.take
    base, time = "frontalis_medialis", (timeline.block()["apex_start"] + timeline.block()["apex_end"]) / 2
    value = f"timeline.scene.model.valueAt('{base}.left', {time})"
    before = page.get(value)
    assert before > 0.2
    place = timeline.graph(base, time, 0.1)
    timeline.click(place)
    timeline.double_click(place)
    timeline.changed(take)
    assert page.get(value) == pytest.approx(0.1, abs=0.06)
    assert page.get(value.replace("left", "right")) == page.get(value)
    page.run(f"timeline.controller.ask({time}, '{base}.left')")
    text = timeline.explained("by hand")
    assert "replaced" in text
    page.picture("timeline-key")
    take = timeline.take
    timeline.press("z", held=Keys.CONTROL)
    timeline.changed(take)
    assert page.get(value) == before
    assert page.get(f"timeline.scene.edits.keys('{base}.left').length") == 0


def test_a_curve_is_drawn_freely(timeline: Timeline) -> None:
    page, take = timeline.page, timeline.take
    page.run("document.querySelector('#tl-draw').click()")
    start, end = (timeline.graph("frontalis_medialis", *at) for at in ((1.5, 0.2), (2.0, 0.8)))
    chain = page.actions()
    pointer = chain.w3c_actions.pointer_action
    pointer.move_to_location(*start)
    pointer.pointer_down()
    for k in range(1, 9):
        x, y = (a + (b - a) * k / 8 for a, b in zip(start, end, strict=True))
        pointer.move_to_location(round(x), round(y))
    pointer.pointer_up()
    chain.perform()
    timeline.changed(take)
    middle = page.get("timeline.scene.model.valueAt('frontalis_medialis.left', 1.75)")
    assert middle == pytest.approx(0.5, abs=0.08)


def test_a_click_on_a_graph_says_why(timeline: Timeline) -> None:
    block = timeline.block()
    time = (block["apex_start"] + block["apex_end"]) / 2
    timeline.click(timeline.graph("frontalis_medialis", time, 0.3))
    text = timeline.explained("signals")
    assert BROWS in text
    assert "really" in text


def test_a_click_on_a_block_says_why_it_is_there(timeline: Timeline) -> None:
    timeline.select(timeline.block())
    assert BROWS in timeline.explained("frontalis medialis")
    assert timeline.page.get("document.activeElement.getAttribute('role')") == "option"


def test_a_lips_block_is_explained_and_not_moved(timeline: Timeline) -> None:
    block, take = timeline.block("lips.3"), timeline.take
    timeline.drag(timeline.place(block, (block["start"] + block["end"]) / 2), 60)
    timeline.explained(block["rule"])
    assert timeline.take == take


def test_the_wheel_zooms_about_the_pointer(timeline: Timeline) -> None:
    page = timeline.page
    place = timeline.place(timeline.block(), timeline.block()["start"])
    at = f"timeline.scene.view.time({place[0]} - timeline.scene.canvas.getBoundingClientRect().left)"
    span, time = page.get("timeline.scene.view.span"), page.get(at)
    page.run(
        """
        const [clientX, clientY] = arguments;
        const wheel = { clientX, clientY, deltaY: -300, ctrlKey: true, bubbles: true, cancelable: true };
        timeline.scene.canvas.dispatchEvent(new WheelEvent("wheel", wheel));
        """,
        *place,
    )
    assert page.get("timeline.scene.view.span") < 0.6 * span
    assert page.get(at) == pytest.approx(time)


def test_a_click_on_the_ruler_moves_the_playhead(timeline: Timeline) -> None:
    page = timeline.page
    box = page.get("timeline.scene.canvas.getBoundingClientRect().toJSON()")
    x = round(box["left"] + page.get("timeline.scene.view.x(1.25)"))
    timeline.click((x, round(box["top"] + 10)))
    assert page.get("timeline.scene.time") == pytest.approx(1.25, abs=0.02)
    left = page.get("document.querySelector('.tl-playhead').getBoundingClientRect().left")
    assert left == pytest.approx(x, abs=2)


def test_graphs_are_searched_and_chosen(timeline: Timeline) -> None:
    page = timeline.page
    timeline.tool("Graphs…").click()
    search = page.driver.find_element("css selector", "#tl-picker input[type=search]")
    search.send_keys("AU15")
    boxes = page.driver.find_elements("css selector", "#tl-picker input[type=checkbox]")
    assert len(boxes) == 1
    boxes[0].click()
    timeline.settle()
    page.picture("timeline-graphs")
    assert page.get("timeline.scene.body.at(-1).base") == "triangularis"


def test_a_lane_folds_to_one_row(timeline: Timeline) -> None:
    page = timeline.page
    height = "timeline.scene.body.find(({ lane }) => lane?.channel === 'signals').height"
    before = page.get(height)
    page.run("document.querySelector('.tl-names [data-name=signals]').click()")
    assert page.get(height) < before / 2
    assert page.get("document.querySelector('.tl-names [data-name=signals]').ariaExpanded") == "false"


@pytest.mark.full
def test_graphs_and_folded_lanes_are_there_again_after_a_reload(timeline: Timeline) -> None:
    page = timeline.page
    page.run("timeline.scene.folded.add('signals'); document.querySelector('.tl-side').click()")
    shown = "[timeline.scene.graphs, [...timeline.scene.folded]]"
    before = page.get(shown)
    assert len(before[0][0]["names"]) == 1
    page.wait("document.querySelector('#state').textContent === 'All changes saved'")
    page.run("await new Promise((done) => setTimeout(done, 1500))")
    page.open("timeline")
    page.run(f"window.timeline = {TIMELINE}")
    page.wait("timeline.scene.model")
    page.wait(f"JSON.stringify({shown}) === {json.dumps(json.dumps(before, separators=(',', ':')))}")
    page.run("document.documentElement.style.setProperty('--timeline-height', '400px')")


NAMED = {"button", "checkbox", "combobox", "listbox", "option", "scrollbar", "searchbox", "spinbutton"}
NAMED |= {"textbox"}


def test_everything_that_can_be_used_has_a_name_for_screen_readers(timeline: Timeline) -> None:
    page = timeline.page
    block = timeline.block()
    timeline.select(block)
    timeline.explained("Targets")
    timeline.tool("Graphs…").click()
    tree = page.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
    used = [node for node in tree if node.get("role", {}).get("value") in NAMED and not node["ignored"]]
    assert len(used) > 60
    nameless = [node for node in used if not node.get("name", {}).get("value", "").strip()]
    places = [
        page.driver.execute_cdp_cmd("DOM.describeNode", {"backendNodeId": node["backendDOMNodeId"]})["node"]
        for node in nameless
    ]
    assert [(place["localName"], place.get("attributes")) for place in places] == []
