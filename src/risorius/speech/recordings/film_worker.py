"""The decoder of films' sound, in a process of its own: `python -m … film_worker FILE CONTAINER`.

It answers on standard output: a line of JSON with the sound's `rate`, then lines with a number of `bytes` and
so many bytes, 32-bit float samples of which the channels are averaged, and at the end a line `{}`; or a line
with an `error`, at any point. A separate process because the decoder's library brings GPL code and may crash.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path
from typing import IO

import av
import numpy as np


class NoSoundError(Exception):
    """The file has no sound."""


class UnknownSoundError(Exception):
    """The file's sound is of a kind that the library does not know."""


def decode(file: IO[bytes], container: str, out: IO[bytes]) -> None:
    """Write the first sound of a file of a container (`mov`, `matroska` …) as messages.

    The container is told by the file's first bytes and is not left to the library, some of whose formats open
    other files and addresses.
    """
    with av.open(file, "r", format=container, metadata_errors="ignore") as film:
        if not film.streams.audio:
            raise NoSoundError("has no sound")
        stream = film.streams.audio[0]
        if stream.codec_context is None:
            raise UnknownSoundError("its sound is of an unknown kind")
        _say(out, {"rate": stream.rate})
        resampler = av.AudioResampler(format="fltp", rate=stream.rate)
        for frame in film.decode(stream):
            for plain in resampler.resample(frame):
                samples = plain.to_ndarray().mean(axis=0, dtype=np.float32)
                _say(out, {"bytes": samples.nbytes})
                out.write(samples.astype("<f4", copy=False).tobytes())
    _say(out, {})


def _say(out: IO[bytes], message: dict[str, object]) -> None:
    out.write(json.dumps(message).encode() + b"\n")


def main() -> int:
    """Decode the file that the first argument names, of the container that the second one names."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the program decides what becomes of this process
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    try:
        with Path(sys.argv[1]).open("rb") as file:
            decode(file, sys.argv[2], answer)
    except BrokenPipeError:
        return 1  # the program is gone, or has heard enough
    except Exception as error:
        text = getattr(error, "strerror", None) or str(error) or type(error).__name__
        _say(answer, {"error": text, "silent": isinstance(error, NoSoundError)})
    answer.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
