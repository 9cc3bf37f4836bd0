"""Exports, and the project: nothing is lost."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from selenium.webdriver.common.by import By

from .acts import SETTLED, SHOWN, choose, open_panel, perform, type_line, values
from .driving import Page

CURVES = "Object.fromEntries(Object.entries(studio.store.get('take').curves).map(([n, c]) => [n, [...c]]))"


def test_an_export_shows_its_progress_and_gives_its_files(performed: Page) -> None:
    open_panel(performed, "Project")
    performed.run("document.querySelectorAll('.outputs input:checked').forEach((box) => box.click())")
    assert not performed.driver.find_element(By.ID, "export").is_enabled()
    for suffix in (".muscles.csv", ".TextGrid"):
        performed.run(f"document.querySelector('[data-suffix=\"{suffix}\"] input').click()")
    performed.run("window.told = []; studio.connection.on('progress', ({ job }) => job && told.push(job))")
    performed.driver.find_element(By.ID, "export").click()
    performed.wait("document.querySelectorAll('#jobs a').length === 3", 120.0)
    seen, shown = performed.get(
        "['#jobs', '#panel-project'].map((name) => document.querySelector(name).getBoundingClientRect().top)"
    )
    assert seen >= shown
    assert performed.get("told.length") > 0
    performed.picture("exported")
    table = performed.run("return (await fetch(document.querySelectorAll('#jobs a')[1].href)).text()")
    rows = table.splitlines()
    assert rows[0].startswith("time_s,zygomatic_major.left,")
    assert len(rows) - 1 == values(performed, "take")[0]["frames"]


@pytest.mark.full
def test_an_export_that_is_stopped_leaves_nothing(page: Page) -> None:
    perform(page)
    open_panel(page, "Project")
    page.run("document.querySelectorAll('.outputs input:checked').forEach((box) => box.click())")
    page.run("document.querySelector('[data-suffix=\".mp4\"] input').click()")
    page.driver.find_element(By.ID, "export").click()
    page.wait("document.querySelector('#jobs progress')")
    page.run("document.querySelector('#jobs button').click()")
    page.wait("document.querySelector('#jobs .bad')", 120.0)
    assert page.get("document.querySelectorAll('#jobs a').length") == 0


def test_what_a_project_replaces_can_be_put_back(performed: Page, tmp_path: Path) -> None:
    before = performed.get(CURVES)
    text = performed.run(
        "const made = await studio.connection.request('project'); return (await fetch(made.path)).text()"
    )
    other = json.loads(text)
    other["made"]["source"]["script"] = "Another file."
    file = tmp_path / "other.risorius.json"
    file.write_text(json.dumps(other), encoding="utf-8")
    type_line(performed, "A draft.")
    open_panel(performed, "Project")
    performed.driver.find_element(By.CSS_SELECTOR, "#panel-project input[type=file]").send_keys(str(file))
    performed.wait("studio.store.get('source').script === 'Another file.'")
    performed.wait("document.querySelector('#notice button')?.textContent === 'Restore'")
    performed.driver.find_element(By.CSS_SELECTOR, "#notice button").click()
    performed.wait("studio.store.get('take').made.source.script === studio.store.get('source').script")
    assert performed.get(CURVES) == before
    assert performed.get("studio.store.get('aside').source.script") == "A draft."
    performed.run("studio.store.set({ aside: null })")


@pytest.mark.full
def test_a_reload_shows_the_same(page: Page) -> None:
    perform(page)
    choose(page, "perform", "profile", "lively")
    page.wait(f"studio.store.get('take').made.choices.profile === 'lively' && {SETTLED}")
    open_panel(page, "Rules")
    page.run(
        "studio.view.choose('side'); studio.clock.seek(1); await new Promise((go) => setTimeout(go, 1200))"
    )
    before = page.get(CURVES)
    page.open(page.get("location.hash.slice(1)"))
    page.wait(f"studio.store.get('take') !== null && {SHOWN}")
    assert page.get(CURVES) == before
    assert page.get("studio.view.state.turn") == 90
    assert page.get("studio.clock.time") == 1
    assert page.get("studio.store.get('tab')") == "rules"
    assert values(page, "source")[0]["script"] == "Oh really? I like it very much."


def test_a_project_file_opens_again_exactly(page: Page, tmp_path: Path) -> None:
    perform(page)
    before = page.get(CURVES)
    text = page.run(
        "const made = await studio.connection.request('project'); return (await fetch(made.path)).text()"
    )
    assert json.loads(text)["risorius_project"] == 1
    file = tmp_path / "mine.risorius.json"
    file.write_text(text, encoding="utf-8")
    page.open("another-session")
    assert page.get("studio.store.get('take')") is None
    open_panel(page, "Project")
    page.driver.find_element(By.CSS_SELECTOR, "#panel-project input[type=file]").send_keys(str(file))
    page.wait("studio.store.get('take') !== null")
    assert page.get(CURVES) == before


def test_a_file_that_is_no_project_is_refused_in_one_line(performed: Page, tmp_path: Path) -> None:
    file = tmp_path / "broken.json"
    file.write_text('{"risorius_project": 99}', encoding="utf-8")
    open_panel(performed, "Project")
    performed.driver.find_element(By.CSS_SELECTOR, "#panel-project input[type=file]").send_keys(str(file))
    performed.wait("!document.querySelector('#notice').hidden")
    assert "\n" not in performed.get("document.querySelector('#notice span').textContent").strip()
    # Read here, or the tests after this one would find it.
    (refused,) = performed.complaints()
    assert "400 (Bad Request)" in refused


def test_sessions_are_listed_named_copied_and_deleted(performed: Page) -> None:
    rows = "document.querySelectorAll('#sessions li').length"
    open_panel(performed, "Project")
    performed.wait(f"{rows} > 0")
    here = performed.get("studio.store.get('session')")
    # Each button is found and pressed at once: the list is made anew when other sessions are saved.
    button = """const row = document.querySelector(`#sessions li[data-session='${arguments[0]}']`);
      const button = [...row.querySelectorAll("button")].find((it) => it.textContent === arguments[1]);"""
    assert performed.run(f"{button} return button.disabled", here, "Delete")
    known = performed.run("return (await (await fetch('/api/sessions')).json()).map((it) => it.session)")
    performed.run(f"{button} button.click()", here, "Copy")
    performed.wait("[...document.querySelectorAll('#sessions input')].some(({ value }) => value === 'Copy')")
    performed.picture("sessions")
    now = performed.run("return (await (await fetch('/api/sessions')).json()).map((it) => it.session)")
    (copied,) = set(now) - set(known)
    performed.run(f"{button} button.click()", copied, "Delete")
    performed.wait(f"!document.querySelector('#sessions li[data-session={copied}]')")
    assert "Restore" in performed.get("document.querySelector('#notice').textContent")
