"""How quick the studio's page is in headless Chromium, which draws by software, at 1280 × 720.

A real server and a real browser on this machine. Prints pictures per second while a line plays whose faces
are there, milliseconds from pressing play on a new line to its sound, and from moving a dial to the picture
of the face (median of twenty, the slowest in brackets); and what else the machine was doing. Needs Chromium
and its driver (`scripts/test --browser` installs them). Run from the repository:
    PYTHONPATH=src:tests/studio python benchmarks/studio_page.py
"""

from __future__ import annotations

import os
import statistics
import tempfile
import threading
from pathlib import Path

import uvicorn
from browser.driving import SIZE, Page, open_browser, waited

from risorius.studio.app import Studio
from risorius.studio.server import bound, configured

LINE = (
    "Oh really? I like it very much, and I would do it again tomorrow if anybody asked me to come along, "
    "but not today, because there is so much left to do before the evening."
)
TIMES = 20
WRITE = """
const box = document.getElementById("script");
box.value = arguments[0];
box.dispatchEvent(new Event("input"));
"""
TO_SOUND = """
const begun = performance.now();
document.getElementById("play").click();
while (!studio.clock.sounding) await new Promise((go) => setTimeout(go, 2));
return performance.now() - begun;
"""
PER_SECOND = """
const { stage, players } = studio.theatre;
studio.clock.pause();
while (players[0].held < 200) await new Promise((go) => setTimeout(go, 50));
studio.clock.seek(0);
studio.clock.play();
const [drawn, begun] = [stage.drawn, performance.now()];
await new Promise((go) => setTimeout(go, 6000));
return (1000 * (stage.drawn - drawn)) / (performance.now() - begun);
"""
TO_PICTURE = """
const { stage, figures } = studio.theatre;
const bar = document.querySelector('input[type=range][aria-label="19 masseter"]');
const before = figures[0].skin.slice();
const begun = performance.now();
bar.value = arguments[0];
bar.dispatchEvent(new Event("input"));
const frame = () => new Promise((go) => requestAnimationFrame(go));
while (!figures[0].skin.some((value, k) => value !== before[k])) await frame();
const drawn = stage.drawn;
while (stage.drawn === drawn) await frame();
return performance.now() - begun;
"""


def main() -> None:
    """Measure and print."""
    with tempfile.TemporaryDirectory() as folder:
        listening = bound(0)
        server = uvicorn.Server(configured(Studio(Path(folder) / "sessions")))
        threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True).start()
        waited(lambda: server.started, "the server", 60.0)
        driver = open_browser(Path(folder) / "profile")
        try:
            measure(Page(driver, f"http://127.0.0.1:{listening.getsockname()[1]}/"))
        finally:
            driver.quit()
            server.should_exit = True


def measure(page: Page) -> None:
    """Measure on a page and print."""
    page.open("benchmark")
    page.run(WRITE, "First, something short to warm up.")
    page.wait("!document.getElementById('play').disabled")
    page.run(TO_SOUND)
    page.wait("!studio.clock.playing")
    page.run(WRITE, LINE)
    print(f"play pressed to sound, a line of about ten seconds  {page.run(TO_SOUND):6.0f} ms")
    print(f"pictures per second at {SIZE[0]} × {SIZE[1]}                {page.run(PER_SECOND):6.1f}")
    page.run("document.querySelectorAll('#panel [role=tab]')[1].click(); studio.clock.pause()")
    times = [page.run(TO_PICTURE, 0.2 + 0.03 * k) for k in range(TIMES)]
    print(f"dial moved to picture       {statistics.median(times):6.0f} ms ({max(times):.0f})")
    print(f"load of the machine's {os.cpu_count()} cores meanwhile  {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
