"""Whether transcripts are told from those of other recordings, with silence and noise around what is said.

FOLDER is laid out as TIMIT (`timit.py`). Each recording is brought to one level and aligned with its own
transcript and with that of another speaker's sentence, of about the same length, after 0, 6 and 30 s of
silence in which there is noise of one of four levels. Prints, for each length of silence,
- how many right transcripts are refused (asked: at most 1 %), and how many wrong ones are accepted without a
  warning (at most 3 %);
- how many of the said words are called "perhaps not said" (at most 1 %);
- how many words begin within 50 ms of where they begin without silence.
Run from the repository (two minutes for 80 recordings):
    PYTHONPATH=src python benchmarks/recordings_with_silence.py FOLDER [--sentences 80]
"""

from __future__ import annotations

import argparse
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np
from timit import Sentence, sentences

from risorius.core.arrays import Array
from risorius.core.speech.audio import Audio, AudioWriter
from risorius.errors import InputError
from risorius.speech.alignment import align
from risorius.speech.alignment.confidence import AlignmentConfidence, receive_confidence
from risorius.speech.recordings.recording import read_recording

SILENCES = (0.0, 6.0, 30.0)
# Levels of the noise in dB of full scale, in turn; None for digital silence.
NOISES = (None, -60.0, -50.0, -40.0)
LEVEL = 3_500.0
NEAR = 0.05


class Result(NamedTuple):
    """The result of one alignment: starts of words (None if it is refused), doubtful words, and warnings."""

    starts: list[float] | None
    doubtful: int
    warned: bool


def with_silence(samples: Array, rate: int, seconds: float, noise: float | None, seed: int) -> Audio:
    """Return a sound at LEVEL after silence, with noise in all of it."""
    silence = np.zeros(round(seconds * rate))
    whole = np.concatenate([silence, samples * LEVEL / np.sqrt(np.mean(samples**2))])
    if noise is not None:
        whole += np.random.default_rng(seed).normal(0.0, 32_767 * 10 ** (noise / 20), len(whole))
    with AudioWriter(rate) as writer:
        writer.append(np.clip(np.round(whole), -32_768, 32_767).astype(np.int16))
        return writer.finish()


def aligned(audio: Audio, text: str) -> Result:
    """Align a recording with a text."""
    doubts: list[AlignmentConfidence] = []
    with warnings.catch_warnings(record=True) as caught, receive_confidence(doubts.append):
        warnings.simplefilter("always")
        try:
            utterance = align(audio, text)
        except InputError:
            return Result(None, 0, True)
    return Result([word.start for word in utterance.words], len(doubts[0].words), bool(caught))


def other_text(spoken: list[Sentence], index: int) -> str:
    """Return the sentence of another speaker whose length is nearest."""
    own = spoken[index]
    others = [s for s in spoken if s.speaker != own.speaker and s.text != own.text]
    return min(others, key=lambda other: abs(len(other.text) - len(own.text))).text


def main(folder: Path, most: int) -> None:
    """Print the figures."""
    spoken = list(sentences(folder))[:most]
    plain: dict[int, list[float] | None] = {}
    for seconds in SILENCES:
        right, wrong, near = [], [], []
        for index, sentence in enumerate(spoken):
            recorded = read_recording(sentence.sound)
            samples = recorded.read().astype(np.float64)
            noise = NOISES[index % len(NOISES)] if seconds else None
            audio = with_silence(samples, recorded.sample_rate, seconds, noise, index)
            result = aligned(audio, sentence.text)
            right.append(result)
            wrong.append(aligned(audio, other_text(spoken, index)))
            before = plain.setdefault(index, result.starts)
            if before is not None and result.starts is not None:
                near += [abs(b - a - seconds) <= NEAR for a, b in zip(before, result.starts, strict=True)]
        words = sum(len(result.starts) for result in right if result.starts is not None)
        print(
            f"{seconds:4.0f} s: right refused {sum(r.starts is None for r in right)} of {len(right)}, "
            f"wrong accepted {sum(w.starts is not None for w in wrong)} of {len(wrong)}, "
            f"without a warning {sum(not w.warned for w in wrong)}; "
            f"said words in doubt {sum(r.doubtful for r in right)} of {words}; "
            f"starts within 50 ms {100 * np.mean(near):.1f} %",
            flush=True,
        )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sentences", type=int, default=80)
    chosen = parser.parse_args()
    main(chosen.folder, chosen.sentences)
