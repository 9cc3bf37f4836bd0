"""Words from the sound alone, if nobody has written them down; phones if words fail.

Stretch by stretch between pauses: pocketsphinx's language model names the words, and these are aligned as a
transcript's would be. If they do not fit what is heard, a loop over all phones says at least what the
mouth does. Both are far weaker than a transcript: about one word in four is wrong.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator

import numpy as np

from ...core.arrays import Array, BoolArray
from ...core.progress import Progress, quiet
from ...core.speech.audio import Audio
from ...core.speech.utterance import SILENCE, Utterance, Word
from ...errors import InputError
from ...languages import phonesets
from ..alignment.aligner import Located, assembled, moved, refined
from ..alignment.confidence import mean_score
from ..alignment.decoder import MIDDLE, MODEL_LANGUAGE, AlignedPhone, AlignmentError, Decoders, with_decoders
from ..alignment.lexicon import ScriptWord, read_transcript, written_readings
from ..alignment.silences import without_gaps
from ..resampled import LEVEL_STEP, RATE, Resampled

# A stretch ends in a pause (dB below loud speech, seconds), and is cut where it is quietest if none comes.
PAUSE_BELOW, SHORTEST_PAUSE = 30.0, 0.3
EARLIEST, LATEST = 6.0, 20.0
NO_WORD = -1
# Recognized words whose mean score is lower are not taken.
WORST = -38.0
# How the dictionary marks a word's further readings.
_ALTERNATIVE = re.compile(r"\(\d+\)$")


def recognize(audio: Audio, progress: Progress = quiet) -> Utterance:
    """Return the words and times that are recognized in a recording.

    Raises InputError if nothing is, SpeechError if the recognizer fails. `progress` is told how many seconds
    of a long recording are recognized.
    """
    text, found = heard(audio, progress)
    return assembled(audio, text, found.phones, found.words, found.language)


def heard(audio: Audio, progress: Progress = quiet) -> tuple[str, Located]:
    """Return the text that seems to be said, and when its phones are; raises as `recognize` does."""
    return with_decoders(lambda decoders: _heard(audio, decoders, progress))


def _heard(audio: Audio, decoders: Decoders, progress: Progress) -> tuple[str, Located]:
    resampled = Resampled(audio)
    aligned: list[AlignedPhone] = []
    names: list[str] = []
    for start, end in stretches(resampled):
        if audio.duration > LATEST:
            progress("Recognizing …", round(start), round(audio.duration))
        phones, words = _recognized(resampled.read(start, end), decoders)
        aligned += refined(resampled, without_gaps(moved(phones, start, end, len(names))))
        names += words
    if not names:
        raise InputError("no speech was recognized; expected a recorded voice")
    return " ".join(names), Located(aligned, list(_script_words(names)), MODEL_LANGUAGE)


def stretches(resampled: Resampled) -> Iterator[tuple[float, float]]:
    """Yield spans of seconds that follow one another over the recording, cut in pauses if possible."""
    levels = np.asarray(resampled.levels, np.float64)
    start, count = 0, len(levels)
    while (count - start) * LEVEL_STEP > LATEST:
        first, last = start + round(EARLIEST / LEVEL_STEP), start + round(LATEST / LEVEL_STEP)
        quiet = levels[first:last] < resampled.loud_level(last * LEVEL_STEP) - PAUSE_BELOW
        cut = _longest_run(quiet, round(SHORTEST_PAUSE / LEVEL_STEP))
        end = first + (cut if cut is not None else int(levels[first:last].argmin()))
        yield start * LEVEL_STEP, end * LEVEL_STEP
        start = end
    yield start * LEVEL_STEP, resampled.audio.duration


def _longest_run(true: BoolArray, shortest: int) -> int | None:
    """Return the middle of the longest run of True, None if none is long enough."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], true, [False])))).reshape(-1, 2)
    lengths = edges[:, 1] - edges[:, 0]
    if not len(lengths) or lengths.max() < shortest:
        return None
    return int(edges[lengths.argmax()].mean())


def _recognized(sound: Array, decoders: Decoders) -> tuple[list[AlignedPhone], list[str]]:
    """Return the phones of a stretch, and the names of its words."""
    names = [_ALTERNATIVE.sub("", name) for name in decoders.name_words(sound)]
    if names:
        with contextlib.suppress(AlignmentError):
            aligned = decoders.align_words(sound, [written_readings(name) for name in names])
            if mean_score([f for f in aligned if f.word >= 0]) >= WORST:
                return aligned, names
    return _phone_runs(sound, decoders)


def _phone_runs(sound: Array, decoders: Decoders) -> tuple[list[AlignedPhone], list[str]]:
    """Return the phones that a loop over all phones hears; each run without a pause is called a word."""
    duration = len(sound) / RATE
    aligned: list[AlignedPhone] = []
    names: list[str] = []
    for segment in decoders.name_phones(sound):
        start, end = max(segment.start + MIDDLE, 0.0), min(segment.end + MIDDLE, duration)
        if start >= end:
            continue
        if segment.name not in phonesets.ARPABET:
            aligned.append(AlignedPhone(SILENCE, start, end, NO_WORD, 0.0))
            continue
        if not aligned or aligned[-1].word == NO_WORD:
            names.append("")
        names[-1] += segment.name
        aligned.append(AlignedPhone(segment.name, start, end, len(names) - 1, 0.0))
    return aligned or [AlignedPhone(SILENCE, 0.0, duration, NO_WORD, 0.0)], names


def _script_words(names: list[str]) -> Iterator[ScriptWord]:
    """Yield the words with their places in the text that they make, and with espeak-ng's stress."""
    _, words = read_transcript(" ".join(names))
    stresses = {word.word.source_start: word.stresses for word in words}
    at = 0
    for name in names:
        yield ScriptWord(Word(name, 0.0, 0.0, 0, 0, at, at + len(name)), (), stresses.get(at, ()))
        at += len(name) + 1
