"""Our own films, decoded again: time, colour, size, bytes."""

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np
import pytest

from risorius.core.arrays import Array, ByteArray
from risorius.core.speech.audio import Audio
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.video.mp4 import write_mp4

TakeMaker = Callable[..., WritableTake]
SoundMaker = Callable[..., Audio]
BARS = np.array(
    [
        (255, 255, 255), (191, 191, 0), (0, 191, 191), (0, 191, 0), (191, 0, 191), (191, 0, 0),
        (0, 0, 191), (16, 16, 16), (224, 172, 140), (180, 90, 80), (128, 128, 128), (0, 0, 0),
    ],
    np.uint8,
)  # fmt: skip


@dataclass(frozen=True)
class Film:
    """A decoded film: (time, planes) of each picture, the sound, its start and rate."""

    pictures: list[tuple[Fraction, Array]]
    sound: Array
    sound_start: Fraction
    sound_rate: int
    size: tuple[int, int]
    video: Any


def _decoded(path: Path) -> Film:
    with av.open(str(path)) as file:
        pictures = [(f.pts * f.time_base, f.to_ndarray().astype(float)) for f in file.decode(video=0)]
        video = file.streams.video[0].codec_context
        size = (video.width, video.height)
    with av.open(str(path)) as file:
        frames = list(file.decode(audio=0)) if file.streams.audio else []
    sound = np.concatenate([f.to_ndarray()[0] for f in frames]) if frames else np.zeros(0)
    start = frames[0].pts * frames[0].time_base if frames else Fraction(0)
    rate = frames[0].sample_rate if frames else 1
    return Film(pictures, sound.astype(float), start, rate, size, video)


def _rgb(planes: Array, size: tuple[int, int]) -> Array:
    """Turn yuv420p of limited range into RGB by the matrix of ITU-R BT.709, (height, width, 3)."""
    width, height = size
    y = (planes[:height] - 16.0) / 219.0
    u, v = ((planes[height:].reshape(2, height // 2, width // 2) - 128.0) / 224.0).repeat(2, 1).repeat(2, 2)
    red, blue = y + 1.5748 * v, y + 1.8556 * u
    green = (y - 0.2126 * red - 0.0722 * blue) / 0.7152
    return np.clip(np.stack([red, green, blue], axis=-1) * 255.0, 0.0, 255.0)


def _write(take: WritableTake, path: Path, size: tuple[int, int]) -> Film:
    write_mp4(take, path, WriteOptions(size=size))
    return _decoded(path)


def _flashes(marked: set[int]) -> Callable[..., Iterator[ByteArray]]:
    def pictures(size: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
        for index in indices:
            yield np.full((size[1], size[0], 3), 255 if index in marked else 20, np.uint8)

    return pictures


@pytest.mark.parametrize(
    ("fps", "rate"),
    [
        (Fraction(30), 22_050),
        (Fraction(24000, 1001), 22_050),
        (Fraction(25), 37_800),
        (Fraction(60), 16_000),
        (Fraction(30000, 1001), 96_001),
    ],
)
def test_flash_and_click_agree_within_a_millisecond(
    tmp_path: Path, take_of: TakeMaker, sound_of: SoundMaker, fps: Fraction, rate: int
) -> None:
    marked = {round(t * fps) for t in (0.5, 1.5, 2.5)}
    samples = np.zeros(3 * rate, np.int16)
    for index in marked:
        at = round(index / fps * rate)
        samples[at : at + 200] = 20_000
    take = take_of(3.0, fps, audio=sound_of(samples, rate), pictures=_flashes(marked))
    film = _write(take, tmp_path / "x.mp4", (64, 48))
    flashes = [time for time, planes in film.pictures if planes[:48].mean() > 128]
    loud = np.flatnonzero(np.abs(film.sound) > 0.4 * np.abs(film.sound).max())
    first = loud[np.diff(loud, prepend=-film.sound_rate) > film.sound_rate // 4]
    clicks = [float(film.sound_start) + sample / film.sound_rate for sample in first]
    assert flashes == [index / fps for index in sorted(marked)]
    assert clicks == pytest.approx([float(time) for time in flashes], abs=0.001)


@pytest.mark.parametrize("fps", [Fraction(30), Fraction(24000, 1001), Fraction(1, 2), Fraction(997)])
def test_picture_k_is_shown_at_k_by_fps_exactly(tmp_path: Path, take_of: TakeMaker, fps: Fraction) -> None:
    take = take_of(float(10 / fps), fps)
    film = _write(take, tmp_path / "x.mp4", (32, 32))
    assert [time for time, _ in film.pictures] == [k / fps for k in range(11)]
    assert len(film.sound) == 0


@pytest.mark.parametrize("seconds", [0.2, 1.0, 2.5])
def test_the_whole_sound_is_kept_whatever_the_pictures_last(
    tmp_path: Path, take_of: TakeMaker, sound_of: SoundMaker, seconds: float
) -> None:
    tone = np.round(8000 * np.sin(np.arange(round(22_050 * seconds)) * 0.1)).astype(np.int16)
    film = _write(take_of(1.0, audio=sound_of(tone)), tmp_path / "x.mp4", (32, 32))
    heard = film.sound[: len(tone)]
    assert len(heard) == len(tone)
    assert np.abs(heard * 32_768 - tone).mean() < 200
    assert len(film.pictures) == 31


def test_colours_are_exact_and_tagged_bt709(tmp_path: Path, take_of: TakeMaker) -> None:
    size = (12 * 40, 80)
    bars = BARS.repeat(40, 0)[None].repeat(size[1], 0)

    def pictures(_: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
        yield from (bars for _ in indices)

    film = _write(take_of(0.5, pictures=pictures), tmp_path / "x.mp4", size)
    assert film.video.pix_fmt == "yuv420p"
    tags = (film.video.colorspace, film.video.color_primaries, film.video.color_trc, film.video.color_range)
    assert tags == (1, 1, 1, 1)
    for _, planes in film.pictures:
        error = np.abs(_rgb(planes, size) - bars)
        # Two pixels at an edge share their colour with the neighbour: half-size chroma.
        inside = error.reshape(size[1], 12, 40, 3)[:, :, 4:-4]
        assert error.mean() <= 2.0
        assert inside.mean(axis=(0, 2, 3)).max() <= 2.0


@pytest.mark.parametrize("size", [(33, 21), (1, 1), (32, 21), (33, 20)])
def test_an_odd_size_repeats_the_last_row_and_column(
    tmp_path: Path, take_of: TakeMaker, size: tuple[int, int]
) -> None:
    even = (size[0] + size[0] % 2, size[1] + size[1] % 2)
    film = _write(take_of(0.2), tmp_path / "x.mp4", size)
    assert film.size == even
    for k, (_, planes) in enumerate(film.pictures):
        assert np.abs(_rgb(planes, even) - (10 + k)).max() <= 3.0


def test_the_same_take_gives_the_same_bytes_on_one_processor_and_on_many(
    tmp_path: Path, take_of: TakeMaker, sound_of: SoundMaker
) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (120, 160, 3)).astype(np.uint8)

    def pictures(_: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
        yield from (np.roll(noise, (index, 3 * index), (0, 1)) for index in indices)

    audio = sound_of(np.random.default_rng(1).integers(-9000, 9000, 44_100).astype(np.int16))
    take = take_of(2.0, audio=audio, pictures=pictures)
    films = []
    for name, processors in (("a", nullcontext()), ("b", nullcontext()), ("c", _one_processor())):
        with processors:
            write_mp4(take, tmp_path / name, WriteOptions(size=(160, 120)))
        films.append((tmp_path / name).read_bytes())
    assert films[0] == films[1] == films[2]


@contextmanager
def _one_processor() -> Iterator[None]:
    """Let this process and those that it starts use one processor, where the system can."""
    if sys.platform != "linux":
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)
