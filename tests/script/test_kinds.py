"""Files of another kind are named, with what reads them."""

from __future__ import annotations

from pathlib import Path

import pytest

import risorius
from risorius.errors import InputError, RisoriusError
from risorius.script import read_script

SRT = "1\n00:00:00,000 --> 00:00:03,500\nThe old man.\n"
FILES = [
    ("x.srt", SRT, "holds subtitles; expected them after --transcript, with their recording after --audio"),
    ("x.vtt", "WEBVTT\n", "holds subtitles"),
    ("x.txt", SRT, "looks like subtitles; expected them after --transcript"),
    (
        "x.txt",
        '<?xml version="1.0"?>\n<speak>Hi.</speak>',
        "looks like SSML; expected a .ssml file, or --text",
    ),
    ("x.txt", "<bml><speech/></bml>", "looks like BML; expected a .bml file"),
    ("x.txt", '<PHONEME text="Oh"/>', "looks like markup; expected a .xml file"),
    ("x.txt", "<apml>Hi.</apml>", "looks like APML; expected a .apml file"),
    ("x.txt", '<?xml version="1.0"?><!DOCTYPE apml SYSTEM "apml.dtd" []><APML >', "looks like APML"),
    ("x.bml", "<!-- one --><fml-apml><bml/></fml-apml>", "looks like APML; expected a .apml file"),
    ("x.apml", "<bml></bml>", "looks like BML; expected a .bml file"),
    ("x.xml", "<speak>Hi.</speak>", "looks like SSML; expected a .ssml file"),
    ("x.ssml", "<bml></bml>", "looks like BML; expected a .bml file"),
    ("x.txt", 'File type = "ooTextFile"\n', "looks like a TextGrid; expected a .TextGrid file"),
    ("x.txt", '{"risorius": 1}', "looks like a score; expected a .score.json file"),
    ("x.txt", "<!DOCTYPE html><p>Hi", "looks like a page"),
    ("x.txt", b"PK\x03\x04abc", "is a document or an archive; expected its text"),
    ("x.txt", b"%PDF-1.7", "is a PDF"),
    ("x.docx", b"PK\x03\x04abc", "is a document; expected its text"),
    ("x.csv", "a,b\n", "is a table: expected risorius play for a captured face"),
    ("x.glb", b"glTF", "is a character; expected it after risorius rig"),
    ("x.wav", b"RIFF", "is a recording; expected it after --audio"),
]


@pytest.mark.parametrize(("name", "content", "message"), FILES, ids=[row[2][:40] for row in FILES])
def test_a_file_of_another_kind_is_named(
    name: str, content: str | bytes, message: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError) as caught:
        read_script(str(path))
    assert message in str(caught.value)


@pytest.mark.parametrize("text", ["I <speak> up.", "At 10:30 --> home", "{risorius}", "File type = x"])
def test_plain_words_are_not_taken_for_another_kind(text: str) -> None:
    assert read_script(text).text == text


def test_text_is_spoken_whatever_it_looks_like() -> None:
    assert "speak" in read_script("<speak>Hi.</speak>", text=True).text


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("x.txt", "is to be spoken; expected risorius speak"),
        ("x.wav", "is a recording; expected it after --audio"),
    ],
)
def test_what_is_not_a_capture_is_named(name: str, message: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("Hi.")
    with pytest.raises(RisoriusError, match=message):
        risorius.play(tmp_path / name)


def test_a_recording_is_not_a_transcript(tmp_path: Path) -> None:
    (tmp_path / "x.wav").write_bytes(b"RIFF")
    with pytest.raises(InputError, match="is a recording; expected its words"):
        risorius.align(tmp_path / "x.wav", tmp_path / "x.wav")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("x.ssml", "<speak>Hi.</speak>", "is not a recording: it is to be spoken; expected risorius speak"),
        (
            "x.TextGrid",
            'File type = "ooTextFile"\n',
            "is not a recording: it holds labels; expected risorius speak",
        ),
        ("x.srt", SRT, "is not a recording: it holds subtitles; expected them after --transcript"),
        ("voice.wav", "Good morning.", "is not a recording: it is a text; expected risorius speak"),
        ("voice.wav", b"\xff\xfb\x90\x00abc", "cannot be read"),
        ("voice.wav", SRT, "is not a recording: it looks like subtitles"),
        ("voice.mp3", b"PK\x03\x04" + bytes(60), "is not a recording: it is a document or an archive"),
        (
            "x.glb",
            b"glTF" + bytes(60),
            "is not a recording: it is a character; expected it after risorius rig",
        ),
    ],
)
def test_a_file_that_is_no_recording_is_named(
    name: str, content: str | bytes, message: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError) as caught:
        risorius.speak("Good morning.", audio=path)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("x.ssml", "<speak>Hi.</speak>", "is not a score: it is to be spoken; expected risorius speak"),
        ("x.TextGrid", 'File type = "ooTextFile"\n', "is not a score: it holds labels"),
        ("x.wav", b"RIFF" + bytes(60), "is not a score: it is a recording; expected it after --audio"),
        ("x.csv", "a,b\n1,2\n", "is not a score: it is a table: expected risorius play"),
        ("x.score.json", "{", "is not JSON"),
        ("x.json", "not yet", "is not JSON"),
    ],
)
def test_a_file_that_is_no_score_is_named(
    name: str, content: str | bytes, message: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError) as caught:
        risorius.mix(path)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("x.ssml", "<speak>Hi.</speak>", "holds marks; expected its words alone, or risorius speak"),
        ("x.TextGrid", 'File type = "ooTextFile"\n', "holds labels; expected its words alone"),
        ("x.txt", "<bml></bml>", "looks like BML"),
    ],
)
def test_a_transcript_that_holds_more_than_words_is_named(
    name: str, content: str, message: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(InputError) as caught:
        risorius.align(tmp_path / "voice.wav", str(path))
    assert message in str(caught.value)


def test_a_recording_is_no_performance(tmp_path: Path) -> None:
    (tmp_path / "x.wav").write_bytes(b"RIFF" + bytes(60))
    with pytest.raises(
        InputError, match="is not a performance: it is a recording; expected it after --audio"
    ):
        risorius.load(tmp_path / "x.wav")
