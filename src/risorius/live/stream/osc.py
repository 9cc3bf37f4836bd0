"""Open Sound Control 1.0: messages and bundles (Wright, The Open Sound Control 1.0 Specification, 2002)."""

from __future__ import annotations

import struct
from collections.abc import Iterable

Argument = int | float | str

_AT_ONCE = b"#bundle\0" + struct.pack(">Q", 1)
LARGEST = 1472  # bytes of a datagram that Ethernet carries in one piece


def message(address: str, *arguments: Argument) -> bytes:
    """Return a message; whole numbers are int32, others float32, texts UTF-8."""
    tags, data = ",", b""
    for argument in arguments:
        if isinstance(argument, str):
            tags, data = tags + "s", data + _text(argument)
        elif isinstance(argument, int):
            tags, data = tags + "i", data + struct.pack(">i", argument)
        else:
            tags, data = tags + "f", data + struct.pack(">f", argument)
    return _text(address) + _text(tags) + data


def bundles(messages: Iterable[bytes], largest: int = LARGEST) -> list[bytes]:
    """Return the messages in their order in as few bundles as hold them, none larger than `largest` bytes."""
    result, open_ = [], _AT_ONCE
    for part in messages:
        entry = struct.pack(">i", len(part)) + part
        if len(open_) + len(entry) > largest and open_ != _AT_ONCE:
            result.append(open_)
            open_ = _AT_ONCE
        open_ += entry
    return [*result, open_] if open_ != _AT_ONCE else result


def _text(text: str) -> bytes:
    data = text.encode()
    return data + b"\0" * (4 - len(data) % 4)
