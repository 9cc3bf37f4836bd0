"""From subtitles and their recording to an Utterance: each cue is sought where it is shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ...core.progress import Progress, quiet
from ...core.speech.audio import Audio, AudioWriter, Samples
from ...core.speech.utterance import SILENCE, Utterance
from ...errors import InputError
from ...script.subtitles import TimedText
from ..alignment.aligner import assembled, located, moved
from ..alignment.decoder import MODEL_LANGUAGE, AlignedPhone
from ..alignment.lexicon import ScriptWord
from ..alignment.silences import without_gaps

# Seconds around a cue in which its words are sought: it appears late, or goes too soon.
_AROUND = 1.0


def align_cues(
    audio: Audio, cues: Sequence[TimedText], language: str | None = None, progress: Progress = quiet
) -> Utterance:
    """Return the timed utterance of a recording of these cues; their text is one line a cue.

    Raises InputError, with its place, for a cue after the recording's end, and for one whose words are not
    heard around its time.
    """
    samples = audio.read()
    phones: list[AlignedPhone] = []
    words: list[ScriptWord] = []
    code, character, time = MODEL_LANGUAGE, 0, 0.0
    for number, (cue, (start, end)) in enumerate(zip(cues, _windows(cues, audio.duration), strict=True)):
        progress("Aligning …", number, len(cues))
        try:
            found = located(_part(audio, samples, start, end), cue.text, language)
        except InputError as error:
            raise error.at(cue.place) from None
        if start > time:
            phones.append(AlignedPhone(SILENCE, time, start, -1, 0.0))
        phones += moved(found.phones, start, end, len(words))
        words += [_placed(entry, character) for entry in found.words]
        code, character, time = found.language, character + len(cue.text) + 1, end
    if time < audio.duration:
        phones.append(AlignedPhone(SILENCE, time, audio.duration, -1, 0.0))
    text = "\n".join(cue.text for cue in cues)
    return assembled(audio, text, without_gaps(phones), words, code)


def _windows(cues: Sequence[TimedText], duration: float) -> list[tuple[float, float]]:
    """Return the stretch of the recording in which each cue is sought; they do not overlap."""
    late = next((cue for cue in cues if cue.start >= duration), None)
    if late is not None:
        message = f"a cue at {late.start:.2f} s, but the recording lasts {duration:.2f} s"
        raise InputError(f"{message}; expected subtitles of this recording", late.place)
    edges = [0.0, *((a.end + b.start) / 2.0 for a, b in pairwise(cues)), duration]
    for index in range(1, len(edges)):
        edges[index] = max(edges[index], edges[index - 1] + 0.1)
    return [
        (max(first, cue.start - _AROUND), max(min(last, cue.end + _AROUND), first + 0.1))
        for cue, (first, last) in zip(cues, pairwise(edges), strict=True)
    ]


def _part(audio: Audio, samples: Samples, start: float, end: float) -> Audio:
    rate = audio.sample_rate
    with AudioWriter(rate) as writer:
        writer.append(samples[round(start * rate) : round(end * rate)])
        return writer.finish()


def _placed(entry: ScriptWord, characters: int) -> ScriptWord:
    word = entry.word
    start, end = word.source_start + characters, word.source_end + characters
    return entry._replace(word=replace(word, source_start=start, source_end=end))
