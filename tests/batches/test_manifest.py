import json
import tracemalloc
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.batches.manifest import LONGEST_LINE, Manifest, ManifestRow, cells_of
from risorius.errors import InputError


def rows(path: Path, content: str | bytes) -> list[object]:
    """Return what a manifest reads as: cells of rows, and errors as texts without their folder."""
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return [
        dict(row.cells) if isinstance(row, ManifestRow) else str(row).removeprefix(f"{path.parent}/")
        for row in Manifest(path).rows()
    ]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "m.csv: is empty"),
        ("id,text,id\n", "m.csv:1: the column 'id' is there twice"),
        ("id,,text\n", "m.csv:1: column 2 has no name"),
        ('"id\n', "m.csv:1: is not CSV"),
    ],
)
def test_a_header_that_is_wrong_stops_all(content: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as error:
        rows(tmp_path / "m.csv", content)
    assert str(error.value).removeprefix(f"{tmp_path}/").startswith(message)


@pytest.mark.parametrize("name", ["missing.csv", "notes.xlsx"])
def test_what_is_no_manifest_is_refused(name: str, tmp_path: Path) -> None:
    (tmp_path / "notes.xlsx").write_text("")
    with pytest.raises(InputError, match=r"expected a \.csv or \.jsonl file, or a folder"):
        Manifest(tmp_path / name)


def test_broken_rows_of_csv_are_errors_in_their_place_and_the_rest_is_read(tmp_path: Path) -> None:
    content = b'id,text\na,one\nb\nc,two,three\n\xff,x\nd,"open\ne,five\n\nf,"two\nlines"\ng,\0\n'
    assert rows(tmp_path / "m.csv", content) == [
        {"id": "a", "text": "one"},
        "m.csv:3: has 1 cells; expected 2, one per column",
        "m.csv:4: has 3 cells; expected 2, one per column",
        "m.csv:5: is not UTF-8 (byte 0xff)",
        "m.csv:6: is not CSV: ',' expected after '\"'",
        {"id": "e", "text": "five"},
        {"id": "f", "text": "two\nlines"},
        "m.csv:11: holds a null character; expected text",
    ]


def test_broken_lines_of_json_are_errors_in_their_place_and_the_rest_is_read(tmp_path: Path) -> None:
    lines = ['{"id": "a", "fps": 25}', "{", "[1]", '{"id": 1, "id": 2}', "", '{"id": "b", "still": true}']
    assert rows(tmp_path / "m.jsonl", "\n".join(lines)) == [
        {"id": "a", "fps": "25"},
        "m.jsonl:2:1: is not JSON: expecting property name enclosed in double quotes",
        'm.jsonl:3: is not an object; expected {"id": …, "text": …}',
        "m.jsonl:4: the key 'id' is given twice in one object; expected it once",
        {"id": "b", "still": "on"},
    ]


def test_a_line_without_end_is_one_error(tmp_path: Path) -> None:
    path = tmp_path / "m.jsonl"
    found = rows(path, b'{"id": "' + b"x" * (2 * LONGEST_LINE) + b'"}\n{"id": "b"}\n')
    assert found == ["m.jsonl:1: is longer than 1,000,000 bytes; expected less", {"id": "b"}]


def test_excel_s_files_are_read(tmp_path: Path) -> None:
    assert rows(tmp_path / "m.csv", b"\xef\xbb\xbfid,text\r\na,one\r\n") == [{"id": "a", "text": "one"}]


def test_recordings_of_a_folder_have_their_words_beside_them(tmp_path: Path) -> None:
    for name in ("b/2.wav", "b/2.txt", "b/2.lab", "a.flac", "a.TextGrid", "c.wav", "d.lab", "README.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    found = [row.cells if isinstance(row, ManifestRow) else str(row) for row in Manifest(tmp_path).rows()]
    assert found == [
        {"id": "a", "audio": "a.flac", "script": "a.TextGrid"},
        f"{tmp_path}/c.wav: there are no words beside it; expected a .txt, .lab or .TextGrid of that name",
        f"{tmp_path}/d.lab: there is no recording beside it; expected e.g. a .wav of that name",
        {"id": "b/2", "audio": "b/2.wav", "transcript": "b/2.lab"},
    ]


def test_an_object_has_the_cells_that_it_would_have_in_csv() -> None:
    row = {
        "id": 7,
        "emotion": ["joy:1", "fear:.2"],
        "shape": {"nose_width": 0.5},
        "seed": None,
        "still": False,
    }
    cells = {"id": "7", "emotion": "joy:1;fear:.2", "shape": "nose_width:0.5", "still": "off"}
    assert cells_of(row) == cells


@given(st.binary(max_size=200))
def test_any_bytes_are_rows_or_errors(tmp_path_factory: pytest.TempPathFactory, content: bytes) -> None:
    folder = tmp_path_factory.getbasetemp()
    for name, head in (("any.csv", b"id,text\n"), ("any.jsonl", b"")):
        found = rows(folder / name, head + content + b"\n")
        assert len(found) <= content.count(b"\n") + content.count(b"\r") + 1


def test_memory_does_not_grow_with_the_manifest(tmp_path: Path) -> None:
    path = tmp_path / "m.jsonl"
    line = json.dumps({"id": "x" * 10_000}) + "\n"
    path.write_text(line * 1_000)
    read = Manifest(path).rows()
    tracemalloc.start()
    count = sum(1 for _ in read)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert count == 1_000
    assert peak < 1_000_000
