import errno
from pathlib import Path

import pytest

from risorius.errors import InputError, ParameterError
from risorius.script import Script, read_script
from risorius.script.files import MAX_BYTES, decode
from risorius.script.read import READERS

NOT_TEXT = [
    ("binary", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "f: is a binary file; expected text in UTF-8"),
    ("latin", b"caf\xe9", "f:1:4: is not text in UTF-8 (byte 0xe9); expected UTF-8"),
    ("latin, second line", b"one\n\xc3\xa9\xe9", "f:2:2: is not text in UTF-8 (byte 0xe9)"),
    ("cut UTF-16", b"\xff\xfea", "f:1:1: is not text in UTF-16-LE (byte 0x61)"),
    ("UTF-32", "\ufeffa".encode("utf-32-le"), "f: is in UTF-32; expected UTF-8"),
]


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def refusal(given: str) -> str:
    with pytest.raises(InputError) as caught:
        read_script(given)
    assert str(caught.value).isprintable()
    return str(caught.value)


@pytest.mark.parametrize(("data", "message"), [row[1:] for row in NOT_TEXT], ids=[row[0] for row in NOT_TEXT])
def test_what_is_no_text_is_refused(data: bytes, message: str) -> None:
    with pytest.raises(InputError) as caught:
        decode(data, "f")
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    "name",
    ["hello.xml", "hello.TXT", "some/where.xml", "Read hello.txt", "x.ssml", "x.bml", "x.TextGrid", "x.json"],
)
def test_a_missing_file_is_never_spoken(name: str) -> None:
    assert (
        refusal(name) == f"{name}: there is no such file; expected a file, or --text to have the words spoken"
    )


def test_a_missing_files_name_stays_on_one_line() -> None:
    assert refusal("a\nb.txt").startswith("a b.txt: there is no such file")


def test_folders_are_refused(tmp_path: Path) -> None:
    (tmp_path / "hello").mkdir()
    (tmp_path / "folder.txt").mkdir()
    assert refusal("hello") == "hello: is a folder; expected a file, or --text to have the words spoken"
    assert refusal("folder.txt").startswith("folder.txt: is a folder")


def test_unreadable_files_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path, mode: str) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    (tmp_path / "a.txt").write_text("hello")
    monkeypatch.setattr(Path, "open", refuse)
    assert refusal("a.txt") == "a.txt: cannot be read: Permission denied"


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("a.txt", b"", "a.txt:1: the text is empty"),
        ("a.txt", b"\n?!\n", "a.txt:1: nothing can be spoken in"),
        ("a.txt", b"one\n\x07two", "a.txt:2:1: U+0007 is not a character of a text"),
        ("a.txt", b"a" * (MAX_BYTES + 1), "a.txt: is larger than 2,000,000 bytes; expected less"),
        ("a.txt", b"a" * 100_001, "a.txt:1: the text has 100,001 characters; expected at most 100,000"),
        ("a.txt", b"\x7fELF\0\0", "a.txt: is a binary file"),
        ("a.WAV", b"RIFF\0\0", "a.WAV: is a recording; expected it after --audio"),
        ("a.xml", b"", "a.xml:1: the script is empty"),
        ("a.xml", b"<A>", "a.xml:1:1: A is not closed"),
        ("a.rst", b"hello", "a.rst: unknown suffix '.rst'; expected one of .txt, .xml"),
        ("a.tx", b"hello", "a.tx: unknown suffix '.tx'; did you mean '.txt'?"),
        ("a.json", b"{}", "a.json: unknown suffix '.json'; expected one of .txt, .xml"),
    ],
)
def test_files_that_cannot_be_used_are_refused(tmp_path: Path, name: str, data: bytes, message: str) -> None:
    (tmp_path / name).write_bytes(data)
    assert refusal(name).startswith(message)


@pytest.mark.parametrize("given", ["", "  \n", "?!", "\0.txt"])
def test_words_that_cannot_be_spoken_are_refused(given: str) -> None:
    assert refusal(given).startswith("text:1")


def test_the_source_of_words_is_named() -> None:
    with pytest.raises(InputError, match=r"^stdin:1: the text is empty"):
        read_script("", source="stdin")


@pytest.mark.parametrize(
    "given",
    [
        "Oh, really?",
        "Hello.",
        "It costs 3.14",
        "e.g. this",
        "a" * 5000,
        "One.\nTwo.",
        "no\u2028way",
    ],
)
def test_words_are_spoken(given: str) -> None:
    script = read_script(given)
    assert (script.text, script.timed, script.source) == (given, False, "text")


@pytest.mark.parametrize("given", ["hello.xml", "folder", "page.txt"])
def test_words_are_spoken_whatever_they_look_like_if_asked(tmp_path: Path, given: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "page.txt").write_text("other words")
    assert read_script(given, text=True).text == given


@pytest.mark.parametrize(
    "data",
    [
        "Señor\nTwo.".encode(),
        "Señor\r\nTwo.".encode("utf-8-sig"),
        "Señor\rTwo.".encode("utf-16"),
        b"\xfe\xff" + "Señor\nTwo.".encode("utf-16-be"),
    ],
    ids=["UTF-8", "UTF-8 with mark", "UTF-16", "UTF-16, big end first"],
)
@pytest.mark.parametrize("name", ["page.txt", "page.TXT", "page"])
def test_text_files_are_read(tmp_path: Path, name: str, data: bytes) -> None:
    (tmp_path / name).write_bytes(data)
    script = read_script(name)
    assert (script.text, script.source, script.timed) == ("Señor\nTwo.", name, False)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_markup_files_are_read(tmp_path: Path, encoding: str) -> None:
    declared = "UTF-16" if encoding == "utf-16" else "utf-8"
    text = f'<?xml version="1.0" encoding="{declared}"?>\n<PHONEME text="Señor"/><BLINK time="0"/>'
    (tmp_path / "talk.xml").write_bytes(text.encode(encoding))
    script = read_script(str(tmp_path / "talk.xml"))
    assert (script.text, script.timed) == ("Señor", True)
    assert (script.marks[0].place.line, script.marks[0].place.column) == (2, 24)


def test_errors_name_the_file_as_it_was_given(tmp_path: Path) -> None:
    (tmp_path / "talk.xml").write_text('<PHONEME text="hi"/>\n<BLINK tme="0"/>')
    with pytest.raises(
        ParameterError, match=r"^\./talk\.xml:2:8: unknown attribute 'tme'; did you mean 'time'\?$"
    ):
        read_script("./talk.xml")


def test_a_format_is_one_reader(tmp_path: Path) -> None:
    @READERS.register(".shout")
    def shout(text: str, source: str) -> Script:
        return read_script(text.upper(), text=True, source=source)

    try:
        (tmp_path / "a.shout").write_text("hello")
        assert read_script("a.shout").text == "HELLO"
        assert refusal("b.shout").startswith("b.shout: there is no such file")
    finally:
        READERS.forget(".shout")


@pytest.mark.parametrize("name", ["missing.mp3", "line.docx", "a_folder/", "lines/one", "a.m4a"])
def test_what_looks_like_a_file_s_name_is_not_spoken(name: str) -> None:
    assert (
        refusal(name) == f"{name}: there is no such file; expected a file, or --text to have the words spoken"
    )
    assert read_script(name, text=True).text == name


@pytest.mark.parametrize(
    "words", ["Hello.", "Really?!", "3.5", "Dr.", "and so on…", "yes / no", "See x.y there"]
)
def test_words_are_not_taken_for_a_file(words: str) -> None:
    assert read_script(words).text == words
