"""Sound as bytes: the encodings of speech services, cut anywhere."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError
from risorius.live.pcm import ENCODINGS, PcmDecoder, check_rate, sample_bytes, samples_of


def test_an_unknown_encoding_is_refused_with_the_nearest() -> None:
    with pytest.raises(InputError, match="'pcm_mulaw'"):
        PcmDecoder("pcm_mulow")


@pytest.mark.parametrize(
    "given", [[1.5], [float("nan")], np.zeros((2, 2)), ["a"], [1, 2], [[1.0], [1.0, 2.0]]]
)
def test_what_is_no_sound_is_refused(given: object) -> None:
    with pytest.raises(InputError):
        samples_of(given)  # type: ignore[arg-type]


@pytest.mark.parametrize("rate", [0, 7_999, 96_001, True, 16_000.0])
def test_a_rate_out_of_range_is_refused(rate: int) -> None:
    with pytest.raises(InputError, match="8,000 to 96,000"):
        check_rate(rate, 8_000, 96_000)


# The ends and the middle of G.711's tables, as samples of 16 bits.
@pytest.mark.parametrize(
    ("encoding", "code", "sample"),
    [
        ("pcm_mulaw", 0x00, -32_124),
        ("pcm_mulaw", 0x80, 32_124),
        ("pcm_mulaw", 0x7F, 0),
        ("pcm_mulaw", 0xFF, 0),
        ("pcm_mulaw", 0xFE, 8),
        ("pcm_alaw", 0x55, -8),
        ("pcm_alaw", 0xD5, 8),
        ("pcm_alaw", 0x2A, -32_256),
        ("pcm_alaw", 0xAA, 32_256),
    ],
)
def test_g711(encoding: str, code: int, sample: int) -> None:
    assert PcmDecoder(encoding).decode(bytes([code])).tolist() == [sample]


@pytest.mark.parametrize("encoding", ["pcm_mulaw", "pcm_alaw"])
def test_g711_has_finer_steps_for_quieter_sound(encoding: str) -> None:
    table = np.unique(np.abs(PcmDecoder(encoding).decode(bytes(range(256))).astype(int)))
    assert len(table) == 128
    steps = np.diff(table)
    assert (np.diff(steps) >= 0).all()
    assert steps[-1] >= 64 * steps[0]


def test_floats_that_are_no_numbers_are_silent_and_loud_ones_are_clipped() -> None:
    data = np.array([np.nan, np.inf, -2.0, 0.5], "<f4").tobytes()
    assert PcmDecoder("pcm_f32le").decode(data).tolist() == [0, 32_767, -32_767, 16_384]


@given(st.sampled_from(ENCODINGS), st.binary(max_size=64), st.lists(st.integers(0, 64), max_size=6))
def test_cuts_change_nothing(encoding: str, data: bytes, cuts: list[int]) -> None:
    edges = [0, *sorted(cuts), len(data)]
    decoder = PcmDecoder(encoding)
    pieces = [decoder.decode(data[a:b]) for a, b in pairwise(edges)]
    whole = PcmDecoder(encoding).decode(data)
    np.testing.assert_array_equal(np.concatenate(pieces), whole)
    assert len(whole) == len(data) // sample_bytes(encoding)
