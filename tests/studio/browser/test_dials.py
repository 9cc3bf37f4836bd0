"""A face held by dials: the skin follows, the face is kept under a name."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from selenium.webdriver.common.by import By

from .acts import MOVED, open_panel, remember_face, slide
from .driving import Page, waited


def hold_face(page: Page) -> None:
    open_panel(page, "Dials")
    slide(page, "19 masseter", 0.0)
    page.wait("studio.headPlayers.figures[0] !== null && studio.store.get('dial') !== null")
    slide(page, "19 masseter", 0.01)
    page.wait("studio.headPlayers.figures[0].skin.some((value, k) => value !== 0)")


@pytest.fixture
def dials(performed: Page) -> Iterator[Page]:
    hold_face(performed)
    yield performed
    for name in ("muscles", "both"):
        performed.run("document.querySelector(`#panel-dials [data-name=${arguments[0]}]`).click()", name)
    performed.driver.find_element(By.ID, "dials-back").click()


def at_rest(page: Page) -> None:
    page.driver.find_element(By.ID, "dials-reset").click()
    page.run("""
      const [figure] = studio.headPlayers.figures;
      let before = null;
      while (before === null || figure.skin.some((value, k) => value !== before[k])) {
        before = figure.skin.slice();
        await new Promise((go) => setTimeout(go, 400));
      }
    """)
    remember_face(page)


def test_every_muscle_head_and_eyes_have_a_dial(dials: Page) -> None:
    count = "document.querySelectorAll('#panel-dials .dial').length"
    parameters = dials.get("studio.store.get('catalogue').parameters")
    bases = {p["base"] for p in parameters}
    assert dials.get(count) == len(bases)
    units = len(dials.get("studio.store.get('catalogue').action_units"))
    dials.run("document.querySelector('#panel-dials [data-name=units]').click()")
    assert dials.get(count) == units
    dials.run("document.querySelector('#panel-dials [data-name=emotions]').click()")
    assert dials.get(count) == len(dials.get("studio.store.get('catalogue').emotions"))


def test_the_face_follows_a_dial(dials: Page) -> None:
    at_rest(dials)
    slide(dials, "01 zygomatic major", 1.0)
    dials.wait(f"{MOVED} > 4")
    dials.picture("dials")


@pytest.mark.full
def test_one_side_moves_alone(dials: Page) -> None:
    at_rest(dials)
    dials.run("document.querySelector('#panel-dials [data-name=left]').click()")
    slide(dials, "01 zygomatic major", 1.0)
    dials.wait(f"{MOVED} > 4")
    assert dials.get("studio.store.get('dial').values") == {"zygomatic_major.left": 1}
    # The subject's left is at positive x.
    right = MOVED.replace("most = Math.max", "if (kept[k] < -15) most = Math.max")
    assert dials.get(right) < 2.0


def test_a_face_is_kept_as_an_emotion(page: Page, tmp_path: Path) -> None:
    hold_face(page)
    page.driver.execute_cdp_cmd(
        "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)}
    )
    slide(page, "01 zygomatic major", 0.4)
    page.driver.find_element(By.ID, "save-emotion").click()  # without a name: the name is asked for
    assert page.get("document.activeElement.id") == "pose-name"
    page.driver.find_element(By.ID, "pose-name").send_keys("wry")
    page.driver.find_element(By.ID, "save-emotion").click()
    page.wait("studio.store.get('ownEmotions').includes('wry')")
    file = waited(lambda: next(tmp_path.glob("*.toml"), None), "the file", 20.0)
    assert "wry" in tomllib.loads(file.read_text()) or "wry" in file.read_text()


def test_playing_shows_the_line_again(performed: Page) -> None:
    open_panel(performed, "Dials")
    slide(performed, "19 masseter", 1.0)
    performed.wait("studio.store.get('dial') !== null")
    performed.driver.find_element(By.ID, "dials-back").click()
    assert performed.get("studio.store.get('dial')") is None
