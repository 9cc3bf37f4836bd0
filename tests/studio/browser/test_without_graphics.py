"""Without a graphics card, and without any WebGL, the studio works; the server draws its stage."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from selenium.webdriver.common.by import By

from .acts import LINE, SETTLED, open_panel, slide, type_line
from .driving import WITHOUT_WEBGL, Page, open_browser

HEADS = "studio.headPlayers"
REASON = "document.getElementById('drawn-by').textContent"
# The mean of what is opaque on the stage, and how much that is.
SEEN = """
  const canvas = document.getElementById("head");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let [sum, count] = [0, 0];
  for (let k = 0; k < data.length; k += 4) {
    if (data[k + 3]) [sum, count] = [sum + data[k] + data[k + 1] + data[k + 2], count + 1];
  }
  return [sum / Math.max(count, 1) / 3, (4 * count) / data.length];
"""
# Counts pictures that are asked for, and how many are in flight at once.
FLIGHTS = """
  const { fetch } = window;
  window.flights = { now: 0, most: 0, all: 0 };
  window.fetch = async (address, ...rest) => {
    if (!String(address).startsWith("/picture.webp")) return fetch(address, ...rest);
    flights.all += 1;
    flights.most = Math.max(flights.most, ++flights.now);
    try {
      return await fetch(address, ...rest);
    } finally {
      flights.now -= 1;
    }
  };
"""


@pytest.fixture(scope="module")
def without(studio_url: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    driver = open_browser(tmp_path_factory.mktemp("without"), WITHOUT_WEBGL)
    yield Page(driver, studio_url, graphics="")
    driver.quit()


def perform(page: Page, session: str) -> None:
    page.open(session)
    type_line(page, LINE)
    page.driver.find_element(By.ID, "perform").click()
    page.wait(f"studio.store.get('take') !== null && {SETTLED} && {HEADS}.drawn > 0")


def picture(page: Page) -> list[float]:
    """Return what is seen once no picture is awaited."""
    page.run("for (let k = 0; k < 3; k++) await new Promise(requestAnimationFrame)")
    page.wait(f"!{HEADS}.awaits")
    return list(page.run(SEEN))


def test_without_webgl_a_line_is_performed_edited_and_exported(without: Page) -> None:
    page = without
    perform(page, "without-webgl")
    assert "no WebGL 2" in page.get(REASON)
    _, covered = picture(page)
    assert 0.1 < covered < 0.9
    block = page.get("studio.store.get('take').blocks.find(({ channel }) => channel === 'signals').id")
    page.run("await studio.actions.edit('delete', { movement: arguments[0] })", block)
    assert "delete" in page.get("studio.store.get('take').undoes")
    assert block not in page.get("studio.store.get('take').blocks.map(({ id }) => id)")
    open_panel(page, "Project")
    page.run("document.querySelectorAll('.outputs input:checked').forEach((box) => box.click())")
    page.run("document.querySelector('[data-suffix=\".muscles.csv\"] input').click()")
    page.driver.find_element(By.ID, "export").click()
    page.wait("document.querySelectorAll('#jobs a').length > 0", 120.0)
    assert page.complaints() == []
    page.picture("without-webgl")


def test_the_server_draws_the_camera_the_time_the_dials_and_a_comparison(without: Page) -> None:
    page = without
    perform(page, "pictures")
    seen = [picture(page)]
    for change in (
        "studio.view.choose('mouth')",
        "studio.view.choose('front'); studio.clock.seek(1.2)",
        "studio.store.set({ other: { ...studio.store.get('take'), label: 'other' } })",
    ):
        page.run(change)
        seen.append(picture(page))
    page.run("studio.store.set({ other: null })")
    open_panel(page, "Dials")
    slide(page, "19 masseter", 1.0)
    page.wait("studio.store.get('dialled')?.masseter === 1")
    seen.append(picture(page))
    assert len({(round(mean, 2), round(covered, 4)) for mean, covered in seen}) == len(seen), seen
    assert page.complaints() == []


def test_one_picture_at_a_time_is_asked_for_however_much_is_scrubbed(without: Page) -> None:
    page = without
    perform(page, "scrubbed")
    page.run(FLIGHTS)
    page.run("""
      for (let k = 0; k < 2000; k++) {
        studio.clock.seek((k % 90) / 30);
        if (k % 100 === 0) await new Promise((go) => setTimeout(go, 10));
      }
    """)
    page.wait("flights.now === 0")
    flights = page.get("flights")
    assert flights["most"] == 1
    assert flights["all"] < 200
    before = page.get(f"{HEADS}.drawn")
    page.run("studio.clock.seek(0); studio.clock.play()")
    page.wait("!studio.clock.playing")
    assert page.get(f"{HEADS}.drawn") > before


def test_where_the_processor_draws_the_server_does(page: Page) -> None:
    page.driver.get("about:blank")
    page.driver.get(f"{page.url}#by-processor")
    page.session = ""
    page.wait("window.studio?.store.get('catalogue') && window.studio.store.get('link') === 'up'")
    assert "No graphics card" in page.get(REASON)
    page.wait(f"{HEADS}.drawn > 0")
