"""Two words halve the silence between a hiss and the nasal, liquid or glide after it.

The mouth is shut or narrow for the second sound before its voice begins: "wash water" has up to 70 ms of
silence there (`epi`, epenthetic silence, in TIMIT's phoncode.doc). The decoder gives it to the hiss, labels
by hand to neither word.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ...core.arrays import Array
from ...languages.phonesets import HISSES, SONORANTS
from .decoder import AlignedPhone
from .spectra import STEP_SECONDS, edge_steps
from .voice_stops import voice_stops


def hiss_ends(levels: Array, phones: Sequence[AlignedPhone], edges: Array) -> Array:
    """Return the `edges` (n - 1,) between n phones, those after words' hisses amid the silence there.

    `edges` are seconds from the start of the sound whose levels (`spectra.band_levels`) are given.
    """
    steps = edge_steps(levels, edges)
    placed = edges.copy()
    for index, (hiss, after) in enumerate(pairwise(phones)):
        if hiss.symbol in HISSES and after.symbol in SONORANTS and 0 <= hiss.word < after.word:
            stop = voice_stops(levels, hiss.symbol, steps[index : index + 3])
            if stop is not None:
                placed[index] = 0.5 * sum(stop) * STEP_SECONDS
    return placed
