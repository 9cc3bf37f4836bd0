"""How quick the studio's page is in headless Chromium, which draws by software, at 1280 × 720.

A real server and a real browser on this machine. Prints pictures per second while a line plays whose faces
are there, milliseconds from pressing play on a new line to its sound, and from turning a dial to the picture
of that face (medians, the slowest in brackets): until the face has come, until the picture is handed over to
be drawn, until it is drawn, and how long drawing by software takes of that; and what else the machine was
doing. Needs Chromium and its driver (`scripts/test --browser` installs them). Run from the repository:
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
STAGES = ("to its face in the page", "to the picture handed over", "to the picture drawn", "drawing alone")
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
WATCH = """
const { stage, figures } = studio.theatre;
const gl = document.getElementById("head").getContext("webgl2");
const sent = (window.sent = []);       // [number of a dial's request, when it was turned]
const drawn = (window.drawn = []);     // {number: the newest face in the picture, come, drawn, seen}
let [number, come] = [0, 0];
const send = WebSocket.prototype.send;
WebSocket.prototype.send = function (text) {
  if (JSON.parse(text).do === "dial") sent.push([JSON.parse(text).id, window.turned]);
  send.call(this, text);
};
const figure = Object.getPrototypeOf(figures[0]);
const ready = figure.ready;
figure.ready = function (...given) {
  ready.apply(this, given);
  const one = { number, come };
  queueMicrotask(() => {
    Object.assign(one, { drawn: performance.now() });
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) return setTimeout(look, 1);
      drawn.push({ ...one, seen: performance.now() });
    };
    look();
  });
};
studio.connection.on("binary", (buffer) => {
  const [kind, given] = new Uint32Array(buffer, 0, 2);
  if (kind === 2) [number, come] = [given, performance.now()];
});
window.turn = (value) => {
  const bar = document.querySelector('input[type=range][aria-label="19 masseter"]');
  window.turned = performance.now();
  bar.value = value;
  bar.dispatchEvent(new Event("input"));
};
window.taken = (id, at) => {
  const { come, drawn: put, seen } = drawn.find(({ number }) => number >= id);
  return [come - at, put - at, seen - at, seen - put];
};
"""
TURNED = """
const before = sent.length;
turn(arguments[0]);
const pause = () => new Promise((go) => setTimeout(go, 5));
while (sent.length === before || !drawn.some(({ number }) => number >= sent[before][0])) await pause();
await new Promise((go) => setTimeout(go, 2600));
return taken(...sent[before]);
"""
DRAGGED = """
const from = sent.length;
for (let k = 0; k < 90; k++) {
  turn(0.5 + 0.4 * Math.sin(k / 7));
  await new Promise((go) => setTimeout(go, 33));
}
await new Promise((go) => setTimeout(go, 1500));
return sent.slice(from).map((one) => taken(...one));
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
    page.run(WATCH)
    page.run(TURNED, 0.1)
    tell("a dial turned", [page.run(TURNED, 0.2 + 0.03 * k) for k in range(TIMES)])
    tell("a dial dragged for 3 s", page.run(DRAGGED))
    print(f"load of the machine's {os.cpu_count()} cores meanwhile  {os.getloadavg()[0]:.1f}")


def tell(what: str, found: list[list[float]]) -> None:
    """Print when a dial's face has come, was handed over to be drawn, was drawn, and how long that took."""
    for name, times in zip(STAGES, zip(*found, strict=True), strict=True):
        print(f"{what} {name:26}{statistics.median(times):6.0f} ms ({max(times):.0f})")


if __name__ == "__main__":
    main()
