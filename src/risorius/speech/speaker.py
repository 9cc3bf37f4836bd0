"""A voice that speaks lines: from their text to stretches of sound."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, MutableMapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from ..core.directions import UNDIRECTED, DirectedSpan, Directions
from ..core.speech.voice_style import PLAIN, VoiceAdjustment
from ..errors import InputError, Place, SpeechWarning, warn
from ..languages import Language, language_of
from .assembly.assemble import LINE_PAUSE, PreparedLine, SpokenPart
from .assembly.lengthen import scale_pauses
from .assembly.retime import is_timed
from .engines.protocol import Rendition, SpeechEngine, SpeechRequest, Voice
from .engines.registry import is_voice_file, load_engine, load_voice_file
from .engines.voices import find_voice
from .structure.context import PlacedWord, context_of, raised
from .text.normalise import normalise, placed
from .text.scripts import foreign_scripts
from .text.sentences import divide
from .text.shape import worded
from .text.tokens import Token

MOST_SEMITONES = 24.0
"""The furthest that a pitch in Hz moves a voice."""
KnownRenditions = MutableMapping[SpeechRequest, Rendition]
"""The renditions of a voice, by their requests."""


@dataclass(frozen=True, slots=True)
class Speaker:
    """A voice of an engine, and how it speaks: `rate` in words per minute, `pitch` 0..99, None for its own.

    Requests in `spoken` are not spoken again; new renditions are added to it. `progress` is told the share
    (0..1) of a line that is done.
    """

    engine: SpeechEngine
    voice: Voice
    rate: int | None = None
    pitch: int | None = None
    manner: VoiceAdjustment = PLAIN
    spoken: KnownRenditions | None = None
    progress: Callable[[float], None] | None = None

    @property
    def language(self) -> Language:
        """The language of the voice."""
        return language_of(self.voice.language)

    @property
    def mean_pitch(self) -> float | None:
        """The mean pitch of the voice in Hz, None if it is not known."""
        return self.engine.mean_pitch(self.voice)

    def transcribe(self, words: Sequence[str]) -> Sequence[Sequence[str]]:
        """Return the phones of each word spoken by itself."""
        return self.engine.transcribe(words, self.voice)

    def prepare(
        self,
        text: str,
        directions: Directions = UNDIRECTED,
        *,
        offset: int = 0,
        time: float | None = None,
        gap: float | None = None,
        silences: tuple[float, float] = (0.0, 0.0),
    ) -> PreparedLine:
        """Return a line as this voice speaks it, with `silences` before and after it, in seconds.

        `offset`, `time` and `gap` as in PreparedLine; without a `gap` it is the usual one. Raises InputError
        for directions that the voice's language does not allow.
        """
        directions = self._in_semitones(directions)
        directions = self._in_scripts(text, directions)
        words = worded(text, directions, self.language, self.voice.language)
        if is_timed(directions) and not self.language.mnemonics.dictated:
            timed = next(span for span in directions.spans if span.seconds)
            message = f"durations of phonemes in '{self.voice.language}'; expected an English voice for them"
            raise InputError(message, timed.place)
        if directions.answers and not directions.accents:
            directions = _answering(text, words.tokens, directions, self.language)
        return PreparedLine(
            words.text,
            words.tokens,
            directions,
            offset,
            time,
            LINE_PAUSE if gap is None else gap,
            *silences,
            shape=words.shape,
            dictated=words.dictated,
        )

    def _in_scripts(self, text: str, directions: Directions) -> Directions:
        """Return directions by which another voice reads words in scripts that this one would spell."""
        taken = [
            span for span in directions.spans if span.voice or span.language or span.phones or span.spoken
        ]
        words = [
            word
            for word in foreign_scripts(text, self.voice.language)
            if not any(span.start < word.end and word.start < span.end for span in taken)
        ]
        unread = ", ".join(f"'{text[w.start : w.end]}'" for w in words if not w.language)
        if unread:
            warn(f"this voice cannot read {unread}; its characters are spelled", SpeechWarning)
        spans = [
            DirectedSpan(w.start, w.end, Place("text"), language=w.language) for w in words if w.language
        ]
        return replace(directions, spans=(*directions.spans, *spans)) if spans else directions

    def _in_semitones(self, directions: Directions) -> Directions:
        """Return directions without Hertz, which count from the voice's own pitch."""
        if all(span.pitch is None for span in directions.spans):
            return directions
        own = self.mean_pitch
        if own is None:
            place = next(span.place for span in directions.spans if span.pitch is not None)
            message = f"{place}: the voice's own pitch is not known; a pitch in Hz is left out"
            warn(message, SpeechWarning)
        return replace(directions, spans=tuple(_in_semitones(span, own) for span in directions.spans))

    def speak(self, line: PreparedLine) -> Iterator[SpokenPart]:
        """Speak a line, stretch by stretch; warn of sounds that had to be guessed."""
        text, language = line.text, self.language
        stretches = divide(line.shape, language)
        guessed: dict[str, None] = {}
        for number, stretch in enumerate(stretches):
            spoken = normalise(text, stretch.start, stretch.end, language, line.dictated)
            last = number + 1 == len(stretches)
            request = SpeechRequest(
                spoken.text,
                self.voice,
                self.rate,
                self.pitch,
                end_pause=stretch.ends_sentence and not last,
                manner=self.manner,
                directions=tuple(placed(line.directions, spoken, stretch.start, stretch.end, last=last)),
            )
            rendition = scale_pauses(self._rendition(request), self.manner.pauses)
            guessed.update(dict.fromkeys(rendition.guessed))
            yield SpokenPart(stretch, spoken, rendition)
            if self.progress is not None:
                self.progress((number + 1) / len(stretches))
        if guessed:
            names = ", ".join(f"'{name}'" for name in guessed)
            warn(f"no mouth shape for {names}: using the nearest phone class", SpeechWarning)

    def _rendition(self, request: SpeechRequest) -> Rendition:
        """Return what was `spoken` for a request, or let the engine speak it and add it there."""
        if self.spoken is None:
            return self.engine.synthesize(request)
        rendition = self.spoken.get(request) or self.engine.synthesize(request)
        self.spoken[request] = rendition
        return rendition


def _in_semitones(span: DirectedSpan, own: float | None) -> DirectedSpan:
    if span.pitch is None:
        return span
    if own is None:
        return replace(span, pitch=None)
    wanted = own + span.pitch.value if span.pitch.added else span.pitch.value
    semitones = 12.0 * math.log2(max(wanted, 1.0) / own)
    semitones = max(-MOST_SEMITONES, min(semitones, MOST_SEMITONES))
    return replace(span, pitch=None, manner=span.manner.then(VoiceAdjustment(pitch=semitones)))


def find_speaker(name: str | None, language: str | None, engine: SpeechEngine | None = None) -> Speaker:
    """Return the speaker with a voice, by its name or its file; with `language` alone its first voice.

    Raises SpeechError for an unknown voice.
    """
    if engine is None and name is not None and is_voice_file(name):
        engine = load_voice_file(name, language)
        return Speaker(engine, engine.voices()[0])
    engine = engine or load_engine()
    return Speaker(engine, find_voice(name, language, engine))


def _answering(text: str, tokens: Sequence[Token], directions: Directions, language: Language) -> Directions:
    """Return directions by which the voice raises what is new in an answer and lowers what is given."""
    if not language.spaces:
        raise InputError(
            f"--answers needs a language that separates words by spaces; '{language.code}' does not"
        )
    ends = [stretch.end for stretch in divide(text, language) if stretch.ends_sentence]
    gaps = [text[a.end : b.start].strip() for a, b in pairwise(tokens)]
    words = [
        PlacedWord(token.text, bisect_right(ends, token.start), separated=bool(gap))
        for token, gap in zip(tokens, ["", *gaps], strict=True)
    ]
    context = context_of(words, directions.answers, language)
    pitch = raised(context, words, language)
    here = Place("text")
    spans = tuple(
        DirectedSpan(tokens[i].start, tokens[i].end, here, VoiceAdjustment(pitch=pitch[i]))
        for i in sorted(pitch)
    )
    return replace(directions, spans=(*spans, *directions.spans))
