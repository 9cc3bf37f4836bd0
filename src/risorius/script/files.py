"""Files of text: read within bounds, decoded strictly."""

from __future__ import annotations

import codecs
from pathlib import Path

from ..errors import InputError, Place
from .kinds import kind_of_bytes
from .quote import LONGEST_PATH, one_line
from .speakable import position

MAX_BYTES = 2_000_000

_BOMS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, ""),
    (codecs.BOM_UTF32_BE, ""),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)


def names_something(path: str) -> bool:
    """Whether there is a file or folder of that name."""
    try:
        return Path(path).exists()
    except (OSError, ValueError):
        return False


def read_text(path: str) -> str:
    """Return a file's text, line ends as in Unix; raise InputError if it is not text or too large."""
    place = Place(one_line(path, LONGEST_PATH))
    if Path(path).is_dir():
        raise InputError("is a folder; expected a file, or --text to have the words spoken", place)
    data = read_bytes(path, MAX_BYTES, place)
    kind = kind_of_bytes(data)
    if kind is not None:
        raise InputError(kind, place)
    return decode(data, place.file)


def read_bytes(path: str, largest: int, place: Place) -> bytes:
    """Return a file's content; raise InputError if it cannot be read or has over `largest` bytes."""
    try:
        with Path(path).open("rb") as source:
            data = source.read(largest + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place) from None
    if len(data) > largest:
        raise InputError(f"is larger than {largest:,} bytes; expected less", place)
    return data


def decode(data: bytes, name: str) -> str:
    """Return text in UTF-8, or in UTF-16 with a byte order mark; raise InputError for anything else."""
    for mark, encoding in _BOMS:
        if data.startswith(mark):
            if not encoding:
                raise InputError("is in UTF-32; expected UTF-8", Place(name))
            return _unix(_decoded(data[len(mark) :], encoding, name))
    if b"\0" in data:
        raise InputError("is a binary file; expected text in UTF-8", Place(name))
    return _unix(_decoded(data, "utf-8", name))


def _decoded(data: bytes, encoding: str, name: str) -> str:
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        before = data[: error.start].decode(encoding, "ignore")
        byte = f"byte 0x{data[error.start]:02x}"
        place = position(name, before, len(before))
        raise InputError(f"is not text in {encoding.upper()} ({byte}); expected UTF-8", place) from None


def _unix(text: str) -> str:
    return text.replace("\r\n", "\n").replace("\r", "\n")
