"""Without a graphics card, the line plays as finely as the head at rest is drawn."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .driving import Page

LAST = 4  # frames of the line that are made
START = "const { stage } = studio.headPlayers; const first = studio.store.get('take').frames - arguments[0];"
PIXELS = """const canvas = document.querySelector('canvas.still');
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const pixels = data.filter((_, k) => k % 31 === 0);"""


@pytest.fixture
def resting(performed: Page) -> Iterator[Page]:
    performed.make_stills(True)
    yield performed
    performed.make_stills(False)


def test_the_line_plays_as_the_head_at_rest_looks(resting: Page) -> None:
    performed = resting
    performed.run(f"{START} studio.clock.seek(first / studio.clock.fps)", LAST)
    performed.wait("!document.querySelector('canvas.still').hidden")
    performed.run(f"{PIXELS} window.atRest = pixels")
    performed.run("const { baked } = studio.headPlayers.stage; baked.on = true; baked.later(0)")
    performed.wait(
        f"(() => {{ {START.replace('arguments[0]', str(LAST))} return stage.baked.lasts(first) }})()"
    )
    performed.run("studio.headPlayers.stage.baked.on = false")
    performed.run(f"{START} studio.clock.step(1); studio.clock.step(-1)", LAST)
    performed.wait("!document.querySelector('canvas.still').hidden")
    apart = performed.run(
        f"{PIXELS} return pixels.reduce((sum, v, k) => sum + Math.abs(v - atRest[k]), 0) / pixels.length"
    )
    assert apart < 2
    performed.run("""
      window.hidden = [];
      window.end = studio.clock.on("tick", () => hidden.push(document.querySelector("canvas.still").hidden));
      studio.clock.play();
    """)
    performed.wait("!studio.clock.playing && hidden.length > 3")
    assert not any(performed.run("end(); return hidden"))
    performed.run("studio.view.choose('side')")
    assert not performed.run(f"{START} return stage.baked.lasts(first)", LAST)
