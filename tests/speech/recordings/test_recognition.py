"""Recorded speech alone: words where they can be recognized, nothing invented in silence."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from risorius.core.speech.audio import AudioWriter
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError
from risorius.speech.recordings.recognition import LATEST, recognize, stretches
from risorius.speech.resampled import Resampled

RATE = 16_000


def audio_of(samples: np.ndarray):
    with AudioWriter(RATE) as writer:
        writer.append(samples.astype(np.int16))
        return writer.finish()


def test_silence_says_nothing() -> None:
    with pytest.raises(InputError, match="no speech was recognized"):
        recognize(audio_of(np.zeros(RATE)))


def test_a_line_is_recognized_well_enough_to_correct(spoken_line: Utterance) -> None:
    found = recognize(spoken_line.audio)
    assert 0.5 < len(found.words) / len(spoken_line.words) < 2.0
    assert found.text == " ".join(w.text for w in found.words)
    assert found.words[0].start == pytest.approx(spoken_line.words[0].start, abs=0.15)
    assert found.words[-1].end == pytest.approx(spoken_line.words[-1].end, abs=0.15)
    labials = [p for p in found.phones if p.symbol in ("P", "B", "M")]
    assert len(labials) >= 3


def test_stretches_cover_the_recording_and_end_in_pauses() -> None:
    burst = np.random.default_rng(0).normal(0.0, 3_000.0, 8 * RATE)
    sound = np.concatenate([burst, np.zeros(RATE // 2), burst, np.zeros(RATE // 2), burst, burst, burst])
    found = list(stretches(Resampled(audio_of(sound))))
    assert found[0][0] == 0.0
    assert found[-1][1] == pytest.approx(len(sound) / RATE)
    assert all(a[1] == b[0] for a, b in pairwise(found))
    assert all(end - start <= LATEST + 0.01 for start, end in found)
    assert found[0][1] in (pytest.approx(8.25, abs=0.2), pytest.approx(16.75, abs=0.2))
