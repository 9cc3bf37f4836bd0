"""Random numbers that are counted, not drawn in turn: each depends on a seed and a key alone.

A key says what a number is for, in names and counts: the rule or the channel, the phrase, the unit. No number
depends on how many others were asked for before it: what is added later leaves earlier ones as they were.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from hashlib import blake2b
from struct import Struct

Key = str | int
# Bits of a random word that make a double in [0, 1).
_BITS = 53
_LOW_BITS, _DOWN = 2**_BITS - 1, 64 - _BITS
_UNIT = 2.0**-_BITS
_words = Struct("<QQ").unpack


class CounterRng:
    """The random numbers of a seed whose keys begin with `key`.

    Every number is a keyed hash (BLAKE2b), so that numbers of different keys are independent.
    `CounterRng(7, "a").uniform("b", 3)` and `CounterRng(7).uniform("a", "b", 3)` are the same number.
    """

    __slots__ = ("_hash",)

    def __init__(self, seed: int, *key: Key) -> None:
        self._hash = blake2b(_encoded((seed, *key)), digest_size=16)

    def under(self, *key: Key) -> CounterRng:
        """Return the numbers whose keys go on with `key`."""
        longer = CounterRng.__new__(CounterRng)
        longer._hash = self._hash.copy()
        longer._hash.update(_encoded(key))
        return longer

    def uniform(self, *key: Key, low: float = 0.0, high: float = 1.0) -> float:
        """Return a number evenly distributed in [low, high)."""
        return low + (high - low) * self._pair(key)[0]

    def normal(self, *key: Key, mean: float = 0.0, deviation: float = 1.0, limit: float = math.inf) -> float:
        """Return a normally distributed number, none further than `limit` deviations from the mean.

        Values beyond are moved to the limit. By the method of Box and Muller (1958).
        """
        one, two = self._pair(key)
        standard = math.sqrt(-2.0 * math.log(1.0 - one)) * math.cos(2.0 * math.pi * two)
        return mean + deviation * min(max(standard, -limit), limit)

    def exponential(self, *key: Key) -> float:
        """Return an exponentially distributed number of mean 1."""
        return -math.log(1.0 - self._pair(key)[0])

    def choice(self, weights: Mapping[str, float], *key: Key) -> str:
        """Return one of the names, each as often as its weight says; one weight at least is above 0."""
        names = sorted(weights)
        left = self._pair(key)[0] * math.fsum(weights.values())
        for name in names:
            left -= weights[name]
            if left < 0.0:
                return name
        return max(names, key=lambda name: weights[name])

    def _pair(self, key: tuple[Key, ...]) -> tuple[float, float]:
        """Return two independent numbers in [0, 1)."""
        state = self._hash.copy()
        state.update(_encoded(key))
        first, second = _words(state.digest())
        return (first & _LOW_BITS) * _UNIT, (second >> _DOWN) * _UNIT


def _encoded(key: tuple[Key, ...]) -> bytes:
    """Return bytes that no other key has."""
    return "".join([f"{part!r}," for part in key]).encode()
