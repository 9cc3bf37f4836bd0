"""From espeak-ng's events to phones.

Times are exact: a phone starts at the sample where espeak-ng says so, but for stops and for vowels after
nasals, which it stamps late and whose beginning is measured in the sound (`acoustics`). Phonemes that stand
for two sounds are divided (`mnemonics`). English comes out as ARPAbet, other languages as IPA.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from itertools import pairwise, zip_longest
from typing import Any, NamedTuple

from ...core.speech.audio import Samples
from ...core.speech.utterance import SILENCE
from ...languages import Language, phonesets
from ...languages.phonesets import ArpabetReading, PhonePart
from ...rules.articulation import is_known
from . import acoustics
from .mnemonics import as_ipa, from_mnemonic, is_pause
from .protocol import Rendition, SpokenPhone


class _Event(NamedTuple):
    """A phoneme event: `name` is the bare mnemonic, `ipa` None if it was not asked for."""

    start: int
    name: str
    ipa: str | None
    stress: int
    position: int
    tone: str


def needs_ipa(phones: Sequence[tuple[int, str, int]], language: Language) -> bool:
    """Tell whether the mnemonic of a sound is unknown, as in a word that switches the language."""
    bare = (phonesets.strip_stress(name)[0] for _, name, _ in phones)
    return any(
        _is_switch(name) or not (is_pause(name) or from_mnemonic(name, "", language).known) for name in bare
    )


def read_word(names: Sequence[str], ipa: bool, language: Language) -> tuple[str, ...]:
    """Return the phones of a word transcribed as mnemonics, or as IPA."""
    bare = [phonesets.strip_stress(name)[0] for name in names if not is_pause(name)]
    readings = (
        _read(name, name if ipa else None, following, language)
        for name, following in zip_longest(bare, bare[1:], fillvalue="")
    )
    return tuple(part.phone for reading in readings for part in reading.parts)


def render(
    answer: dict[str, Any], samples: Samples, language: Language, rate: int | None = None
) -> Rendition:
    """Return the phones of a worker's answer.

    It holds `sample_rate`, `phones` (sample, mnemonic, position of the word) and, if asked for, `ipa`: the
    phones' names in IPA, and `tones`, in letters of the IPA. `rate` is in words per minute.
    """
    sample_rate = int(answer["sample_rate"])
    unit = sample_rate * acoustics.tempo(rate)
    events = _events(answer)
    phones: list[SpokenPhone] = []
    guessed: dict[str, None] = {}
    for index, event in enumerate(events):
        end, following = events[index + 1][:2] if index + 1 < len(events) else (len(samples), "")
        if is_pause(event.name):
            phones.append(SpokenPhone(SILENCE, event.start, -1, 0, event.position))
            continue
        reading = _read(event.name, event.ipa, following, language)
        if not reading.known:
            guessed[event.ipa or event.name] = None
        closure = 0
        if reading.parts and phonesets.is_stop(reading.parts[0].phone):
            after_silence = not phones or phones[-1].symbol == SILENCE
            voiceless = phonesets.is_voiceless_stop(reading.parts[0].phone)
            closure = _closure(samples, event.start, unit, voiceless, after_silence)
        phones += _divide(event, reading.parts, end, closure)
    _open_nasals(phones, samples, sample_rate, unit)
    return Rendition(samples, sample_rate, tuple(phones), tuple(guessed))


def _is_switch(name: str) -> bool:
    return name.startswith("(")


def _events(answer: dict[str, Any]) -> list[_Event]:
    ipa = answer.get("ipa") or [None] * len(answer["phones"])
    tones = answer.get("tones") or [""] * len(answer["phones"])
    events = []
    for (start, name, position), sound, tone in zip(answer["phones"], ipa, tones, strict=True):
        if not _is_switch(name):
            bare, stress = phonesets.strip_stress(name)
            events.append(_Event(start, bare, sound, stress, position, tone))
    return events


def _read(name: str, ipa: str | None, following: str, language: Language) -> ArpabetReading:
    if ipa is None:
        return from_mnemonic(name, following, language)
    bare = as_ipa(phonesets.strip_stress(ipa)[0], language)
    if language.arpabet:
        return phonesets.from_ipa(bare)
    return ArpabetReading(
        (PhonePart(bare, 1.0),) if _sounds(bare) else (), is_known(bare) or not _sounds(bare)
    )


def _sounds(bare: str) -> bool:
    return any(char.isalpha() and unicodedata.category(char) != "Lm" for char in bare)


def _divide(event: _Event, parts: tuple[PhonePart, ...], end: int, closure: int) -> list[SpokenPhone]:
    phones = []
    at = float(event.start)
    stress, tone = event.stress, event.tone
    for phone, share in parts:
        level = stress if phonesets.is_vowel(phone) else -1
        own_tone = tone if level >= 0 else ""
        phones.append(SpokenPhone(phone, round(at), level, closure, event.position, own_tone))
        at += share * (end - event.start)
        closure = 0
        if level >= 0:
            # The marks stand on the first vowel.
            stress, tone = 0, ""
    return phones


def _closure(samples: Samples, burst: int, unit: float, voiceless: bool, after_silence: bool) -> int:
    """Return by how many samples the closure of a stop precedes its burst; `unit` samples are a second."""
    usual = round(acoustics.USUAL_CLOSURE * unit)
    if after_silence:
        # There the sound does not tell the closure from the pause, and voiced stops begin at the burst too.
        return usual
    measured = acoustics.silence_before(samples, burst, round(acoustics.LONGEST_CLOSURE * unit))
    return measured or (usual if voiceless else 0)


def _open_nasals(phones: list[SpokenPhone], samples: Samples, sample_rate: int, unit: float) -> None:
    """Let vowels after nasals begin where the mouth opens."""
    for index, (nasal, vowel) in enumerate(pairwise(phones)):
        if phonesets.is_nasal(nasal.symbol) and phonesets.is_vowel(vowel.symbol):
            earliest = max(
                (nasal.start + vowel.start) // 2, vowel.start - round(acoustics.LATEST_STAMP * unit)
            )
            start = acoustics.opening_before(samples, vowel.start, earliest, sample_rate)
            phones[index + 1] = vowel._replace(start=start)
