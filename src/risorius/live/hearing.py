"""Align a phrase of the face's own voice in the background, while frames are shown."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import dataclass, replace

import numpy as np

from ..core.speech.audio import Audio, AudioWriter, Samples
from ..core.speech.utterance import SILENCE, Utterance
from ..errors import Place, RisoriusError
from ..pipeline import combine, compose
from ..rules.emotions import Displays
from ..script import SpokenLine
from ..script.model import script_of
from ..settings import Settings
from ..speech.alignment.aligner import Located, assembled, located
from ..speech.alignment.decoder import MODEL_LANGUAGE, AlignedPhone
from ..speech.alignment.lexicon import ScriptWord
from ..speech.alignment.silences import without_gaps
from ..speech.alignment.text_progress import text_progress
from ..speech.alignment.timed_words import locate_in_words, written
from ..speech.prosody import measured
from ..speech.prosody.measure import MeasurePitch
from ..speech.prosody.pitch import measure_pitch
from ..speech.recordings.recognition import heard
from ..speech.recordings.recording import SHORTEST, SILENT_PEAK
from ..speech.text.tokens import is_speakable
from ..take import Take, with_profile
from .voice import Known, VoicedPhrase

# Seconds of a voice's own silence that stand for as much of the lead.
_OWN_SILENCE = 0.15


@dataclass(frozen=True, slots=True)
class HeardPhrase:
    """The words of a phrase and their times.

    `rest`: the text that came with it but is not said in it. `fault`: why its words are less certain than
    they might be, "" if nothing is wrong.
    """

    phrase: VoicedPhrase
    text: str
    located: Located
    rest: str = ""
    fault: str = ""

    @property
    def silence(self) -> float:
        """Seconds before its first sound."""
        first = self.located.phones[0]
        return first.end if first.symbol == SILENCE else 0.0


Hearing = Future[HeardPhrase]


def hear_phrase(phrase: VoicedPhrase, language: str) -> HeardPhrase:
    """Return the timed words of a phrase: by its words' times, else by its text, else by ear.

    One that cannot be heard is played with the mouth at rest.
    """
    audio = _audio([phrase.samples], phrase.sample_rate)
    faults: list[str] = []
    is_silent = phrase.duration < SHORTEST or np.abs(phrase.samples).max() < SILENT_PEAK * 32_768
    ways = {
        Known.TIMES: (_by_times, _by_text, _by_ear),
        Known.TEXT: (_by_text, _by_ear),
        Known.NOTHING: (_by_ear,),
    }[phrase.known]
    for way in () if is_silent else ways:
        try:
            return replace(way(phrase, audio, language), fault="; ".join(faults))
        except RisoriusError as error:
            faults.append(error.message)
    return _unheard(phrase, phrase.text, "; ".join(faults))


def _by_times(phrase: VoicedPhrase, audio: Audio, language: str) -> HeardPhrase:
    if not any(is_speakable(word.text) for word in phrase.words):
        return _unheard(phrase)
    return HeardPhrase(phrase, written(phrase.words), locate_in_words(audio, phrase.words, language))


def _by_text(phrase: VoicedPhrase, audio: Audio, language: str) -> HeardPhrase:
    text, unspoken = written(phrase.words) or phrase.text, ""
    if phrase.is_open and not phrase.words and is_speakable(text):
        end = text_progress(audio, text, language)
        text, unspoken = text[:end], text[end:]
    if not is_speakable(text):
        # All of it was said before: a breath.
        return _unheard(phrase, unspoken)
    return HeardPhrase(phrase, text.strip(), located(audio, text.strip(), language), unspoken)


def _by_ear(phrase: VoicedPhrase, audio: Audio, language: str) -> HeardPhrase:
    return HeardPhrase(phrase, *heard(audio))


def perform_voice(
    phrases: Sequence[HeardPhrase],
    feelings: Displays,
    settings: Settings,
    *,
    measure: MeasurePitch = measure_pitch,
) -> Take:
    """Perform phrases that follow one another, with the settings' lead before them and their tail after.

    `measure` measures pitch.
    """
    settings = with_profile(settings)
    utterance = measured(_joined(phrases, settings), measure=measure)
    line = SpokenLine(utterance.text, 0.0, Place("live"))
    script = script_of((line,), timed=False, source="live", language=utterance.language)
    return combine(compose(script, utterance, feelings, settings), settings, utterance)


def texts_of(phrases: Sequence[HeardPhrase]) -> tuple[str, ...]:
    """Return the text of the phrases, with the blanks between them."""
    return tuple(phrase.text.strip() + " " if phrase.text.strip() else "" for phrase in phrases)


def _unheard(phrase: VoicedPhrase, unspoken: str = "", fault: str = "") -> HeardPhrase:
    silence = AlignedPhone(SILENCE, 0.0, phrase.duration, -1, 0.0)
    return HeardPhrase(phrase, "", Located([silence], [], MODEL_LANGUAGE), unspoken, fault)


def _joined(phrases: Sequence[HeardPhrase], settings: Settings) -> Utterance:
    """Return phrases as one utterance."""
    rate = phrases[0].phrase.sample_rate
    silent = settings.lead - min(phrases[0].silence, _OWN_SILENCE), settings.tail
    lead, tail = (np.zeros(round(seconds * rate), np.int16) for seconds in silent)
    phones: list[AlignedPhone] = []
    words: list[ScriptWord] = []
    character, time = 0, len(lead) / rate
    if len(lead):
        phones.append(AlignedPhone(SILENCE, 0.0, time, -1, 0.0))
    for phrase, text in zip(phrases, texts_of(phrases), strict=True):
        first = len(words)
        phones += [
            f._replace(start=f.start + time, end=f.end + time, word=f.word + first if f.word >= 0 else -1)
            for f in phrase.located.phones
        ]
        words += [_moved(entry, character) for entry in phrase.located.words]
        character, time = character + len(text), time + phrase.phrase.duration
    phones.append(AlignedPhone(SILENCE, time, time + len(tail) / rate, -1, 0.0))
    audio = _audio([lead, *(phrase.phrase.samples for phrase in phrases), tail], rate)
    text = "".join(texts_of(phrases))
    return assembled(audio, text, without_gaps(phones), words, phrases[0].located.language)


def _moved(entry: ScriptWord, characters: int) -> ScriptWord:
    word = entry.word
    start, end = word.source_start + characters, word.source_end + characters
    return entry._replace(word=replace(word, source_start=start, source_end=end))


def _audio(pieces: Sequence[Samples], rate: int) -> Audio:
    with AudioWriter(rate) as writer:
        for piece in pieces:
            writer.append(piece)
        return writer.finish()
