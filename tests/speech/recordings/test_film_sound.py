"""Films and what telephones record: their sound is read by a worker, and what is wrong has its place."""

from __future__ import annotations

import os
import signal
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from risorius.errors import InputError, Place
from risorius.machine.workers import Worker
from risorius.speech.recordings import film_sound
from risorius.speech.recordings.film_sound import FilmSound, container_of
from risorius.speech.recordings.recording import read_recording

SECONDS = 0.5


def film(
    path: Path,
    codec: str,
    rate: int = 48_000,
    *,
    pictures: bool = False,
    sound: bool = True,
    seconds: float = SECONDS,
    right: int = 0,
    sound_from: float = 0.0,
    picture_from: float = 0.0,
) -> Path:
    """Write a film with a tone of 220 Hz on the left channel, and `right` times it on the other."""
    with av.open(str(path), "w") as container:
        video = container.add_stream("mpeg4", rate=10) if pictures else None
        stream = container.add_stream(codec, rate=rate, layout="stereo") if sound else None
        if video is not None:
            video.width = video.height = 16
            for number in range(5):
                frame = av.VideoFrame.from_ndarray(np.zeros((16, 16, 3), np.uint8), format="rgb24")
                frame.pts, frame.time_base = number + round(10 * picture_from), Fraction(1, 10)
                container.mux(video.encode(frame))
            container.mux(video.encode(None))
        if stream is not None:
            times = np.arange(round(seconds * rate)) / rate
            left = (9_000 * np.sin(2 * np.pi * 220 * times)).astype(np.int16)
            frame = av.AudioFrame.from_ndarray(
                np.stack([left, right * left], 1).reshape(1, -1), format="s16", layout="stereo"
            )
            frame.sample_rate, frame.time_base = rate, Fraction(1, rate)
            frame.pts = round(sound_from * rate)
            container.mux(stream.encode(frame))
            container.mux(stream.encode(None))
    return path


FILMS = {
    "x.m4a": ("aac", False),
    "x.mp4": ("aac", True),
    "x.webm": ("libopus", False),
    "x.mov": ("pcm_s16le", True),
    "x.mkv": ("flac", True),
    "x.aac": ("aac", False),
    "x.opus": ("libopus", False),
}
DAILY = ("x.mp4", "x.webm")


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.full] * (n not in DAILY)) for n in FILMS]
)
def test_the_sound_of_a_film_is_that_of_its_channels_on_average(name: str, tmp_path: Path) -> None:
    codec, pictures = FILMS[name]
    audio = read_recording(film(tmp_path / name, codec, pictures=pictures))
    assert audio.sample_rate == 48_000
    assert audio.duration == pytest.approx(SECONDS, abs=0.06)
    middle = audio.read(audio.frames // 4, audio.frames // 2)
    assert np.abs(middle.astype(float)).max() == pytest.approx(4_500, rel=0.06)


def test_channels_of_a_film_that_cancel_each_other_out_are_heard(tmp_path: Path) -> None:
    audio = read_recording(film(tmp_path / "x.mov", "pcm_s16le", seconds=2.5, right=-1))
    assert audio.duration == pytest.approx(2.5, abs=0.001)
    assert np.abs(audio.read().astype(float)).max() == pytest.approx(9_000, rel=0.01)


def onset(path: Path) -> float:
    """Return when the tone begins in a recording, in seconds."""
    audio = read_recording(path)
    return float(np.argmax(np.abs(audio.read().astype(float)) > 2_000)) / audio.sample_rate


@pytest.mark.parametrize(
    ("name", "codec"),
    [("x.mp4", "aac"), ("x.mov", "pcm_s16le"), ("x.mov", "aac"), ("x.mkv", "flac"), ("x.webm", "libopus")],
)
def test_sound_that_begins_after_the_picture_keeps_the_time_of_the_film(
    name: str, codec: str, tmp_path: Path
) -> None:
    pictures = name != "x.webm"
    late = film(tmp_path / name, codec, pictures=pictures, sound_from=0.8)
    assert onset(late) == pytest.approx(0.8 if pictures else 0.0, abs=0.025)
    assert read_recording(late).duration == pytest.approx(SECONDS + (0.8 if pictures else 0.0), abs=0.06)


def test_times_of_a_film_are_counted_from_its_picture(tmp_path: Path) -> None:
    shifted = film(tmp_path / "x.mkv", "flac", pictures=True, sound_from=10.3, picture_from=10.0)
    assert onset(shifted) == pytest.approx(0.3, abs=0.025)
    early = film(tmp_path / "y.mkv", "flac", pictures=True, picture_from=0.5)
    assert onset(early) == pytest.approx(0.0, abs=0.025)


def test_hours_of_nothing_before_the_sound_are_refused(tmp_path: Path) -> None:
    path = film(tmp_path / "x.mkv", "flac", rate=8_000, pictures=True, sound_from=7 * 3600.0)
    assert "is longer than 6 hours" in refusal(path)


def test_a_film_is_known_by_its_first_bytes() -> None:
    assert container_of(b"\0\0\0\x20ftypM4A \0\0\0\0") == "mov"
    assert container_of(b"\x1a\x45\xdf\xa3" + bytes(12)) == "matroska"
    assert container_of(b"\xff\xf1\x50\x80") == "aac"
    for other in (b"RIFF\0\0\0\0WAVEfmt ", b"ID3\x03", b"\xff\xfb\x90\x64", b"#EXTM3U\n#EXT-X-", b""):
        assert container_of(other) is None


def refusal(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_recording(path)
    assert str(caught.value).startswith(f"{path}: ")
    return str(caught.value)


def test_a_silent_film_and_one_that_is_cut_are_refused(tmp_path: Path) -> None:
    silent = film(tmp_path / "x.mp4", "aac", pictures=True, sound=False)
    assert "has no sound; expected a recording, or a film with a voice" in refusal(silent)
    whole = film(tmp_path / "y.mov", "pcm_s16le").read_bytes()
    (tmp_path / "y.mov").write_bytes(whole[:200])
    assert "cannot be read" in refusal(tmp_path / "y.mov")


def test_a_list_of_addresses_is_never_followed(tmp_path: Path) -> None:
    film(tmp_path / "x.m4a", "aac")
    (tmp_path / "x.mp4").write_text(f"#EXTM3U\n#EXTINF:1,\n{tmp_path}/x.m4a\n#EXT-X-ENDLIST\n")
    assert "is not a recording: it is a text" in refusal(tmp_path / "x.mp4")


def test_a_decoder_that_says_nothing_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = film(tmp_path / "x.m4a", "aac")
    monkeypatch.setattr(film_sound, "PATIENCE", 0.0)
    with pytest.raises(InputError, match=r"the decoder gave no answer within 0 s"):
        FilmSound(path, "mov", Place(str(path)))


def test_a_decoder_that_dies_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, decoder = film(tmp_path / "x.m4a", "aac", seconds=10.0), Worker()  # more than a socket holds
    monkeypatch.setattr(film_sound, "Worker", lambda: decoder)
    with FilmSound(path, "mov", Place(str(path))) as sound:
        os.kill(decoder.pid, signal.SIGKILL)
        with pytest.raises(InputError, match=r"x\.m4a: cannot be .*the decoder ended .*\(signal 9\)"):
            list(sound.blocks())
