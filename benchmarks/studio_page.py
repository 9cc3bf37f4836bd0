"""How quick the studio's page is in headless Chromium, which draws by software, at 1280 × 720.

A real server and a real browser on this machine. Prints milliseconds from pressing play on a new line until
it is heard and until its first picture is drawn; pictures per second while a line plays whose faces are
there, and the milliseconds of the page's main thread that each takes; pictures per second and the longest
wait while somebody scrubs through five minutes; milliseconds from turning a dial to the picture of that face
(medians, the slowest in brackets): until the face has come, until the picture is handed over to be drawn,
until it is drawn, and how long drawing by software takes of that; and what else the machine was doing. Needs
Chromium and its driver (`scripts/test --browser` installs them). Run from the repository:
    PYTHONPATH=src:tests/studio python benchmarks/studio_page.py
"""

from __future__ import annotations

import os
import statistics
import tempfile
import threading
import time
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
PLAYS = 7
MINUTES_5 = 30  # lines
LONGEST = 60_000.0  # ms for which a line is waited for
STAGES = ("to its face in the page", "to the picture handed over", "to the picture drawn", "drawing alone")
WRITE = """
const box = document.getElementById("script");
box.value = arguments[0];
box.dispatchEvent(new Event("input"));
"""
PLAYED = """
const { clock, store, headPlayers: { figures, players } } = studio;
const gl = document.getElementById("head").getContext("webgl2");
const [begun, before, wait] = [performance.now(), store.get("take"), arguments[0]];
let [heard, seen, fence] = [null, null, null];
const figure = Object.getPrototypeOf(figures[0]);
const { ready } = figure;
figure.ready = function (...given) {
  ready.apply(this, given);
  if (fence === null && store.get("take") !== before && !players[0].behind) {
    queueMicrotask(() => {
      fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      gl.flush();
    });
  }
};
document.getElementById("play").click();
while (heard === null || seen === null) {
  await new Promise((go) => setTimeout(go, 1));
  const now = performance.now() - begun;
  if (now > wait) throw new Error(`not heard and seen: ${document.getElementById("notice").textContent}`);
  if (heard === null && clock.sounding) heard = now;
  if (fence && seen === null && gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED) seen = now;
}
figure.ready = ready;
return [heard, seen];
"""
PER_SECOND = """
const { stage, players } = studio.headPlayers;
studio.clock.pause();
while (players[0].held < 200) await new Promise((go) => setTimeout(go, 50));
studio.clock.seek(0);
studio.clock.play();
const [drawn, begun] = [stage.drawn, performance.now()];
await new Promise((go) => setTimeout(go, 6000));
return (1000 * (stage.drawn - drawn)) / (performance.now() - begun);
"""
SCRUBBED = """
const { clock, headPlayers: { stage } } = studio;
clock.pause();
const [begun, end, drawn] = [performance.now(), clock.duration, stage.drawn];
let [last, count, longest] = [begun, drawn, 0];
for (let now = begun; now < begun + 6000; now = performance.now()) {
  clock.seek(end * (0.5 - 0.5 * Math.cos((now - begun) / 1500)));
  await new Promise((go) => requestAnimationFrame(go));
  if (stage.drawn !== count) {
    longest = Math.max(longest, performance.now() - last);
    [last, count] = [performance.now(), stage.drawn];
  }
}
return [(1000 * (count - drawn)) / (last - begun), longest];
"""
WATCH = """
const { stage, figures } = studio.headPlayers;
const gl = document.getElementById("head").getContext("webgl2");
const sent = (window.sent = []);       // [number of a dial's request, when it was turned]
const drawn = (window.drawn = []);     // {number: the newest face in the picture, come, drawn, seen}
let [number, come] = [0, 0];
const send = WebSocket.prototype.send;
const noted = (event) => {             // before the page hears it, which may draw at once
  if (!(event.data instanceof ArrayBuffer)) return;
  const [kind, given] = new Uint32Array(event.data, 0, 2);
  if (kind === 2) [number, come] = [given, performance.now()];
};
WebSocket.prototype.send = function (text) {
  if (!this.noted) {
    const { onmessage } = this;
    this.noted = true;
    this.onmessage = (event) => { noted(event); onmessage.call(this, event); };
  }
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
    page.driver.find_element("id", "script").send_keys("First, something short.")
    page.wait("!document.getElementById('play').disabled && Boolean(studio.headPlayers.figures[0])")
    first = page.run(PLAYED, LONGEST)
    print(f"the first line of all, heard {first[0]:.0f} ms after play was pressed, seen {first[1]:.0f} ms")
    page.wait("!studio.clock.playing")
    for name, pause in (("as soon as it is written", 0.0), ("a second later", 1.0)):
        tell_played(f"ten seconds, played {name}", [played(page, pause, k) for k in range(PLAYS)])
    tell_playing(page)
    tell_scrubbed(page)
    page.run("document.querySelectorAll('#panel [role=tab]')[1].click(); studio.clock.pause()")
    page.run(WATCH)
    page.run(TURNED, 0.1)
    tell("a dial turned", [page.run(TURNED, 0.2 + 0.03 * k) for k in range(TIMES)])
    tell("a dial dragged for 3 s", page.run(DRAGGED))
    print(f"load of the machine's {os.cpu_count()} cores meanwhile  {os.getloadavg()[0]:.1f}")


def tell_playing(page: Page) -> None:
    """Print how many pictures a second are drawn while a line plays, and the main thread's work for each."""
    page.driver.execute_cdp_cmd("Performance.enable", {})
    before, begun = busy(page), page.run("return studio.headPlayers.stage.drawn")
    rate = page.run(PER_SECOND)
    each = 1000.0 * (busy(page) - before) / (page.run("return studio.headPlayers.stage.drawn") - begun)
    print(f"pictures per second at {SIZE[0]} × {SIZE[1]}: {rate:.1f}, main thread {each:.1f} ms each")


def busy(page: Page) -> float:
    """Return the seconds that the page's main thread has worked."""
    metrics = page.driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    return float(next(m["value"] for m in metrics if m["name"] == "TaskDuration"))


def tell_scrubbed(page: Page) -> None:
    """Print how smoothly five minutes are scrubbed through."""
    page.run("studio.clock.pause()")
    page.run(WRITE, " ".join(f"{LINE[:-1]} of week {k}." for k in range(MINUTES_5)))
    page.run(PLAYED, LONGEST)
    rate, longest = page.run(SCRUBBED)
    length = page.run("return studio.clock.duration")
    print(f"scrubbed through {length:.0f} s: {rate:.1f} pictures per second, longest wait {longest:.0f} ms")


def played(page: Page, pause: float, k: int) -> list[float]:
    """Return when a line not played before was heard and seen, in ms after play was pressed."""
    page.run("studio.clock.pause()")
    time.sleep(2.5)
    page.run(WRITE, f"{LINE[:-1]} of day {k} {'at last' if pause else 'at least'}.")
    time.sleep(pause)
    found: list[float] = page.run(PLAYED, LONGEST)
    return found


def tell_played(what: str, found: list[list[float]]) -> None:
    """Print how long it took until a line was heard and seen: the least, the median, the most."""
    for name, times in zip(("heard", "seen"), zip(*found, strict=True), strict=True):
        least, middle, most = min(times), statistics.median(times), max(times)
        print(f"{what}, {name}: {least:.0f} ms at least, median {middle:.0f}, at most {most:.0f}")


def tell(what: str, found: list[list[float]]) -> None:
    """Print when a dial's face has come, was handed over to be drawn, was drawn, and how long that took."""
    for name, times in zip(STAGES, zip(*found, strict=True), strict=True):
        print(f"{what} {name:26}{statistics.median(times):6.0f} ms ({max(times):.0f})")


if __name__ == "__main__":
    main()
