"""What is measured of a run comes from the sound up to its end: what follows changes nothing of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from risorius.core.speech.audio import AudioWriter
from risorius.core.speech.utterance import Pause, PauseKind, Phone, Utterance, Word
from risorius.speech import synthesize_line
from risorius.speech.prosody import measured
from risorius.speech.prosody.measure import pitched
from risorius.speech.structure.phrases import with_phrases

TEXT = (
    "Oh, really? I like it very much. My baby brother put the big map by the beam. "
    "Nobody wanted the lemonade, but everybody drank it."
)


@pytest.fixture(scope="module")
def spoken() -> Utterance:
    return synthesize_line(TEXT, lead=0.3, tail=0.3)


def cut(said: Utterance, words: int) -> Utterance:
    """Return the utterance up to the middle of the pause after so many words."""
    pause = said.pause_after(words - 1)
    assert pause is not None
    frames = round(0.5 * (pause.start + pause.end) * said.audio.sample_rate)
    with AudioWriter(said.audio.sample_rate) as writer:
        writer.append(said.audio.read(0, frames))
        audio = writer.finish()
    inside = said.words[:words]
    phones = said.phones[: inside[-1].last_phone]
    return with_phrases(
        Utterance(
            said.text[: inside[-1].source_end + 1],
            said.language,
            audio,
            (*phones, Phone("", phones[-1].end, audio.duration)),
            inside,
            tuple(s for s in said.syllables if s.word < words),
            (
                *(p for p in said.pauses if p.end <= inside[-1].end),
                Pause(phones[-1].end, audio.duration, PauseKind.FINAL),
            ),
        )
    )


def cuts(said: Utterance) -> list[int]:
    return [sentence.last_word for sentence in said.sentences[:-1]]


def test_what_follows_changes_nothing_that_was_measured(spoken: Utterance) -> None:
    whole = measured(spoken)
    assert len(cuts(spoken)) == 3
    for words in cuts(spoken):
        part = measured(cut(spoken, words))
        count = len(part.syllables)
        assert part.syllables == whole.syllables[:count]
        assert part.accents == tuple(a for a in whole.accents if a.word < words)
        # How sure the last boundary is depends on how long the silence after it lasts.
        known = [b for b in whole.boundaries if b.word < words]
        assert part.boundaries[:-1] == tuple(known[:-1])
        assert part.boundaries[-1].label == known[-1].label


def test_what_follows_changes_no_pitch_of_a_synthesized_voice(spoken: Utterance) -> None:
    whole = pitched(spoken, 100.0)
    for words in cuts(spoken):
        part = pitched(cut(spoken, words), 100.0)
        assert part.syllables == whole.syllables[: len(part.syllables)]


def test_loudness_is_told_beside_what_was_heard_before(spoken: Utterance) -> None:
    with AudioWriter(spoken.audio.sample_rate) as writer:
        writer.append(np.round(spoken.audio.read() * 0.05).astype(np.int16))
        soft = replace(spoken, audio=writer.finish())
    for ours, theirs in zip(measured(soft).syllables, measured(spoken).syllables, strict=True):
        assert ours.loudness == pytest.approx(theirs.loudness, abs=0.5)
        assert ours.prominence == pytest.approx(theirs.prominence, abs=0.1)


def test_what_has_no_vowel_has_no_accent_and_no_tone() -> None:
    with AudioWriter(16_000) as writer:
        writer.append(np.full(8_000, 3_000, np.int16))
        audio = writer.finish()
    phones = (Phone("SH", 0.0, 0.5, -1, 0),)
    hushed = Utterance("shh", "en-us", audio, phones, (Word("shh", 0.0, 0.5, 0, 1, 0, 3),))
    found = measured(hushed)
    assert (found.syllables, found.accents, found.boundaries) == ((), (), ())
