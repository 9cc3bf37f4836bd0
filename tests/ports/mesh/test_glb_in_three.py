"""Both kinds of GLB, played by three.js in a real browser: what it shows is what our face does."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from risorius.core.arkit import SHAPES
from risorius.core.parameters import INDEX
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.face.frame import FaceFrame
from risorius.take import Take
from tests.profiles import samples

from ..gltf_reader import Document
from ..npm import with_package

CHROMIUM, DRIVER = Path("/usr/bin/chromium"), Path("/usr/bin/chromedriver")
FLAGS = (
    *("--headless=new", "--no-sandbox", "--no-first-run", "--disable-background-networking"),
    *("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=500,620"),
)
ROUNDED = 0.35  # mm: the neck's shares of the head's turn are bytes
MuscleCoverage = dict[str, Any]


@pytest.fixture(scope="module")
def folder(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("three")
    clip.write(found / "x.glb", found / "x.rig.glb")
    return found


@pytest.fixture(scope="module")
def served(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a server of three.js, the page and the clips."""
    modules = with_package(tmp_path_factory, "three", "0.180.0") / "node_modules"
    page = Path(__file__).parent / "three_page.html"

    class Handler(SimpleHTTPRequestHandler):
        def translate_path(self, path: str) -> str:
            asked = path.split("?")[0].lstrip("/")
            return str(
                page if not asked else modules / asked if asked.startswith("three/") else folder / asked
            )

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(folder)))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def browser(served: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    if not (CHROMIUM.exists() and DRIVER.exists()):
        pytest.skip("chromium and chromedriver are not here")
    webdriver = pytest.importorskip("selenium.webdriver")
    options = webdriver.ChromeOptions()
    options.binary_location = str(CHROMIUM)
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(str(DRIVER))
    driver = webdriver.Chrome(options=options, service=service)
    driver.set_script_timeout(120)
    driver.get(served)
    end = time.monotonic() + 60.0
    while not driver.execute_script("return window.ready === true"):
        assert time.monotonic() < end, driver.get_log("browser")
        time.sleep(0.05)
    yield driver
    driver.quit()


@pytest.fixture(scope="module", params=["x.glb", "x.rig.glb"])
def at(request: pytest.FixtureRequest, browser: Any, clip: Take) -> Callable[[int, str], MuscleCoverage]:
    """A function from a frame's number and a mesh's name to what three.js shows; `at.name` is the file's."""
    tell = "window.load(arguments[0]).then(arguments[1], (e) => arguments[1]({error: String(e.stack)}))"
    loaded = browser.execute_async_script(tell, request.param)
    assert "error" not in loaded, loaded["error"]
    assert loaded["clips"] == pytest.approx([clip.times[-1]], abs=1e-5)
    assert {"skin", "tongue", "teeth_lower", "eye_left", "hair"} <= set(loaded["meshes"])

    def shown(frame: int, mesh: str) -> MuscleCoverage:
        found = browser.execute_script("return window.at(...arguments)", float(clip.times[frame]), mesh)
        return {**found, "places": np.reshape(found["places"], (-1, 3))}

    shown.file = request.param  # type: ignore[attr-defined]
    return shown


def turned(clip: Take, skin: np.ndarray, frame: FaceFrame) -> np.ndarray:
    """Skin (n, 3) mm as the head's rotation carries it: each vertex by its share."""
    head = clip.head
    share = np.clip(head.skin.matrix @ head.neck_weight, 0.0, 1.0)[:, None]
    return (1.0 - share) * skin + share * ((skin - head.head_pivot) @ frame.head_rotation.T + head.head_pivot)


def wanted(clip: Take, file: str, number: int, frame: FaceFrame) -> tuple[np.ndarray, float]:
    """Where the skin should be in mm, and how far off it may be: what the file states, and rounding."""
    if file == "x.rig.glb":  # what the weights make of our head's own shapes
        return turned(clip, ArkitFit.of(clip.head).skin(clip.arkit.weights[number]), frame), ROUNDED
    return turned(clip, frame.skin, frame), ROUNDED


def test_vertices_and_boxes_are_where_our_face_has_them(at, clip: Take, folder: Path) -> None:
    stated = Document(folder / at.file).json["asset"]["extras"]["residual_worst_mm"]
    for number, frame in enumerate(clip.faces()):
        if number % samples(3, everyday=6) and number != len(clip.times) - 1:
            continue
        shown = at(number, "skin")
        place, slack = wanted(clip, at.file, number, frame)
        most = slack + (stated if at.file == "x.glb" else 0.0)
        assert np.linalg.norm(shown["places"] - place, axis=1).max() < most, number
        box = np.concatenate([place.min(axis=0), place.max(axis=0)])
        assert np.abs(shown["corners"] - box).max() < most, number


def test_the_rig_is_the_face_within_the_stated_residual(at, clip: Take, folder: Path) -> None:
    if at.file != "x.rig.glb":
        pytest.skip("the clip's own shapes are compared vertex by vertex")
    extras = Document(folder / at.file).json["asset"]["extras"]
    squares = []
    fit = ArkitFit.of(clip.head)
    for number in (4, 8):
        (frame,) = clip.faces([number])
        away = np.linalg.norm(at(number, "skin")["places"] - turned(clip, frame.skin, frame), axis=1)
        assert away[fit.counted].max() < extras["residual_worst_mm"] + ROUNDED
        squares.append((away[fit.counted] ** 2).mean())
        shown = at(number, "skin")["weights"]
        assert [shown[name] for name in SHAPES] == pytest.approx(clip.arkit.weights[number], abs=1e-5)
    assert np.sqrt(np.mean(squares)) < extras["residual_rms_mm"] + 0.3


def test_the_jaw_opens_when_it_should(at, clip: Take) -> None:
    """The lower teeth go down with the jaw, frame by frame."""
    jaw = clip.performance.values[:, INDEX["masseter"]]
    numbers = range(0, len(jaw), 2)
    shown, meant = [], []
    for number, frame in enumerate(clip.faces()):
        if number in numbers:
            pivot, teeth = clip.head.head_pivot, frame.teeth_lower
            meant.append(((teeth - pivot) @ frame.head_rotation.T + pivot)[:, 1].mean())
            shown.append(at(number, "teeth_lower")["places"][:, 1].mean())
    drop = np.max(meant) - np.min(meant)
    assert drop > 2.0
    # The 52 shapes open the jaw as far as the skin tells, not as far as the teeth go.
    near = 0.1 if at.file == "x.glb" else 0.25 * drop
    assert np.abs(np.array(shown) - meant).max() < near
    assert np.argmin(shown) == np.argmin(meant)


def test_nothing_is_complained_of_and_something_is_seen(at, browser: Any, clip: Take, tmp_path: Path) -> None:
    at(len(clip.times) // 3, "skin")
    browser.save_screenshot(str(tmp_path / f"{at.file}.png"))
    complaints = [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
    assert [line for line in complaints if "favicon" not in line] == []
    script = """const c = document.querySelector('canvas'), d = document.createElement('canvas');
        d.width = d.height = 60; const x = d.getContext('2d'); x.drawImage(c, 0, 0, 60, 60);
        return [...x.getImageData(0, 0, 60, 60).data];"""
    pixels = np.reshape(browser.execute_script(script), (60, 60, 4))[..., :3]
    background = pixels[2, 2]
    seen = np.abs(pixels - background).max(axis=2) > 12
    assert 0.2 < seen.mean() < 0.95
