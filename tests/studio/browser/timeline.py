"""The timeline of a page, used by mouse and by keys."""

from __future__ import annotations

from typing import Any

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.remote.webelement import WebElement

from .driving import Page

LINE = "Oh really? I like it very much."
BROWS = "signals.brows.unmarked"
TIMELINE = "document.querySelector('#timeline').timeline"
FRAME = 1 / 30
JUMP = 0.3  # s by which a block is moved: further than any edge that it could snap to


class Timeline:
    """The timeline of a page on which a line is performed."""

    def __init__(self, page: Page) -> None:
        self.page = page
        page.run(f"window.timeline = {TIMELINE}")
        page.driver.find_element("id", "script").send_keys(LINE)
        page.driver.find_element("id", "perform").click()
        page.wait("timeline.scene.model && !timeline.busy")
        page.run("document.documentElement.style.setProperty('--timeline-height', '400px')")
        self.settle()

    def settle(self) -> None:
        """Wait until what was changed is drawn."""
        self.page.run("for (let k = 0; k < 3; k++) await new Promise(requestAnimationFrame)")

    def restore(self) -> None:
        """Take all changes back, and show the whole take."""
        self.page.run("""
          const { controller, scene } = timeline;
          document.querySelectorAll("dialog[open]").forEach((dialog) => dialog.close());
          document.querySelectorAll(":popover-open").forEach((popover) => popover.hidePopover());
          if (controller.draws) document.querySelector("#tl-draw").click();
          while (scene.model.take.undoes) await controller.undo();
          scene.folded.clear();
          controller.choose(null);
          controller.arrange();
          controller.scroller.scrollTop = 0;
          controller.fit();
        """)
        self.settle()

    @property
    def take(self) -> int:
        return int(self.page.get("timeline.scene.model.take.take"))

    def block(self, start: str = BROWS) -> dict[str, Any]:
        """Return the first block whose id starts so, as the take has it."""
        found: dict[str, Any] = self.page.run(
            "return timeline.scene.model.take.blocks.find(({ id }) => id.startsWith(arguments[0]))", start
        )
        return found

    def changed(self, take: int) -> None:
        """Wait for the answer to an edit made on a take."""
        self.page.wait(f"timeline.scene.model.take.take !== {take} && !timeline.busy")
        self.settle()

    def place(self, block: dict[str, Any], time: float, depth: float = 0.6) -> tuple[int, int]:
        """Return where a time of a block is on the page; `depth` 0 is its top, 1 its bottom."""
        x, y = self.page.run(
            """
            const [id, time, depth] = arguments;
            const { scene } = timeline;
            const { blockBand } = await import("/web/timeline/model/rows.js");
            const block = scene.model.blocks.get(id);
            const row = scene.body.find(({ lane }) => lane?.channel === block.channel);
            const [top, bottom] = blockBand(row, block);
            const box = scene.canvas.getBoundingClientRect();
            const y = scene.headHeight - scene.scroll + top + depth * (bottom - top);
            return [box.left + scene.view.x(time), box.top + y];
            """,
            block["id"],
            time,
            depth,
        )
        return round(x), round(y)

    def graph(self, base: str, time: float, value: float) -> tuple[int, int]:
        """Return where a value of a muscle is on the page, its graph brought into sight."""
        self.page.run(
            """
            const row = timeline.scene.body.find((row) => row.base === arguments[0]);
            timeline.controller.revealRow(row);
            """,
            base,
        )
        self.settle()
        x, y = self.page.run(
            """
            const [base, time, value] = arguments;
            const { scene } = timeline;
            const { scaleOf } = await import("/web/timeline/paint/paint_graphs.js");
            const row = scene.body.find((row) => row.base === base);
            const box = scene.canvas.getBoundingClientRect();
            const y = scene.headHeight - scene.scroll + scaleOf(scene.model, row).y(value);
            return [box.left + scene.view.x(time), box.top + y];
            """,
            base,
            time,
            value,
        )
        return round(x), round(y)

    def pixels(self, seconds: float) -> int:
        return round(seconds * self.page.get("timeline.scene.view.scale"))

    def drag(self, start: tuple[int, int], by: int) -> None:
        chain = self.page.actions()
        pointer = chain.w3c_actions.pointer_action
        pointer.move_to_location(*start)
        pointer.pointer_down()
        pointer.move_to_location(start[0] + by // 2, start[1])
        pointer.move_to_location(start[0] + by, start[1])
        pointer.pointer_up()
        chain.perform()

    def click(self, place: tuple[int, int]) -> None:
        chain = self.page.actions()
        pointer = chain.w3c_actions.pointer_action
        pointer.move_to_location(*place)
        pointer.pointer_down()
        pointer.pointer_up()
        chain.perform()
        self.settle()

    def double_click(self, place: tuple[int, int]) -> None:
        """Double-click, however slowly a loaded machine lets clicks follow one another."""
        self.page.run(
            """
            const [clientX, clientY] = arguments;
            const event = new MouseEvent("dblclick", { clientX, clientY, bubbles: true });
            timeline.scene.canvas.dispatchEvent(event);
            """,
            *place,
        )

    def select(self, block: dict[str, Any]) -> None:
        """Click in the middle of a block."""
        self.click(self.place(block, (block["apex_start"] + block["apex_end"]) / 2))

    def press(self, *keys: str, held: str = "") -> None:
        chain: ActionChains = self.page.actions()
        for key in held:
            chain.key_down(key)
        chain.send_keys(*keys)
        for key in held:
            chain.key_up(key)
        chain.perform()

    def tool(self, name: str) -> WebElement:
        """Return a button of the timeline's tools."""
        found = self.page.driver.find_elements("css selector", ".tl-tools button")
        return next(button for button in found if button.text == name)

    def explained(self, what: str) -> str:
        """Return the explanation once it contains something."""
        text = "document.querySelector('#explanation').innerText"
        self.page.wait(f"{text}.includes({what!r})")
        return str(self.page.get(text))
