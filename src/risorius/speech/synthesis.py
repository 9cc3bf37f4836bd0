"""From text to an Utterance with sound: spoken sentence by sentence and joined sample by sample."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, MutableMapping, Sequence
from dataclasses import replace
from itertools import chain, pairwise

from ..core.audio import AudioWriter
from ..core.choices import RATES, SILENCES
from ..core.directions import UNDIRECTED, DirectedSpan, Directions
from ..core.manner import PLAIN, Manner
from ..core.utterance import Utterance
from ..errors import InputError, ParameterError, Place, SpeechWarning, warn
from ..languages import Language, language_of
from .assembly.assemble import SpokenPart, assemble, place, silence
from .assembly.lengthen import scale_pauses
from .assembly.retime import is_timed, retime
from .engines.protocol import Rendition, SpeechEngine, SpeechRequest, Voice
from .engines.registry import is_voice_file, load_engine, load_voice_file
from .engines.voices import find_voice
from .structure.accents import intone
from .structure.context import PlacedWord, context_of, raised
from .structure.pauses import find_pauses
from .structure.syllables import syllabify
from .text.normalise import normalise, placed
from .text.sentences import divide
from .text.tokens import Token, is_speakable, tokenize, with_words

KnownRenditions = MutableMapping[SpeechRequest, Rendition]
"""What a voice has spoken, by what it was asked for."""
LONGEST_TEXT = 100_000
LOWEST_PITCH, HIGHEST_PITCH = 0, 99


def synthesize(
    text: str,
    *,
    voice: str | None = None,
    language: str | None = None,
    rate: int | None = None,
    pitch: int | None = None,
    lead: float = 0.0,
    tail: float = 0.0,
    manner: Manner = PLAIN,
    directions: Directions = UNDIRECTED,
    engine: SpeechEngine | None = None,
    progress: Callable[[float], None] | None = None,
    spoken: KnownRenditions | None = None,
) -> Utterance:
    """Speak `text` and return the utterance, with `lead` and `tail` seconds of silence around it.

    `voice` is a name from `voices` (default `en-us`) or a voice's file; with `language` alone its first
    voice speaks. `rate` is in words per minute (`RATES`), `pitch` 0 to 99; None leaves the voice's own.
    `manner` changes the whole, `directions` parts of it. `progress` is told the share (0..1) that is done.
    What is in `spoken` is not spoken again; what is spoken is added to it.
    Same arguments, same bytes.

    Raises InputError for text that is empty, has nothing to speak or is longer than 100,000 characters,
    ParameterError for a number out of range, SpeechError for an unknown voice or a failing engine.
    """
    _check_text(text)
    _check_numbers(rate, pitch, lead, tail)
    engine, chosen = _voice(voice, language, engine)
    tokens = with_words(tokenize(text), language_of(chosen.language).words)
    if directions.answers and not directions.accents:
        directions = _answering(text, tokens, directions, language_of(chosen.language))
    request = SpeechRequest("", chosen, rate, pitch, manner=manner)
    parts = _speak(text, request, directions, engine, progress, spoken)
    first = next(parts)
    with AudioWriter(first.rendition.sample_rate) as writer:
        segments = silence(writer, lead)
        for part in chain([first], parts):
            segments += place(part, tokens, writer.frames, lambda words: engine.transcribe(words, chosen))
            writer.append(part.rendition.samples)
        segments += silence(writer, tail)
        audio = writer.finish()
    phones, words = assemble(segments, text, tokens, audio.sample_rate)
    if not words:
        raise InputError("nothing in the text can be spoken by this voice; expected words of its language")
    if is_timed(directions):
        _check_dictated(directions, chosen)
        audio, phones, words = retime(audio, phones, words, directions)
    syllables = syllabify(phones, words, language_of(chosen.language))
    pauses = find_pauses(text, phones, words, language_of(chosen.language))
    said = Utterance(text, chosen.language, audio, phones, words, syllables, pauses)
    return intone(said, directions)


def _answering(text: str, tokens: Sequence[Token], directions: Directions, language: Language) -> Directions:
    """Return directions by which the voice raises what is new in an answer and lowers what is given."""
    if not language.spaces:
        raise InputError(f"questions are not compared in '{language.code}'; expected a language with blanks")
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
        DirectedSpan(tokens[i].start, tokens[i].end, here, Manner(pitch=pitch[i])) for i in sorted(pitch)
    )
    return replace(directions, spans=(*spans, *directions.spans))


def voice_pitch(voice: str | None, language: str | None) -> float | None:
    """Return the mean pitch in Hz of the voice that `synthesize` uses, None if it is not known."""
    engine, chosen = _voice(voice, language, None)
    return engine.mean_pitch(chosen)


def voice_language(voice: str | None, language: str | None) -> Language:
    """Return the language of the voice that `synthesize` uses."""
    return language_of(_voice(voice, language, None)[1].language)


def _voice(name: str | None, language: str | None, engine: SpeechEngine | None) -> tuple[SpeechEngine, Voice]:
    if engine is None and name is not None and is_voice_file(name):
        engine = load_voice_file(name, language)
        return engine, engine.voices()[0]
    engine = engine or load_engine()
    return engine, find_voice(name, language, engine)


def _check_dictated(directions: Directions, voice: Voice) -> None:
    timed = next(span for span in directions.spans if span.seconds)
    if not language_of(voice.language).mnemonics.dictated:
        message = f"durations of phonemes in '{voice.language}'; expected an English voice for them"
        raise InputError(message, timed.place)


def _speak(
    text: str,
    request: SpeechRequest,
    directions: Directions,
    engine: SpeechEngine,
    progress: Callable[[float], None] | None,
    known: KnownRenditions | None,
) -> Iterator[SpokenPart]:
    """Speak the stretches of `text` in the manner of `request`; warn of sounds that had to be guessed."""
    language = language_of(request.voice.language)
    stretches = divide(text, language)
    guessed: dict[str, None] = {}
    for number, stretch in enumerate(stretches):
        spoken = normalise(text, stretch.start, stretch.end, language)
        last = number + 1 == len(stretches)
        stretch_request = replace(
            request,
            text=spoken.text,
            end_pause=stretch.ends_sentence and not last,
            directions=tuple(placed(directions, spoken, stretch.start, stretch.end, last=last)),
        )
        rendition = _rendition(engine, stretch_request, known)
        part = SpokenPart(stretch, spoken, scale_pauses(rendition, request.manner.pauses))
        guessed.update(dict.fromkeys(part.rendition.guessed))
        yield part
        if progress is not None:
            progress((number + 1) / len(stretches))
    if guessed:
        names = ", ".join(f"'{name}'" for name in guessed)
        warn(f"unknown phones are shown as the nearest class of phones: {names}", SpeechWarning)


def _rendition(engine: SpeechEngine, request: SpeechRequest, known: KnownRenditions | None) -> Rendition:
    """Return what is `known` of a request, or let the engine speak it and add it there."""
    if known is None:
        return engine.speak(request)
    rendition = known.get(request) or engine.speak(request)
    known[request] = rendition
    return rendition


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
