"""Right files, spoilt by what they are made of: members, rows, letters that look alike, counts in headers."""

from __future__ import annotations

import copy
import json
import random
import re
import struct
from collections.abc import Callable, Iterator
from typing import Any

from .registry import READERS

VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 1e308, -1e308, 2**64, 1e-320, -0.0, 21601, "", "x" * 5000, [], {}, [[]],
    [None], {"a": 1}, [1] * 50_000, "NaN", "1e400", "\u202e", "../../etc/passwd", "C:\\x",
    "file:///etc/passwd", [0, 0, 0], "AU12", "zygomatic_major",
)  # fmt: skip
ALIKE = dict(zip("aeo\"'-01 ,.", "аео”’−Ol\u00a0，․", strict=True))
"""Letters and others that look like them."""
ODD = "\u0301\u200b\ufffd\U0001f600\x7f\x85\ufffe\U0010ffff"
_NUMBER = re.compile(rb"\d+(\.\d+)?")
_BETWEEN = re.compile(rb"([\s,;=<>\"'])")
_NUMBERS = (b"-5", b"1e9", b"0.0000001", b"99999999999", b"7", b"3.5", b"nan")


def members(data: bytes, numbers: random.Random) -> bytes:
    """Change, delete, copy or rename members of JSON."""
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return rows(data, numbers)
    for _ in range(numbers.randint(1, 4)):
        places = list(_places(tree))
        if places:
            _change(tree, numbers.choice(places), numbers.choice(places), numbers)
    return json.dumps(tree).encode("utf-8", "surrogatepass")


def _places(tree: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield the path of each member."""
    if path:
        yield path
    for key in (
        tree if isinstance(tree, dict) else range(min(len(tree), 40)) if isinstance(tree, list) else ()
    ):
        yield from _places(tree[key], (*path, key))


def _at(tree: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        tree = tree[key]
    return tree


def _change(tree: Any, path: tuple[Any, ...], other: tuple[Any, ...], numbers: random.Random) -> None:
    holder, key, what = _at(tree, path[:-1]), path[-1], numbers.randrange(7)
    if what < 3:
        holder[key] = copy.deepcopy(numbers.choice(VALUES))
    elif what == 3:
        del holder[key]
    elif what == 4:
        taken = _at(tree, other)
        if len(json.dumps(taken)) < 20_000:
            holder[key] = copy.deepcopy(taken)
    elif isinstance(holder, dict):
        holder[key + numbers.choice(["s", "_", "é", " "])] = holder.pop(key)
    else:
        holder.extend(copy.deepcopy(holder[:20]) * numbers.randint(1, 5))


def rows(data: bytes, numbers: random.Random) -> bytes:
    """Delete, double, swap, lengthen, shuffle lines, or put another kind of file among them."""
    lines = data.split(b"\n")
    one, two, what = numbers.randrange(len(lines)), numbers.randrange(len(lines)), numbers.randrange(8)
    if what == 0:
        del lines[one]
    elif what == 1:
        lines.insert(one, lines[two])
    elif what == 2:
        lines[one], lines[two] = lines[two], lines[one]
    elif what == 3:
        lines[one] = lines[one][:20_000] * numbers.choice([2, 10, 1000])
    elif what == 4:
        parts = _BETWEEN.split(lines[one])
        numbers.shuffle(parts)
        lines[one] = b"".join(parts)
    elif what == 5:
        lines[one] = lines[one].swapcase()
    elif what == 6:
        lines[one] = _NUMBER.sub(lambda _: numbers.choice(_NUMBERS), lines[one])
    else:
        lines[one:one] = _another(numbers)[:3000].split(b"\n")
    return numbers.choice([b"\n"] * 8 + [b"\r\n", b"\r"]).join(lines)


def letters(data: bytes, numbers: random.Random) -> bytes:
    """Put letters that look alike, or odd ones, in place of some, and perhaps another encoding."""
    text = list(data[:200_000].decode("utf-8", "replace"))
    for _ in range(min(numbers.randint(1, 8), len(text))):
        at = numbers.randrange(len(text))
        text[at] = ALIKE.get(text[at], numbers.choice(ODD))
    code = numbers.choice(["utf-8"] * 4 + ["utf-16", "utf-8-sig", "latin-1"])
    return "".join(text).encode(code, "replace")


def headers(data: bytes, numbers: random.Random) -> bytes:
    """Put other lengths and counts into a file of bytes, most often at its start."""
    held = bytearray(data)
    if len(held) < 8:
        return data
    at = numbers.randrange(min(len(held) - 4, 400 if numbers.random() < 0.7 else len(held)))
    what = numbers.randrange(4)
    if what == 0:
        counts = (0, 1, 2**31, 2**32 - 1, len(held), 65_536, numbers.getrandbits(32))
        held[at : at + 4] = struct.pack("<I", numbers.choice(counts))
    elif what == 1:
        held[at : at + 2] = struct.pack("<H", numbers.choice([0, 1, 2, 32, 65_535]))
    elif what == 2:
        del held[at : at + numbers.randint(1, 64)]
    else:
        held[at:at] = numbers.randbytes(numbers.randint(1, 64))
    return bytes(held)


def another(data: bytes, numbers: random.Random) -> bytes:
    """Put a file of another kind in the place of this one, or behind it."""
    return _another(numbers) if numbers.random() < 0.5 else data + _another(numbers)


def _another(numbers: random.Random) -> bytes:
    return READERS[numbers.choice(list(READERS))].samples()[0]


STRUCTURED: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    members,
    members,
    rows,
    rows,
    letters,
    headers,
    another,
)
