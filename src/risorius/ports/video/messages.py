"""Messages between the program and the video worker: a kind, a length, the bytes.

The program sends one SETUP, then PICTURE and SOUND as they come, then END. A picture's bytes stand in memory
that both share (`slots`), and its message is the number of its slot. The worker answers TAKEN when it has
copied a picture, whose slot may then be filled again, in the order of the pictures. When it has finished or
failed, it answers with a JSON object: `{}`, or `{"error": text, "errno": number or null}`.
"""

from __future__ import annotations

import io
import json
import struct
from dataclasses import asdict, dataclass

SETUP = b"S"
PICTURE = b"P"
SOUND = b"A"
END = b"E"
TAKEN = b"."
SLOTS = 4
"""Pictures waiting for the encoder; more only cost memory."""

Buffer = bytes | bytearray | memoryview
_HEADER = struct.Struct("<cI")


@dataclass(frozen=True, slots=True)
class Setup:
    """What the worker needs to begin.

    `fps` as "24000/1001"; `sample_rate` None for a silent film; `codec` is a name of `codecs.CODECS`;
    `pixels` says how the numbers of a picture come: rgb24, rgba or yuv420p; `memory` is the path of the
    slots; `draft` is true for a film that should rather be made soon than be small. Width and height are
    even, as most formats want them.
    """

    path: str
    width: int
    height: int
    fps: str
    sample_rate: int | None
    codec: str = "mp4"
    pixels: str = "rgb24"
    memory: str = ""
    draft: bool = False

    def encode(self) -> bytes:
        """Return the payload of a SETUP message."""
        return json.dumps(asdict(self)).encode()

    @staticmethod
    def decode(payload: Buffer) -> Setup:
        """Return the setup that a payload holds."""
        return Setup(**json.loads(bytes(payload)))


def send(pipe: io.RawIOBase, kind: bytes, payload: Buffer = b"") -> None:
    """Write one message; blocks until the pipe has taken it. Raises OSError if the reader is gone."""
    for part in (_HEADER.pack(kind, len(payload)), payload):
        rest = memoryview(part)
        while rest:
            rest = rest[pipe.write(rest) :]


def receive(pipe: io.RawIOBase) -> tuple[bytes, bytearray]:
    """Read one message; blocks until it is whole. Raises EOFError if the writer is gone."""
    kind, length = _HEADER.unpack(_read(pipe, _HEADER.size))
    return kind, _read(pipe, length)


def _read(pipe: io.RawIOBase, length: int) -> bytearray:
    data = bytearray(length)
    rest = memoryview(data)
    while rest:
        count = pipe.readinto(rest)
        if not count:
            raise EOFError("the pipe was closed in the middle of a film")
        rest = rest[count:]
    return data
