"""Times: closures, short silences and vanishing sounds, always contiguous."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.speech.assembly.timing import Segment, settle

RATE = 22_050
CLOSURE = round(0.044 * RATE)


def ms(*milliseconds: float) -> list[int]:
    return [round(m * RATE / 1000) for m in milliseconds]


def chain(
    *spans: tuple[str, float], closures: dict[int, int] | None = None, intended: bool = False
) -> list[Segment]:
    segments, edge = [], 0
    for index, (symbol, length) in enumerate(spans):
        start, edge = edge, edge + ms(length)[0]
        segments.append(
            Segment(symbol, start, edge, closure=(closures or {}).get(index, 0), token=0, intended=intended)
        )
    return segments


def lengths(segments: list[Segment]) -> list[tuple[str, int]]:
    return [(s.symbol, round(s.length / RATE * 1000)) for s in segments]


def test_a_closure_is_taken_from_the_phone_before() -> None:
    settled = settle(chain(("AA", 150), ("P", 60), closures={1: CLOSURE}), RATE)
    assert lengths(settled) == [("AA", 106), ("P", 104)]


@pytest.mark.parametrize(("before", "remains"), [(60, 24), (40, 20), (30, 20), (20, 20), (15, 15)])
def test_a_closure_takes_at_most_60_percent_and_leaves_20_milliseconds(before, remains) -> None:
    settled = settle(chain(("T", 90), ("AA", before), ("P", 90), closures={2: CLOSURE}), RATE)
    assert settled[1].length == pytest.approx(ms(remains)[0], abs=2)
    assert settled[2].start == settled[1].end


def test_a_closure_may_take_all_of_a_silence() -> None:
    settled = settle(chain(("AA", 100), ("", 30), ("P", 60), intended=True, closures={2: CLOSURE}), RATE)
    assert lengths(settled) == [("AA", 100), ("P", 90)]


@pytest.mark.parametrize("symbol", ["B", "M", "S"])
def test_without_a_closure_nothing_moves(symbol) -> None:
    assert lengths(settle(chain(("AA", 150), (symbol, 60)), RATE)) == [("AA", 150), (symbol, 60)]


@pytest.mark.parametrize(
    ("silence", "intended", "expected"),
    [
        (59, False, [("AA", 159), ("M", 80)]),
        (61, False, [("AA", 100), ("", 61), ("M", 80)]),
        (12, True, [("AA", 100), ("", 12), ("M", 80)]),
        (9, True, [("AA", 109), ("M", 80)]),
    ],
)
def test_short_silence_belongs_to_the_sound_before_unless_it_is_meant(silence, intended, expected) -> None:
    segments = chain(("AA", 100), ("", silence), ("M", 80))
    segments[1].intended = intended
    assert lengths(settle(segments, RATE)) == expected


def test_short_silence_at_the_beginning_belongs_to_the_first_sound() -> None:
    assert lengths(settle(chain(("", 20), ("S", 80), ("AA", 90)), RATE)) == [("S", 100), ("AA", 90)]


def test_neighbouring_silences_are_one() -> None:
    assert lengths(settle(chain(("AA", 90), ("", 40), ("", 30), ("M", 90)), RATE)) == [
        ("AA", 90),
        ("", 70),
        ("M", 90),
    ]


def test_a_sound_without_duration_borrows_from_its_longer_neighbour() -> None:
    assert lengths(settle(chain(("EH", 160), ("L", 0), ("V", 80)), RATE)) == [
        ("EH", 110),
        ("L", 50),
        ("V", 80),
    ]
    assert lengths(settle(chain(("EH", 40), ("L", 0), ("V", 100)), RATE)) == [
        ("EH", 40),
        ("L", 35),
        ("V", 65),
    ]


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["AA", "P", "", "M"]), st.integers(0, 8000), st.integers(0, 3000), st.booleans()
        ),
        min_size=1,
        max_size=20,
    ).filter(lambda spans: sum(length for _, length, _, _ in spans) > 0)
)
def test_the_same_span_is_covered_without_a_gap(spans) -> None:
    segments, edge = [], 0
    for symbol, length, closure, intended in spans:
        start, edge = edge, edge + length
        segments.append(
            Segment(symbol, start, edge, closure=closure if symbol == "P" else 0, intended=intended)
        )
    settled = settle(segments, RATE)
    assert settled[0].start == 0
    assert settled[-1].end == edge
    assert all(a.end == b.start for a, b in pairwise(settled))
    assert all(segment.length > 0 for segment in settled)
