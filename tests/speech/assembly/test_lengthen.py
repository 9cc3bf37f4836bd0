"""Pauses longer and shorter: the sounds between them stay as they are."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.speech.assembly.lengthen import SHORTEST, scale_pauses
from risorius.speech.engines.protocol import Rendition, SpokenPhone

RATE = 1000


def rendition(closure: int = 0) -> Rendition:
    """Return a sound "AA", 0.5 s of pause in two parts, "T" and 0.3 s of pause; sounds are 1, pauses 0."""
    samples = np.concatenate([np.full(200, 1), np.zeros(500), np.full(100, 1), np.zeros(300)]).astype(
        np.int16
    )
    starts = [("AA", 0), ("", 200), ("", 400), ("T", 700), ("", 800)]
    phones = [SpokenPhone(s, at, -1, closure if s == "T" else 0, 0) for s, at in starts]
    return Rendition(samples, RATE, tuple(phones))


def test_a_factor_of_one_is_nothing() -> None:
    plain = rendition()
    assert scale_pauses(plain, 1.0) is plain


@pytest.mark.parametrize(
    ("factor", "starts", "length"), [(2.0, [0, 200, 1200, 1300], 1900), (0.5, [0, 200, 450, 550], 700)]
)
def test_pauses_are_scaled(factor: float, starts: list[int], length: int) -> None:
    scaled = scale_pauses(rendition(), factor)
    assert [phone.start for phone in scaled.phones] == starts
    assert [phone.symbol for phone in scaled.phones] == ["AA", "", "T", ""]
    assert len(scaled.samples) == length


def test_a_closure_is_no_pause() -> None:
    scaled = scale_pauses(rendition(closure=100), 2.0)
    assert scaled.phones[2].start - scaled.phones[1].start == 2 * 400 + 100


@given(st.floats(0.1, 4.0))
def test_no_sound_is_lost_and_some_pause_is_left(factor: float) -> None:
    scaled = scale_pauses(rendition(), factor)
    assert int(scaled.samples.sum()) == int(rendition().samples.sum())
    first, second = scaled.phones[1], scaled.phones[2]
    assert second.start - first.start >= SHORTEST * RATE
