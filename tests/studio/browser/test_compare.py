"""Two settings side by side."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By

from .acts import MOVED, choose, open_panel
from .driving import Page


@pytest.mark.full
def test_two_heads_stand_side_by_side_in_step(performed: Page) -> None:
    open_panel(performed, "Compare")
    choose(performed, "compare", "lips", "lookahead")
    performed.driver.find_element(By.ID, "compare").click()
    performed.wait("studio.headPlayers.figures[1] !== null && !studio.headPlayers.players[1].behind", 120.0)
    performed.run("studio.clock.seek(1.5)")
    performed.wait("studio.headPlayers.players.every((player) => !player.behind)")
    performed.picture("compare")
    performed.run("window.kept = studio.headPlayers.figures[1].skin")
    performed.wait(f"{MOVED} > 0.3")
    labels = performed.get("[...document.querySelectorAll('#views-names b')].map((b) => b.textContent)")
    assert labels == ["this take", "lips: lookahead"]
    assert performed.get("document.querySelectorAll('.differences tbody tr').length") > 0
    assert performed.get("studio.store.get('take').made.choices.lips") == "effort"
    performed.driver.find_element(By.ID, "compare-end").click()
    performed.wait("studio.headPlayers.figures[1] === null")
    choose(performed, "compare", "lips", "effort")


def test_the_same_settings_do_not_differ(performed: Page) -> None:
    open_panel(performed, "Compare")
    performed.driver.find_element(By.ID, "compare").click()
    performed.wait("studio.store.get('other') !== null")
    assert performed.get(
        "document.querySelector('#panel-compare').textContent.includes('The two takes are the same.')"
    )
