"""Workers that perform lines: one that ends is replaced, one that hangs is given up."""

from pathlib import Path
from typing import Any

import pytest

import risorius
from risorius.batches.outcome import LineResult

SILENT = """
import base64, json, sys
json.loads(sys.stdin.read())
sound = base64.b64encode(bytes(44100)).decode()
print(json.dumps({"sample_rate": 22050, "audio": sound, "phones": [["", 0.0], ["AA1", 0.3], ["", 0.7]]}))
"""
ENDS = """
import os, pathlib, signal
mark = pathlib.Path("mark")
if MARKED or not mark.exists():
    mark.touch()
    os.kill(os.getppid(), signal.SIGKILL)
"""
HANGS = """
import os, time
parent, end = os.getppid(), time.monotonic() + 20.0  # the parent may be gone before this begins
while os.getppid() == parent and time.monotonic() < end:
    time.sleep(0.05)
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(rows: list[dict[str, object]], **options: Any) -> dict[str, LineResult]:
    return {result.id: result for result in risorius.batch(rows, "out/{id}.TextGrid", **options)}


def test_a_process_that_ends_is_replaced(folder: Path) -> None:
    (folder / "once.py").write_text("MARKED = False" + ENDS + SILENT)
    rows: list[dict[str, object]] = [
        {"id": "once", "text": "Ah.", "voice": "once.py"},
        {"id": "good", "text": "Good."},
    ]
    results = run(rows, jobs=1)
    assert {name: result.outcome.error for name, result in results.items()} == {"once": "", "good": ""}
    assert not list(folder.glob("out/*.part"))


def test_a_line_that_hangs_is_given_up(folder: Path) -> None:
    (folder / "hangs.py").write_text(HANGS)
    results = run([{"id": "hangs", "text": "Ah.", "voice": "hangs.py"}], jobs=1, timeout=0.5)
    assert results["hangs"].outcome.error == "took longer than 0.5 s"


@pytest.mark.full
def test_a_line_that_ends_every_process_is_given_up(folder: Path) -> None:
    (folder / "always.py").write_text("MARKED = True" + ENDS + SILENT)
    rows: list[dict[str, object]] = [
        {"id": "always", "text": "Ah.", "voice": "always.py"},
        {"id": "good", "text": "Good."},
    ]
    results = run(rows, jobs=2)
    errors = {name: result.outcome.error for name, result in results.items()}
    assert errors == {"always": "its process ended without an answer (signal 9)", "good": ""}


def test_texts_come_back_as_takes_in_their_order_from_several_processes() -> None:
    texts = ["One.", "Two, three, four, five.", "Six."]
    alone = list(risorius.pipe(texts))
    together = list(
        risorius.pipe(((text, number) for number, text in enumerate(texts)), as_tuples=True, n_process=2)
    )
    assert [number for _, number in together] == [0, 1, 2]
    for take, (other, _) in zip(alone, together, strict=True):
        assert (take.curves["lip_seal"] == other.curves["lip_seal"]).all()
        assert take.duration == other.duration


def test_a_text_that_cannot_be_performed_is_raised_at_its_place() -> None:
    takes = risorius.pipe(["One.", "…"])
    next(takes)
    with pytest.raises(risorius.RisoriusError, match="can be spoken"):
        next(takes)
