"""From the lines of a script to one utterance: all are spoken first, then their phrases and accents found."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from ..core.choices import LEAD, RATES, SILENCES, TAIL
from ..core.directions import UNDIRECTED, Directions
from ..core.progress import Progress, quiet
from ..core.speech.utterance import Utterance
from ..core.speech.voice_style import PLAIN, VoiceAdjustment
from ..errors import InputError, ParameterError, Place, SpeechError, warnings_to
from ..script import Script
from .affect import Feeling, coloured, common_manner, written_words
from .assembly.assemble import Assembler, SpokenText
from .engines.protocol import SpeechEngine
from .engines.registry import is_voice_file
from .plain_breaks import plain_breaks
from .prosody.measure import pitched
from .prosody.pitch import measure_pitch
from .speaker import KnownRenditions, Speaker, find_speaker
from .structure.build import build_utterance
from .structure.pauses import Breaks
from .synthesis_cache import SynthesisCache
from .text.tokens import is_speakable

VOICE_SETTINGS = ("voice", "language", "rate", "lead", "tail", "answers")
"""The settings that `synthesize_script` takes, by name."""
LONGEST_TEXT = 100_000
LOWEST_PITCH, HIGHEST_PITCH = 0, 99
_SEMITONES = 12.0
# Characters of a line that takes so long to speak that the share that is done is told.
_LONG = 1000


def synthesize_script(
    script: Script,
    *,
    voice: str | None = None,
    language: str | None = None,
    rate: int | None = None,
    lead: float = LEAD,
    tail: float = TAIL,
    answers: str | None = None,
    felt: Sequence[Feeling] = (),
    progress: Progress = quiet,
    before: SynthesisCache | None = None,
) -> Utterance:
    """Speak a script. `lead` and `tail` seconds of silence surround it unless its times are absolute.

    Without `voice`, `language`, or else the script's, is spoken by its first voice, English if neither is
    named. `answers`: the question that the first line answers, in place of the script's own. `felt`: emotions
    that change the voice. `progress` is told when the voice is found and speaks, and how much of a long line
    is spoken, in per cent. Speech from `before` is not spoken again; new speech is added to it.
    Raises InputError, with the line's place, if a line starts before the one before it has ended;
    SpeechError if the engine fails.
    """
    if answers:
        script = _answering(script, answers)
    code = language
    if code is None and (voice is None or is_voice_file(voice)):
        code = script.language
    try:
        speaker = replace(
            find_speaker(voice, code),
            rate=rate,
            spoken=None if before is None else before.renditions,
            progress=partial(_tell, progress) if len(script.text) > _LONG else None,
        )
        progress("Speaking …")
        manner = common_manner(felt)
        silences = (0.0, 0.0) if script.timed else (lead, tail)
        if manner is not None:
            spoken = _speak(script, replace(speaker, manner=manner), silences)
        else:
            spoken = _speak_coloured(script, felt, speaker, silences)
        breaks = None
        if manner != PLAIN:
            quiet_speaker = replace(speaker, progress=None)
            speak_plainly = partial(_speak, speaker=quiet_speaker, silences=silences)
            with warnings_to(lambda _: None):  # they were told when it was spoken with emotion
                breaks = plain_breaks(script, spoken, speaker.language, speak_plainly)
        measure = measure_pitch if before is None else before.pitch.measure
        return pitched(_built(spoken, speaker, breaks), _pitch(speaker, manner), measure)
    except SpeechError as error:
        # The script is at fault only if it names the language itself.
        named = code is not None and language is None
        raise error.at(script.lines[0].place) if named else error from None


def synthesize_line(
    text: str,
    *,
    voice: str | None = None,
    language: str | None = None,
    rate: int | None = None,
    pitch: int | None = None,
    lead: float = 0.0,
    tail: float = 0.0,
    manner: VoiceAdjustment = PLAIN,
    directions: Directions = UNDIRECTED,
    engine: SpeechEngine | None = None,
    progress: Callable[[float], None] | None = None,
    spoken: KnownRenditions | None = None,
) -> Utterance:
    """Speak `text` and return the utterance, with `lead` and `tail` seconds of silence around it.

    `voice` is a name from `voices` (default `en-us`) or a voice's file; with `language` alone its first
    voice speaks. `rate` is in words per minute (`RATES`), `pitch` 0 to 99; None leaves the voice's own.
    `manner` changes the whole, `directions` parts of it. `progress` is told the share (0..1) that is done.
    Requests in `spoken` are not spoken again; new renditions are added to it.
    Same arguments, same bytes.

    Raises InputError for text that is empty, has nothing to speak or is longer than 100,000 characters,
    ParameterError for a number out of range, SpeechError for an unknown voice or a failing engine.
    """
    _check_text(text)
    _check_numbers(rate, pitch, lead, tail)
    speaker = replace(
        find_speaker(voice, language, engine),
        rate=rate,
        pitch=pitch,
        manner=manner,
        spoken=spoken,
        progress=progress,
    )
    with Assembler() as assembler:
        line = speaker.prepare(text, directions, silences=(lead, tail))
        assembler.add(line, speaker.speak(line), speaker.transcribe)
        return _built(assembler.finish(text), speaker)


def _answering(script: Script, question: str) -> Script:
    """Return a script whose first line answers a question; raise InputError if that has no words."""
    if not is_speakable(question):
        raise InputError(f"answers = {question!r} has no words; expected a question, e.g. 'Who is it?'")
    first, *rest = script.lines
    answer = replace(first, directions=replace(first.directions, answers=question))
    return replace(script, lines=(answer, *rest))


def _tell(progress: Progress, share: float) -> None:
    progress("Speaking …", round(100 * share), 100)


def _speak_coloured(
    script: Script, felt: Sequence[Feeling], speaker: Speaker, silences: tuple[float, float]
) -> SpokenText:
    """Speak a script with emotions that colour a part of it.

    The edges of words are known before anything is spoken. A time counts in the plain voice, whose rate
    emotions change: then the script is spoken plainly first, and its coloured parts once more.
    """
    if speaker.spoken is None:
        speaker = replace(speaker, spoken={})
    if all(feeling.by_words for feeling in felt):
        words = written_words(script, speaker.language, speaker.voice.language)
        spoken = _speak(coloured(script, felt, words, words[-1].end if words else 0.0), speaker, silences)
        if [word.source_start for word in spoken.words] == [word.source_start for word in words]:
            return spoken
        plain = spoken  # a word has no sound, and does not count
    else:
        plain = _speak(script, speaker, silences)
    return _speak(coloured(script, felt, plain.words, plain.audio.duration), speaker, silences)


def _speak(script: Script, speaker: Speaker, silences: tuple[float, float]) -> SpokenText:
    """Speak all lines, at their times, or in `silences`; raise errors of a line with its place."""
    with Assembler() as assembler:
        for line in script.lines:
            with _at(line.place):
                _check_text(line.text)
                _check_numbers(speaker.rate, speaker.pitch, *silences)
                prepared = speaker.prepare(
                    line.text,
                    line.directions,
                    offset=line.source_offset,
                    time=line.start if script.timed else None,
                    gap=line.gap,
                    silences=silences,
                )
                assembler.add(prepared, speaker.speak(prepared), speaker.transcribe)
        return assembler.finish(script.text)


@contextmanager
def _at(place: Place) -> Iterator[None]:
    try:
        yield
    except InputError as error:
        raise error.at(place) from None


def _built(spoken: SpokenText, speaker: Speaker, breaks: Breaks | None = None) -> Utterance:
    text, audio, phones, words, lines = spoken
    return build_utterance(text, speaker.voice.language, audio, phones, words, lines, breaks)


def _pitch(speaker: Speaker, manner: VoiceAdjustment | None) -> float | None:
    """Return the mean pitch of the speech in Hz, None if that of the voice is not known."""
    hertz, semitones = speaker.mean_pitch, 0.0 if manner is None else manner.pitch
    return None if hertz is None else hertz * 2.0 ** (semitones / _SEMITONES)


def _check_text(text: str) -> None:
    if len(text) > LONGEST_TEXT:
        raise InputError(
            f"the text has {len(text):,} characters; at most {LONGEST_TEXT:,} can be spoken at once"
        )
    if not text.strip():
        raise InputError("the text is empty; expected something to say")
    if not is_speakable(text):
        raise InputError(f"nothing in {text.strip()[:20]!r} can be spoken; expected letters or digits")


def _check_numbers(rate: int | None, pitch: int | None, lead: float, tail: float) -> None:
    if rate is not None and not RATES.allows(rate):
        expected = f"{RATES.low} to {RATES.high} words per minute"
        raise ParameterError(f"rate {rate} is out of range; expected {expected}")
    if pitch is not None and not LOWEST_PITCH <= pitch <= HIGHEST_PITCH:
        raise ParameterError(f"pitch {pitch} is out of range; expected {LOWEST_PITCH} to {HIGHEST_PITCH}")
    for name, seconds in (("lead", lead), ("tail", tail)):
        if not SILENCES.allows(seconds):
            expected = f"{SILENCES.low:g} to {SILENCES.high:g} seconds"
            raise ParameterError(f"{name} {seconds} is out of range; expected {expected}")
