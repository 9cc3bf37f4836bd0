"""Films: pictures with sound, whatever the codec.

Picture k is shown at k/fps exactly, and sample n is heard at n/rate. A picture with an odd side gets its last
row or column twice, because most formats have even sides only. Colours are BT.709 and tagged so.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ...core.arrays import Int16Array
from ...core.speech.audio import Audio
from ...errors import warn
from ..export_source import WritableTake, WriteOptions
from .encoder import LostEncoderError, VideoEncoder


def write_film(take: WritableTake, path: Path, options: WriteOptions, codec: str) -> None:
    """Write all frames at `options.size`, with the take's sound if it has one.

    `codec` is a name of `codecs.CODECS`. An encoder that dies or gives no answer is replaced once, and the
    film begun again. Raises OutputError if the encoder fails, OSError for a fault of the disk.
    """
    lost = ""
    try:
        _encode(take, path, options, codec)
    except LostEncoderError as error:
        lost = str(error)
    if lost:  # not in the handler, which would keep the first run's pictures and threads
        warn(f"{lost}; the film is begun again")
        _encode(take, path, options, codec)


def _encode(take: WritableTake, path: Path, options: WriteOptions, codec: str) -> None:
    performance, audio = take.performance, take.audio
    frames = range(len(performance.values))
    rate = None if audio is None else audio.sample_rate
    channels = 4 if options.alpha else 3
    with VideoEncoder(
        path,
        options.size,
        performance.fps,
        rate,
        codec=codec,
        channels=channels,
        draft=options.draft,
    ) as encoder:
        sound = _Sound(audio)
        for index, picture in zip(frames, take.pictures(options.size, frames, options.progress), strict=True):
            encoder.picture(picture)
            # Sound goes along with the pictures: the file interleaves them, and nothing piles up.
            for block in sound.until(float((index + 1) / performance.fps)):
                encoder.sound(block)
        for block in sound.until(float("inf")):
            encoder.sound(block)


class _Sound:
    """Hands out a sound in blocks of about a second, no earlier than they are needed."""

    def __init__(self, audio: Audio | None) -> None:
        self._rate = 1 if audio is None else audio.sample_rate
        self._blocks = iter(()) if audio is None else audio.blocks(audio.sample_rate)
        self._given = 0

    def until(self, seconds: float) -> Iterator[Int16Array]:
        """Yield blocks until at least `seconds` of the sound are given, or its end is reached."""
        while self._given < seconds * self._rate:
            block = next(self._blocks, None)
            if block is None:
                return
            self._given += len(block)
            yield block
