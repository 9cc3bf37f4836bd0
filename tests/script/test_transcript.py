"""Transcripts as they come: tags, speakers and times are no words, and each character stays at its place."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.speech.characters import shown
from risorius.errors import InputError
from risorius.script.plain import TextForm, parse_plain
from risorius.script.subtitles import looks_like_subtitles, read_subtitles
from risorius.script.transcript import without_speakers, without_tags
from risorius.script.tree import ScriptWarning

HEARD = TextForm(heard=True)
TAGS = [
    ("[laughs] The old man (sighs) went", "The old man went"),
    ("{breath} one <noise> two 【笑】", "one two"),
    ("(clears throat) Well (of course)", "Well (of course)"),
    ("*coughs* and *really*", "and *really*"),
    ("[00:01:02] It is [inaudible 0:03] late", "It is late"),
    ("♪ la la ♪", "la la"),
    ("Sie kam (lacht) nicht (mehr)", "Sie kam nicht (mehr)"),
]
SPEAKERS = [
    ("ANNA: Hi.\nBO: Hello.\nANNA: Bye.\nBO: Bye.", "Hi. Hello. Bye. Bye."),
    ("Anna: Hi.\nBo: Hello.", "Anna: Hi. Bo: Hello."),
    ("Speakers: Anna, Bo\nAnna: Hi.\nBo: Hello.", "Hi. Hello."),
    ("Anna: Hi.\n \nBo: Hello.", "Anna: Hi. Bo: Hello."),
    ("0:01\nAnna: Hi.\n0:05\nBo: Hello.", "Anna: Hi. Bo: Hello."),
    ("Note: one.\nNote: two.", "Note: one. Note: two."),
    ("10:30 is late.\nWe left at 10:40.", "10:30 is late. We left at 10:40."),
    ("0:05 Anna: Hi.\n0:09 Bo: Hm.\n0:12 Anna: Bye.", "Hi. Bo: Hm. Bye."),
    ("Speaker 1: Hi.\n>> Dr. Lee: Well.\nSpeaker 1: Bye.\n>> Dr. Lee: So.", "Hi. >> Well. Bye. >> So."),
    ("小明：你好。\n小红：你好。\n小明：再见。\n小红：再见。", "你好。 你好。 再见。 再见。"),
    ("Well, he said: no.\nWell, he said: yes.", "Well, he said: no. Well, he said: yes."),
]
SRT = """1
00:00:01,000 --> 00:00:03,500
<i>The old man</i> walked
{\\an8}his dog &amp; cat.

2
00:00:04,000 --> 00:00:05,000
[door slams]
3
00:00:06,000 --> 00:00:07,250
- ANNA: Yes.

4
00:00:08,000 --> 00:00:09,000
ANNA: No.
"""
VTT = """WEBVTT - a film

NOTE not this

STYLE
::cue { color: red }

first
00:01.000 --> 00:02.500 align:start
<v Anna>Hello <00:01.500>there.</v>

01:00:02.000 --> 01:00:03.000
Late.
"""


def flat(text: str) -> str:
    return " ".join(shown(text).split())


@pytest.mark.parametrize(("text", "words"), TAGS)
def test_tags_are_no_words_of_a_transcript(text: str, words: str) -> None:
    assert flat(without_tags(text, known_only=False).text) == words


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[laughs] Yes (sighs).", "Yes ."),
        ("See [1] and [the rest].", "See [1] and [the rest]."),
        ("(no)", "(no)"),
    ],
)
def test_only_sounds_are_left_out_of_a_text_that_is_spoken(text: str, words: str) -> None:
    assert flat(without_tags(text, known_only=True).text) == words


@pytest.mark.parametrize(("text", "words"), SPEAKERS)
def test_names_of_speakers_are_no_words(text: str, words: str) -> None:
    assert flat(without_speakers(text).text) == words


@given(st.text(st.sampled_from("aB1: \n[](){}<>*♪-\u3010\u3011,."), max_size=60))
def test_every_character_stays_at_its_place(text: str) -> None:
    for plain in (without_tags(text, known_only=False), without_speakers(text)):
        assert len(plain.text) == len(text)
        assert plain.text.count("\n") == text.count("\n")


def test_what_is_left_out_is_named_and_can_be_kept() -> None:
    text = "ANNA: Hi [laughs].\nANNA: Bye."
    with pytest.warns(
        ScriptWarning, match=r"^t: left out: the tag \[laughs\] \(line 1\), the name ANNA \(line 1, 2 "
    ):
        assert flat(parse_plain(text, "t", HEARD).text) == "Hi . Bye."
    assert parse_plain(text, "t", HEARD._replace(keep_tags=True)).text == text
    with pytest.warns(ScriptWarning, match=r"^t: left out: the tag \[laughs\] \(line 1\)$"):
        assert flat(parse_plain(text, "t").text) == "ANNA: Hi . ANNA: Bye."


def test_a_transcript_of_tags_alone_is_an_error() -> None:
    with pytest.raises(InputError, match="the text is empty"):
        parse_plain("[laughs] (sighs)", "t", HEARD)


def test_subtitles_are_words_with_times() -> None:
    cues = read_subtitles(SRT, "x.srt")
    assert [(flat(cue.text), cue.start, cue.end) for cue in cues] == [
        ("The old man walked his dog & cat.", 1.0, 3.5),
        ("- Yes.", 6.0, 7.25),
        ("No.", 8.0, 9.0),
    ]
    assert [cue.place.line for cue in cues] == [2, 10, 14]
    assert flat(read_subtitles(SRT, "x.srt", keep_tags=True)[1].text) == "[door slams]"
    spoken = [(flat(cue.text), cue.start) for cue in read_subtitles(VTT, "x.vtt")]
    assert spoken == [("Hello there.", 1.0), ("Late.", 3602.0)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Hello.", "x.srt:1: has no cue"),
        ("00:00:05,000 --> 00:00:01,000\nHi", "x.srt:1: ends at 1 s, before"),
    ],
)
def test_files_that_are_no_subtitles(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_subtitles(text, "x.srt")


def test_subtitles_are_known_by_their_times() -> None:
    assert looks_like_subtitles(SRT)
    assert looks_like_subtitles(VTT)
    assert not looks_like_subtitles("At 10:30 --> home.")
