"""Accents and boundaries that stand in a TextGrid, in tiers of points with ToBI's labels."""

from __future__ import annotations

import contextlib
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ...core.speech.tobi import BOUNDARY_TONES, PITCH_ACCENTS, UNKNOWN_ACCENT, UNKNOWN_BOUNDARY, boundary_tone
from ...core.speech.utterance import Accent, Boundary, Syllable, Word
from ...errors import InputError, Place, unknown
from ...script.textgrid import POINTS, Label, TextGrid, Tier
from ..structure.nuclei import with_nuclei

# Labels that may stand in tiers of these names.
ACCENTS, BOUNDARIES = (*PITCH_ACCENTS, UNKNOWN_ACCENT), (*BOUNDARY_TONES, UNKNOWN_BOUNDARY)
TIERS = {
    "accents": ACCENTS,
    "boundaries": BOUNDARIES,
    "tones": ACCENTS + BOUNDARIES,
    "tobi": ACCENTS + BOUNDARIES,
}


class Tones(NamedTuple):
    """The accents and boundaries of the tiers."""

    accents: tuple[Accent, ...]
    boundaries: tuple[Boundary, ...]


def read_tones(grid: TextGrid, syllables: Sequence[Syllable], words: Sequence[Word]) -> Tones:
    """Return the accents and boundaries of a TextGrid, each at the syllable or word that it stands on.

    Raises InputError, with the line, for a label that ToBI does not have.
    """
    labels = [pair for tier in _tone_tiers(grid) for pair in _tones(tier, grid.source)]
    tones = sorted((label.start, tone) for label, tone in labels)
    accents = [_accent(at, tone, syllables) for at, tone in tones if tone in ACCENTS and syllables]
    boundaries = tuple(_boundary(at, tone, words) for at, tone in tones if tone in BOUNDARIES and words)
    return Tones(with_nuclei(accents, {boundary.word for boundary in boundaries}), boundaries)


def tells_accents(grid: TextGrid) -> bool:
    """Tell whether there is a tier of accents, possibly an empty one."""
    return any(UNKNOWN_ACCENT in _allowed(tier) for tier in _tone_tiers(grid))


def tells_boundaries(grid: TextGrid) -> bool:
    """Tell whether there is a tier of boundaries, possibly an empty one."""
    return any(UNKNOWN_BOUNDARY in _allowed(tier) for tier in _tone_tiers(grid))


def _tone_tiers(grid: TextGrid) -> list[Tier]:
    return [t for t in grid.tiers if t.kind == POINTS and t.name.strip().lower() in TIERS]


def _allowed(tier: Tier) -> tuple[str, ...]:
    return TIERS[tier.name.strip().lower()]


def _tones(tier: Tier, source: str) -> Iterator[tuple[Label, str]]:
    for label in tier.labels:
        tone = label.text.strip().upper()
        if tone not in ACCENTS and UNKNOWN_BOUNDARY in _allowed(tier):
            with contextlib.suppress(InputError):
                tone = boundary_tone(tone)
        if tone not in _allowed(tier):
            raise InputError(unknown("tone", label.text, _allowed(tier)), Place(source, label.line))
        yield label, tone


def _accent(time: float, tone: str, syllables: Sequence[Syllable]) -> Accent:
    index = max(bisect_right(syllables, time, key=lambda s: s.start) - 1, 0)
    return Accent(time, syllables[index].word, index, tone)


def _boundary(time: float, tone: str, words: Sequence[Word]) -> Boundary:
    nearest = min(range(len(words)), key=lambda index: abs(words[index].end - time))
    return Boundary(time, nearest, tone)
