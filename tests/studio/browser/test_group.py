"""Several movements selected, moved and deleted together: each is one change."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from selenium.webdriver.common.keys import Keys

from .acts import MOVED, remember_face
from .driving import Page
from .timeline import FRAME, JUMP, Timeline

# What is changed is tested at the server every day.
pytestmark = pytest.mark.full


@pytest.fixture(scope="module")
def performed(browser_page: Page) -> Timeline:
    browser_page.open("group")
    return Timeline(browser_page)


@pytest.fixture
def timeline(performed: Timeline) -> Iterator[Timeline]:
    yield performed
    performed.restore()


def signals(timeline: Timeline) -> list[dict[str, Any]]:
    blocks = timeline.page.get("timeline.scene.model.take.blocks.filter((b) => b.channel === 'signals')")
    return sorted(blocks, key=lambda block: str(block["id"]))


def selected(timeline: Timeline) -> set[str]:
    return set(timeline.page.get("timeline.controller.blocks.map(({ id }) => id)"))


def test_movements_are_selected_one_by_one_and_dragged_together(timeline: Timeline) -> None:
    before, take = signals(timeline), timeline.take
    one, other = before[0], before[-1]
    timeline.select(one)
    timeline.page.run(
        "timeline.controller.toggle(timeline.scene.model.blocks.get(arguments[0]))", other["id"]
    )
    assert selected(timeline) == {one["id"], other["id"]}
    timeline.page.picture("group")
    middle = (one["apex_start"] + one["apex_end"]) / 2
    timeline.drag(timeline.place(one, middle), timeline.pixels(JUMP))
    timeline.changed(take)
    after = signals(timeline)
    deltas = [b["start"] - a["start"] for a, b in zip(before, after, strict=True)]
    assert deltas[0] == pytest.approx(deltas[-1], abs=1e-3)
    assert deltas[0] > JUMP / 2
    assert not any(deltas[1:-1])
    assert timeline.page.get("timeline.scene.model.take.undoes").endswith("and 1 more")
    timeline.page.run("await timeline.controller.undo()")
    assert signals(timeline) == before


def test_what_is_dragged_together_is_seen_before_it_is_let_go_of(timeline: Timeline) -> None:
    page, before, take = timeline.page, signals(timeline), timeline.take
    one, other = before[0], before[-1]
    middle = (one["apex_start"] + one["apex_end"]) / 2
    page.run("studio.clock.seek(0)")
    page.wait("studio.headPlayers.players[0].held === studio.store.get('take').frames")
    page.run("studio.clock.seek(arguments[0])", middle)
    remember_face(page)
    blocks = "arguments[0].map((id) => timeline.scene.model.blocks.get(id))"
    page.run(f"timeline.controller.chooseAll({blocks})", [other["id"], one["id"]])
    x, y = timeline.place(one, middle)
    chain = page.actions()
    pointer = chain.w3c_actions.pointer_action
    pointer.move_to_location(x, y)
    pointer.pointer_down()
    pointer.move_to_location(x + 80, y)
    chain.perform()
    page.wait("timeline.scene.model.previewed.size > 0")
    previewed = set(page.get("[...timeline.scene.model.previewed.keys()]"))
    assert all(previewed & set(block["targets"]) for block in (one, other))
    page.wait(f"{MOVED} > 0.5")
    timeline.press(Keys.ESCAPE)
    page.wait(f"{MOVED} === 0")
    assert page.get("timeline.scene.model.previewed.size") == 0
    release = page.actions()
    release.w3c_actions.pointer_action.pointer_up()
    release.perform()
    timeline.settle()
    assert (signals(timeline), timeline.take) == (before, take)


def test_a_box_selects_what_it_touches_and_delete_deletes_it_at_once(timeline: Timeline) -> None:
    before, take = signals(timeline), timeline.take
    timeline.page.run("""
      const { scene, controller } = timeline;
      const row = scene.body.find(({ lane }) => lane?.channel === "signals");
      const { DragBox } = await import("/web/timeline/edit/group.js");
      const y = scene.headHeight - scene.scroll + row.y;
      const box = new DragBox(controller, 0, y + 1, false);
      box.move(scene.width, y + row.height - 2);
      box.end();
    """)
    assert selected(timeline) == {block["id"] for block in before}
    timeline.page.run("document.querySelector('.tl-blocks [tabindex=\"0\"]').focus()")
    timeline.press(Keys.DELETE)
    timeline.changed(take)
    assert signals(timeline) == []
    timeline.page.run("await timeline.controller.undo()")
    assert signals(timeline) == before


def test_a_lane_is_selected_and_moved_by_keys(timeline: Timeline) -> None:
    before, take = signals(timeline), timeline.take
    timeline.select(before[0])
    timeline.press("a", held=Keys.CONTROL)
    assert selected(timeline) == {block["id"] for block in before}
    timeline.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    timeline.changed(take)
    for was, now in zip(before, signals(timeline), strict=True):
        assert now["start"] - was["start"] == pytest.approx(2 * FRAME, abs=1e-3)
