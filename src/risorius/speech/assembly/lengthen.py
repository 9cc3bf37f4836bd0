"""Longer and shorter pauses in an engine's rendition."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...core.speech.utterance import SILENCE
from ..engines.protocol import Rendition, SpokenPhone

# Shortest pause that shortening leaves, in seconds.
SHORTEST = 0.06


def scale_pauses(rendition: Rendition, factor: float) -> Rendition:
    """Return the rendition with its pauses `factor` times as long: silence put in, or cut from their middle.

    The closure of a stop after a pause is not part of it.
    """
    if factor == 1.0:
        return rendition
    least = round(SHORTEST * rendition.sample_rate)
    pieces = []
    phones: list[SpokenPhone] = []
    taken = moved = 0
    for phone, end in _joined(rendition):
        phones.append(phone._replace(start=phone.start + moved))
        room = end - phone.start
        if phone.symbol != SILENCE or room <= least:
            continue
        change = max(round((factor - 1.0) * room), least - room)
        cut = phone.start + room // 2 + min(change, 0) // 2
        pieces += [rendition.samples[taken:cut], np.zeros(max(change, 0), np.int16)]
        taken = cut - min(change, 0)
        moved += change
    pieces.append(rendition.samples[taken:])
    return replace(rendition, samples=np.concatenate(pieces), phones=tuple(phones))


def _joined(rendition: Rendition) -> Iterator[tuple[SpokenPhone, int]]:
    """Yield the phones with where they end, silences in a row as one."""
    phones = rendition.phones
    for index, phone in enumerate(phones):
        if phone.symbol == SILENCE and index and phones[index - 1].symbol == SILENCE:
            continue
        following = next(
            (p for p in phones[index + 1 :] if phone.symbol != SILENCE or p.symbol != SILENCE), None
        )
        end = len(rendition.samples) if following is None else following.start - following.closure
        yield phone, max(end, phone.start)
