"""SSML documents."""

import math
import warnings

import numpy as np
import pytest

from risorius.core.speech.voice_style import VoiceAdjustment
from risorius.errors import RisoriusError, SpeechWarning
from risorius.script.ssml import parse_ssml
from risorius.script.tree import ScriptWarning
from risorius.speech import synthesize_script
from risorius.speech.prosody.pitch import measure_pitch
from risorius.speech.resampled import Resampled

BAD = [
    ("<speak></speak>", "x.ssml:1:1: the text is empty"),
    ("<bml/>", "x.ssml:1:1: <bml> stands outside; expected one <speak>"),
    ("", "x.ssml:1: there is no element; expected <speak>"),
    ("<speak>a</speak><speak>b</speak>", "x.ssml:1:17: <speak> stands outside"),
    ("<speak>Hello <s>there</speak>", "x.ssml:1:14: s is not closed"),
    ("<speak>a & b</speak>", "x.ssml:1:11: a bare '&'; expected &amp;"),
    ('<!DOCTYPE speak [<!ENTITY a "b">]><speak>&a;</speak>', "x.ssml:1:1: document types and entity"),
]
UNSPEAKABLE = [
    ('<speak>Hello\n <lang xml:lang="qq">there</lang></speak>', r"x\.ssml:2:2: unknown language 'qq'"),
    ('<speak xml:lang="qq">Hello</speak>', r"x\.ssml:1:1: unknown language 'qq'"),
]
REPORTED = [
    ("<amazon:effect>b</amazon:effect>", "x.ssml:1:10: <amazon:effect> is not understood", "a b"),
    ('<audio src="x">b</audio>', "<audio> is not understood; its words are spoken plainly", "a b"),
    ('<say-as interpret-as="name">b</say-as>', "interpret-as 'name' is not understood", "a b"),
    ('<prosody contour="(0%,+2st)">b</prosody>', "contour of <prosody> is not understood", "a b"),
    ('<prosody range="120Hz">b</prosody>', "x.ssml:1:19: unknown range '120Hz'", "a b"),
    ('<break time="long"/>b', "x.ssml:1:17: time = 'long' is not a time; expected e.g. 250ms", "a b"),
    ('<break time="0.5"/>b', "x.ssml:1:17: time = '0.5' is not a time; expected e.g. 250ms", "a b"),
    ('<break strength="huge"/>b', "x.ssml:1:17: unknown strength 'huge'", "a b"),
    ('<prosody rate="quick">b</prosody>', "x.ssml:1:19: unknown rate 'quick'", "a b"),
    ('<prosody rate="1%">b</prosody>', "x.ssml:1:19: rate = '1%' is out of range", "a b"),
    ('<prosody pitch="+60st">b</prosody>', "x.ssml:1:19: pitch = '+60st' is out of range", "a b"),
    ('<prosody pitch="1.1">b</prosody>', "x.ssml:1:19: unknown pitch '1.1'", "a b"),
    ('<prosody volume="noisy">b</prosody>', "x.ssml:1:19: unknown volume 'noisy'", "a b"),
    ('<emphasis level="much">b</emphasis>', "x.ssml:1:20: unknown level 'much'", "a b"),
    ('<phoneme ph="hB">b</phoneme>', "x.ssml:1:19: unknown phone 'hB'", "a b"),
    ('<phoneme ph="">b</phoneme>', "x.ssml:1:19: ph has no phones", "a b"),
    ("<phoneme>b</phoneme>", "x.ssml:1:10: <phoneme> without ph is not understood", "a b"),
    ('<phoneme alphabet="arpabet" ph="QX">b</phoneme>', "x.ssml:1:38: unknown phone 'QX'", "a b"),
    ("<sub>b</sub>", "x.ssml:1:10: <sub> without alias is not understood", "a b"),
    ("<mark/>b", "x.ssml:1:10: <mark> without name is not understood", "a b"),
    ("<say-as>b</say-as>", "<say-as> without interpret-as is not understood", "a b"),
    ('<say-as interpret-as="date" format="q">b</say-as>', "interpret-as 'date' is not understood", "a b"),
    ('<say-as interpret-as="expletive">x</say-as>b', "interpret-as 'expletive' is not understood", "a b"),
    ("<lang>b</lang>", "<lang> without xml:lang is not understood", "a b"),
    ('<lexicon uri="x.pls"/>b', "<lexicon> is not understood", "a b"),
    ('<mstts:express-as style="sad">b</mstts:express-as>', "<mstts:express-as> is not understood", "a b"),
    ("<par><media>b</media></par>", "<par> is not understood", "a b"),
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


def test_the_usual_voice_speaks_for_one_that_is_not_there() -> None:
    text = '<speak>Hello <voice name="en-US-JennyNeural">there</voice></speak>'
    with pytest.warns(SpeechWarning, match=r"x\.ssml:1:14: unknown voice .*; the usual voice speaks"):
        utterance = synthesize_script(parse_ssml(text, "x.ssml"))
    assert [word.text for word in utterance.words] == ["Hello", "there"]


@pytest.mark.parametrize(("inside", "message", "spoken"), REPORTED)
def test_what_is_not_understood_is_reported_by_name(inside: str, message: str, spoken: str) -> None:
    with pytest.warns(ScriptWarning) as caught:
        script = parse_ssml(f"<speak>a {inside}</speak>", "x.ssml")
    assert message in str(caught[0].message)
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
        ('the <sub alias="World Wide Web">WWW</sub>', "the WWW"),
        ('the <sub alias="World Wide Web"/>', "the World Wide Web"),
        ("a<!-- no --> b &amp; c", "a b & c"),
        ('<meta name="x" content="y"/><desc>no</desc>yes', "yes"),
        ("<w>one</w> <token>two</token>", "one two"),
    ],
)
def test_the_words(inside: str, text: str) -> None:
    assert parse_ssml(f'<?xml version="1.0"?>\n<speak version="1.1">{inside}</speak>').text == text


@pytest.mark.parametrize(
    ("inside", "text"),
    [
        ("One.<mark name='a'/>Two", "One. Two"),
        ("<prosody rate='slow'>One</prosody><prosody rate='fast'>two</prosody>", "One two"),
        ("<emphasis>Yes</emphasis>, <emphasis>no</emphasis>!", "Yes, no!"),
        ("(<emphasis>aside</emphasis>)<lang xml:lang='de'>ja</lang>", "(aside) ja"),
        ('"<voice name="en-us">Go</voice>" he said', '"Go" he said'),
        ('He said<break strength="none"/>"go"', 'He said "go"'),
        ('"Go."<mark name="a"/>Then', '"Go." Then'),
        ("<say-as interpret-as='cardinal'>5</say-as>%<phoneme ph='a'>a</phoneme>", "5% a"),
        ("in<audio src='x'>a</audio>for <w>b</w><token>c</token>", "in a for b c"),
        ("$<say-as interpret-as='cardinal'>5</say-as>each", "$5 each"),
        ("twenty-<emphasis>one</emphasis>", "twenty-one"),
        ("a<!-- b -->c<![CDATA[d]]>e", "acde"),
        ("你好。<mark name='a'/>世界<emphasis>好</emphasis>", "你好。世界好"),
    ],
)
@pytest.mark.filterwarnings("ignore::risorius.script.tree.ScriptWarning")
def test_elements_that_touch_divide_words(inside: str, text: str) -> None:
    assert parse_ssml(f"<speak>{inside}</speak>").text == text


@pytest.mark.parametrize(
    ("inside", "written", "spoken"),
    [
        ('the <sub alias="World Wide Web">WWW</sub>.', "WWW", "World Wide Web"),
        ('<sub alias="mister Smith">Mr. Smith</sub>', "Mr. Smith", "mister Smith"),
        ('<say-as interpret-as="characters">ab1</say-as>', "ab1", "A, B, 1"),
        ('<say-as interpret-as="telephone">555-1</say-as>', "555-1", "5 5 5 1"),
        ('<say-as interpret-as="date" format="dmy">5.6.2021</say-as>', "5.6.2021", "2021-06-05"),
        ('<say-as interpret-as="date" format="mdy">5/6/21</say-as>', "5/6/21", "2021-05-06"),
        ('the <say-as interpret-as="ordinal">2</say-as>', "2", "2nd"),
        ('the <say-as interpret-as="ordinal">112</say-as>', "112", "112th"),
    ],
)
def test_what_is_said_in_place_of_what_is_written(inside: str, written: str, spoken: str) -> None:
    (line,) = parse_ssml(f"<speak>{inside}</speak>").lines
    (span,) = line.directions.spans
    assert line.text[span.start : span.end] == written
    assert span.spoken == spoken


def test_a_substitute_is_heard_and_the_written_word_is_the_label() -> None:
    script = parse_ssml('<speak>The <sub alias="World Wide Web Consortium">W3C</sub> met.</speak>')
    utterance = synthesize_script(script)
    assert [word.text for word in utterance.words] == ["The", "W3C", "met"]
    label = utterance.words[1]
    phones = [phone.symbol for phone in utterance.phones[label.first_phone : label.last_phone]]
    assert phones[:4] == ["W", "ER", "L", "D"]
    assert phones[-1] in ("M", "N")


def test_rates_of_neighbours_are_their_own() -> None:
    text = "".join(f'<prosody rate="{rate}">One two.</prosody>' for rate in ("x-fast", "default", "x-slow"))
    words = synthesize_script(parse_ssml(f"<speak>{text}</speak>")).words
    lengths = [words[i + 1].end - words[i].start for i in (0, 2, 4)]
    assert lengths[0] < 0.8 * lengths[1] < 0.7 * lengths[2]


def test_marks_have_times() -> None:
    text = "Hello <mark name='0'/> there.<mark name='1'/><break time='1s'/><mark name='2'/>How are you?"
    text += "<mark name='0'/>"
    utterance = synthesize_script(parse_ssml(f"<speak>{text}</speak>"))
    hello, there, how, _, you = utterance.words
    assert hello.text == "Hello"
    times = [(mark.name, mark.time) for mark in utterance.marks]
    assert times == [("0", there.start), ("1", there.end), ("2", how.start), ("0", you.end)]


@pytest.mark.parametrize("join", ["One,{}two", "One.{}Two", "One, {}two", "One - {} two"])
@pytest.mark.parametrize("silent", ['<break strength="none"/>', '<break time="0ms"/>'])
def test_a_break_of_no_strength_prevents_a_pause(join: str, silent: str) -> None:
    script = parse_ssml(f"<speak>{join.format(silent)}</speak>")
    utterance = synthesize_script(script)
    first, second = utterance.words
    assert first.end == second.start
    assert script.text == " ".join(join.format(" ").split())
    paused = synthesize_script(parse_ssml(f"<speak>{join.format(' ')}</speak>"))
    assert paused.words[0].end < paused.words[1].start


def test_a_pitch_in_hertz_is_that_of_the_voice() -> None:
    def pitch(value: str) -> float:
        text = f'<speak><prosody pitch="{value}">Many men may roam.</prosody></speak>'
        utterance = synthesize_script(parse_ssml(text))
        return float(np.nanmedian(measure_pitch(Resampled(utterance.audio), 0.0, utterance.duration).hertz))

    assert pitch("160Hz") / pitch("100Hz") == pytest.approx(1.6, rel=0.15)
    assert pitch("+30Hz") > pitch("+0%") > pitch("-20Hz")


@pytest.mark.parametrize(
    ("attributes", "manner"),
    [
        ('rate="slow"', VoiceAdjustment(rate=0.75)),
        ('rate="80%"', VoiceAdjustment(rate=0.8)),
        ('rate="+20%"', VoiceAdjustment(rate=1.2)),
        ('pitch="+2st" volume="-6dB"', VoiceAdjustment(pitch=2.0, volume=-6.0)),
        ('pitch="+100%"', VoiceAdjustment(pitch=12.0)),
        ('volume="50"', VoiceAdjustment(volume=20 * math.log10(0.5))),
        ('volume="30%"', VoiceAdjustment(volume=20 * math.log10(0.3))),
        ('volume="+20%"', VoiceAdjustment(volume=20 * math.log10(1.2))),
        ('volume="-10.0"', VoiceAdjustment(volume=20 * math.log10(0.9))),
        ('volume="0"', VoiceAdjustment(volume=-60.0)),
        ('volume="silent" pitch="-1.5ST"', VoiceAdjustment(volume=-60.0, pitch=-1.5)),
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
