from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from risorius.core.speech.audio import Audio
from risorius.errors import OutputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.speech.wav import write_wav


def test_silence_of_a_score_is_no_voice(tmp_path: Path, take_of: Callable[..., WritableTake]) -> None:
    with pytest.raises(OutputError, match="no voice"):
        write_wav(take_of(), tmp_path / "x.wav", WriteOptions())


def test_samples_are_read_back_exactly(
    tmp_path: Path, take_of: Callable[..., WritableTake], sound_of: Callable[..., Audio]
) -> None:
    samples = np.random.default_rng(0).integers(-32768, 32768, 150_001).astype(np.int16)
    write_wav(take_of(audio=sound_of(samples, 16_000)), tmp_path / "x.wav", WriteOptions())
    copy = Audio(tmp_path / "x.wav", 16_000, len(samples))
    np.testing.assert_array_equal(copy.read(), samples)
    assert (tmp_path / "x.wav").stat().st_size == 44 + 2 * len(samples)
