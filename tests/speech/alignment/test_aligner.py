"""Alignment of what espeak-ng says, against espeak-ng's own times."""

from __future__ import annotations

import warnings
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
import pytest

from risorius.core.speech.audio import Audio, AudioWriter
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError, SpeechWarning
from risorius.speech import synthesize_line
from risorius.speech.alignment import align
from risorius.speech.alignment.confidence import check_words
from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.lexicon import OwnPhone, read_transcript

WRONG = "Some completely different words were never spoken here at all."


def starts(utterance: Utterance, symbols: str) -> np.ndarray:
    return np.array([p.start for p in utterance.phones if p.symbol in symbols.split()])


def quietly(audio: Audio, text: str) -> Utterance:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return align(audio, text)


def test_another_lines_transcript_is_refused_with_the_words_in_doubt(spoken: Utterance) -> None:
    with pytest.raises(
        InputError, match=r"does not fit the recording; perhaps not .* \(\d+ of 10 words\): '\w+' at"
    ):
        align(spoken.audio, WRONG)


def test_more_words_than_there_is_time_for_are_refused(spoken: Utterance) -> None:
    with pytest.raises(
        InputError, match=r"does not fit the recording; \d+ words do not fit into 0.00 to 2.\d+ s"
    ):
        align(spoken.audio, WRONG * 5)


@pytest.mark.parametrize("text", ["", " \n", "?!"])
def test_a_transcript_without_words_is_refused(text: str, spoken: Utterance) -> None:
    with pytest.raises(InputError):
        align(spoken.audio, text)


@pytest.mark.parametrize(("doubtful", "refused"), [(1, False), (2, False), (4, True), (9, True)])
def test_one_word_in_doubt_of_a_poor_voice_is_no_refusal(doubtful: int, refused: bool) -> None:
    _, words = read_transcript("your letter went away on Monday night number nine")
    scores = [-80.0] * doubtful + [-30.0] * (9 - doubtful)
    aligned = [AlignedPhone("AH", 0.3 * k, 0.3 * (k + 1), k, score) for k, score in enumerate(scores)]
    if refused:
        with pytest.raises(InputError, match="does not fit the recording"):
            check_words(words, aligned)
    else:
        with pytest.warns(SpeechWarning, match=rf"perhaps not said .*\({doubtful} of 9 words\)"):
            check_words(words, aligned)


def test_foreign_words_are_refused_though_none_is_in_doubt_by_itself() -> None:
    _, words = read_transcript("my dear old friend")
    foreign = tuple(word._replace(own=(OwnPhone("AH", 1),)) for word in words)
    aligned = [AlignedPhone("AH", 0.3 * k, 0.3 * (k + 1), k, -60.0) for k in range(len(foreign))]
    with pytest.raises(InputError, match="does not fit the recording"):
        check_words(foreign, aligned)


def test_words_that_are_not_said_are_named(spoken: Utterance) -> None:
    with pytest.warns(SpeechWarning, match=r"perhaps not said in the recording .*'scissors' at"):
        align(spoken.audio, spoken.text.replace("big", "scissors"))


@pytest.mark.parametrize(
    ("said", "wrong"),
    [
        ("the beam.", "the deep blue sea."),
        ("the beam.", "the beam and then he slept."),
        ("big ", "big green "),
    ],
)
def test_words_without_room_are_named(spoken: Utterance, said: str, wrong: str) -> None:
    with pytest.warns(SpeechWarning, match="perhaps not said in the recording"):
        align(spoken.audio, spoken.text.replace(said, wrong))


def test_what_the_transcript_lacks_is_told(spoken: Utterance) -> None:
    with pytest.warns(SpeechWarning, match=r"said in the recording, but not in the transcript: \d\.\d\d to"):
        align(spoken.audio, "My baby brother put the big map by")


def test_phones_are_where_espeak_says(spoken: Utterance) -> None:
    found = quietly(spoken.audio, spoken.text)
    assert [w.text for w in found.words] == [w.text for w in spoken.words]
    away = np.array([a.start - b.start for a, b in zip(found.words, spoken.words, strict=True)])
    assert np.median(np.abs(away)) < 0.02
    assert np.abs(away).max() < 0.08
    for labials in ("M", "B", "P"):
        assert starts(found, labials) == pytest.approx(starts(spoken, labials), abs=0.05)


def test_two_threads_that_align_at_once_get_what_each_gets_alone(spoken: Utterance) -> None:
    other = synthesize_line("I told you so.")
    expected = [quietly(said.audio, said.text).phones for said in (spoken, other)]
    with ThreadPoolExecutor(2) as threads:
        both = list(threads.map(lambda said: align(said.audio, said.text).phones, (spoken, other)))
    assert both == expected


def test_the_result_is_whole(spoken: Utterance) -> None:
    found = quietly(spoken.audio, spoken.text)
    assert found.language == "en-us"
    assert found.syllables
    assert all(a.end <= b.start for a, b in pairwise(found.words))
    assert all(found.text[w.source_start : w.source_end] == w.text for w in found.words)
    assert {p.stress for p in found.phones if p.symbol in ("M", "B", "")} == {-1}
    assert found.phones == quietly(spoken.audio, spoken.text).phones


@pytest.mark.parametrize(
    "text",
    [
        "Dr. Smith paid $5.50 in 1984.",
        "The xylophonist Wraxlby is 42.",
        "The BBC and NASA met at 10 o'clock.",
        "Well-being, isn\u2019t it?",
    ],
)
def test_numbers_abbreviations_and_unknown_words_are_read(text: str) -> None:
    said = synthesize_line(text, lead=0.2, tail=0.2)
    found = quietly(said.audio, text)
    assert [w.text for w in found.words] == [w.text for w in said.words]
    assert found.words[-1].end == pytest.approx(said.words[-1].end, abs=0.1)


def test_digital_silence_and_no_silence_are_both_aligned(spoken: Utterance) -> None:
    samples = spoken.audio.read()
    first, last = (round(t * spoken.audio.sample_rate) for t in (spoken.words[0].start, spoken.words[-1].end))
    for part in (samples[first:last], np.concatenate([np.zeros(60_000, np.int16), samples])):
        with AudioWriter(spoken.audio.sample_rate) as writer:
            writer.append(part)
            audio = writer.finish()
        found = quietly(audio, spoken.text)
        assert len(found.words) == len(spoken.words)
        away = np.array([a.end - b.end for a, b in zip(found.words, spoken.words, strict=True)])
        assert np.abs(away - np.median(away)).max() < 0.08


@pytest.mark.full
def test_long_recordings_are_aligned_window_by_window() -> None:
    text = " ".join(
        f"Number {n} is here. My baby brother put the big map by the beam, I think." for n in range(14)
    )
    said = synthesize_line(text)
    assert said.duration > 60
    found = quietly(said.audio, text)
    away = [abs(a.start - b.start) for a, b in zip(found.words, said.words, strict=True)]
    assert np.percentile(away, 90) < 0.06
    assert max(away) < 0.3
