"""The page as a whole: themes, keys, names for screen readers, sizes."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from .acts import perform, press
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


def test_keys_play_step_and_help(page: Page) -> None:
    perform(page)
    page.driver.find_element(By.ID, "head").click()
    press(page, Keys.ARROW_RIGHT)  # on the picture, arrows turn the head
    assert page.get("studio.view.state.turn") != 0
    press(page, "1")
    assert page.get("studio.view.state.turn") == 0
    page.run("document.activeElement.blur()")
    press(page, Keys.ARROW_RIGHT)
    press(page, Keys.ARROW_RIGHT)
    assert abs(page.get("studio.clock.time") - 2 / 30) < 1e-6
    press(page, Keys.SHIFT, Keys.ARROW_RIGHT)
    assert abs(page.get("studio.clock.time") - 2 / 30 - 1) < 1e-6
    press(page, " ")
    page.wait("studio.clock.playing")
    press(page, " ")
    page.wait("!studio.clock.playing")
    press(page, Keys.HOME)
    assert page.get("studio.clock.time") == 0
    press(page, "l")
    assert page.get("studio.clock.loop !== null")
    press(page, "?")
    page.wait("document.querySelector('dialog[open]')")
    page.picture("keys")
    press(page, Keys.ESCAPE)
    page.wait("!document.querySelector('dialog[open]')")


def test_a_line_is_performed_and_played_by_keys_alone(page: Page) -> None:
    page.wait("studio.store.get('link') === 'up'")
    for _ in range(60):
        press(page, Keys.TAB)
        if page.get("document.activeElement.id") == "script":
            break
    press(page, "Keys only.")
    press(page, Keys.CONTROL, Keys.ENTER)
    page.wait("studio.store.get('take') !== null")
    for _ in range(120):
        press(page, Keys.TAB)
        if page.get("document.activeElement.id") == "play":
            break
    assert page.get("document.activeElement.id") == "play"
    press(page, " ")
    page.wait("studio.clock.playing")


def test_everything_has_a_name_and_stays_on_the_page(page: Page) -> None:
    perform(page)
    for name in page.get("[...document.querySelectorAll('#panel [role=tab]')].map((tab) => tab.textContent)"):
        page.driver.find_element(By.XPATH, f"//*[@role='tab'][text()='{name}']").click()
        assert page.get(NAMELESS) == []
        assert page.get(OUTSIDE) == []


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


def test_nothing_is_asked_of_other_hosts(page: Page) -> None:
    perform(page)
    names = page.get("performance.getEntriesByType('resource').map(({ name }) => new URL(name).host)")
    assert set(names) - {""} == {page.get("location.host")}
    assert page.complaints() == []
