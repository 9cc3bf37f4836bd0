"""Driving the studio's page in a real browser."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains

CHROMIUM, DRIVER = Path("/usr/bin/chromium"), Path("/usr/bin/chromedriver")
ARTEFACTS = Path(__file__).parent / "artefacts"
SIZE = (1280, 720)
_FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader-webgl",  # for WebGL alone: the page itself is drawn for less
    "--enable-unsafe-swiftshader",
    "--autoplay-policy=no-user-gesture-required",
    "--use-fake-device-for-media-stream",  # a microphone that beeps
    "--use-fake-ui-for-media-stream",
)
_NO_WEBGL = ("--disable-gpu", "--disable-webgl", "--disable-3d-apis")
WITHOUT_WEBGL = (*(flag for flag in _FLAGS if "swiftshader" not in flag and "gl=" not in flag), *_NO_WEBGL)
"""Flags of a browser that cannot draw in 3D."""


def open_browser(profile: Path, flags: tuple[str, ...] = _FLAGS) -> Chrome:
    """Return a browser with a profile of its own, its page 1280 by 720."""
    options = ChromeOptions()
    options.binary_location = str(CHROMIUM)
    for flag in (*flags, f"--user-data-dir={profile}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = Chrome(options=options, service=Service(str(DRIVER)))
    driver.set_script_timeout(120)
    metrics = {"width": SIZE[0], "height": SIZE[1], "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    return driver


class Page:
    """The studio's page in the browser."""

    def __init__(self, driver: Chrome, url: str, graphics: str = "coarse") -> None:
        """`graphics` is how the page draws: the coarse head, which comes in time, unless told."""
        self.driver, self.url, self.graphics = driver, url, graphics
        self.session = ""

    def open(self, session: str) -> None:
        """Show a session, and wait until the page has its server: its buttons are dead before."""
        self.session = session
        self.driver.get("about:blank")
        self.driver.get(f"{self.url}?graphics={self.graphics}#{session}")
        self.wait("window.studio?.store.get('catalogue') && window.studio.store.get('link') === 'up'")

    def run(self, body: str, *given: Any) -> Any:
        """Return what an asynchronous function with this body returns; `given` are its `arguments`."""
        answer = self.driver.execute_async_script(
            "const tell = arguments[arguments.length - 1];"
            f"(async function () {{ {body} }}).apply(null, arguments).then("
            "(ok) => tell({ ok: ok === undefined ? null : ok }),"
            "(error) => tell({ error: String(error.stack) }));",
            *given,
        )
        assert "error" not in answer, answer["error"]
        return answer["ok"]

    def get(self, expression: str) -> Any:
        """Return the value of an expression."""
        return self.run(f"return {expression}")

    def wait(self, expression: str, seconds: float = 180.0) -> Any:
        """Return an expression's value as soon as it is true."""
        return waited(lambda: self.get(expression), expression, seconds)

    def actions(self) -> ActionChains:
        """Return a chain of inputs that happen without delay."""
        return ActionChains(self.driver, duration=10)

    def picture(self, name: str) -> None:
        """Keep what is seen."""
        ARTEFACTS.mkdir(exist_ok=True)
        self.driver.save_screenshot(str(ARTEFACTS / f"{name}.png"))

    def complaints(self) -> list[str]:
        """Return what the browser's console has complained of since the last call."""
        return [str(e["message"]) for e in self.driver.get_log("browser") if e["level"] == "SEVERE"]


def waited(ask: Callable[[], Any], what: str, seconds: float) -> Any:
    """Return an answer as soon as it is true; fail, saying what was waited for."""
    end = time.monotonic() + seconds
    while True:
        answer = ask()
        if answer:
            return answer
        assert time.monotonic() < end, f"waited {seconds:g} s in vain for {what}"
        time.sleep(0.05)
