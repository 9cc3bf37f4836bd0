"""Assign each phone to its word.

The engine says where in the text a phone's word begins, but its words are not a reader's: "of the" is one, a
number is many. So phones go to the token at their place, and tokens that share a place divide the phones as
their transcriptions suggest.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from itertools import accumulate, groupby

from ...languages import phonesets
from ..text.normalise import NormalisedText
from ..text.tokens import Token

# Transcribes words: the phones of each.
Transcriber = Callable[[Sequence[str]], Sequence[Sequence[str]]]

# Costs of taking one phone for another: of the same kind, both consonants, vowel for consonant.
_KIN, _SIMILAR, _DIFFERENT = 0.4, 0.6, 1.6
_MISSING = 1.0


def assign(
    symbols: Sequence[str],
    positions: Sequence[int],
    spoken: NormalisedText,
    tokens: Sequence[Token],
    transcribe: Transcriber,
) -> list[int]:
    """Return the index into `tokens` for every phone; the indices never decrease.

    `symbols` are the phones' names and `positions` their words' places in `spoken.text`.
    """
    if not tokens:
        raise ValueError("phones without a token to belong to")
    at_places = accumulate((_token_at(tokens, _source(spoken, position)) for position in positions), max)
    owners: list[int] = []
    runs = [(token, len(list(run))) for token, run in groupby(at_places)]
    for (token, count), (following, _) in zip(runs, [*runs[1:], (len(tokens), 0)], strict=True):
        run = symbols[len(owners) : len(owners) + count]
        shared = range(token, following)
        owners += [token] * count if len(shared) == 1 else _share(run, shared, spoken, tokens, transcribe)
    return owners


def _source(spoken: NormalisedText, position: int) -> int:
    return spoken.origin[max(0, min(position, len(spoken.origin) - 1))]


def _token_at(tokens: Sequence[Token], offset: int) -> int:
    """Return the token that holds the character at `offset`, or the next one, or the last."""
    index = bisect_right(tokens, offset, key=lambda token: token.start) - 1
    if index < 0 or offset >= tokens[index].end:
        index += 1
    return min(index, len(tokens) - 1)


def _share(
    run: Sequence[str],
    shared: range,
    spoken: NormalisedText,
    tokens: Sequence[Token],
    transcribe: Transcriber,
) -> list[int]:
    transcribed = transcribe([_spoken_text(spoken, tokens[index]) for index in shared])
    audible = [(index, phones) for index, phones in zip(shared, transcribed, strict=True) if phones]
    if not audible:
        return [shared.start] * len(run)
    indices = [index for index, _ in audible]
    counts = split(run, [phones for _, phones in audible])
    return [index for index, count in zip(indices, counts, strict=True) for _ in range(count)]


def _spoken_text(spoken: NormalisedText, token: Token) -> str:
    first = bisect_left(spoken.origin, token.start)
    last = bisect_left(spoken.origin, token.end)
    return spoken.text[first:last].strip()


def split(phones: Sequence[str], words: Sequence[Sequence[str]]) -> list[int]:
    """Return how many of `phones` belong to each of the words, transcribed one by one in `words`.

    The transcriptions are aligned with the phones at the least cost of phones changed, added and dropped;
    every word has a phone as long as there are enough.
    """
    expected = [(symbol, index) for index, word in enumerate(words) for symbol in word]
    owners = _align(phones, expected)
    bounds = [sum(owner <= index for owner in owners) for index in range(len(words))]
    bounds[-1] = len(phones)
    for index in range(len(words)):
        lowest = min(index + 1, len(phones))
        highest = max(len(phones) - (len(words) - 1 - index), lowest)
        previous = bounds[index - 1] + 1 if index else 1
        bounds[index] = min(max(bounds[index], lowest, min(previous, highest)), highest)
    return [after - before for before, after in zip([0, *bounds], bounds, strict=False)]


def _align(phones: Sequence[str], expected: Sequence[tuple[str, int]]) -> list[int]:
    """Return for each phone the word of the expected phone that it is aligned with, or that follows it."""
    rows, columns = len(phones) + 1, len(expected) + 1
    cost = [[0.0] * columns for _ in range(rows)]
    for i in range(rows):
        for j in range(columns):
            ways = [cost[i - 1][j] + _MISSING] if i else []
            ways += [cost[i][j - 1] + _MISSING] if j else []
            ways += [cost[i - 1][j - 1] + _difference(phones[i - 1], expected[j - 1][0])] if i and j else []
            cost[i][j] = min(ways, default=0.0)
    owners = [0] * len(phones)
    i, j = rows - 1, columns - 1
    while i:
        if j and cost[i][j] == cost[i - 1][j - 1] + _difference(phones[i - 1], expected[j - 1][0]):
            i, j = i - 1, j - 1
            owners[i] = expected[j][1]
        elif j and cost[i][j] == cost[i][j - 1] + _MISSING:
            j -= 1
        else:
            i -= 1
            owners[i] = expected[j - 1][1] if j else expected[0][1]
    return owners


def _difference(a: str, b: str) -> float:
    if a == b:
        return 0.0
    if phonesets.is_vowel(a) != phonesets.is_vowel(b):
        return _DIFFERENT
    kinds = (phonesets.is_vowel, phonesets.is_nasal, phonesets.is_stop)
    return _KIN if any(kind(a) and kind(b) for kind in kinds) else _SIMILAR
