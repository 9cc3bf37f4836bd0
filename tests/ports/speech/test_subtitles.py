from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.speech.utterance import Utterance
from risorius.errors import OutputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.speech.subtitles import LINES, SPACED, subtitles, write_srt, write_vtt
from risorius.script.plain import parse_plain
from risorius.speech import synthesize_script
from tests.profiles import examples

TIMES = re.compile(r"\d\d:\d\d:\d\d[,.]\d{3} --> \d\d:\d\d:\d\d[,.]\d{3}")
Maker = Callable[..., Utterance]


@pytest.mark.parametrize("write", [write_srt, write_vtt])
def test_nothing_said_is_an_error(tmp_path: Path, take_of: Callable[..., WritableTake], write) -> None:
    with pytest.raises(OutputError, match="there is no speech"):
        write(take_of(), tmp_path / "x", WriteOptions())


def test_both_forms_hold_phrases_with_their_marks(tmp_path: Path, take_of, sentence_of: Maker) -> None:
    said = sentence_of("Well, my friend you? Come in here!", phone=0.1, lead=0.5, pause=0.3)
    said = replace(said, text="Well, my friend & you? Come <in> here!")
    take = take_of(duration=said.duration, utterance=said, audio=said.audio)
    write_srt(take, tmp_path / "x.srt", WriteOptions())
    write_vtt(take, tmp_path / "x.vtt", WriteOptions())
    srt, vtt = (tmp_path / "x.srt").read_text(), (tmp_path / "x.vtt").read_text()
    assert srt.startswith("1\n00:00:00,500 --> 00:00:01,600\nWell, my friend & you?\n\n2\n00:00:01,900 --> ")
    assert vtt.startswith("WEBVTT\n\n00:00:00.500 --> 00:00:01.600\nWell, my friend &amp; you?\n\n")
    assert "\nCome &lt;in&gt; here!\n" in vtt
    assert len(TIMES.findall(srt)) == len(TIMES.findall(vtt)) == 2


@examples(40)
@given(words=st.lists(st.text("abcdefgh", min_size=1, max_size=14), min_size=1, max_size=40))
def test_all_words_are_shown_once_in_lines_that_can_be_read(words: list[str], sentence_of: Maker) -> None:
    said = sentence_of(" ".join(words) + ".")
    cues = list(subtitles(said))
    assert " ".join(" ".join(cue.shape.split()) for cue in cues) == said.text
    for cue in cues:
        assert cue.start < cue.end
        assert len(cue.shape.splitlines()) <= LINES
        assert max(map(len, cue.shape.splitlines())) <= SPACED.width
    assert all(a.end <= b.start for a, b in pairwise(cues))


def test_words_that_touch_in_the_text_touch_in_the_cue() -> None:
    text = "#1 is 3×4=12, pp. 12–15, and 5*6."
    cues = [cue.shape for cue in subtitles(synthesize_script(parse_plain(text, "text")))]
    assert " ".join(" ".join(cues).split()) == text


def test_marks_stand_with_the_words_that_they_open_and_close(sentence_of: Maker) -> None:
    said = replace(sentence_of("One two three."), text='One "two" (three).')
    assert [cue.shape for cue in subtitles(said)] == ['One "two" (three).']
    long = "word " * 16
    said = replace(sentence_of(f"{long}two."), text=f'{long}"two".')
    assert next(cue for cue in subtitles(said) if "two" in cue.shape).shape.endswith('"two".')


def test_words_that_the_text_lacks_are_shown_as_they_are_said(sentence_of: Maker) -> None:
    said = replace(sentence_of("Doctor Smith."), text="Dr. Smith.")
    assert [cue.shape for cue in subtitles(said)] == ["Doctor Smith"]


@pytest.mark.parametrize(
    ("text", "code", "cues"),
    [
        ("我想买一部iphone。你好，世界！", "cmn", ["我想买一部iphone。", "你好，世界！"]),
        (
            "他说：我们明天早上八点半在北京大学的东门外面见面，然后一起坐车去机场。",
            "cmn",
            ["他说：我们明天早上八点半在北京\n大学的东门外面见面，", "然后一起坐车去机场。"],
        ),
        ("えっと、こんにちは。げんきですか。", "ja", ["えっと、こんにちは。", "げんきですか。"]),
        ("We *pack* it **today**.", "en-us", ["We pack it today."]),
    ],
)
def test_cues_as_readers_of_the_language_expect_them(text: str, code: str, cues: list[str]) -> None:
    script = parse_plain(text)
    shown = [cue.shape for cue in subtitles(synthesize_script(script, language=code))]
    assert shown == cues
