"""A run that is killed at any moment, and started again: nothing is missing, half, or made twice."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import risorius

LINES: list[dict[str, object]] = [{"id": f"{n % 3}/{n}", "text": f"Line {n}."} for n in range(14)]
OUTPUTS = ("out/{id}.TextGrid", "out/{id}.muscles.csv")
COMMAND = [sys.executable, "-m", "risorius", "batch", "lines.jsonl", "--jobs", "2"]
JOURNAL = Path("out/.risorius-batch.jsonl")


def journalled() -> dict[str, int]:
    """Return the ids of the lines that are whole, with the time at which their first output was made."""
    entries = JOURNAL.read_bytes().split(b"\n")[:-1] if JOURNAL.exists() else []
    ids = [json.loads(entry)["id"] for entry in entries]
    return {name: Path(f"out/{name}.TextGrid").stat().st_mtime_ns for name in ids}


@pytest.mark.full
def test_nothing_is_missing_half_or_made_twice(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("lines.jsonl").write_text("".join(json.dumps(line) + "\n" for line in LINES))
    before: dict[str, int] = {}
    for wanted, moment in ((1, 0.0), (4, 0.013), (8, 0.031), (11, 0.05)):
        outputs = [part for output in OUTPUTS for part in ("-o", output)]
        run = subprocess.Popen([*COMMAND, *outputs], stderr=subprocess.DEVNULL, env=os.environ)
        while len(journalled()) < wanted and run.poll() is None:
            time.sleep(0.005)
        time.sleep(moment)
        run.send_signal(signal.SIGKILL)
        run.wait()
        # What its processes still write, they write beside; the lock goes with them.
        time.sleep(0.5)
        whole = journalled()
        assert len(whole) >= wanted
        assert {name: whole[name] for name in before} == before
        before = whole
    results = {r.id: r.state for r in risorius.batch(LINES, OUTPUTS, jobs=0)}
    assert len(results) == len(LINES)
    assert {name: time for name, time in journalled().items() if name in before} == before
    assert all(results[name] == "whole" for name in before)
    assert not list(tmp_path.rglob("*.part"))
    list(risorius.batch(LINES, [output.replace("out", "again") for output in OUTPUTS], jobs=0))
    for again in Path("again").rglob("*.*"):
        if again.suffix in (".TextGrid", ".csv") and again.stem != "report":
            assert again.read_bytes() == Path("out", *again.parts[1:]).read_bytes()
