"""Runs in this process, with outputs that take little: what is whole, what is made anew, what fails."""

import errno
import json
import os
from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

import risorius
from risorius.batches import fingerprint, perform
from risorius.batches.outcome import LineResult
from risorius.batches.run import Shard
from risorius.errors import DiskFullError, InputError, OutputError

ROWS: list[dict[str, object]] = [
    {"id": "a/hello", "text": "Hello.", "emotion": "joy:.5"},
    {"id": "b", "text": "Guten Tag.", "language": "de", "seed": 3},
    {"id": "c", "script": "c.xml"},
]
OUTPUTS = ("out/{id}.TextGrid", "out/{id}.muscles.csv")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(fingerprint, "installation", lambda: "this")
    (tmp_path / "c.xml").write_text("<PHONEME time='0' text='Oh.'/>")
    return tmp_path


def run(rows: Any = ROWS, outputs: Any = OUTPUTS, **options: Any) -> dict[str, LineResult]:
    return {result.id: result for result in risorius.batch(rows, outputs, jobs=0, **options)}


def states(rows: Any = ROWS, outputs: Any = OUTPUTS, **options: Any) -> str:
    """Return the first letters of the lines' states, in the order of the rows."""
    results = run(rows, outputs, **options)
    return "".join(results[str(row["id"])].state[0] for row in rows)


def files(folder: Path) -> dict[str, bytes]:
    names = (path for path in folder.rglob("*") if path.suffix in (".TextGrid", ".csv"))
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in names if path.stem != "report"}


@pytest.mark.parametrize(
    ("outputs", "options", "message"),
    [
        ((), {}, "no output named"),
        ("out/{id}.xyz", {}, "unknown suffix"),
        ("out/x.wav", {}, "names no column"),
        ("s3://x/{id}.wav", {}, "a journal needs a folder"),
        ("{id}.wav", {"shard": "3/2"}, "'3/2' is not a shard"),
        ("{id}.wav", {"shard": "x"}, "'x' is not a shard"),
    ],
)
def test_what_concerns_all_lines_is_raised_at_once(outputs: Any, options: Any, message: str) -> None:
    with pytest.raises((InputError, OutputError), match=message):
        risorius.batch(ROWS, outputs, **options)


def test_bad_rows_are_results_and_the_rest_goes_on() -> None:
    bad: list[dict[str, object]] = [
        {"id": "a/hello", "text": "Again."},
        {"id": "../up", "text": "Hi."},
        {"id": "missing", "audio": "gone.wav", "transcript": "Hi."},
        {"id": "silent", "text": "…"},
        {"id": "voice", "text": "Hi.", "voice": "nobody"},
        {"text": "No id."},
        {"id": "object", "text": "Hi.", "emotion": [["x"]]},
    ]
    results = list(risorius.batch([*ROWS, *bad], OUTPUTS, jobs=0))
    assert Counter(result.state for result in results) == {"made": 3, "failed": 7}
    lines = [json.loads(line) for line in Path("out/errors.jsonl").read_text().splitlines()]
    assert [line["error"] for line in lines] == [result.error for result in results if result.error]
    assert lines[0]["error"] == "row:4: the id 'a/hello' is also used by row:1; expected a different one"
    assert sorted(line["line"] for line in lines) == [4, 5, 6, 7, 8, 9, 10]


def test_the_bytes_are_those_of_one_by_one_in_any_order() -> None:
    Path("one/a").mkdir(parents=True)
    takes = {
        "a/hello": risorius.speak("Hello.", text=True, emotion={"joy": 0.5}),
        "b": risorius.speak("Guten Tag.", text=True, settings=risorius.Settings(language="de", seed=3)),
        "c": risorius.speak("c.xml"),
    }
    for name, take in takes.items():
        take.write(f"one/{name}.TextGrid", f"one/{name}.muscles.csv")
    for name, rows in (("x", ROWS), ("y", ROWS[::-1])):
        run(rows, [output.replace("out", name) for output in OUTPUTS])
        assert files(Path(name)) == files(Path("one"))


def test_what_is_whole_is_not_made_again(folder: Path) -> None:
    assert states() == "mmm"
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*.TextGrid")}
    assert states() == "www"
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*.TextGrid")} == before
    assert states(ROWS[::-1]) == "www"


def _other_text(rows: list[dict[str, object]]) -> None:
    rows[0]["text"] = "Hello!"


def _other_setting(rows: list[dict[str, object]]) -> None:
    rows[0]["seed"] = 1


def _output_gone(rows: list[dict[str, object]]) -> None:
    Path("out/a/hello.TextGrid").unlink()


def _output_torn(rows: list[dict[str, object]]) -> None:
    Path("out/a/hello.TextGrid").write_text("")


@pytest.mark.parametrize("change", [_other_text, _other_setting, _output_gone, _output_torn])
def test_a_line_that_changed_is_made_anew(change: Callable[[list[dict[str, object]]], None]) -> None:
    rows = [dict(row) for row in ROWS]
    run(rows)
    change(rows)
    assert states(rows) == "mww"
    assert states(rows) == "www"


def test_a_script_that_changed_is_read_anew_and_one_that_was_touched_is_not(folder: Path) -> None:
    run()
    (folder / "c.xml").write_text("<PHONEME time='0' text='Oh?'/>")
    assert states() == "wwm"
    os.utime(folder / "c.xml", (1, 1))
    assert states() == "www"


def test_other_rules_outputs_or_versions_make_all_anew(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "my.toml").write_text('delete = ["gaze"]\n')
    settings = risorius.Settings(rules=folder / "my.toml")
    assert [states(settings=settings), states(settings=settings)] == ["mmm", "www"]
    (folder / "my.toml").write_text('delete = ["signals"]\n')
    assert states(settings=settings) == "mmm"
    assert states(settings=settings, outputs=OUTPUTS[1:]) == "mmm"
    monkeypatch.setattr(fingerprint, "installation", lambda: "another")
    assert states(settings=settings, outputs=OUTPUTS[1:]) == "mmm"


def test_a_run_that_was_killed_goes_on_where_it_was(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It left a line half done: one output of two, a temporary file, and a torn line in the journal."""
    results = iter(risorius.batch(ROWS, OUTPUTS, jobs=0))
    next(results)
    run_name = {path.name for path in Path("out").glob(".risorius-batch*")}
    del results
    made = []
    perform_line = perform.perform_line
    monkeypatch.setattr(
        perform, "perform_line", lambda job, run: made.append((job.id, run)) or perform_line(job, run)
    )
    Path("out/b.TextGrid").write_text("half")
    with Path("out/.risorius-batch.jsonl").open("a") as journal:
        journal.write('{"id":"b","dig')
    assert states() == "wmm"
    assert [name for name, _ in made] == ["b", "c"]
    left = Path(f"out/.risorius-{made[0][1]}-0a1b.part")
    left.write_text("half")
    Path("out/b.TextGrid").unlink()
    assert states() == "wmw"
    assert not left.exists()
    assert {path.name for path in Path("out").glob(".risorius*")} == run_name


def test_a_full_disk_stops_the_run_with_one_line_and_it_can_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    write = risorius.Take.write

    def full(take: risorius.Take, *paths: str) -> None:
        if "b" in str(paths[0]):
            raise DiskFullError("no space left on the disk; nothing was written")
        write(take, *paths)

    monkeypatch.setattr(risorius.Take, "write", full)
    with pytest.raises(DiskFullError, match="start again to go on"):
        run()
    monkeypatch.setattr(risorius.Take, "write", write)
    assert states() == "wmm"


def test_a_journal_on_a_full_disk_stops_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(number: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    sync = os.fsync
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(DiskFullError, match="no space left"):
        run()
    monkeypatch.setattr(os, "fsync", sync)
    assert states()[1:] == "mm"


def test_what_nobody_expects_is_the_failure_of_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(take: risorius.Take, *paths: str) -> None:
        raise ValueError("of\ncourse")

    monkeypatch.setattr(risorius.Take, "write", broken)
    assert {result.outcome.error for result in run().values()} == {"unexpected ValueError: of course"}


def test_shards_make_all_lines_once_and_a_run_of_all_finds_them_whole() -> None:
    made = [sorted(run(shard=f"{number}/3")) for number in (1, 2, 3)]
    assert sorted(name for names in made for name in names) == ["a/hello", "b", "c"]
    assert states() == "www"


@pytest.mark.parametrize("name", ["", "a", "ü/x"])
def test_each_line_falls_to_one_shard(name: str) -> None:
    assert sum(Shard(number, 7).holds(name) for number in range(1, 8)) == 1


def test_results_come_while_the_rows_are_read() -> None:
    read: list[int] = []

    def rows() -> Iterator[dict[str, object]]:
        for number in range(1000):
            read.append(number)
            yield {"id": str(number), "text": ""}

    results = iter(risorius.batch(rows(), "out/{id}.TextGrid", jobs=0))
    next(results)
    assert len(read) < 10
    results.close()  # type: ignore[attr-defined]


def test_a_contact_sheet_is_a_strip_of_six_pictures() -> None:
    rows: list[dict[str, object]] = [{"id": "a/x", "text": "Ah."}]
    settings = risorius.Settings(lead=0.2, tail=0.2, fps=Fraction(15), dynamics="static")
    (result,) = risorius.batch(rows, "{id}.landmarks.csv", jobs=0, settings=settings, sheets=True)
    assert (result.error, result.outcome.sheet) == ("", "sheets/a/x.png")
    with Image.open("sheets/a/x.png") as sheet:
        assert sheet.size == (6 * 112, 112)
    assert "sheets/a/x.png" in Path("report.html").read_text()
