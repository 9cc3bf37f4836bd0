"""The task that aligns and recognizes: pocketsphinx, in a worker (`machine.workers`).

It imports nothing of Risorius, so that it starts fast. The library is in C: in a process of its own, what
breaks or delays it breaks or delays no more than one recording.

Requests, by `op`: `align`, `follow` and `fit` (readings: of each word in order, its readings, each a list of
phones), `hear`, `name_words`, `name_phones`. Answers: `segments`, each [name, first frame, last frame]; for
`align` and `fit` also `words`, each [name, phones], each phone [name, first frame, frames, log likelihood];
for `hear`, nothing. `fit` takes less time than `align`, and finds no words that fit badly.

All but `hear` have a decoder of their own, made when first needed, which adapts to the voice as it hears it.
`hear` lets the decoder of `align` adapt to a sound as if it had aligned it, in a seventh of the time.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pocketsphinx import Decoder

RATE = 16_000
# `align`'s loses no transcript, however wrong; `follow`'s is enough to follow one.
_WIDE_BEAM, _BEAM = 1e-200, 1e-80
_GRAMMAR = "words"
# How often `align` decodes its sound.
_PASSES = 2
# The model's phone of silence: a search for it alone takes the least time.
_SILENCE = "SIL"
# How likely it is, word by word, that the sound ends there: only where it must, as far as that matters.
_STOP_PROBABILITY = 1e-3

_Readings = Sequence[Sequence[str]]


class AlignerWorker:
    """The decoders of one recording."""

    def answer(self, request: dict[str, Any], sound: bytes) -> dict[str, Any]:
        """Meet one request; raise ValueError for an unknown one."""
        op = request.get("op")
        if op == "align":
            return self._align(self._wide, request["readings"], sound)
        if op == "hear":
            return self._hear(sound)
        if op == "follow":
            _set_grammar(self._narrow, request["readings"], stops=True)
            return {"segments": _heard(self._narrow, sound)}
        if op == "fit":
            return self._align(self._narrow, request["readings"], sound)
        if op == "name_words":
            return {"segments": _heard(self._words, sound)}
        if op == "name_phones":
            return {"segments": _heard(self._phones, sound)}
        raise ValueError(f"unknown request '{op}'")

    def _align(self, decoder: Decoder, readings: Sequence[_Readings], sound: bytes) -> dict[str, Any]:
        _set_grammar(decoder, readings, stops=False)
        segments = _heard(decoder, sound)
        if not segments:
            return {"segments": [], "words": []}
        decoder.set_alignment()
        _decode(decoder, sound)
        words = [
            [word.name, [[phone.name, phone.start, phone.duration, phone.score] for phone in word]]
            for word in decoder.get_alignment()
        ]
        return {"segments": segments, "words": words}

    def _hear(self, sound: bytes) -> dict[str, Any]:
        _set_grammar(self._wide, [[[_SILENCE]]], stops=False)
        for _ in range(_PASSES):
            _decode(self._wide, sound)
        return {}

    @cached_property
    def _wide(self) -> Decoder:
        return _aligner(_WIDE_BEAM)

    @cached_property
    def _narrow(self) -> Decoder:
        return _aligner(_BEAM)

    @cached_property
    def _words(self) -> Decoder:
        """Names words by the language model."""
        import pocketsphinx

        return pocketsphinx.Decoder(loglevel="FATAL", samprate=RATE)

    @cached_property
    def _phones(self) -> Decoder:
        """Names phones, whatever they make."""
        import pocketsphinx

        model = pocketsphinx.get_model_path("en-us/en-us-phone.lm.bin")
        beam = 1e-20
        return pocketsphinx.Decoder(
            loglevel="FATAL", samprate=RATE, lm=None, dict=None, allphone=model, lw=2.0, beam=beam, pbeam=beam
        )


def _aligner(beam: float) -> Decoder:
    import pocketsphinx

    return pocketsphinx.Decoder(
        loglevel="FATAL", lm=None, dict=None, samprate=RATE, bestpath=False, beam=beam, pbeam=beam, wbeam=beam
    )


def _set_grammar(decoder: Decoder, words: Sequence[_Readings], stops: bool) -> None:
    """Let `words` be said in order; with `stops` the sound may end after any of them."""
    arcs: list[tuple[Any, ...]] = []
    for index, readings in enumerate(words):
        arcs += [(index, index + 1, 1.0 / len(readings), _named(decoder, phones)) for phones in readings]
        if stops:
            arcs.append((index, len(words), _STOP_PROBABILITY))
    decoder.add_fsg(_GRAMMAR, decoder.create_fsg(_GRAMMAR, 0, len(words), arcs))
    decoder.activate_search(_GRAMMAR)


def _named(decoder: Decoder, phones: Sequence[str]) -> str:
    """Return the decoder's word for a reading: named by its phones, so that no two are confused."""
    name = "-".join(phones)
    if decoder.lookup_word(name) is None:
        decoder.add_word(name, " ".join(phones), False)
    return name


def _heard(decoder: Decoder, sound: bytes) -> list[list[Any]]:
    """Return the segments that the decoder hears in all of `sound`."""
    _decode(decoder, sound)
    segments = [] if decoder.hyp() is None else decoder.seg()
    return [[segment.word, segment.start_frame, segment.end_frame] for segment in segments]


def _decode(decoder: Decoder, sound: bytes) -> None:
    decoder.start_utt()
    decoder.process_raw(sound, full_utt=True)
    decoder.end_utt()


def answer(request: dict[str, Any], sound: bytes) -> dict[str, Any]:
    """Meet a request about a sound (16 kHz, 16-bit little-endian) with the decoders of this process."""
    return _worker().answer(request, sound)


@cache
def _worker() -> AlignerWorker:
    return AlignerWorker()
