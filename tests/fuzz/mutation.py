"""Right files, spoilt: bytes, tokens, numbers, lengths and nesting."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from hypothesis import strategies as st

NUMBERS = (
    *b"0 -1 1e308 -1e308 1e-320 1e10000000 NaN Infinity 1e999 00 0x10 1_000 2.5.1 4294967296".split(),
    *b'18446744073709551616 -0.0 21600 21601 true null ""'.split(),
    *(b"9" * 400, b"9" * 4301, b"1" + b"0" * 30, b"0.1" + b"0" * 5000),
)
TOKENS = (
    *b"\" ' < > & &lt; &x; # [ ] { } ( ) , ; : = \\ \\u0000 \\ud800 / ../ %s {} \xff \xed\xa0\x80".split(
        b" "
    ),
    *(text.encode() for text in ("\u2028", "\u202e", "\ufeff", "é", "𝕏")),
    *b"[[ <!DOCTYPE <![CDATA[ --> word:3 end-0.5 AU12 AU999 jaw_open".split(),
    *(b"", b"\0", b"\n", b"\r", b"\t", b" " * 3000, b"x" * 3000),
)
_NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
_WORD = re.compile(rb"[A-Za-z_]+")
_SPAN = 40  # bytes of what is deleted, doubled or moved


def _delete(data: bytes, at: int, number: int) -> bytes:
    return data[:at] + data[at + 1 + number % _SPAN :]


def _double(data: bytes, at: int, number: int) -> bytes:
    return data[:at] + data[at : at + _SPAN] * (2 + number % 50) + data[at + _SPAN :]


def _flip(data: bytes, at: int, number: int) -> bytes:
    return data[:at] + bytes([data[at] ^ (1 << number % 8)]) + data[at + 1 :] if at < len(data) else data


def _insert(data: bytes, at: int, number: int) -> bytes:
    return data[:at] + TOKENS[number % len(TOKENS)] + data[at:]


def _cut(data: bytes, at: int, _number: int) -> bytes:
    return data[:at]


def _move(data: bytes, at: int, number: int) -> bytes:
    piece, rest = data[at : at + _SPAN], data[:at] + data[at + _SPAN :]
    to = number % (len(rest) + 1)
    return rest[:to] + piece + rest[to:]


def _nest(data: bytes, at: int, number: int) -> bytes:
    opening, closing = ((b"[", b"]"), (b"{", b"}"), (b"<p>", b"</p>"), (b"(", b")"))[number % 4]
    return data[:at] + opening * 200 + data[at:] + closing * 200


def _replaced(pattern: re.Pattern[bytes], values: Sequence[bytes]) -> Callable[[bytes, int, int], bytes]:
    """Return what replaces the match after a place by one of `values`."""

    def replace(data: bytes, at: int, number: int) -> bytes:
        match = pattern.search(data, at) or pattern.search(data)
        return (
            data
            if match is None
            else data[: match.start()] + values[number % len(values)] + data[match.end() :]
        )

    return replace


MUTATIONS: tuple[Callable[[bytes, int, int], bytes], ...] = (
    _replaced(_NUMBER, NUMBERS),
    _replaced(_WORD, TOKENS),
    _delete,
    _double,
    _flip,
    _insert,
    _cut,
    _move,
    _nest,
)


@st.composite
def mutated(draw: st.DrawFn, samples: Sequence[bytes]) -> bytes:
    """Draw one of the samples with one to four mutations."""
    data = draw(st.sampled_from(samples))
    steps = st.tuples(st.integers(0, len(MUTATIONS) - 1), st.integers(0, 9999), st.integers(0, 999))
    for kind, place, number in draw(st.lists(steps, min_size=1, max_size=4)):
        data = MUTATIONS[kind](data, place * len(data) // 10_000, number)
    return data
