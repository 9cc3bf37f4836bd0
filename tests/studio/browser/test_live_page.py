"""The live face in a page: its module plays sound as the clock, and its example page shows it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from risorius.core.arkit import SHAPES
from risorius.face.numerics.rotations import head_rotation

from ...live.serve.running import running
from .driving import Page

# So long (some half a minute) that a page that is kept waiting interrupts it all the same.
LINE = f"{', '.join(['One two three four five six seven eight nine ten'] * 6)} eleven."
CONVERSATION = """
const { LiveFace } = await import("/risorius-live.js");
const face = new LiveFace(`ws://${location.host}/live`, { outputs: ["arkit"] });
const told = [];
for (const kind of ["sentence", "interrupted", "error", "ended", "closed"]) {
  const about = ({ text, unsaid, message }) => text ?? unsaid ?? message;
  face.addEventListener(kind, ({ detail }) => told.push([kind, about(detail)]));
}
const until = async (done) => { while (!done()) await new Promise((go) => setTimeout(go, 10)); };
const started = await face.start();
face.feel("joy", 0.5);
face.feel("jox", 0.5);
face.say("LINE ");
face.flush();
await until(() => face.frame()?.text);
const lags = [], overtaken = [];
for (let k = 0; k < 10; k++) {
  await new Promise((go) => setTimeout(go, 20));
  const now = face.now() - face.base;
  const { time } = face.frame();
  overtaken.push(...face.frames.filter((frame) => frame.time > time && frame.time <= now));
  lags.push(face.now() - face.base - time);
}
await until(() => face.sources.size);
const playing = face.sources.size;
face.interrupt();
const silent = face.sources.size;
await until(() => told.some(([kind]) => kind === "interrupted"));
const at = face.frame().time;
await until(() => face.frame().time > at + 0.2);
face.close();
await until(() => told.some(([kind]) => kind === "closed"));
const weights = Array.from(face.frame().values.arkit);
return { told, lags, overtaken: overtaken.length, playing, silent, names: started.arkit, weights };
""".replace("LINE", LINE)
DRIVING = """
const { driving } = await import("/risorius-live.js");
const THREE = await import("/web/vendor/three/three.module.min.js");
const [root, head, eye, mesh] = [new THREE.Group(), new THREE.Group(), new THREE.Group(), new THREE.Mesh()];
head.name = "Head"; eye.name = "eye_left"; mesh.name = "Face";
mesh.morphTargetDictionary = { other: 0, JawOpen: 1, "face.mouthSmileLeft": 2 };
mesh.morphTargetInfluences = [0.5, 0, 0];
root.add(head); head.add(eye, mesh);
const names = { arkit: ["mouthSmileLeft", "jawOpen"], rotations: [] };
const values = { arkit: [0.25, 0.75], rotations: new Float32Array([0.3, 0.2, 0.1, 0.3, 0, 0, 0, 0, 0]) };
const show = driving(root);
show(null);
show({ names, values });
const ahead = new THREE.Vector3(0, 0, 1).applyQuaternion(head.quaternion).toArray();
const up = new THREE.Vector3(0, 1, 0).applyQuaternion(head.quaternion).toArray();
const looks = new THREE.Vector3(0, 0, 1).applyQuaternion(eye.quaternion).toArray();
return { influences: mesh.morphTargetInfluences, ahead, up, looks };
"""


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with running() as server:
        yield f"http://127.0.0.1:{server.port}/"


@pytest.fixture
def tab(browser_page: Page, address: str) -> Iterator[Page]:
    """A tab of its own beside the studio's, at the server of live faces."""
    driver = browser_page.driver
    studio = driver.current_window_handle
    driver.switch_to.new_window("tab")
    driver.get(f"{address}health")
    yield Page(driver, address)
    driver.close()
    driver.switch_to.window(studio)


def test_the_module_speaks_and_falls_silent(tab: Page) -> None:
    heard = tab.run(CONVERSATION)
    kinds = [kind for kind, _ in heard["told"]]
    assert kinds == ["error", "sentence", "interrupted", "sentence", "ended", "closed"], heard["told"]
    assert heard["told"][0][1].startswith("unknown emotion 'jox'")
    assert heard["told"][1][1] == LINE
    assert heard["told"][2][1].endswith("ten eleven.")
    # A frame is shown when it is due, until the next that has come is.
    assert min(heard["lags"]) >= 0.0
    assert heard["overtaken"] == 0
    assert heard["playing"] > 0
    assert heard["silent"] == 0
    assert heard["names"] == list(SHAPES)
    assert len(heard["weights"]) == len(SHAPES)


def test_the_module_drives_what_has_arkits_names(tab: Page) -> None:
    shown = tab.run(DRIVING)
    assert shown["influences"] == [0.5, 0.75, 0.25]
    turned = head_rotation(*np.degrees([0.2, 0.3, 0.1]).tolist())
    np.testing.assert_allclose(shown["ahead"], turned[:, 2], atol=1e-6)
    np.testing.assert_allclose(shown["up"], turned[:, 1], atol=1e-6)
    np.testing.assert_allclose(shown["looks"], [np.sin(0.3), 0.0, np.cos(0.3)], atol=1e-6)


@pytest.mark.full
def test_the_example_page_shows_a_face_and_takes_a_line(tab: Page) -> None:
    tab.complaints()
    tab.driver.get(tab.url)
    tab.wait("document.body.dataset.ready === 'yes'")
    tab.run("document.getElementById('say').click()")
    caption = tab.wait("document.getElementById('caption').textContent")
    assert caption in ("Hello there.", "How are you today?")
    assert not tab.complaints()


@pytest.mark.parametrize("head", ["standard", pytest.param("amara", marks=pytest.mark.full)])
def test_the_studio_goes_live_with_what_is_chosen_there(page: Page, head: str) -> None:
    page.run(
        f"studio.store.set({{ choices: {{ ...studio.store.get('choices'), head: '{head}', seed: 4 }} }})"
    )
    page.run("document.getElementById('live').click()")
    inside = "document.getElementById('live-face').contentDocument"
    page.wait(f"{inside}.body?.dataset.ready === 'yes'")
    assert page.get(f"{inside}.getElementById('head').value") == head
    line = "One, two, three, four, five, six, seven."
    # A busy page may be asked less often than the caption changes.
    page.run(
        f"const caption = {inside}.getElementById('caption'); window.captions = [];"
        "new MutationObserver(() => window.captions.push(caption.textContent))"
        ".observe(caption, { childList: true, characterData: true, subtree: true })"
    )
    page.run(f"{inside}.getElementById('text').value = '{line}'; {inside}.getElementById('say').click()")
    assert page.wait("window.captions.find((text) => text)") == line
    page.run("document.getElementById('live').click()")
    assert page.get("document.getElementById('live-face')") is None
    assert not page.complaints()
