"""What a newcomer meets: an example, hints, and what is said of a text that is not what it seems."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.by import By

from .acts import type_line
from .driving import Page

HINT = "document.querySelector('#hints p')?.textContent ?? ''"


@pytest.mark.full
def test_an_example_plays_on_a_click_and_three_hints_follow(page: Page) -> None:
    page.picture("empty")
    page.driver.find_element(By.ID, "example").click()
    page.wait("studio.clock.time > 0.2")
    page.wait("document.getElementById('hints')")
    assert not page.driver.find_element(By.ID, "example").is_displayed()
    page.picture("hints")
    seen = []
    for _ in range(3):
        seen.append(page.get(HINT))
        page.driver.find_elements(By.CSS_SELECTOR, "#hints button:not([hidden])")[0].click()
    assert [hint[:7] for hint in seen] == ["1 of 3:", "2 of 3:", "3 of 3:"]
    assert page.get("document.querySelectorAll('#hints, [data-hinted]').length") == 0


def test_tags_in_plain_text_are_named_and_read_or_taken_out(performed: Page) -> None:
    source = "(({ script, format }) => [script, format])(studio.store.get('source'))"
    line = performed.get("studio.store.get('source').script")
    assert not performed.driver.find_element(By.ID, "tags").is_displayed()
    type_line(performed, "I am <emphasis>sure</emphasis>.")
    assert performed.driver.find_element(By.ID, "tags").is_displayed()
    performed.driver.find_element(By.ID, "tags-read").click()
    assert performed.get(source) == ["<speak>I am <emphasis>sure</emphasis>.</speak>", "ssml"]
    performed.run("studio.store.set({ source: { ...studio.store.get('source'), format: 'text' } })")
    performed.driver.find_element(By.ID, "tags-out").click()
    assert performed.get(source) == ["I am sure.", "text"]
    type_line(performed, line)
