"""Recordings: what cannot be used is refused with its place, what can is read whatever its form."""

from __future__ import annotations

import os
import warnings
from pathlib import Path

import numpy as np
import pytest
import soundfile

from risorius.errors import InputError, SpeechWarning
from risorius.speech.recordings.recording import read_recording


def tone(seconds: float = 0.5, rate: int = 16_000, level: float = 0.3) -> np.ndarray:
    return level * np.sin(2 * np.pi * 220 * np.arange(round(seconds * rate)) / rate)


@pytest.fixture
def written(tmp_path: Path):
    def write(
        samples: np.ndarray, rate: int = 16_000, name: str = "x.wav", subtype: str | None = None
    ) -> Path:
        soundfile.write(tmp_path / name, samples, rate, subtype=subtype)
        return tmp_path / name

    return write


def refusal(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_recording(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_missing_file_a_folder_and_what_is_no_sound_are_refused(tmp_path: Path) -> None:
    assert "there is no such file" in refusal(tmp_path / "x.wav")
    assert "is a folder" in refusal(tmp_path)
    os.mkfifo(tmp_path / "pipe.mp3")
    assert "is not a regular file" in refusal(tmp_path / "pipe.mp3")
    (tmp_path / "text.wav").write_text("These are no samples. " * 20)
    assert "is not a recording: it is a text; expected risorius speak" in refusal(tmp_path / "text.wav")
    (tmp_path / "text.mp3").write_text("These are no samples. " * 20)
    assert "is not a recording: it is a text; expected risorius speak" in refusal(tmp_path / "text.mp3")
    (tmp_path / "empty.wav").touch()
    assert "expected WAV, FLAC, OGG, MP3, M4A, MP4, MOV or WebM" in refusal(tmp_path / "empty.wav")


def test_a_file_that_is_damaged_within_is_refused_with_the_time(written, tmp_path: Path) -> None:
    noise = np.random.default_rng(0).normal(0.0, 0.1, 20 * 16_000)
    whole = bytearray(written(noise, name="x.flac").read_bytes())
    whole[len(whole) // 2 :] = bytes(len(whole) - len(whole) // 2)
    (tmp_path / "cut.flac").write_bytes(whole)
    assert "cannot be decoded from" in refusal(tmp_path / "cut.flac")


@pytest.mark.parametrize(
    ("samples", "rate", "message"),
    [
        (tone(0.001), 16_000, "lasts 0.001 s; expected at least 0.1 s"),
        (np.zeros(16_000), 16_000, "is silent"),
        (tone(level=5e-4), 16_000, "is silent"),
        (np.full(16_000, np.nan), 16_000, "is silent"),
        (tone(rate=4_000), 4_000, "has 4,000 samples per second; expected 8,000 to 96,000"),
        (tone(rate=192_000), 192_000, "has 192,000 samples per second"),
    ],
)
def test_what_holds_no_speech_is_refused(samples, rate: int, message: str, written) -> None:
    assert message in refusal(written(samples, rate, subtype="FLOAT"))


def test_no_numbers_become_silence_with_a_warning(written) -> None:
    samples = tone(1.0)
    samples[4_000:4_010] = np.nan
    samples[8_000] = np.inf
    with pytest.warns(SpeechWarning, match=r"x.wav: 11 samples are not numbers, the first at 0.250 s"):
        audio = read_recording(written(samples, subtype="FLOAT"))
    assert not audio.read(4_000, 10).any()
    assert audio.frames == 16_000


def test_clipping_is_told(written) -> None:
    with pytest.warns(SpeechWarning, match=r"the sound is clipped \(\d+ %, first at 0.00\d s\)"):
        read_recording(written(np.clip(tone(1.0, level=2.0), -1.0, 1.0)))


def test_loud_but_sound_is_not_called_clipped(written) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_recording(written(tone(1.0, level=0.99)))


@pytest.mark.parametrize("name", ["x.wav", "x.flac", "x.ogg", "x.mp3"])
@pytest.mark.parametrize("rate", [8_000, 16_000, 44_100, 48_000])
def test_all_forms_give_the_same_sound(name: str, rate: int, written) -> None:
    stereo = np.stack([tone(0.5, rate), np.zeros(rate // 2)], axis=1)
    audio = read_recording(written(stereo, rate, name))
    assert audio.sample_rate == rate
    assert audio.duration == pytest.approx(0.5, abs=0.06)
    middle = audio.read(audio.frames // 4, audio.frames // 2) / 32_767
    assert np.abs(middle).max() == pytest.approx(0.15, rel=0.06)


def test_ninety_six_thousand_samples_per_second(written) -> None:
    assert read_recording(written(tone(0.5, 96_000), 96_000)).frames == 48_000


@pytest.mark.parametrize("name", ["x.wav", "x.flac"])
@pytest.mark.parametrize("inverted", [-1.0, -0.8])
def test_channels_that_cancel_each_other_out_are_heard(name: str, inverted: float, written) -> None:
    quiet = np.zeros(32_000)
    samples = np.concatenate([quiet, tone(3.0)])
    audio = read_recording(written(np.stack([samples, inverted * samples], axis=1), name=name))
    assert np.abs(audio.read()).max() == pytest.approx(0.3 * 32_767, rel=0.01)


@pytest.mark.parametrize("gains", [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, -0.3), (0.0, 0.0, 1.0)])
def test_other_channels_are_averaged(gains: tuple[float, ...], written) -> None:
    samples = tone(2.0)
    audio = read_recording(written(np.stack([gain * samples for gain in gains], axis=1)))
    mean = 0.3 * 32_767 * abs(sum(gains)) / len(gains)
    assert np.abs(audio.read()).max() == pytest.approx(mean, rel=0.01)


def test_two_voices_one_a_channel_are_both_heard(written) -> None:
    one, two = np.random.default_rng(1).normal(0.0, 0.1, (2, 48_000))
    audio = read_recording(written(np.stack([one, two], axis=1)))
    assert np.corrcoef(audio.read(), one + two)[0, 1] > 0.99


@pytest.mark.parametrize("subtype", ["PCM_16", "PCM_24", "FLOAT", "PCM_U8"])
@pytest.mark.parametrize("size", [0, 0xFFFF_FFFF, 0x7FFF_FFFF, 2_000_000_000])
def test_a_wav_of_unknown_length_goes_to_its_end(size: int, subtype: str, written) -> None:
    path = written(np.stack([tone(1.0)] * 2, axis=1), subtype=subtype)
    whole = read_recording(path).read()
    data = bytearray(path.read_bytes())
    at = data.index(b"data") + 4
    data[at : at + 4] = data[4:8] = size.to_bytes(4, "little")
    path.write_bytes(data)
    found = read_recording(path).read()
    assert len(found) >= len(whole)
    assert (found[: len(whole)] == whole).all()


def test_a_wav_without_samples_stays_empty(written) -> None:
    assert "lasts 0.000 s" in refusal(written(np.zeros(0)))
