"""Two settings side by side."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By

from .acts import MOVED, choose, open_panel, perform
from .driving import Page


@pytest.mark.full
def test_two_heads_stand_side_by_side_in_step(page: Page) -> None:
    perform(page)
    open_panel(page, "Compare")
    choose(page, "compare", "lips", "lookahead")
    page.driver.find_element(By.ID, "compare").click()
    page.wait("studio.headPlayers.figures[1] !== null && !studio.headPlayers.players[1].behind", 120.0)
    page.run("studio.clock.seek(1.5)")
    page.wait("studio.headPlayers.players.every((player) => !player.behind)")
    page.picture("compare")
    page.run("window.kept = studio.headPlayers.figures[1].skin")
    page.wait(f"{MOVED} > 0.3")
    labels = page.get("[...document.querySelectorAll('#views-names b')].map((b) => b.textContent)")
    assert labels == ["this take", "lips: lookahead"]
    assert page.get("document.querySelectorAll('.differences tbody tr').length") > 0
    assert page.get("studio.store.get('take').made.choices.lips") == "effort"
    page.driver.find_element(By.ID, "compare-end").click()
    page.wait("studio.headPlayers.figures[1] === null")


def test_the_same_settings_do_not_differ(page: Page) -> None:
    perform(page)
    open_panel(page, "Compare")
    page.driver.find_element(By.ID, "compare").click()
    page.wait("studio.store.get('other') !== null")
    assert page.get("document.querySelector('#panel-compare').textContent.includes('Both are the same.')")
