"""Recordings: made with the microphone, and words that were recognized, to be corrected."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By

from .acts import SETTLED, SHOWN, perform
from .driving import Page

WRITTEN = "studio.store.get('source').script"


@pytest.mark.full
def test_a_line_is_recorded_with_the_microphone(page: Page) -> None:
    record = page.driver.find_element(By.ID, "record")
    record.click()
    page.wait("document.getElementById('record').ariaPressed === 'true'")
    page.run("await new Promise((go) => setTimeout(go, 1500))")
    page.driver.find_element(By.ID, "record").click()
    page.wait("studio.store.get('source').recording !== null")
    assert page.get("studio.store.get('source').recording").startswith("recorded-")
    page.wait(SETTLED)


@pytest.mark.full
def test_words_that_were_recognized_are_written_to_be_corrected(page: Page) -> None:
    perform(page, "Seven eight nine ten.")
    page.run("""
      const sound = await (await fetch(studio.store.get("take").speech.sound)).blob();
      studio.store.set({ source: { script: "", format: "text", recording: null, edges: [] } });
      const { upload } = await import("/web/panels/recording.js");
      await upload(studio, new File([sound], "seven.wav"));
    """)
    page.wait(f"studio.store.get('take').made.source.recording && {SETTLED} && {SHOWN}")
    assert page.get(WRITTEN) == ""
    page.driver.find_element(By.ID, "recognized").click()
    words = page.get(WRITTEN)
    assert words == page.get("studio.store.get('take').speech.text")
    assert words
    assert not page.driver.find_elements(By.ID, "recognized")
