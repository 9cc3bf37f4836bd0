"""What axe-core finds wrong with the page for people who see, hear or move otherwise."""

from __future__ import annotations

from pathlib import Path

import pytest

from .acts import open_panel
from .driving import SIZE, Page
from .test_page import resize

AXE = (Path(__file__).parent / "axe" / "axe.min.js").read_text(encoding="utf-8")
# What lies under a panel's foot is scrolled from there: it counts as if the foot stood below it.
LOOK = """document.querySelectorAll(".panel-foot").forEach((foot) => (foot.style.position = "static"));
  const options = { resultTypes: ["violations"], rules: { "target-size": { enabled: true } } };
  const { violations } = await axe.run(document.querySelector(arguments[0]), options);
  document.querySelectorAll(".panel-foot").forEach((foot) => (foot.style.position = ""));
  const where = ({ target }) => target.join(" ").slice(-90);
  return violations.map(({ id, nodes }) => [id, ...nodes.map(where)]);"""


@pytest.fixture
def examined(performed: Page) -> Page:
    performed.driver.execute_script(AXE)
    return performed


def violations(page: Page, part: str = "html") -> list[list[str]]:
    """Return the rules that a part of the page breaks, and where."""
    found = page.run(LOOK, part)
    assert isinstance(found, list)
    return found


def choose_block(page: Page) -> None:
    page.run("""
      const { timeline } = document.getElementById("timeline");
      const { blocks } = studio.store.get("take");
      timeline.controller.choose(blocks.find(({ channel }) => channel === "signals"));
    """)
    page.wait("document.querySelector('#tl-time-0')")


def test_axe_finds_nothing_wrong(examined: Page) -> None:
    choose_block(examined)
    assert violations(examined) == []
    examined.run("studio.actions.select({ time: 1, parameter: 'masseter' })")
    examined.wait("document.querySelector('#tl-key-add')")
    assert violations(examined, "#explanation") == []


@pytest.mark.full
@pytest.mark.parametrize("size", [(390, 844), (640, 360), SIZE, (2560, 1440)])
def test_axe_finds_nothing_wrong_in_other_windows_and_the_other_theme(
    examined: Page, size: tuple[int, int]
) -> None:
    try:
        resize(examined, *size)
        examined.wait(f"innerWidth === {size[0]}")
        for name in ("Perform", "Dials", "Rules", "Compare", "Project"):
            open_panel(examined, name)
            assert violations(examined) == []
        examined.run("document.getElementById('theme').click()")
        examined.run("await new Promise((go) => setTimeout(go, 300))")  # colours that still change
        assert violations(examined) == []
        examined.run("document.getElementById('help').click()")
        assert violations(examined) == []
    finally:
        examined.run("document.getElementById('theme').click()")
        resize(examined, *SIZE)


def test_a_movement_that_moves_nothing_says_why(performed: Page) -> None:
    said = "document.querySelector('.tl-why').textContent"
    performed.run("""
      const { timeline } = document.getElementById("timeline");
      timeline.controller.choose(studio.store.get("take").blocks.find(({ channel }) => channel === "gaze"));
    """)
    performed.wait(f"{said}.includes('It keeps gaze at rest')")
    assert "gaze yaw" in performed.get(said)


def test_forced_colours_and_reduced_motion_are_taken_up(performed: Page) -> None:
    def emulate(**features: str) -> None:
        wanted = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
        performed.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": wanted})

    palette = "document.getElementById('timeline').timeline.scene.palette.ground"
    snap = (
        "[...document.querySelectorAll('.tl-tools button')].map((it) => getComputedStyle(it).backgroundColor)"
    )
    try:
        emulate(forced_colors="active", prefers_reduced_motion="reduce")
        performed.wait(f"{palette} === 'Canvas'")
        assert len(set(performed.get(snap))) > 1, "what is pressed looks like what is not"
        performed.run("document.getElementById('stop').hidden = false")
        assert performed.get("getComputedStyle(document.getElementById('stop')).animationName") == "none"
    finally:
        performed.run("document.getElementById('stop').hidden = true")
        emulate(forced_colors="none", prefers_reduced_motion="no-preference")
    performed.wait(f"{palette} !== 'Canvas'")
