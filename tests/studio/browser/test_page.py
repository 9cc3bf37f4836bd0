"""The page as a whole: themes, keys, names for screen readers, sizes."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from .acts import SETTLED, SHOWN, perform, press
from .driving import SIZE, Page

GROUND = "getComputedStyle(document.body).backgroundColor"
NAMELESS = """[...document.querySelectorAll('button, input, select, textarea, [tabindex="0"]')]
  .filter((it) => it.checkVisibility() && !(it.labels?.length || it.getAttribute('aria-label')
    || it.getAttribute('aria-labelledby') || it.textContent.trim() || it.title))
  .map((it) => it.outerHTML.slice(0, 120))"""
OUTSIDE = """[...document.querySelectorAll('#studio > *')].filter((it) => {
  const { left, top, right, bottom } = it.getBoundingClientRect();
  return left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1;
}).map((it) => it.id || it.tagName)"""

# Lists whose chosen text is wider than the room beside their arrow.
CUT = """[...document.querySelectorAll('select')].filter((it) => it.checkVisibility()).map((it) => {
  const { font, paddingLeft, paddingRight } = getComputedStyle(it);
  const line = Object.assign(document.createElement('canvas').getContext('2d'), { font });
  const text = it.selectedOptions[0]?.textContent ?? '';
  const room = it.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight) - 16;
  return [text, room - line.measureText(text).width];
}).filter(([, room]) => room < 0)"""
SMALL = """[...document.querySelectorAll('.tl-name button:not(.tl-lane-name, .tl-state)')].filter((it) => {
  const { width, height } = it.getBoundingClientRect();
  return width < 32 || height < 32;
}).map((it) => it.title)"""


@pytest.mark.full
def test_light_and_dark(page: Page) -> None:
    perform(page)
    before = page.get(GROUND)
    page.driver.find_element(By.ID, "theme").click()
    after = page.get(GROUND)
    assert after != before
    page.picture(f"theme-{page.get('document.documentElement.dataset.theme')}")
    page.open(page.get("location.hash.slice(1)"))
    assert page.get(GROUND) == after
    page.driver.find_element(By.ID, "theme").click()
    assert page.get(GROUND) == before


def test_keys_play_step_and_help(performed: Page) -> None:
    performed.driver.find_element(By.ID, "head").click()
    press(performed, Keys.ARROW_RIGHT)  # on the picture, arrows turn the head
    assert performed.get("studio.view.state.turn") != 0
    press(performed, "1")
    assert performed.get("studio.view.state.turn") == 0
    performed.run("document.activeElement.blur()")
    press(performed, Keys.ARROW_RIGHT)
    press(performed, Keys.ARROW_RIGHT)
    assert abs(performed.get("studio.clock.time") - 2 / 30) < 1e-6
    press(performed, Keys.SHIFT, Keys.ARROW_RIGHT)
    assert abs(performed.get("studio.clock.time") - 2 / 30 - 1) < 1e-6
    press(performed, " ")
    performed.wait("studio.clock.playing")
    press(performed, " ")
    performed.wait("!studio.clock.playing")
    press(performed, Keys.HOME)
    assert performed.get("studio.clock.time") == 0
    press(performed, "l")
    assert performed.get("studio.clock.loop !== null")
    press(performed, "?")
    performed.wait("document.querySelector('dialog[open]')")
    performed.picture("keys")
    press(performed, Keys.ESCAPE)
    performed.wait("!document.querySelector('dialog[open]')")


def test_a_line_is_performed_and_played_by_keys_alone(page: Page) -> None:
    page.wait("studio.store.get('link') === 'up'")
    for _ in range(60):
        press(page, Keys.TAB)
        if page.get("document.activeElement.id") == "script":
            break
    press(page, "Keys only.")
    press(page, Keys.CONTROL, Keys.ENTER)
    page.wait("studio.store.get('take') !== null")
    page.wait(f"{SETTLED} && {SHOWN}")
    for _ in range(120):
        press(page, Keys.TAB)
        if page.get("document.activeElement.id") == "play":
            break
    assert page.get("document.activeElement.id") == "play"
    # The line is short: on a busy machine it may have been played before one can look.
    page.run("window.played = false; studio.clock.on('state', ({ playing }) => (window.played ||= playing))")
    press(page, " ")
    page.wait("played")


def test_everything_has_a_name_and_stays_on_the_page(performed: Page) -> None:
    for name in performed.get(
        "[...document.querySelectorAll('#panel [role=tab]')].map((tab) => tab.textContent)"
    ):
        performed.driver.find_element(By.XPATH, f"//*[@role='tab'][text()='{name}']").click()
        assert performed.get(NAMELESS) == []
        assert performed.get(OUTSIDE) == []
        assert performed.get(CUT) == []
    assert performed.get(SMALL) == []


@pytest.mark.full
def test_a_large_screen(page: Page) -> None:
    try:
        resize(page, 2560, 1440)
        perform(page)
        assert page.get(OUTSIDE) == []
        page.run("await new Promise((go) => setTimeout(go, 1500))")
        page.picture("large")
    finally:
        resize(page, *SIZE)


def resize(page: Page, width: int, height: int) -> None:
    metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    page.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)


def test_nothing_is_asked_of_other_hosts(performed: Page) -> None:
    names = performed.get("performance.getEntriesByType('resource').map(({ name }) => new URL(name).host)")
    assert set(names) - {""} == {performed.get("location.host")}
    assert performed.complaints() == []
