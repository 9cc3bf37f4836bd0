"""Recordings put end to end are read to their end, or one error names the joint."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import av
import numpy as np
import pytest
import soundfile

from risorius.errors import InputError
from risorius.speech.recordings import recording
from risorius.speech.recordings.joined_files import is_tag
from risorius.speech.recordings.recording import read_recording

RATE = 24_000
ID3V1 = b"TAG" + b"x" * 125
APE = b"APETAGEX" + bytes([208, 7, 0, 0, 60, 0, 0, 0]) + bytes(16) + bytes(range(1, 61))


def tones(*pitches: int) -> np.ndarray:
    """A second of each tone, with noise."""
    times, noise = np.arange(RATE) / RATE, np.random.default_rng(1).normal(0.0, 0.03, RATE)
    return np.concatenate([0.3 * np.sin(2 * np.pi * pitch * times) + noise for pitch in pitches])


def encoded(folder: Path, name: str, pitch: int) -> Path:
    path = folder / f"{pitch}.{name.rpartition('.')[2]}"
    kind = {"format": "OGG", "subtype": "OPUS"} if name.endswith("opus") else {}
    soundfile.write(path, tones(pitch, pitch), RATE, **kind)
    return path


def remuxed(paths: list[Path], out: Path) -> Path:
    """Join the packets of files, as `ffmpeg -f concat -c copy` does."""
    kind = {"opus": "ogg"}.get(out.suffix[1:], out.suffix[1:])
    with av.open(str(out), "w", format=kind) as joined:
        stream, offset = None, 0
        for path in paths:
            with av.open(str(path)) as part:
                stream = stream or joined.add_stream_from_template(part.streams.audio[0])
                first, end = None, 0
                for packet in part.demux(part.streams.audio[0]):
                    if packet.dts is not None and packet.pts is not None:
                        first = packet.pts if first is None else first
                        packet.pts, packet.dts = packet.pts - first, packet.dts - first
                        end = packet.pts + (packet.duration or 0)
                        packet.pts, packet.dts = packet.pts + offset, packet.dts + offset
                        packet.stream = stream
                        joined.mux(packet)
                offset += end
    return out


def pitch_of(samples: np.ndarray, rate: int) -> float:
    spectrum = np.abs(np.fft.rfft(samples * np.hanning(len(samples))))
    return float(np.argmax(spectrum)) * rate / len(samples)


def check_both(path: Path) -> None:
    audio = read_recording(path)
    assert audio.duration == pytest.approx(4.0, abs=0.15)
    for start, pitch in ((0.5, 300), (2.6, 700)):
        samples = audio.read(round(start * audio.sample_rate), audio.sample_rate)
        assert pitch_of(samples, audio.sample_rate) == pytest.approx(pitch, abs=3)


@pytest.mark.parametrize("name", ["x.mp3", "x.flac", "x.ogg", "x.opus"])
def test_both_parts_are_read(name: str, tmp_path: Path) -> None:
    parts = [encoded(tmp_path, name, pitch) for pitch in (300, 700)]
    (tmp_path / name).write_bytes(b"".join(part.read_bytes() for part in parts))
    check_both(tmp_path / name)
    check_both(remuxed(parts, tmp_path / f"packets-{name}"))


def test_a_tag_between_two_parts_is_passed(tmp_path: Path) -> None:
    one, two = (encoded(tmp_path, "x.mp3", pitch).read_bytes() for pitch in (300, 700))
    (tmp_path / "x.mp3").write_bytes(one + ID3V1 + two)
    check_both(tmp_path / "x.mp3")


def test_a_short_last_part_of_flac_is_found(tmp_path: Path) -> None:
    parts = []
    for number, samples in enumerate((tones(300, 300), tones(700)[: RATE // 5])):
        soundfile.write(tmp_path / f"{number}.flac", samples, RATE)
        parts.append((tmp_path / f"{number}.flac").read_bytes())
    (tmp_path / "x.flac").write_bytes(b"".join(parts))
    assert read_recording(tmp_path / "x.flac").duration == pytest.approx(2.2, abs=0.01)


def test_flac_files_of_two_rates_are_refused(tmp_path: Path) -> None:
    one = encoded(tmp_path, "x.flac", 300).read_bytes()
    soundfile.write(tmp_path / "two.flac", tones(700), 16_000)
    (tmp_path / "x.flac").write_bytes(one + (tmp_path / "two.flac").read_bytes())
    with pytest.raises(
        InputError, match=r"at byte [\d,]+ has 16,000 samples per second, the one before 24,000"
    ):
        read_recording(tmp_path / "x.flac")


@pytest.mark.parametrize("end", [b"", ID3V1, APE, APE + ID3V1, bytes(30_000)])
def test_tags_cost_nothing(end: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are at the end of many files: no decoder is started to look at them."""

    def started(*_: object) -> Iterator[np.ndarray]:
        raise AssertionError("the decoder was started")

    monkeypatch.setattr(recording, "rest_after", started)
    path = encoded(tmp_path, "x.mp3", 300)
    path.write_bytes(path.read_bytes() + end)
    assert read_recording(path).duration == pytest.approx(2.0, abs=0.06)


def test_what_is_no_tag(tmp_path: Path) -> None:
    for rest in (b"ID3\x04", b"\xff\xfb\x90", b"TAG", ID3V1 + b"\xff\xfb", b"fLaC"):
        assert not is_tag(rest)


def test_files_of_two_kinds_are_refused_with_the_time_of_the_joint(tmp_path: Path) -> None:
    kinds = {
        name: encoded(tmp_path, name, 300).read_bytes() for name in ("x.mp3", "x.flac", "x.ogg", "x.wav")
    }
    for one, two in (("x.ogg", "x.flac"), ("x.mp3", "x.ogg"), ("x.flac", "x.mp3"), ("x.wav", "x.wav")):
        path = tmp_path / f"joined-{two}{Path(one).suffix}"
        path.write_bytes(kinds[one] + kinds[two])
        with pytest.raises(
            InputError, match=r"(the sound ends at|cannot be decoded from) 2\.0\d s"
        ) as refused:
            read_recording(path)
        assert "\n" not in str(refused.value)


def test_a_part_at_another_rate_sounds_as_it_did(tmp_path: Path) -> None:
    one = encoded(tmp_path, "x.mp3", 300).read_bytes()
    soundfile.write(tmp_path / "two.mp3", 0.3 * np.sin(2 * np.pi * 700 * np.arange(32_000) / 16_000), 16_000)
    (tmp_path / "x.mp3").write_bytes(one + (tmp_path / "two.mp3").read_bytes())
    check_both(tmp_path / "x.mp3")


def test_a_damaged_recording_is_not_read_past_the_damage(tmp_path: Path) -> None:
    path = encoded(tmp_path, "x.flac", 300)
    data = bytearray(path.read_bytes())
    data[len(data) // 3 : len(data) // 2] = bytes(len(data) // 2 - len(data) // 3)
    path.write_bytes(data)
    with pytest.raises(InputError, match="cannot be decoded from"):
        read_recording(path)


def test_what_only_begins_like_a_recording_is_refused(tmp_path: Path) -> None:
    for beginning in (b"fLaC", b"OggS", b"ID3\x04", b"\xff\xfb\x90\x64"):
        (tmp_path / "x.mp3").write_bytes(beginning + b"no sound " * 50)
        with pytest.raises(InputError, match=r"cannot be read|cannot be decoded|lasts 0\.\d+ s|is silent"):
            read_recording(tmp_path / "x.mp3")
