"""pocketsphinx as an aligner: words with given readings, in order, found in a stretch of sound.

Two passes: the first finds which reading of each word is said when, the second divides the words into phones.
Beams are so wide that the search does not lose its way; a little noise everywhere keeps exact silence, which
no model has heard, from ending it early.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...core.arrays import Array
from ...core.utterance import SILENCE
from ..recordings.resampled import RATE

if TYPE_CHECKING:
    from pocketsphinx import Decoder

# The language of the model, and of its dictionary.
MODEL_LANGUAGE = "en-us"
# Seconds of the model's frames. A frame's features are those of the sound around its middle.
FRAME = 0.01
MIDDLE = FRAME / 2
# The first loses no transcript, however wrong; the second is enough to follow one.
_WIDE_BEAM, _BEAM = 1e-200, 1e-80
PAD_SECONDS = 0.2
_NOISE = 10.0
_GRAMMAR = "words"
UNSPOKEN = ("<", "[", "+", "(")
# How likely it is, word by word, that the sound ends there: only where it must, as far as that matters.
_STOP_PROBABILITY = 1e-3

Reading = tuple[str, ...]
Readings = tuple[Reading, ...]


class AlignmentError(Exception):
    """The words cannot be found in the sound."""


class AlignedPhone(NamedTuple):
    """A phone, or silence of word -1, in [start, end) seconds. `score`: mean log likelihood per frame."""

    symbol: str
    start: float
    end: float
    word: int
    score: float


class Decoders:
    """The decoders of one recording, each made when first needed.

    What a decoder has heard before changes what it finds, and it serves one thread: no two recordings share
    one.
    """

    def align_words(self, sound: Array, words: Sequence[Readings]) -> list[AlignedPhone]:
        """Return the phones and silences of `sound` (16 kHz), in which all `words` are said in order.

        They follow one another without gaps. Raises AlignmentError if there is no room for so many words.
        """
        decoder, data = self._wide, prepared(sound)
        _set_grammar(decoder, words, stops=False)
        decode(decoder, data)
        said = [segment.word for segment in _segments(decoder)]
        if sum(not word.startswith(UNSPOKEN) for word in said) != len(words):
            raise AlignmentError
        decoder.set_alignment()
        decode(decoder, data)
        return list(_phones(decoder.get_alignment(), len(sound) / RATE))

    def follow_words(self, sound: Array, words: Sequence[Readings]) -> list[tuple[float, float]]:
        """Return the spans in seconds of as many of `words`, from the first on, as are said in `sound`."""
        decoder, data = self._narrow, prepared(sound)
        _set_grammar(decoder, words, stops=True)
        decode(decoder, data)
        return [
            (segment.start_frame * FRAME - PAD_SECONDS, (segment.end_frame + 1) * FRAME - PAD_SECONDS)
            for segment in _segments(decoder)
            if not segment.word.startswith(UNSPOKEN)
        ]

    @cached_property
    def _wide(self) -> Decoder:
        return _decoder(_WIDE_BEAM)

    @cached_property
    def _narrow(self) -> Decoder:
        return _decoder(_BEAM)


def dictionary_path() -> str:
    """Return the path of the pronunciation dictionary that comes with the model (CMUdict)."""
    import pocketsphinx

    return str(pocketsphinx.get_model_path("en-us/cmudict-en-us.dict"))


def _decoder(beam: float) -> Decoder:
    import pocketsphinx

    return pocketsphinx.Decoder(
        loglevel="FATAL", lm=None, dict=None, samprate=RATE, bestpath=False, beam=beam, pbeam=beam, wbeam=beam
    )


def prepared(sound: Array) -> bytes:
    """Return the sound as the decoder takes it: with noise everywhere and PAD_SECONDS of it at both ends."""
    padded = np.pad(sound, round(PAD_SECONDS * RATE))
    padded += np.random.default_rng(0).normal(0.0, _NOISE, len(padded))
    return np.clip(np.round(padded), -32_768, 32_767).astype("<i2").tobytes()


def _set_grammar(decoder: Decoder, words: Sequence[Readings], stops: bool) -> None:
    """Let `words` be said in order; with `stops` the sound may end after any of them."""
    arcs: list[tuple[Any, ...]] = []
    for index, readings in enumerate(words):
        arcs += [(index, index + 1, 1.0 / len(readings), _named(decoder, phones)) for phones in readings]
        if stops:
            arcs.append((index, len(words), _STOP_PROBABILITY))
    decoder.add_fsg(_GRAMMAR, decoder.create_fsg(_GRAMMAR, 0, len(words), arcs))
    decoder.activate_search(_GRAMMAR)


def _named(decoder: Decoder, phones: Reading) -> str:
    """Return the decoder's word for a reading: named by its phones, so that no two are confused."""
    name = "-".join(phones)
    if decoder.lookup_word(name) is None:
        decoder.add_word(name, " ".join(phones), False)
    return name


def decode(decoder: Decoder, data: bytes) -> None:
    """Let the decoder hear all of `data`."""
    decoder.start_utt()
    decoder.process_raw(data, full_utt=True)
    decoder.end_utt()


def _segments(decoder: Decoder) -> list[Any]:
    return [] if decoder.hyp() is None else list(decoder.seg())


def _phones(alignment: Any, duration: float) -> Iterator[AlignedPhone]:
    """Yield the aligned phones, cut to [0, duration]: a phone in the padding has no length left."""
    index = -1
    for word in alignment:
        spoken = not word.name.startswith(UNSPOKEN)
        index += spoken
        for phone in word:
            start = phone.start * FRAME + MIDDLE - PAD_SECONDS
            end = (phone.start + phone.duration) * FRAME + MIDDLE - PAD_SECONDS
            start, end = min(max(start, 0.0), duration), min(max(end, 0.0), duration)
            if spoken or start < end:
                symbol = phone.name if spoken else SILENCE
                yield AlignedPhone(symbol, start, end, index if spoken else -1, phone.score / phone.duration)
