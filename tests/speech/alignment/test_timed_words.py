"""Words whose times are known: refused ones, and phones within them."""

from __future__ import annotations

import pytest

from risorius import speak
from risorius.core.speech.audio import AudioWriter, silence
from risorius.core.speech.utterance import SILENCE, Utterance
from risorius.errors import InputError
from risorius.speech.alignment.aligner import assembled
from risorius.speech.alignment.text_progress import text_progress
from risorius.speech.alignment.timed_words import TimedWord, check_times, locate_in_words, written

TEXT = "Well, that is a long story. She paid 3.50 for it."


@pytest.fixture(scope="module")
def spoken() -> Utterance:
    utterance = speak(TEXT, text=True).utterance
    assert utterance is not None
    return utterance


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        ([("a", 0.2, 0.1)], "lasts from 0.2 to 0.1 s; expected it to end after it starts"),
        ([("a", -0.1, 0.1)], "expected it to end after it starts"),
        ([("a", 0.0, float("nan"))], "expected it to end after it starts"),
        ([("a", 0.0, 0.5), ("b", 0.3, 0.8)], "the one before it to 0.5 s; expected one after another"),
        ([("a", 0.4, 0.5), ("b", 0.1, 0.2)], "'b' lasts from 0.1 to 0.2 s"),
    ],
)
def test_times_that_no_speech_has_are_refused(words: list[tuple[str, float, float]], fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        check_times([TimedWord(*word) for word in words])


def test_times_beyond_the_sound_are_refused() -> None:
    with pytest.raises(InputError, match=r"'b' ends at 1\.2 s, but the sound at 1\.000 s"):
        locate_in_words(silence(1.0), [TimedWord("a", 0.0, 0.5), TimedWord("b", 0.5, 1.2)])


def test_words_keep_their_times_and_gaps_are_silent(spoken: Utterance) -> None:
    words = [TimedWord(word.text, word.start, word.end) for word in spoken.words]
    found = locate_in_words(spoken.audio, words)
    heard = assembled(spoken.audio, written(words), found.phones, found.words, found.language)
    assert [word.text for word in heard.words] == [word.text for word in words]
    for said, word in zip(heard.words, words, strict=True):
        assert (said.start, said.end) == pytest.approx((word.start, word.end), abs=0.02)
    silences = [p for p in heard.phones if p.symbol == SILENCE]
    assert len(silences) == sum(phone.symbol == SILENCE for phone in spoken.phones)
    phones = [p.symbol for p in heard.phones[heard.words[8].first_phone : heard.words[8].last_phone]]
    assert phones[:2] == ["TH", "R"]  # 3.50 is read out
    truth = [phone.start for phone in spoken.phones if phone.symbol]
    ours = [phone.start for phone in heard.phones if phone.symbol]
    assert len(truth) == len(ours)
    assert sum(abs(a - b) < 0.03 for a, b in zip(truth, ours, strict=True)) > 0.8 * len(truth)


def test_words_that_the_sound_has_no_room_for_are_divided_evenly() -> None:
    (word, *_) = found = locate_in_words(silence(0.3), [TimedWord("extraordinary", 0.1, 0.2)]).phones
    assert word.symbol == SILENCE
    said = [phone.end - phone.start for phone in found if phone.symbol]
    assert len(said) > 9
    assert said == pytest.approx([0.1 / len(said)] * len(said), rel=0.3)


def test_how_much_of_a_text_is_said_up_to_a_pause(spoken: Utterance) -> None:
    rate = spoken.audio.sample_rate
    inner = [p for p in spoken.pauses if p.start > 0 and p.end < spoken.audio.duration]
    found = []
    for pause in inner:
        with AudioWriter(rate) as writer:
            writer.append(spoken.audio.read(0, round(0.5 * (pause.start + pause.end) * rate)))
            found.append(TEXT[: text_progress(writer.finish(), TEXT)])
    assert found == ["Well, ", "Well, that is a long story. "]


def test_nothing_of_a_text_is_said_in_silence() -> None:
    assert text_progress(silence(1.0), TEXT) == 0
