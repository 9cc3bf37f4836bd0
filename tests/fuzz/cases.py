"""Spoilt files, counted: the same number of the same kind is the same file."""

from __future__ import annotations

import random

from .mutation import MUTATIONS
from .registry import READERS
from .structure import STRUCTURED

MOST = 1_500_000  # bytes of a case


def spoilt(kind: str, number: int, seed: int = 0) -> bytes:
    """Return a right file of a kind, spoilt: by bytes and tokens, or by what it is made of."""
    numbers = random.Random(f"{seed} {kind} {number}")
    data = numbers.choice(READERS[kind].samples())
    if numbers.random() < 0.5:
        for _ in range(numbers.randint(1, 4)):
            change = numbers.choice(MUTATIONS)
            data = change(data, numbers.randint(0, len(data)), numbers.randrange(1000))[:MOST]
        return data
    for _ in range(numbers.randint(1, 3)):
        data = numbers.choice(STRUCTURED)(data, numbers)[:MOST]
    return data
