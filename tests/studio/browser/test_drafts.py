"""What is written but not performed is never lost."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By

from .acts import SETTLED, perform, type_line
from .driving import Page

WRITTEN = "document.getElementById('script').value"
DRAFT = "A sentence that nobody has performed."
SAVED = f"{SETTLED} && studio.store.get('draft') === 'saved'"


def test_a_draft_outlasts_a_lost_connection_another_tab_and_undo(performed: Page) -> None:
    line = performed.get(WRITTEN)
    type_line(performed, DRAFT)
    performed.run("""
      const { connection } = studio;
      const down = new Promise((go) => connection.on("down", go));
      connection.drop();
      await down;
    """)
    performed.wait("studio.store.get('link') === 'up'")
    performed.wait(f"{SAVED}")
    assert performed.get(WRITTEN) == DRAFT
    # Another tab performs something else.
    performed.run("""
      const socket = new WebSocket(`ws://${location.host}/ws/${studio.store.get("session")}`);
      await new Promise((go) => { socket.onopen = go; });
      const done = new Promise((go) => {
        socket.onmessage = ({ data }) => JSON.parse(data).re === 1 && go();
      });
      socket.send(JSON.stringify({ id: 1, do: "perform", source: { script: "Two." } }));
      await done;
      socket.close();
    """)
    performed.wait("studio.store.get('take').made.source.script === 'Two.'")
    assert performed.get(WRITTEN) == DRAFT
    assert "kept" in performed.get("document.querySelector('#notice span').textContent")
    performed.driver.find_element(By.ID, "undo").click()
    performed.wait(f"studio.store.get('take').made.source.script === {line!r}")
    assert performed.get(WRITTEN) == DRAFT
    performed.driver.find_element(By.ID, "draft-aside").click()


@pytest.mark.full
def test_a_draft_outlasts_a_reload(page: Page) -> None:
    perform(page, "One.")
    type_line(page, DRAFT)
    page.open(page.get("location.hash.slice(1)"))
    assert page.get("studio.store.get('take').made.source.script") == "One."
    assert page.get(WRITTEN) == DRAFT
    page.wait(f"{SAVED}")
    # Without what this tab remembers, as after a crash: the server has it.
    page.run("sessionStorage.clear()")
    page.open(page.get("location.hash.slice(1)"))
    assert page.get(WRITTEN) == DRAFT
    # What is put aside at the last moment does not come back.
    page.driver.find_element(By.ID, "draft-aside").click()
    page.open(page.get("location.hash.slice(1)"))
    assert page.get(WRITTEN) == "One."


def test_a_draft_is_put_aside_and_brought_back(performed: Page) -> None:
    line = performed.get(WRITTEN)
    type_line(performed, DRAFT)
    performed.driver.find_element(By.ID, "draft-aside").click()
    assert performed.get(WRITTEN) == line
    performed.driver.find_element(By.ID, "draft-back").click()
    assert performed.get(WRITTEN) == DRAFT
    performed.driver.find_element(By.ID, "draft-aside").click()


def test_changes_by_hand_follow_the_text_or_can_be_brought_back(performed: Page) -> None:
    word = "studio.store.get('take').speech.words.find(({ text }) => text === 'very')"
    edited = "studio.store.get('take').blocks.filter((block) => block.edited)"
    performed.run(f"""
      const {{ start, end }} = {word};
      await studio.actions.edit("add", {{ channel: "signals", start, end, targets: {{ AU1: 0.8 }} }});
    """)
    perform(performed, "Well, I like it very much!")
    assert performed.get(f"{edited}.length") == 1
    assert performed.get(f"Math.abs({edited}[0].start - {word}.start) < 0.001")
    perform(performed, "Well, I like it!")
    assert performed.get(f"{edited}.length") == 0
    assert "did not fit" in performed.get("document.querySelector('#notice span').textContent")
    performed.picture("lost")
    performed.driver.find_element(By.CSS_SELECTOR, "#lost li button").click()
    performed.wait(f"{edited}.length === 1")
    assert performed.get("document.getElementById('lost').hidden")
