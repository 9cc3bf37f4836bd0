"""`risorius batch`: exit codes, what it prints, and what a manifest of bad rows leaves."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from risorius.batches import run as batch_run
from risorius.batches.outcome import LineResult
from risorius.cli import run

BAD = """id,text,seed,emotion
a,Hello.,1,
,Hi.,,
../b,Hi.,,
a,Again.,,
c,Hi.,x,
d,Hi.,,joyy:1
e
f,Bye.,,fear:0.5;joy:0.2
"""
ERRORS = [
    "risorius: lines.csv:3: has no id; expected one",
    "risorius: lines.csv:4: id '../b' leaves the folder of the outputs; expected a name below it",
    "risorius: lines.csv:5: the id 'a' is also used by lines.csv:2; expected a different one",
    "risorius: lines.csv:6: seed 'x' is not a whole number; expected 0 or more",
    "risorius: lines.csv:7: unknown emotion 'joyy'; did you mean 'joy'?",
    "risorius: lines.csv:8: has 1 cells; expected 4, one per column",
]
MUSCLES = ["-o", "out/{id}.muscles.csv", "--jobs", "0"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lines.csv").write_text(BAD)
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["gone.csv", "-o", "{id}.wav"], "gone.csv: there is no such manifest"),
        (["lines.csv"], "no output named"),
        (["lines.csv", "-o", "x.wav"], "x.wav: names no column"),
        (["lines.csv", "-o", "{id}.wav", "--shard", "0/2"], "'0/2' is not a shard"),
        (["lines.csv", "-o", "{id}.wav", "--emotion", "joyy:1"], "unknown emotion 'joyy'"),
        (["lines.csv", "-o", "{id}.wav", "--timeout", "0"], "--timeout"),
    ],
)
def test_what_concerns_all_lines_ends_it_with_one_line(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["batch", *arguments]) == 2
    error = capsys.readouterr().err.strip()
    assert message in error
    assert "\n" not in error


def test_a_dry_run_names_every_bad_row_and_makes_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["batch", "lines.csv", *MUSCLES, "--dry-run"]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert lines[:-1] == ERRORS
    assert lines[-1] == "8 rows: 2 can be performed, 6 cannot"
    assert not Path("out").exists()


def test_bad_rows_do_not_stop_the_others(capsys: pytest.CaptureFixture[str]) -> None:
    for made in ("2 lines made", "0 lines made"):
        assert run(["batch", "lines.csv", *MUSCLES]) == 1
        lines = capsys.readouterr().err.splitlines()
        assert sorted(line for line in lines if line.startswith("risorius")) == sorted(ERRORS)
        assert lines[-1].startswith(made)
        assert "6 failed" in lines[-1]
    assert sorted(path.name for path in Path("out").glob("*.muscles.csv")) == [
        "a.muscles.csv",
        "f.muscles.csv",
    ]
    assert len(Path("out/errors.jsonl").read_text().splitlines()) == 6


def test_all_is_well_with_good_rows() -> None:
    Path("good.jsonl").write_text('{"id": "a", "text": "Hi.", "notes": "loud"}\n')
    assert run(["batch", "good.jsonl", *MUSCLES]) == 1
    assert run(["batch", "good.jsonl", *MUSCLES, "--ignore", "notes"]) == 0


def test_an_interruption_says_how_to_go_on(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = batch_run.BatchRun.lines

    def interrupted(batch: batch_run.BatchRun) -> Iterator[LineResult]:
        yield next(result for result in lines(batch) if not result.error)
        raise KeyboardInterrupt

    monkeypatch.setattr(batch_run.BatchRun, "lines", interrupted)
    assert run(["batch", "lines.csv", *MUSCLES]) == 130
    assert capsys.readouterr().err.splitlines()[-1] == (
        "risorius: interrupted; 1 lines were made, start again to go on"
    )
