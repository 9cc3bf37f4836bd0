"""From a script's lines to one utterance: each line spoken, then joined at its time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TypeVar

from ..core.audio import Audio, AudioWriter
from ..core.choices import LEAD, TAIL
from ..core.progress import Progress, quiet
from ..core.time import ticks_of
from ..core.utterance import (
    SILENCE,
    Accent,
    Boundary,
    Pause,
    PauseKind,
    Phone,
    Phrase,
    Syllable,
    Utterance,
    Word,
)
from ..errors import InputError, SpeechError
from ..languages import Language
from ..script import Script, SpokenLine
from .affect import Feeling, coloured, common_manner, written_words
from .engines.registry import is_voice_file
from .engines.voices import find_voice
from .prosody.measure import pitched
from .prosody.pitch import measure_pitch
from .spoken import SpokenBefore
from .synthesis import synthesize, voice_language, voice_pitch
from .text.tokens import is_speakable

VOICE_SETTINGS = ("voice", "language", "rate", "lead", "tail", "answers")
"""The settings that `say` takes, by name."""
_SEMITONES = 12.0
# Seconds between lines where the second has no time of its own.
LINE_PAUSE = 0.3
# Characters of a line that takes so long to speak that the share that is done is told.
_LONG = 1000

Speaker = Callable[..., Utterance]
Timed = TypeVar("Timed", Phone, Word, Syllable, Pause, Phrase)


@dataclass(frozen=True, slots=True)
class _Placed:
    """A spoken line: its first sample in the whole, and what stands before it there."""

    utterance: Utterance
    line: SpokenLine
    first_sample: int


def say(
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
    before: SpokenBefore | None = None,
) -> Utterance:
    """Speak a script. `lead` and `tail` seconds of silence surround it unless its times are absolute.

    Without `voice`, `language`, or else the script's, is spoken by its first voice, English where neither is
    named. `answers`: the question that the first line answers, in place of the script's own. `felt`: emotions
    that change the voice. `progress` is told when the voice is found and speaks, and how much of a long line
    is spoken, in per cent. What was spoken `before` is not spoken again; what is spoken is added to it.
    Raises InputError, with the line's place, where a line starts before the one before it has ended;
    SpeechError if the engine fails.
    """
    if answers:
        script = _answering(script, answers)
    code = language
    if code is None and (voice is None or is_voice_file(voice)):
        code = script.language
    told = partial(_tell, progress) if len(script.text) > _LONG else None
    speak = partial(synthesize, voice=voice, language=code, rate=rate, progress=told)
    if before is not None:
        speak = partial(speak, spoken=before.renditions)
    if not script.timed:
        speak = partial(speak, lead=lead, tail=tail)
    manner = common_manner(felt)
    try:
        if voice is None or not is_voice_file(voice):
            find_voice(voice, code)
        progress("Speaking …")
        if manner is not None:
            said = _speak(script, partial(speak, manner=manner))
        else:
            speak = speak if before is not None else partial(speak, spoken={})
            said = _speak_coloured(script, felt, speak, voice_language(voice, code))
        hertz = voice_pitch(voice, code)
        raised = 0.0 if manner is None else manner.pitch
        hertz = None if hertz is None else hertz * 2.0 ** (raised / _SEMITONES)
        return pitched(said, hertz, measure_pitch if before is None else before.pitch.measure)
    except SpeechError as error:
        # The script is at fault only where it names the language itself.
        named = code is not None and language is None
        raise error.at(script.lines[0].place) if named else error from None


def _answering(script: Script, question: str) -> Script:
    """Return a script whose first line answers a question; raise InputError if that has no words."""
    if not is_speakable(question):
        raise InputError(f"answers = {question!r} has no words; expected a question, e.g. 'Who is it?'")
    first, *rest = script.lines
    answer = replace(first, directions=replace(first.directions, answers=question))
    return replace(script, lines=(answer, *rest))


def _tell(progress: Progress, share: float) -> None:
    progress("Speaking …", round(100 * share), 100)


def _speak_coloured(script: Script, felt: Sequence[Feeling], speak: Speaker, language: Language) -> Utterance:
    """Speak a script with emotions that colour a part of it.

    Edges of words are known before anything is spoken. A time is one of the plain voice, whose rate emotions
    change: then it is spoken plainly, and what is coloured once more.
    """
    if all(feeling.by_words for feeling in felt):
        words = written_words(script, language)
        said = _speak(coloured(script, felt, words, words[-1].end if words else 0.0), speak)
        if [word.source_start for word in said.words] == [word.source_start for word in words]:
            return said
        plain = said  # a word has no sound, and does not count
    else:
        plain = _speak(script, speak)
    return _speak(coloured(script, felt, plain.words, plain.duration), speak)


def _speak(script: Script, speak: Speaker) -> Utterance:
    if not script.timed:
        return _located(script.lines[0], speak)
    placed = list(_place(script.lines, speak))
    if len(placed) == 1 and placed[0].first_sample == 0:
        return placed[0].utterance
    return _join(script.text, placed)


def _located(line: SpokenLine, speak: Speaker) -> Utterance:
    """Speak a line; what is wrong with it is raised with its place."""
    try:
        return speak(line.text, directions=line.directions)
    except InputError as error:
        raise error.at(line.place) from None


def _place(lines: Sequence[SpokenLine], speak: Speaker) -> Iterator[_Placed]:
    """Speak the lines in order of their time and yield each with its first sample."""
    end = 0
    for line in lines:
        utterance = _located(line, speak)
        sample_rate = utterance.audio.sample_rate
        gap = LINE_PAUSE if line.gap is None else line.gap
        follows = end + round(gap * sample_rate) if end else 0
        first = follows if line.start is None else round(line.start * sample_rate)
        if first < end:
            raise InputError(
                f"time = {line.start:g}, but the words before last until {end / sample_rate:.2f} s",
                line.place,
            )
        yield _Placed(utterance, line, first)
        end = first + utterance.audio.frames


@dataclass(slots=True)
class _Joiner:
    """Collects lines into one utterance, their times, words and phones counted on."""

    phones: list[Phone] = field(default_factory=list)
    words: list[Word] = field(default_factory=list)
    syllables: list[Syllable] = field(default_factory=list)
    pauses: list[Pause] = field(default_factory=list)
    accents: list[Accent] = field(default_factory=list)
    boundaries: list[Boundary] = field(default_factory=list)
    phrases: list[Phrase] = field(default_factory=list)

    def add(self, part: _Placed) -> None:
        """Add a line, and the pause before it."""
        said, at = part.utterance, part.first_sample / part.utterance.audio.sample_rate
        self._pause_until(at)
        phones, words, syllables = len(self.phones), len(self.words), len(self.syllables)
        sentences = self.phrases[-1].sentence + 1 if self.phrases else 0
        self.phones += [
            replace(p, word=p.word + words if p.word >= 0 else p.word) for p in _shifted(said.phones, at)
        ]
        self.words += [_moved_word(w, phones, part.line.source_offset) for w in _shifted(said.words, at)]
        self.syllables += [_moved_syllable(s, phones, words) for s in _shifted(said.syllables, at)]
        for pause in _shifted(said.pauses, at):
            self._add_pause(pause)
        self.accents += [
            replace(a, time=a.time + at, word=a.word + words, syllable=a.syllable + syllables)
            for a in said.accents
        ]
        self.boundaries += [replace(b, time=b.time + at, word=b.word + words) for b in said.boundaries]
        self.phrases += [_moved_phrase(p, words, sentences) for p in _shifted(said.phrases, at)]

    def _pause_until(self, at: float) -> None:
        edge = self.phones[-1].end if self.phones else 0.0
        if ticks_of(at) - ticks_of(edge) > 1:
            self.phones.append(Phone(SILENCE, edge, at))
            self._add_pause(Pause(edge, at, PauseKind.INITIAL))
        elif self.phones:
            # At some sample rates the end of a line and the start of the next are rounded to two ticks.
            self.phones[-1] = replace(self.phones[-1], end=at)

    def _add_pause(self, pause: Pause) -> None:
        """Add a pause, which goes on with the one before if nothing is said between them.

        Between two lines is a full stop, unless the first line ends with other punctuation.
        """
        if self.words and pause.kind is PauseKind.INITIAL:
            pause = replace(pause, kind=PauseKind.FULL_STOP)
        if self.pauses and self.pauses[-1].end == pause.start:
            last = self.pauses.pop()
            kind = pause.kind if last.kind is PauseKind.FINAL else last.kind
            pause = Pause(last.start, pause.end, kind)
        self.pauses.append(pause)

    def utterance(self, text: str, language: str, audio: Audio) -> Utterance:
        """Return what was collected."""
        phones = (*self.phones[:-1], replace(self.phones[-1], end=audio.duration))
        rest = (self.words, self.syllables, self.pauses, self.accents, self.boundaries, self.phrases)
        return Utterance(text, language, audio, phones, *map(tuple, rest))  # type: ignore[arg-type]


def _join(text: str, placed: Sequence[_Placed]) -> Utterance:
    joiner = _Joiner()
    for part in placed:
        joiner.add(part)
    return joiner.utterance(text, placed[0].utterance.language, _joined_audio(placed))


def _shifted(items: Sequence[Timed], seconds: float) -> list[Timed]:
    return [replace(item, start=item.start + seconds, end=item.end + seconds) for item in items]


def _moved_word(word: Word, phones: int, characters: int) -> Word:
    return replace(
        word,
        first_phone=word.first_phone + phones,
        last_phone=word.last_phone + phones,
        source_start=word.source_start + characters,
        source_end=word.source_end + characters,
    )


def _moved_syllable(syllable: Syllable, phones: int, words: int) -> Syllable:
    return replace(
        syllable,
        first_phone=syllable.first_phone + phones,
        last_phone=syllable.last_phone + phones,
        word=syllable.word + words,
    )


def _moved_phrase(phrase: Phrase, words: int, sentences: int) -> Phrase:
    return replace(
        phrase,
        first_word=phrase.first_word + words,
        last_word=phrase.last_word + words,
        sentence=phrase.sentence + sentences,
    )


def _joined_audio(placed: Sequence[_Placed]) -> Audio:
    with AudioWriter(placed[0].utterance.audio.sample_rate) as writer:
        for part in placed:
            writer.silence((part.first_sample - writer.frames) / writer.sample_rate)
            for block in part.utterance.audio.blocks():
                writer.append(block)
        return writer.finish()
