"""Anticipation: a coming vowel already shapes the consonants before it.

A vowel begins with the consonants of its syllable that are before it (Öhman 1966): an articulator that such a
consonant leaves free already moves to the vowel. The consonants at the end of a syllable are timed by the
vowel before them, and do not wait for the next one (Browman and Goldstein 1988).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from ..core.lips.articulators import PROTRUSION, WIDTH
from ..core.movement import LipSegment
from ..core.speech.utterance import SILENCE, Phone, Utterance
from ..reading.frozen import FrozenDict

ROUNDING = (WIDTH, PROTRUSION)
"""The articulators of rounding. It begins before its vowel; an unrounded vowel asks nothing of consonants.
A phone without a target for these keeps them at rest."""


@dataclass(frozen=True, slots=True)
class ComingVowel:
    """The vowel after a consonant: the index of its phone, and the articulators that it already holds, each
    with the share of its precision."""

    phone: int
    shares: Mapping[str, float]


class TargetsHeld(NamedTuple):
    """Targets, and the precision of each."""

    targets: Mapping[str, float]
    precision: Mapping[str, float]


def coming_vowels(
    utterance: Utterance, anticipates: Callable[[Phone], Mapping[str, float]]
) -> Mapping[int, ComingVowel]:
    """Return the coming vowel by index of the consonants that the vowel of their syllable follows.

    `anticipates`: the shares of a consonant. Of several consonants before a vowel, one anticipates only what
    all after it do. Phones that no syllable holds belong together.
    """
    phones = utterance.phones
    syllable = {
        index: number
        for number, own in enumerate(utterance.syllables)
        for index in range(own.first_phone, own.last_phone)
    }
    coming: dict[int, ComingVowel] = {}
    vowel, free = -1, FrozenDict[str, float]()
    for index in reversed(range(len(phones))):
        phone = phones[index]
        if phone.symbol == SILENCE:
            vowel = -1
        elif phone.stress >= 0:
            vowel = index
        elif vowel >= 0 and syllable.get(index) == syllable.get(vowel):
            shares = anticipates(phone)
            if index + 1 < vowel:
                shares = {name: share for name, share in shares.items() if name in free}
            free = FrozenDict(shares)
            if free:
                coming[index] = ComingVowel(vowel, free)
    return coming


def coarticulate_onset(own: LipSegment, vowel: LipSegment, shares: Mapping[str, float]) -> TargetsHeld:
    """Return the targets of a consonant's segment in which a vowel takes part, by `shares` of its precision.

    Each is the mean of both, by precision; it is as precise as both together. Closures, and
    articulators without a target of the vowel, stay as they are.
    """
    targets, precision = dict(own.targets), dict(own.precision)
    rounded = PROTRUSION in vowel.targets
    for name, share in shares.items():
        target = targets.get(name, 0.0 if name in ROUNDING else None)
        if target is not None and name in vowel.targets and (rounded or name not in ROUNDING):
            mine, its = own.precision_of(name), share * vowel.precision_of(name)
            targets[name] = (mine * target + its * vowel.targets[name]) / (mine + its)
            precision[name] = mine + its
    return TargetsHeld(FrozenDict(targets), FrozenDict(precision))
