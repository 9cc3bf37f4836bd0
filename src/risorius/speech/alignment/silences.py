"""Keep the true silences among those that the decoder puts between words."""

from __future__ import annotations

from collections.abc import Sequence

from ...core.speech.utterance import SILENCE
from ...languages import phonesets
from .decoder import AlignedPhone

# Seconds. Shorter silence belongs to a sound beside it: a stop's closure, or the end of the sound before.
SHORTEST = 0.05
LONGEST_CLOSURE = 0.09


def without_gaps(aligned: Sequence[AlignedPhone]) -> list[AlignedPhone]:
    """Return the phones with short silences given to their neighbours, and adjacent silences joined."""
    joined: list[AlignedPhone] = []
    for index, phone in enumerate(aligned):
        after = aligned[index + 1] if index + 1 < len(aligned) else None
        before = joined[-1] if joined else None
        if before and before.symbol == SILENCE and (phone.symbol == SILENCE or _is_closure(before, phone)):
            joined[-1] = phone._replace(start=before.start, score=_joint_score(before, phone))
        elif phone.symbol == SILENCE and before and after and phone.end - phone.start < SHORTEST:
            if phonesets.is_stop(after.symbol):
                joined.append(phone)
            else:
                joined[-1] = before._replace(end=phone.end)
        else:
            joined.append(phone)
    return joined


def _joint_score(silence: AlignedPhone, phone: AlignedPhone) -> float:
    """Return the mean score of two silences in a row; a closure's is that of its stop."""
    if phone.symbol != SILENCE:
        return phone.score
    lengths = silence.end - silence.start, phone.end - phone.start
    return (silence.score * lengths[0] + phone.score * lengths[1]) / max(sum(lengths), 1e-9)


def _is_closure(silence: AlignedPhone, phone: AlignedPhone) -> bool:
    return (
        phonesets.is_stop(phone.symbol)
        and silence.start > 0.0
        and silence.end - silence.start < LONGEST_CLOSURE
    )
