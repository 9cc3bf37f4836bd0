"""Words that begin with a vowel begin where the voice stops before it.

Speakers often put a glottal stop, or a few slow pulses of creak, before a vowel that begins a word (Dilley,
Shattuck-Hufnagel and Ostendorf 1996). The model has no phone for it: the decoder gives it to the word before.
Stops end the voice themselves, and their bursts are not told from the glottis's: edges after them stay.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ...core.arrays import Array
from ...languages import phonesets
from .decoder import AlignedPhone
from .spectra import STEP_SECONDS, edge_steps
from .voice_stops import voice_stops


def glottal_starts(levels: Array, phones: Sequence[AlignedPhone], edges: Array) -> Array:
    """Return the `edges` (n - 1,) between n phones with those before glottal stops where these begin.

    `edges` are seconds from the start of the sound whose levels (`spectra.band_levels`) are given.
    """
    steps = edge_steps(levels, edges)
    placed = edges.copy()
    for index, (before, vowel) in enumerate(pairwise(phones)):
        begins = before.word >= 0 and vowel.word > before.word and phonesets.is_vowel(vowel.symbol)
        if begins and not phonesets.is_stop(before.symbol):
            stop = voice_stops(levels, before.symbol, steps[index : index + 3])
            if stop is not None:
                placed[index] = stop[0] * STEP_SECONDS
    return placed
