"""SSML documents."""

import warnings

import pytest

from risorius.core.speech.voice_style import VoiceAdjustment
from risorius.errors import RisoriusError, SpeechWarning
from risorius.script.ssml import parse_ssml
from risorius.script.tree import ScriptWarning
from risorius.speech import synthesize_script

BAD = [
    ("<speak></speak>", "x.ssml:1:1: the text is empty"),
    ("<bml/>", "x.ssml:1:1: <bml> stands outside; expected one <speak>"),
    ("", "x.ssml:1: there is no element; expected <speak>"),
    ("<speak>a</speak><speak>b</speak>", "x.ssml:1:17: <speak> stands outside"),
    ("<speak>Hello <s>there</speak>", "x.ssml:1:14: s is not closed"),
    ("<speak>a & b</speak>", "x.ssml:1:11: a bare '&'; expected &amp;"),
    ('<!DOCTYPE speak [<!ENTITY a "b">]><speak>&a;</speak>', "x.ssml:1:1: document types and entity"),
    (
        '<speak>a <break time="long"/></speak>',
        "x.ssml:1:17: time = 'long' is not a time; expected e.g. 250ms",
    ),
    ('<speak>a <break strength="huge"/></speak>', "x.ssml:1:17: unknown strength 'huge'"),
    ('<speak>a\n <prosody rate="quick">b</prosody></speak>', "x.ssml:2:11: unknown rate 'quick'"),
    ('<speak>a <prosody rate="1%">b</prosody></speak>', "x.ssml:1:19: rate = '1%' is out of range"),
    ('<speak>a <prosody pitch="+60st">b</prosody></speak>', "x.ssml:1:19: pitch = '+60st' is out of range"),
    ('<speak>a <prosody volume="9">b</prosody></speak>', "x.ssml:1:19: unknown volume '9'"),
    ('<speak>a <emphasis level="much">b</emphasis></speak>', "x.ssml:1:20: unknown level 'much'"),
    ('<speak>a <phoneme ph="hB">b</phoneme></speak>', "x.ssml:1:19: unknown phone 'hB'"),
    ('<speak>a <phoneme ph="">b</phoneme></speak>', "x.ssml:1:19: ph has no phones"),
    ("<speak>a <phoneme>b</phoneme></speak>", "x.ssml:1:10: <phoneme>: ph is missing"),
    (
        '<speak>a <phoneme alphabet="arpabet" ph="HH QX">b</phoneme></speak>',
        "x.ssml:1:38: unknown phone 'QX'",
    ),
    ('<speak>a <mark name="b"/> c <mark name="b"/></speak>', "x.ssml:1:29: the mark 'b' is set twice"),
    ("<speak>a <sub>b</sub></speak>", "x.ssml:1:10: <sub>: alias is missing"),
]
UNSPEAKABLE = [
    ('<speak>Hello\n <lang xml:lang="qq">there</lang></speak>', r"x\.ssml:2:2: unknown language 'qq'"),
    ('<speak>Hello <voice name="nobody">there</voice></speak>', r"x\.ssml:1:14: unknown voice 'nobody'"),
    ('<speak xml:lang="qq">Hello</speak>', r"x\.ssml:1:1: unknown language 'qq'"),
]
REPORTED = [
    ("<amazon:effect>b</amazon:effect>", "x.ssml:1:10: <amazon:effect> is not understood", "a b"),
    ('<audio src="x">b</audio>', "<audio> is not understood; its words are spoken plainly", "a b"),
    ('<say-as interpret-as="date">b</say-as>', "interpret-as 'date' is not understood", "a b"),
    ('<prosody contour="(0%,+2st)">b</prosody>', "contour of <prosody> is not understood", "a b"),
    ('<prosody pitch="120Hz">b</prosody>', "pitch in Hz is not understood", "a b"),
    ('<phoneme alphabet="x-sampa" ph="a">b</phoneme>', "alphabet 'x-sampa' is not understood", "a b"),
    ('<emphasis style="x">b</emphasis>', "x.ssml:1:20: style of <emphasis> is not understood", "a b"),
    ('<voice gender="female">b</voice>', "gender of <voice> is not understood", "a b"),
]


@pytest.mark.parametrize(("text", "message"), BAD, ids=[row[0][:40] for row in BAD])
def test_faults_have_their_place(text: str, message: str) -> None:
    with pytest.raises(RisoriusError) as caught:
        parse_ssml(text, "x.ssml")
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(("text", "message"), UNSPEAKABLE)
def test_voices_that_are_not_there(text: str, message: str) -> None:
    with pytest.raises(RisoriusError, match=message):
        synthesize_script(parse_ssml(text, "x.ssml"))


@pytest.mark.parametrize(("inside", "message", "spoken"), REPORTED)
def test_what_is_not_understood_is_reported_by_name(inside: str, message: str, spoken: str) -> None:
    with pytest.warns(ScriptWarning) as caught:
        script = parse_ssml(f"<speak>a {inside}</speak>", "x.ssml")
    assert [message in str(w.message) for w in caught] == [True]
    assert script.text == spoken


def test_it_is_reported_once() -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        parse_ssml("<speak>a <x>b</x> <x>c</x> <y>d</y></speak>")
    assert len(caught) == 2


@pytest.mark.parametrize(
    ("inside", "text"),
    [
        ("one\n  two", "one two"),
        ("<s>One</s><s>two.</s>", "One. two."),
        ("<p><s>One</s></p> two", "One. two"),
        ('the <sub alias="World Wide Web">WWW</sub>', "the World Wide Web"),
        ('<say-as interpret-as="characters">ab1</say-as>', "A, B, 1"),
        ('<say-as interpret-as="telephone">555-1</say-as>', "5 5 5 1"),
        ('the <say-as interpret-as="ordinal">2</say-as>', "the 2nd"),
        ('the <say-as interpret-as="ordinal">112</say-as>', "the 112th"),
        ("a<!-- no --> b &amp; c", "a b & c"),
        ('<meta name="x" content="y"/><desc>no</desc>yes', "yes"),
        ("<w>one</w> <token>two</token>", "one two"),
    ],
)
def test_the_words(inside: str, text: str) -> None:
    assert parse_ssml(f'<?xml version="1.0"?>\n<speak version="1.1">{inside}</speak>').text == text


@pytest.mark.parametrize(
    ("attributes", "manner"),
    [
        ('rate="slow"', VoiceAdjustment(rate=0.75)),
        ('rate="80%"', VoiceAdjustment(rate=0.8)),
        ('rate="+20%"', VoiceAdjustment(rate=1.2)),
        ('pitch="+2st" volume="-6dB"', VoiceAdjustment(pitch=2.0, volume=-6.0)),
        ('pitch="+100%"', VoiceAdjustment(pitch=12.0)),
        ('pitch="x-high" range="x-low" volume="loud"', VoiceAdjustment(pitch=5.0, range=0.3, volume=4.0)),
    ],
)
def test_prosody(attributes: str, manner: VoiceAdjustment) -> None:
    (span,) = parse_ssml(f"<speak>a <prosody {attributes}>b</prosody></speak>").lines[0].directions.spans
    assert (span.start, span.end) == (2, 3)
    assert span.manner == manner


def test_ipa_keeps_stress_on_its_vowel() -> None:
    text = '<speak><phoneme ph="təˈmɑːtoʊ">tomato</phoneme></speak>'
    (span,) = parse_ssml(text).lines[0].directions.spans
    assert span.phones == ("t", "ə", "m", "ˈɑː", "t", "oʊ")


def test_what_is_asked_for_is_heard() -> None:
    plain = synthesize_script(parse_ssml("<speak>Julia prefers popcorn today.</speak>"))
    asked = synthesize_script(
        parse_ssml(
            '<speak>Julia <break time="500ms"/> <prosody rate="50%">prefers</prosody>'
            ' <phoneme ph="ˈkæbɪdʒ">popcorn</phoneme> <emphasis>today</emphasis>.</speak>'
        )
    )
    words = [(w.end - w.start, u.end - u.start) for w, u in zip(plain.words, asked.words, strict=True)]
    assert words[1][1] > 1.6 * words[1][0]
    assert asked.words[1].start - asked.words[0].end > 0.4
    cabbage = asked.words[2]
    phones = [p.symbol for p in asked.phones[cabbage.first_phone : cabbage.last_phone]]
    assert phones == ["K", "AE", "B", "IH", "JH"]
    assert [a.label for a in asked.accents if a.word == 3] == ["L+H*"]


def test_a_word_of_another_language_has_its_sounds() -> None:
    said = synthesize_script(parse_ssml('<speak>Guten <lang xml:lang="de">Weg</lang></speak>'))
    way = said.words[1]
    assert said.phones[way.first_phone].symbol == "V"


def test_a_break_at_the_end_is_kept() -> None:
    plain, longer = (
        synthesize_script(parse_ssml(f"<speak>Hello.{more}</speak>")) for more in ("", '<break time="1s"/>')
    )
    assert longer.duration - plain.duration == pytest.approx(1.0, abs=0.35)


def test_other_languages_say_that_they_take_no_phonemes() -> None:
    text = '<speak xml:lang="de">Guten <phoneme ph="taːk">Tag</phoneme></speak>'
    with pytest.warns(SpeechWarning, match=r"x\.ssml:1:28: only English voices take phonemes"):
        said = synthesize_script(parse_ssml(text, "x.ssml"))
    assert said.words[1].text == "Tag"


def test_another_voice_for_some_words() -> None:
    said = synthesize_script(parse_ssml("<speak>Can't <voice name=\"en-gb\">can't</voice>.</speak>"))
    vowels = [said.phones[w.first_phone + 1].symbol for w in said.words]
    assert vowels == ["AE", "AA"]
