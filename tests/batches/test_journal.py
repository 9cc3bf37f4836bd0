from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.batches.journal import Journal, JournalEntry
from risorius.batches.outcome import Outcome
from risorius.errors import OutputError

FIRST = JournalEntry("a", "1", {"x.wav": (3, "17", "abc")}, Outcome(duration=1.5, outputs={"a.wav": 44}))
SECOND = JournalEntry("b/ü", "2")


def written(folder: Path) -> Path:
    with Journal(folder) as journal:
        journal.append(FIRST)
        journal.append(SECOND)
        return journal.path


def test_a_second_run_is_refused_in_the_same_folder(tmp_path: Path) -> None:
    with Journal(tmp_path), pytest.raises(OutputError, match="another batch is running in this folder"):
        Journal(tmp_path)
    Journal(tmp_path).close()


def test_shards_run_beside_each_other_but_not_beside_a_run_of_all(tmp_path: Path) -> None:
    with Journal(tmp_path, "1-of-2"), Journal(tmp_path, "2-of-2"):
        for shard in ("", "2-of-2"):
            with pytest.raises(OutputError, match="another batch is running in this folder"):
                Journal(tmp_path, shard)


def test_a_folder_that_cannot_be_made_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="cannot be written"):
        Journal(tmp_path / "file" / "out")


def test_entries_are_read_back(tmp_path: Path) -> None:
    written(tmp_path)
    with Journal(tmp_path) as journal:
        entry = journal.entry("a")
        assert entry is not None
        assert (entry.digest, entry.outcome) == ("1", FIRST.outcome)
        assert {name: tuple(record) for name, record in entry.files.items()} == FIRST.files
        assert journal.entry("b/ü") is not None
        assert journal.entry("c") is None


@given(st.integers(0, 400))
def test_a_journal_that_ends_anywhere_loses_only_the_line_that_it_ends_in(
    tmp_path_factory: pytest.TempPathFactory, end: int
) -> None:
    folder = tmp_path_factory.mktemp("journal")
    path = written(folder)
    whole = path.read_bytes()
    path.write_bytes(whole[:end])
    with Journal(folder) as journal:
        lines = whole[:end].count(b"\n")
        assert [journal.entry(name) is not None for name in ("a", "b/ü")] == [lines > 0, lines > 1]
        journal.append(JournalEntry("c", "3"))
    assert path.read_bytes().startswith(whole[: whole[:end].rfind(b"\n") + 1])
    with Journal(folder) as journal:
        assert journal.entry("c") is not None


@pytest.mark.parametrize("line", ["null", "[]", '{"id": 3}', '{"id": "a", "outcome": 1}', "[" * 100_000])
def test_lines_that_are_no_entries_are_passed_over(line: str, tmp_path: Path) -> None:
    path = written(tmp_path)
    path.write_text(f"{line}\n{path.read_text()}")
    with Journal(tmp_path) as journal:
        assert journal.entry("a") is not None
