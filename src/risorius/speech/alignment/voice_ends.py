"""Find the end of the voice before a silence, and the edge inside a sound that two words share.

Before a silence the decoder lets a vowel, nasal or liquid last as long as anything of it is heard: soft
breath and the echo of the room, up to 120 ms beyond the voice. There it ends where the voice does, as a
fall of the power in the lowest band, by which labels by hand are set, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ...core.arrays import Array
from ...core.speech.utterance import SILENCE
from ...languages import phonesets
from .decoder import AlignedPhone
from .spectra import STEP_SECONDS, edge_steps

# The voice ends where it falls to a fifth of the vowel's amplitude (natural logarithm of power, as the levels
# are). From a third to a tenth of the amplitude, ends differ by 4 ms in the mean.
_FALL = np.log(25.0)
_VOICE = 0
_ALIKE = frozenset({"S", "Z"})
_LASTING = phonesets.SONORANTS | phonesets.HISSES


def voice_ends(levels: Array, phones: Sequence[AlignedPhone], edges: Array) -> Array:
    """Return the `edges` (n - 1,) between n phones, those before silence no later than the voice's end.

    `edges` are seconds from the start of the sound whose levels (`spectra.band_levels`) are given. A sound
    keeps its first half.
    """
    steps = edge_steps(levels, edges)
    placed, vowel = edges.copy(), -1
    for index, (phone, after) in enumerate(pairwise(phones)):
        if phonesets.is_vowel(phone.symbol):
            vowel = index
        if (
            vowel < 0
            or after.symbol != SILENCE
            or not (vowel == index or phone.symbol in phonesets.SONORANTS)
        ):
            continue
        first, end = steps[index : index + 2].tolist()
        whole = levels[steps[vowel] : max(steps[vowel + 1], steps[vowel] + 1), _VOICE]
        if not len(whole):
            continue  # the sound ends before it
        half = (first + end) // 2
        loud = np.flatnonzero(levels[half:end, _VOICE] >= np.median(whole) - _FALL)
        last = half + int(loud[-1]) + 1 if len(loud) else half
        if last < end:
            placed[index] = last * STEP_SECONDS
    return placed


def shared_sounds(phones: Sequence[AlignedPhone], edges: Array) -> Array:
    """Return the `edges` (n - 1,) with those between two words that meet in one lasting sound at its middle.

    In "Gus saw" one /s/ is heard: no edge in it can be. If the second word goes on with a consonant, as in
    "this skirt", the sound is the first word's, as in labels by hand.
    """
    placed = edges.copy()
    for index, (one, two, after) in enumerate(zip(phones, phones[1:], phones[2:], strict=False)):
        alike = one.symbol == two.symbol or {one.symbol, two.symbol} == _ALIKE
        lasts = one.symbol in _LASTING or phonesets.is_vowel(one.symbol)
        if alike and lasts and index > 0 and 0 <= one.word < two.word:
            cluster = not (phonesets.is_vowel(two.symbol) or phonesets.is_vowel(after.symbol))
            first = 1.0 if cluster and after.word == two.word else 0.5
            placed[index] = (1.0 - first) * edges[index - 1] + first * edges[index + 1]
    return placed
