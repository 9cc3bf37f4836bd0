"""A real server and a real browser, started once."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from ..running import running
from .acts import LINE, SHOWN, open_panel, perform, restore
from .driving import CHROMIUM, DRIVER, Page, open_browser

PERFORMED = "performed"


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave the browser's tests out if it is missing, and put those first that share the line performed."""
    here = [place for place, item in enumerate(items) if Path(__file__).parent in item.path.parents]
    browsed = sorted((items[place] for place in here), key=_opens_own_page)
    for place, item in zip(here, browsed, strict=True):
        items[place] = item
    if CHROMIUM.exists() and DRIVER.exists():
        return
    reason = "chromium and chromium-driver are not here: scripts/test --browser installs them"
    for item in browsed:
        item.add_marker(pytest.mark.skip(reason=reason))


def _opens_own_page(item: pytest.Item) -> int:
    """Tests of parts take the page that they find."""
    names = getattr(item, "fixturenames", ())
    return 0 if "performed" in names else 1 if "any_page" in names else 2


@pytest.fixture(scope="session")
def studio_url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running(tmp_path_factory.mktemp("studio")) as (_, port):
        yield f"http://127.0.0.1:{port}/"


@pytest.fixture(scope="session")
def browser_page(studio_url: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    driver = open_browser(tmp_path_factory.mktemp("profile"))
    yield Page(driver, studio_url)
    driver.quit()


@pytest.fixture
def performed(browser_page: Page) -> Iterator[Page]:
    """The page with `LINE` performed, which tests share: what one changes is taken back."""
    if browser_page.session != PERFORMED:
        browser_page.open(PERFORMED)
        browser_page.run("await studio.connection.request('open')")
        if browser_page.get("studio.store.get('take')?.made.source.script") == LINE:
            # The page opens with the panel and at the time that it was left with.
            browser_page.run("studio.clock.seek(0)")
            browser_page.wait(SHOWN)
            open_panel(browser_page, "Perform")
        else:
            perform(browser_page)
    yield browser_page
    restore(browser_page)


@pytest.fixture(scope="module")
def any_page(browser_page: Page) -> Page:
    """A page for tests of its parts alone, which leave it as it is."""
    if not browser_page.session:
        browser_page.open("parts")
    return browser_page


@pytest.fixture
def page(browser_page: Page, request: pytest.FixtureRequest) -> Page:
    """The page with a session of its own, nothing performed yet."""
    name = "".join(c if c.isalnum() else "-" for c in request.node.name.lower())
    browser_page.open(name.strip("-")[:40].rstrip("-"))
    return browser_page
