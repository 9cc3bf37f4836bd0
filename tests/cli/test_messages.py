"""What the command line says: lines, objects of JSON, or only what went wrong; and outputs on its output."""

from __future__ import annotations

import io
import json
import time
import wave
from pathlib import Path
from typing import Any

import pytest

from risorius.cli import run
from risorius.cli.console import INTERVAL, Console
from risorius.cli.messages import choose_form
from risorius.errors import warn

SPEAK = ["speak", "Oh.", "--fps", "5"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    choose_form([])
    return tmp_path


def objects(text: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.splitlines()]


def test_quiet_says_what_goes_wrong_alone(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["speak", "Oh.", "-o", "x.wav", "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    assert run(["speak", "Oh.", "-q", "-o", "x.wave"]) == 2
    assert capsys.readouterr().err.startswith("risorius: x.wave: unknown suffix '.wave'")
    choose_form(["-q"])
    with Console() as console:
        console.say("Speaking …")
        console.progress("Drawing", 3, 3)
        console.fail("line 3: is empty")
        warn("clipped")
    assert capsys.readouterr().err == "risorius: line 3: is empty\nrisorius: warning: clipped\n"


def test_json_is_an_object_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*SPEAK, "-o", "x.muscles.csv", "--json"]) == 0
    assert objects(capsys.readouterr().err) == [{"stage": "Speaking …"}, {"wrote": ["x.muscles.csv"]}]
    Path("x.xml").write_text("<PHONEME")
    assert run(["speak", "x.xml", "-o", "x.wav", "--json"]) == 2
    (fault,) = objects(capsys.readouterr().err)
    assert fault["error"].startswith("x.xml:1:")
    assert (fault["file"], fault["line"]) == ("x.xml", 1)
    assert run(["spaek", "--json"]) == 2
    assert objects(capsys.readouterr().err) == [{"error": "unknown command 'spaek'; did you mean 'speak'?"}]


def test_lists_are_objects_as_well(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "channels", "--json"]) == 0
    assert {"channel": "lips", "priority": "60"} in objects(capsys.readouterr().out)


def test_a_script_that_says_json_is_not_meant() -> None:
    choose_form([])
    assert run(["speak", "-o", "x.TextGrid", "--quiet", "--", "--json"]) == 0


def test_long_work_says_how_far_it_is_where_nobody_watches(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    with Console() as console:
        for done in range(1, 101):
            now[0] += 0.3 * INTERVAL
            console.progress("Drawing", done, 100)
    lines = capsys.readouterr().err.splitlines()
    assert lines[:2] == ["Drawing: 5 of 100", "Drawing: 9 of 100"]
    assert lines[-1] == "Drawing: 100"
    assert len(lines) == 25


def test_one_output_goes_to_standard_output(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert run([*SPEAK, "-o", "-.muscles.csv", "-o", "x.muscles.csv"]) == 0
    printed = capfdbinary.readouterr()
    assert printed.out == Path("x.muscles.csv").read_bytes()
    assert printed.err.decode().endswith("Wrote -.muscles.csv, x.muscles.csv\n")
    assert run(["speak", "Oh.", "-q", "-o", "-.wav"]) == 0
    with wave.open(io.BytesIO(capfdbinary.readouterr().out)) as sound:
        assert sound.getnframes() > 10_000
    assert run(["pose", "AU1=1", "-q", "-o", "-.muscles.csv"]) == 0
    assert capfdbinary.readouterr().out.startswith(b"time_s,")
    assert sorted(Path().iterdir()) == [Path("x.muscles.csv")]


@pytest.mark.parametrize(
    ("outputs", "message"),
    [
        (["-.wav", "-.srt"], "-.srt: standard output takes one output; expected files for the others"),
        (["-.wave"], "-.wave: unknown suffix '.wave'; did you mean '.wav'?"),
        (["x.wav", "-.srt", "nowhere/x.srt"], "nowhere/x.srt: the folder 'nowhere' does not exist"),
    ],
)
def test_what_standard_output_cannot_take(
    outputs: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["speak", "Oh.", *(word for name in outputs for word in ("-o", name))]) == 2
    told = capsys.readouterr()
    assert message in told.err
    assert told.out == ""
    assert not list(Path().iterdir())


def test_a_terminal_is_not_sent_sound(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    assert run(["speak", "Oh.", "-o", "-.wav"]) == 2
    assert "-.wav: a terminal cannot show binary output; expected a pipe or a file" in capsys.readouterr().err
