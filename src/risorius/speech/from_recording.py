"""Utterances of recorded speech: by its transcript, by labels, or by ear alone."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

from ..core.directions import Directions
from ..core.progress import Progress, quiet
from ..core.speech.audio import Audio
from ..core.speech.utterance import Utterance
from ..errors import InputError, Place, SpeechWarning, warn
from ..script import Script, SpokenLine
from ..script.model import script_of
from ..script.textgrid import read_textgrid
from .alignment import align
from .alignment.aligner import assembled
from .alignment.timed_words import TimedWord, locate_in_words, written
from .assembly.retime import is_timed
from .prosody import measured
from .recordings.dictated import utterance_dictated
from .recordings.labelled import (
    PHONE_TIERS,
    WORD_TIERS,
    found_tier,
    from_start,
    said_words,
    utterance_of_labels,
)
from .recordings.recognition import recognize
from .recordings.recording import read_recording
from .recordings.tone_labels import tells_accents, tells_boundaries
from .structure.accents import intone
from .structure.lines import whole

WEAKER = "there is no transcript: words are recognized from the sound, with errors; check them in a TextGrid"


@dataclass(frozen=True, slots=True)
class Recording:
    """A recorded voice: the file `audio`, and what is known of its words.

    `transcript`: the words; `script`: the marks, and the words if there is no transcript. Without either, the
    words are recognized. `language` is that of the words, by default the script's, or English.
    """

    audio: str | PathLike[str]
    transcript: str | None = None
    script: Script | None = None
    language: str | None = None


@dataclass(frozen=True, slots=True)
class LabelledRecording:
    """A recorded voice, the file `audio` (None for silence), and the TextGrid of its timed words."""

    labels: str
    audio: str | PathLike[str] | None = None


def align_recording(
    recording: Recording | LabelledRecording, progress: Progress = quiet
) -> tuple[Script, Utterance]:
    """Return the script to be performed, and the timed utterance of a recording.

    Recognized words come with a warning (SpeechWarning). Raises InputError for what does not fit.
    """
    if isinstance(recording, LabelledRecording):
        utterance = _labelled(recording, progress)
        return _script_of(utterance, recording.labels), utterance
    audio, script = recording.audio, recording.script
    language = recording.language or (None if script is None else script.language)
    if recording.transcript is not None or script is None:
        utterance = hear_words(audio, recording.transcript, progress, language)
    else:
        utterance = with_written_tones(_hear_script(audio, script, progress, language), script)
    return script or _script_of(utterance, str(audio)), utterance


def _hear_script(
    audio: str | PathLike[str], script: Script, progress: Progress, language: str | None
) -> Utterance:
    """Return the utterance of a recording that reads a script; durations in the script are its labels."""
    directions = Directions()
    for line in script.lines:
        directions = directions.joined(line.directions.moved(line.source_offset))
    if directions.answers:
        message = "answers is not read with a recording, whose accents are those of its sound"
        warn(f"{script.lines[0].place}: {message}", SpeechWarning)
    if is_timed(directions):
        return measured(utterance_dictated(read_recording(audio), script.text, directions))
    dictated = next((span for span in directions.spans if span.phones), None)
    if dictated is not None:
        message = "phonemes without durations are not used with a recording; expected durations as well"
        warn(f"{dictated.place}: {message}", SpeechWarning)
    return hear_words(audio, script.text, progress, language)


def hear_words(
    audio: str | PathLike[str],
    transcript: str | None,
    progress: Progress = quiet,
    language: str | None = None,
) -> Utterance:
    """Return the utterance of a recording, with times; its words are recognized if none are given.

    `language` is that of the words that are given, by default English.
    """
    sound = read_recording(audio)
    try:
        if transcript is None:
            progress("Recognizing …")
            warn(f"{audio}: {WEAKER}", SpeechWarning)
            return measured(recognize(sound, progress))
        progress("Aligning …")
        return measured(align(sound, transcript, language, progress))
    except InputError as error:
        raise error.at(Place(str(audio))) from None


def _labelled(recording: LabelledRecording, progress: Progress) -> Utterance:
    labels, audio = read_textgrid(recording.labels), recording.audio
    if audio is None:
        return utterance_of_labels(labels)
    sound = read_recording(audio)
    labels = from_start(labels, sound.duration)
    words = found_tier(labels, WORD_TIERS)
    if words is not None and found_tier(labels, PHONE_TIERS) is None:
        timed_words = [TimedWord(w.text, w.start, w.end) for w in said_words(words, labels.source)]
        return _hear_timed(sound, timed_words, labels.source, progress)
    utterance = utterance_of_labels(labels, sound)
    progress("Listening …")
    return measured(utterance, accents=not tells_accents(labels), boundaries=not tells_boundaries(labels))


def _hear_timed(sound: Audio, words: list[TimedWord], source: str, progress: Progress) -> Utterance:
    """Return the utterance of a recording whose words have labels: these are kept."""
    progress("Aligning …")
    try:
        found = locate_in_words(sound, words)
    except InputError as error:
        raise error.at(Place(source)) from None
    return measured(assembled(sound, written(words), found.phones, found.words, found.language))


def with_written_tones(utterance: Utterance, script: Script) -> Utterance:
    """Return the utterance with the tones that the script has; if it has any, none are measured."""
    accents = [tone for line in script.lines for tone in line.directions.moved(line.source_offset).accents]
    ends = [tone for line in script.lines for tone in line.directions.moved(line.source_offset).boundaries]
    if not accents and not ends:
        return utterance
    tones = Directions(accents=tuple(accents), boundaries=tuple(ends))
    return intone(utterance, (whole(utterance.text, utterance.phones, tones),))


def _script_of(utterance: Utterance, source: str) -> Script:
    line = SpokenLine(utterance.text, 0.0, Place(source))
    return script_of((line,), timed=False, source=source, language=utterance.language)
