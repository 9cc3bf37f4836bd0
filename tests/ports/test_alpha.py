"""Films with an alpha channel, decoded again."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import av
import numpy as np
import pytest

from risorius.core.arrays import ByteArray
from risorius.core.speech.utterance import Utterance
from risorius.errors import OutputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.output_files import check_targets, write_targets

TakeMaker = Callable[..., WritableTake]
COLOUR = (180, 90, 60)


def _halves(size: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
    """Yield pictures that are opaque on the left and empty on the right."""
    for _ in indices:
        picture = np.zeros((size[1], size[0], 4), np.uint8)
        picture[..., :3] = COLOUR
        picture[:, : size[0] // 2, 3] = 255
        yield picture


@pytest.fixture
def take(take_of: TakeMaker, utterance_of: Callable[..., Utterance]) -> WritableTake:
    utterance = utterance_of("M AA M", lead=0.1, tail=0.1)
    return take_of(audio=utterance.audio, utterance=utterance, pictures=_halves, duration=0.2)


def _write(take: WritableTake, path: Path) -> None:
    write_targets(take, check_targets([path]), WriteOptions(size=(96, 64), alpha=True))


def test_a_format_without_alpha_is_refused_before_anything_is_drawn(
    take: WritableTake, tmp_path: Path
) -> None:
    with pytest.raises(
        OutputError, match=r"\.mp4 cannot have a transparent background; expected one of \.webm"
    ):
        _write(take, tmp_path / "x.mp4")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("suffix", "decoder"), [(".webm", "libvpx-vp9"), (".mov", None)])
def test_alpha_and_colour_survive(
    take: WritableTake, tmp_path: Path, suffix: str, decoder: str | None
) -> None:
    path = tmp_path / f"x{suffix}"
    _write(take, path)
    with av.open(str(path)) as file:
        stream = file.streams.video[0]
        # FFmpeg's own VP9 decoder leaves the alpha out.
        context = av.CodecContext.create(decoder, "r") if decoder else stream.codec_context
        frames = [frame for packet in file.demux(stream) for frame in context.decode(packet)]
        assert (stream.codec_context.colorspace, stream.codec_context.color_primaries) == (1, 1)
        assert file.streams.audio
    picture = frames[0].to_ndarray(format="rgba", src_colorspace=1)
    assert picture.shape == (64, 96, 4)
    assert picture[10:50, 5:40, 3].min() >= 253
    assert picture[10:50, 56:90, 3].max() <= 2
    assert np.abs(picture[10:50, 5:40, :3].astype(int) - COLOUR).mean() < 3
