"""The page that plays a performance from a file, in a real browser."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from risorius.take import Take

from .driving import WITHOUT_WEBGL, Page, open_browser

CLICK = """
  const block = [...document.querySelectorAll(".block")].find((one) => one.block.targets?.masseter);
  const { left, top } = block.getBoundingClientRect();
  block.dispatchEvent(new MouseEvent("click", { bubbles: true, clientX: left + 1, clientY: top + 1 }));
"""


@pytest.fixture(scope="module")
def written(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("played") / "x.html"
    clip.write(path)
    return path


@pytest.fixture
def played(browser_page: Page, written: Path) -> Iterator[Page]:
    driver = browser_page.driver
    # The browser may still be fetching the icon of the page before.
    driver.get("about:blank")
    driver.get(written.as_uri())
    browser_page.wait("window.played?.stage.drawn && document.getElementById('note').textContent === ''")
    yield browser_page
    driver.get("about:blank")
    browser_page.session = ""


def test_the_page_plays_from_a_file_and_a_click_explains(played: Page, written: Path) -> None:
    assert written.stat().st_size < 8e6
    # On a busy machine the sound may have ended before it is asked for.
    played.run("""
      const { clock } = window.played;
      window.heard = 0;
      clock.on("tick", () => (heard ||= clock.sounding ?? 0));
      clock.play();
    """)
    played.wait("window.heard > 0 && !window.played.clock.playing")
    assert played.get("window.played.clock.time === window.played.facts.duration")
    played.run(CLICK)
    assert "from lips: /" in played.get("document.getElementById('explanation').textContent")
    assert played.get("document.title") == "Oh, my mother!"
    fetched = played.get("performance.getEntriesByType('resource').map((entry) => entry.name)")
    assert all(name.startswith(("data:", "blob:")) for name in fetched)
    assert played.complaints() == []


def test_without_a_graphics_card_the_coarse_head_plays(played: Page) -> None:
    drawn = played.get("window.played.stage.drawn")
    played.run("window.played.clock.seek(0.5)")
    played.wait(f"window.played.stage.drawn > {drawn}")
    triangles = played.run("""
      const { group } = window.played.figure;
      let count = 0;
      group.traverse(({ visible, geometry }) => {
        if (visible && geometry?.index) count += geometry.index.count / 3;
      });
      return count;
    """)
    assert 1_000 < triangles < 60_000


def test_without_webgl_the_file_is_heard_and_explained(written: Path, tmp_path: Path) -> None:
    driver = open_browser(tmp_path, WITHOUT_WEBGL)
    try:
        page = Page(driver, written.as_uri())
        driver.get(written.as_uri())
        page.wait("window.played && !document.getElementById('play').disabled")
        assert "no WebGL 2" in page.get("document.getElementById('note').textContent")
        page.run(f"window.played.clock.seek(0.5); {CLICK}")
        assert "from lips: /" in page.get("document.getElementById('explanation').textContent")
        page.run("window.played.clock.play()")
        page.wait("window.played.clock.time > 0.8")
        assert page.complaints() == []
    finally:
        driver.quit()
