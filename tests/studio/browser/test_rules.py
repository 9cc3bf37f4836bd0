"""Rules seen, switched off, and a profile's numbers edited."""

from __future__ import annotations

from pathlib import Path

import pytest
from selenium.webdriver.common.by import By

from .acts import SETTLED, open_panel
from .driving import Page, waited

RULE = "signals.brows.accent"
BLOCKS = f"studio.store.get('take').blocks.filter(({{ rule }}) => rule === '{RULE}').length"
ROW = f"document.querySelector('#rules [data-rule=\"{RULE}\"]')"


@pytest.fixture
def rules(performed: Page) -> Page:
    open_panel(performed, "Rules")
    performed.wait("document.querySelector('#rules .rule:not([hidden])')")
    return performed


@pytest.mark.full
def test_the_rules_that_fired_are_listed_with_their_places(rules: Page) -> None:
    rules.wait(f"{ROW}?.hidden === false")
    rules.picture("rules")
    assert rules.get(f"{ROW}.querySelectorAll('.chip').length") == rules.get(BLOCKS) > 0
    rules.run(f"{ROW}.querySelector('.chip').click()")
    time = float(rules.get(f"{ROW}.querySelector('.chip').textContent"))
    assert abs(rules.get("studio.clock.time") - time) < 0.01


def test_a_rule_is_switched_off_and_on(rules: Page) -> None:
    rules.wait(f"{ROW}?.hidden === false")
    before = rules.get(BLOCKS)
    rules.run(f"{ROW}.querySelector('input').click()")
    rules.wait(f"{SETTLED} && {BLOCKS} === 0")
    rules.wait(f"{ROW} && !{ROW}.hidden && !{ROW}.querySelector('input').checked")
    rules.run(f"{ROW}.querySelector('input').click()")
    rules.wait(f"{SETTLED} && {BLOCKS} === {before}")


def test_a_number_of_the_profile_is_performed_and_exported(rules: Page, tmp_path: Path) -> None:
    rules.driver.execute_cdp_cmd(
        "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)}
    )
    rules.run(
        "document.querySelectorAll('#panel-rules details').forEach((it) => it.setAttribute('open', ''));"
        "const label = document.querySelector('#panel-rules [title=\"blinks.period\"]');"
        "const box = document.getElementById(label.htmlFor);"
        "box.value = 2; box.dispatchEvent(new Event('change'));"
    )
    rules.wait(f"{SETTLED} && studio.store.get('take').made.choices.profile_text !== null")
    rules.picture("profile-numbers")
    rules.driver.find_element(By.ID, "export-profile").click()
    file = waited(lambda: next(tmp_path.glob("*.toml"), None), "the profile", 20.0)
    assert "period = 2" in file.read_text()
