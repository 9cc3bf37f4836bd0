"""Errors that nobody foresaw: one line and exit code 2, the traceback if it is asked for."""

from __future__ import annotations

import contextlib
import errno
import json
import sys
from pathlib import Path

import pytest

from risorius import cli
from risorius.cli import EXIT_FAULT, run
from risorius.errors import LONGEST_LINE


@pytest.fixture
def score(tmp_path: Path) -> Path:
    path = tmp_path / "a.score.json"
    path.write_text(json.dumps({"risorius": 1, "duration": 1.0, "movements": []}))
    return path


def broken(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.delenv(cli.STRICT)
    monkeypatch.setattr("risorius.api.read_score_file", fail)


@pytest.mark.parametrize("debug", [False, True])
def test_an_unforeseen_error_is_one_line_with_the_file(
    debug: bool, score: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    broken(ValueError("x" * 1000), monkeypatch)
    options = ["--debug"] if debug else []
    assert run(["mix", str(score), *options]) == EXIT_FAULT
    *trace, line = capsys.readouterr().err.splitlines()
    assert line.startswith(f"risorius: {score}: cannot be used (ValueError: xxx")
    assert line.endswith("please report it with what --debug prints")
    assert len(line) <= LONGEST_LINE
    assert any("Traceback" in row for row in trace) is debug
    assert debug or not trace


def test_a_fault_of_the_system_is_one_line_with_its_file(
    score: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    broken(OSError(errno.EFBIG, "File too large", "/tmp/voice.wav"), monkeypatch)
    assert run(["mix", str(score)]) == EXIT_FAULT
    assert capsys.readouterr().err.startswith("risorius: /tmp/voice.wav: File too large; expected ")


def test_the_tests_take_an_unforeseen_error_for_a_failure(
    score: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken(ValueError("odd"), monkeypatch)
    monkeypatch.setenv(cli.STRICT, "1")
    with pytest.raises(ValueError, match="odd"):
        run(["mix", str(score)])


def test_a_word_after_two_dashes_is_no_option(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["mix", "--", "--debug"]) == EXIT_FAULT
    assert "--debug: " in capsys.readouterr().err


def test_closed_standard_input_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    assert run(["speak", "-", "-o", str(tmp_path / "x.wav")]) == EXIT_FAULT
    assert "standard input is closed" in capsys.readouterr().err


@pytest.mark.parametrize(
    "option", ["--emotion", "--size", "--shape", "--camera", "--seed", "--head", "--voice"]
)
def test_long_options_are_shortened(option: str, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert run(["speak", "hi", option, "x" * 60_000, "-o", str(tmp_path / "x.png")]) == EXIT_FAULT
    line = capsys.readouterr().err.splitlines()[-1]
    assert line.isprintable()
    assert len(line) <= LONGEST_LINE


def test_too_many_frames_are_refused_with_their_memory(
    score: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    score.write_text(json.dumps(json.loads(score.read_text()) | {"duration": 3600.0}))
    assert run(["mix", str(score), "--fps", "1000", "-o", str(tmp_path / "x.muscles.csv")]) == EXIT_FAULT
    expected = "3600 s at 1000 frames a second are 3,600,001 frames (1,325 MB of curves)"
    assert expected in capsys.readouterr().err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_what_a_full_disk_did_not_take_is_not_said_to_be_written(
    score: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    full = Path("/dev/full").open("w")  # noqa: SIM115  # closing it fails, too
    with monkeypatch.context() as patch:
        patch.setattr(sys, "stdout", full)
        assert run(["mix", str(score)]) == EXIT_FAULT
    with contextlib.suppress(OSError):
        full.close()
    assert capsys.readouterr().err == "risorius: no space left on the disk\n"
