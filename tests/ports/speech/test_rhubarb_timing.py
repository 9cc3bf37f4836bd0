from itertools import accumulate, pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.ports.speech.rhubarb_timing import paused, tweened
from risorius.ports.speech.visemes import Cue


def cues_of(text: str) -> list[Cue]:
    """Cues of shapes with their hundredths of a second: "D30 A12"."""
    parts = [(word[0], int(word[1:])) for word in text.split()]
    ends = list(accumulate(length for _, length in parts))
    return [Cue((e - n) / 100, e / 100, s) for (s, n), e in zip(parts, ends, strict=True)]


def told(cues: list[Cue]) -> str:
    return " ".join(f"{cue.shape}{100 * (cue.end - cue.start):g}" for cue in cues)


@pytest.mark.parametrize(
    ("given_", "expected"),
    [
        ("D30 X11 A10", "D41 A10"),
        ("D30 X12 A10", "D30 C12 A10"),
        ("D30 X35 C10", "D30 B35 C10"),  # relaxed twice: C comes next
        ("C30 X30 B10", "C30 X30 B10"),  # all that it relaxes to comes next
        ("D30 X36 A10", "D30 X36 A10"),
        ("X10 D30 X10", "X10 D30 X10"),  # no pauses: nothing before, nothing after
    ],
)
def test_pauses(given_: str, expected: str) -> None:
    assert told(paused(cues_of(given_))) == expected


@pytest.mark.parametrize(
    ("given_", "expected"),
    [
        ("D24 A10", "D16 C8 A10"),
        ("D15 A10", "D10 C5 A10"),
        ("D11 A10", "D11 A10"),  # less than 0.04 s would be left for it
        ("D24 X15", "D24 C5 X10"),
        ("C20 F16", "C18 E4 F14"),
        ("C20 F12", "C20 F12"),
        ("A24 D24", "A24 D24"),  # it opens at once
        ("F32 C32 F32", "F28 E8 C24 E8 F28"),
    ],
)
def test_shapes_in_between(given_: str, expected: str) -> None:
    found = [(cue.shape, round(100 * (cue.end - cue.start), 6)) for cue in tweened(cues_of(given_))]
    assert found == [(cue.shape, round(100 * (cue.end - cue.start), 6)) for cue in cues_of(expected)]


@given(st.lists(st.tuples(st.sampled_from("ABCDEFGHX"), st.integers(1, 60)), min_size=1, max_size=20))
def test_nothing_is_left_open_and_nothing_overlaps(parts: list[tuple[str, int]]) -> None:
    before = cues_of(" ".join(f"{shape}{length}" for shape, length in parts))
    after = tweened(paused(before))
    assert (after[0].start, after[-1].end) == (before[0].start, before[-1].end)
    assert all(one.end == other.start for one, other in pairwise(after))
    assert all(cue.end > cue.start for cue in after)
