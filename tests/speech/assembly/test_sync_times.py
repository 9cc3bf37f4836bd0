"""Speech whose places in the text have times."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError, SpeechWarning
from risorius.script.bml import parse_bml
from risorius.speech import synthesize_script

TURN = (
    '<sync id="a" time="0.10"/>it\'s <sync id="b" time="0.45"/> <sync id="c" time="0.45"/>my '
    '<sync id="d" time="0.80"/> <sync id="e" time="0.80"/>turn <sync id="f" time="1.60"/>'
)


def said(text: str, start: str = "") -> Utterance:
    script = parse_bml(f'<bml><speech id="s"{start}>\n<text>{text}</text></speech></bml>', "x.bml")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return synthesize_script(script)


def spans(utterance: Utterance) -> list[tuple[str, float, float]]:
    return [(word.text, round(word.start, 3), round(word.end, 3)) for word in utterance.words]


def test_words_are_where_smartbody_says() -> None:
    assert spans(said(TURN)) == [("it's", 0.1, 0.45), ("my", 0.45, 0.8), ("turn", 0.8, 1.6)]


def test_times_count_from_the_start_of_the_speech() -> None:
    assert spans(said(TURN, ' start="2.0"'))[0] == ("it's", 2.1, 2.45)


@pytest.mark.parametrize("time", [0.3, 0.9, 2.5])
def test_a_single_place_is_the_start_of_the_next_word(time: float) -> None:
    plain = said("Hello there, my friend.")
    timed = said(f'Hello <sync id="t" time="{time}"/>there, my friend.')
    assert timed.words[1].start == pytest.approx(time, abs=0.001)
    lengths = [[w.end - w.start for w in utterance.words[1:]] for utterance in (plain, timed)]
    assert lengths[1] == pytest.approx(lengths[0], abs=0.01)
    assert timed.words[0].end - timed.words[0].start < 1.4 * (plain.words[0].end - plain.words[0].start)
    assert timed.audio.duration == pytest.approx(timed.duration, abs=0.001)


def test_two_places_leave_a_pause_and_the_last_is_the_end() -> None:
    timed = said('One <sync id="a" time="0.5"/><sync id="b" time="1.2"/>two three.<sync id="c" time="2.4"/>')
    assert timed.words[0].end == pytest.approx(0.5, abs=0.001)
    assert timed.words[1].start == pytest.approx(1.2, abs=0.001)
    assert timed.words[2].end == pytest.approx(2.4, abs=0.001)
    rate = timed.audio.sample_rate
    pause = timed.audio.read(round(0.52 * rate), round(0.6 * rate))
    assert np.abs(pause.astype(float)).max() < 0.05 * np.abs(timed.audio.read().astype(float)).max()


def test_phones_follow_one_another() -> None:
    timed = said(TURN)
    assert all(a.end == b.start for a, b in zip(timed.phones, timed.phones[1:], strict=False))
    assert timed.phones[0].start == 0.0


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('Hello my dear old <sync id="t" time="0.1"/>friend', r"times as fast"),
        (
            'Hello <sync id="a" time="1.0"/>my <sync id="t" time="0.7"/>friend',
            "it is not after the one before it",
        ),
        ('My co<sync id="t" time="1.0"/>-operative friend', "it is inside a word"),
        ('Hello <sync id="t" time="9"/><sync id="u" time="9.5"/>friend', r"times as slow"),
    ],
)
def test_a_time_that_cannot_hold_is_told_with_its_reason(text: str, reason: str) -> None:
    script = parse_bml(f'<bml><speech id="s">\n<text>{text}</text></speech></bml>', "x.bml")
    with pytest.warns(SpeechWarning, match=rf"x.bml:2:\d+: sync point 't' is not at [\d.]+ s: .*{reason}"):
        utterance = synthesize_script(script)
    assert utterance.words[-1].text == "friend"


@pytest.mark.parametrize("time", ["soon", "-1", "nan", ""])
def test_what_is_not_a_time_is_refused_with_its_place(time: str) -> None:
    with pytest.raises(InputError, match=r"x.bml:1:\d+: time = .*; expected seconds"):
        parse_bml(f'<bml><speech id="s"><text>a <sync id="t" time="{time}"/>b</text></speech></bml>', "x.bml")
