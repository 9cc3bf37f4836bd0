"""The client that the page on the protocol prints, run as it stands."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from .running import running

PAGE = Path(__file__).parents[2] / "docs" / "serve.md"


def test_the_printed_client_hears_a_face(capsys: pytest.CaptureFixture[str]) -> None:
    ((code,),) = (re.findall(r"^```py\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE),)
    short = code.replace("Hello there. How are you?", "Oh.")
    with running() as server:
        exec(compile(short.replace(":8766/", f":{server.port}/"), str(PAGE), "exec"), {})
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert [float(time) for time, _, _ in rows] == pytest.approx([k / 30 for k in range(len(rows))], abs=1e-5)
    assert max(float(weight) for _, weight, _ in rows) > 0.1
