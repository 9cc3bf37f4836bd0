"""Subtitles as the transcript of a recording: their times are hints."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.core.speech.audio import AudioWriter
from risorius.errors import InputError
from risorius.speech.synthesis import synthesize_line

LINES = ["The old man walked his dog.", "It rained all day.", "Nobody came."]
PAUSE = 3.0


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[float]]:
    """Return a recording of the lines with long pauses, and when each of their words starts."""
    path, starts = tmp_path_factory.mktemp("cued") / "x.wav", []
    spoken = [synthesize_line(line) for line in LINES]
    rate = spoken[0].audio.sample_rate
    with AudioWriter(rate) as writer:
        for line in spoken:
            writer.append(np.zeros(round(PAUSE * rate), np.int16))
            starts += [writer.frames / rate + word.start for word in line.words]
            writer.append(line.audio.read())
        audio = writer.finish()
    path.write_bytes(Path(audio.path).read_bytes())
    return path, starts


def subtitles(starts: list[float], shift: float = 0.0) -> str:
    firsts = [starts[0], starts[6], starts[10]]
    stamps = [f"00:00:{start + shift:06.3f} --> 00:00:{start + shift + 1.5:06.3f}" for start in firsts]
    return "WEBVTT\n\n" + "\n\n".join(f"{s}\n[sighs] {line}" for s, line in zip(stamps, LINES, strict=True))


@pytest.mark.parametrize("shift", [0.0, 0.4])
def test_words_are_found_around_their_cues(
    recording: tuple[Path, list[float]], tmp_path: Path, shift: float
) -> None:
    path, starts = recording
    (tmp_path / "x.vtt").write_text(subtitles(starts, shift))
    utterance = risorius.align(path, tmp_path / "x.vtt").utterance
    assert utterance is not None
    assert [word.text for word in utterance.words] == " ".join(LINES).replace(".", "").split()
    errors = [abs(word.start - start) for word, start in zip(utterance.words, starts, strict=True)]
    assert np.median(errors) < 0.05
    assert max(errors) < 0.2
    take = risorius.speak(tmp_path / "x.vtt", audio=path)
    assert take.utterance is not None
    assert [w.start for w in take.utterance.words] == [w.start for w in utterance.words]


def test_a_cue_after_the_recording_is_an_error(recording: tuple[Path, list[float]], tmp_path: Path) -> None:
    path, starts = recording
    (tmp_path / "x.srt").write_text(subtitles(starts, 20.0).removeprefix("WEBVTT\n\n"))
    with pytest.raises(InputError, match=r"x\.srt:\d+: a cue at [\d.]+ s, but the recording lasts"):
        risorius.align(path, tmp_path / "x.srt")
