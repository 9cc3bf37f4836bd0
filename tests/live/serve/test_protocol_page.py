"""The client that the page on the protocol prints, run as it stands."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from risorius.live.serve import limits
from risorius.live.serve.server import warm_up

from .running import running

PAGE = Path(__file__).parents[3] / "docs" / "serve.md"


def test_the_printed_client_hears_a_face(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # Frames come however late a busy machine makes them.
    monkeypatch.setattr(limits, "LATE", 60.0)
    ((code,),) = (re.findall(r"^```py\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE),)
    short = code.replace("Hello there. How are you?", "Oh, wow.")
    warm_up()
    with running() as server:
        exec(compile(short.replace(":8766/", f":{server.port}/"), str(PAGE), "exec"), {})
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    # A machine that does other work may drop some, never their order.
    indices = [30 * float(time) for time, _, _ in rows]
    assert indices == pytest.approx(sorted({round(index) for index in indices}), abs=1e-3)
    assert max(float(weight) for _, weight, _ in rows) > 0.1
