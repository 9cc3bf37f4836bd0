"""What animators expect of a timeline: stretch, copy, paste, lanes muted and locked, markers, bent curves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from .driving import Page
from .timeline import Timeline

MUSCLE = "frontalis_medialis"


@pytest.fixture(scope="module")
def performed(browser_page: Page) -> Timeline:
    browser_page.open("animator")
    return Timeline(browser_page)


@pytest.fixture
def timeline(performed: Timeline) -> Iterator[Timeline]:
    yield performed
    performed.page.run("localStorage.removeItem('risorius-movements')")
    performed.restore()


def signals(timeline: Timeline, count: int = 3) -> list[dict[str, Any]]:
    """Select the first movements of the signals and return them."""
    return list(
        timeline.page.run(
            """
            const { controller, scene } = timeline;
            const { items } = scene.model.lanes.find(({ channel }) => channel === "signals").spans;
            controller.chooseAll(items.slice(0, arguments[0]));
            return controller.blocks;
            """,
            count,
        )
    )


def now(timeline: Timeline, blocks: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [timeline.block(block["id"]) for block in blocks]


def ends(blocks: list[dict[str, Any]]) -> list[float]:
    return [block[name] for block in blocks for name in ("start", "apex_start", "apex_end", "end")]


def keys(timeline: Timeline) -> Any:
    return timeline.page.get(f"timeline.controller.edits.keys('{MUSCLE}.left')")


def test_all_that_is_selected_is_stretched_by_the_end_of_its_bar(timeline: Timeline) -> None:
    blocks, take = signals(timeline), timeline.take
    first, last = min(b["start"] for b in blocks), max(b["end"] for b in blocks)
    timeline.settle()
    timeline.page.picture("group-bar")
    x, y = timeline.page.run(
        """
        const { scene } = timeline;
        const box = scene.canvas.getBoundingClientRect();
        return [box.left + scene.view.x(arguments[0]), box.top + scene.head[0].height - 5];
        """,
        last,
    )
    timeline.page.run("timeline.controller.snaps = false")
    timeline.drag((round(x), round(y)), timeline.pixels((last - first) / 2))
    timeline.page.run("timeline.controller.snaps = true")
    timeline.changed(take)
    after = now(timeline, blocks)
    share = (max(b["end"] for b in after) - first) / (last - first)
    assert share == pytest.approx(1.5, abs=0.05)
    assert ends(after) == pytest.approx([first + share * (time - first) for time in ends(blocks)], abs=1e-3)
    assert timeline.page.get("timeline.scene.model.take.undoes").endswith("and 2 more")


def test_keys_stretch_all_that_is_selected(timeline: Timeline) -> None:
    blocks, take = signals(timeline), timeline.take
    first, last = min(b["start"] for b in blocks), max(b["end"] for b in blocks)
    timeline.page.run("document.querySelector('.tl-blocks [tabindex=\"0\"]').focus()")
    timeline.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, held=Keys.SHIFT)
    timeline.changed(take)
    share = (last + 3 / 30 - first) / (last - first)
    expected = [first + share * (time - first) for time in ends(blocks)]
    assert ends(now(timeline, blocks)) == pytest.approx(expected, abs=1e-3)


def test_movements_are_copied_and_pasted_at_the_playhead(timeline: Timeline) -> None:
    blocks, take = signals(timeline), timeline.take
    timeline.page.run("document.querySelector('.tl-blocks [tabindex=\"0\"]').focus()")
    timeline.press("c", held=Keys.CONTROL)
    timeline.page.run("studio.clock.seek(0.9)")
    timeline.press("v", held=Keys.CONTROL)
    timeline.changed(take)
    timeline.page.wait("timeline.controller.blocks.length === 3")
    added = timeline.page.get("timeline.controller.blocks")
    assert {block["id"] for block in added} == {"hand.1", "hand.2", "hand.3"}
    first = min(block["start"] for block in blocks)
    moved = sorted((b["start"] - first + 0.9, b["end"] - first + 0.9) for b in blocks)
    assert [
        t for b in sorted(added, key=lambda b: (b["start"], b["end"])) for t in (b["start"], b["end"])
    ] == (pytest.approx([t for pair in moved for t in pair], abs=1e-3))
    targets = sorted(str(sorted(b["targets"].items())) for b in blocks)
    assert sorted(str(sorted(b["targets"].items())) for b in added) == targets


def test_a_lane_is_muted_and_locked_by_its_buttons(timeline: Timeline) -> None:
    take = timeline.take

    def button(name: str) -> Any:
        return timeline.page.driver.find_element(By.CSS_SELECTOR, f"[data-name='{name}']")

    turns = "[...(timeline.scene.model.take.curves.head_yaw ?? [])]"
    before = timeline.page.get(turns)
    timeline.page.run(
        "timeline.controller.revealRow(timeline.scene.body.find((r) => r.lane?.channel === 'head'))"
    )
    timeline.settle()
    button("head muted").click()
    timeline.changed(take)
    assert button("head muted").get_attribute("aria-pressed") == "true"
    assert timeline.page.get(turns) != before
    timeline.select(timeline.block("head."))
    assert "muted" in timeline.explained("has no effect")
    take = timeline.take
    button("head locked").click()
    timeline.changed(take)
    block = timeline.block("head.")
    timeline.drag(timeline.place(block, (block["apex_start"] + block["apex_end"]) / 2), 40)
    timeline.settle()
    assert timeline.block("head.")["start"] == block["start"]
    assert "locked" in timeline.explained("locked")
    timeline.page.run("await timeline.controller.turnLane('solo', 'lips')")
    assert timeline.page.get("[...timeline.scene.model.silent].includes('signals')")


def test_markers_are_set_noted_dragged_and_gone_to(timeline: Timeline) -> None:
    page, take = timeline.page, timeline.take
    page.run("studio.clock.seek(0.5); timeline.scene.canvas.focus()")
    timeline.press("m")
    timeline.changed(take)
    take = timeline.take
    x, y = page.run("""
      const { scene } = timeline;
      const box = scene.canvas.getBoundingClientRect();
      return [box.left + scene.view.x(0.5), box.top + 5];
    """)
    timeline.double_click((round(x), round(y)))
    note = page.driver.find_element(By.ID, "tl-marker-0-text")
    note.send_keys("lift", Keys.TAB)
    timeline.changed(take)
    page.run("document.querySelector('.tl-markers').close()")
    take = timeline.take
    timeline.drag((round(x), round(y)), timeline.pixels(0.6))
    timeline.changed(take)
    (marker,) = page.get("timeline.scene.model.markers")
    assert marker["text"] == "lift"
    assert marker["time"] == pytest.approx(1.1, abs=0.02)
    page.run("studio.clock.seek(2); timeline.scene.canvas.focus()")
    timeline.press("<")
    assert page.get("studio.clock.time") == pytest.approx(marker["time"], abs=1e-3)
    page.open("animator")
    page.run("window.timeline = document.querySelector('#timeline').timeline")
    page.wait("timeline.scene.model && !timeline.busy")
    assert page.get("timeline.scene.model.markers") == [marker]


def test_a_key_is_smoothed_by_its_list_and_bent_by_its_handle(timeline: Timeline) -> None:
    page = timeline.page
    page.run(
        f"""
        const {{ controller, scene }} = timeline;
        if (!scene.body.some(({{ base }}) => base === "{MUSCLE}")) controller.graphs.toggle("{MUSCLE}");
        const drawn = [[0.5, 0], [1, 0.5], [1.5, 0.7], [2, 0]];
        await controller.edits.sendKeys(controller.partners("{MUSCLE}.left"), drawn);
        controller.chooseKey("{MUSCLE}.left", 1);
        """
    )
    page.wait("document.querySelector('#tl-key-1-shape')")
    take = timeline.take
    page.run("""
      const list = document.querySelector("#tl-key-1-shape");
      list.value = "smooth";
      list.dispatchEvent(new Event("change"));
    """)
    timeline.changed(take)
    shape = keys(timeline)[1][2]
    assert shape["after"] == pytest.approx([1 / 6, 2 * 1 * 0.4 / 1.4 / 6], abs=1e-3)
    assert shape["before"][1] / shape["before"][0] == pytest.approx(shape["after"][1] / shape["after"][0])
    take = timeline.take
    place = timeline.graph(MUSCLE, 1 + shape["after"][0], 0.5 + shape["after"][1])
    page.run("timeline.controller.chooseKey(arguments[0], 1)", f"{MUSCLE}.left")
    timeline.drag(place, timeline.pixels(0.2))
    timeline.changed(take)
    bent = keys(timeline)[1][2]
    assert bent["after"][0] > shape["after"][0] + 0.1
    assert bent["before"][0] == pytest.approx(shape["before"][0])
    page.picture("bent-key")


def test_the_stage_fills_the_screen_and_comes_back(timeline: Timeline) -> None:
    page = timeline.page
    wide = page.driver.find_element(By.ID, "full-screen")
    wide.click()
    page.wait("document.fullscreenElement?.id === 'stage'")
    page.wait("document.getElementById('full-screen').ariaPressed === 'true'")
    page.run("await document.exitFullscreen()")
    page.wait("document.getElementById('full-screen').ariaPressed === 'false'")
