"""Find the position of a value in a text of TOML or JSON, once something is wrong with it.

The texts have been parsed before, so that the scanners below need not judge their syntax.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Generator, Iterator
from functools import lru_cache

KeyPath = tuple[str | int, ...]
"""From the whole document to a value: names of keys, and numbers of items from 0 on."""
PathAndStart = tuple[KeyPath, int]
"""A path, and where in the text its key, item or header begins."""
Scan = Generator[PathAndStart, None, int]
"""Yields the contents of a piece of text, and returns where it ends."""

_BLANK = re.compile(r"[ \t\r\n]*")
_BLANK_OR_COMMENT = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_TOML_STRING = re.compile(
    r'"""(?:\\.|[^\\])*?"{3,5}(?!")' r"|'''.*?'{3,5}(?!')" r'|"(?:\\.|[^"\\\n])*"' r"|'[^'\n]*'", re.DOTALL
)
_TOML_KEY = re.compile(
    r"""(?:[\w-]+|"(?:\\.|[^"\\\n])*"|'[^'\n]*')(?:[ \t]*\.[ \t]*(?:[\w-]+|"(?:\\.|[^"\\\n])*"|'[^'\n]*'))*"""
)
_BARE_KEY = re.compile(r"[\w-]+")
_TOML_PLAIN = re.compile(r"[^,\]}#\n]+")
_DECODER = json.JSONDecoder()


def json_position(text: str, path: KeyPath) -> int | None:
    """Return where the member or item at `path`, or the nearest above it, begins; None for the whole."""
    place, start = None, _BLANK.match(text).end()  # type: ignore[union-attr]
    for part in path:
        entry_at = next((entry for entry in _json_entries(text, start) if entry[0] == part), None)
        if entry_at is None:
            return place
        _, place, start = entry_at
    return place


def _json_entries(text: str, start: int) -> Iterator[tuple[str | int, int, int]]:
    """Yield each key or index of an object or a list, where it begins, and where its value begins."""
    opening, at = text[start], _after_blanks(text, start + 1)
    if opening not in "{[" or text[at] in "}]":
        return
    number = 0
    while True:
        key: str | int
        place, key = at, number
        if opening == "{":
            key, at = _DECODER.raw_decode(text, at)
            at = _after_blanks(text, _after_blanks(text, at) + 1)
        yield key, place, at
        _, at = _DECODER.raw_decode(text, at)
        at = _after_blanks(text, at)
        if text[at] != ",":
            return
        at, number = _after_blanks(text, at + 1), number + 1


def _after_blanks(text: str, at: int) -> int:
    return _BLANK.match(text, at).end()  # type: ignore[union-attr]


def toml_position(text: str, path: KeyPath) -> int | None:
    """Return where the key, item or header at `path`, or the nearest above it, begins; None for the whole."""
    best: PathAndStart = ((), -1)
    for entry, at in _toml_places(text):
        here = entry[: len(path)]  # a table also begins with the first thing in it
        if len(here) > len(best[0]) and path[: len(here)] == here:
            best = (here, at)
    return best[1] if best[0] else None


@lru_cache(maxsize=1)
def _toml_places(text: str) -> tuple[PathAndStart, ...]:
    """Return all entries; the places of many values of one text are asked for in succession."""
    return tuple(_toml_entries(text))


def _toml_entries(text: str) -> Iterator[PathAndStart]:
    """Yield the path of every header, key and item of a document, and where it begins."""
    table: KeyPath = ()
    counts: dict[KeyPath, int] = {}
    at = _after_comments(text, 0)
    while at < len(text):
        if text[at] == "[":
            many = text.startswith("[[", at)
            key = _TOML_KEY.match(text, _after_blanks(text, at + 1 + many))
            assert key is not None
            table = _header(_parts(key[0]), counts, many=many)
            yield table, at
            at = text.index("]", key.end()) + 1 + many
        else:
            at = yield from _pair(text, at, table)
        at = _after_comments(text, at)


def _header(parts: KeyPath, counts: dict[KeyPath, int], *, many: bool) -> KeyPath:
    """Return a header's path with the numbers of the tables in arrays that it means; counts a new one."""
    path: KeyPath = ()
    for number, part in enumerate(parts):
        path = (*path, part)
        if many and number == len(parts) - 1:
            counts[path] = counts.get(path, -1) + 1
        if path in counts:
            path = (*path, counts[path])
    return path


def _pair(text: str, at: int, table: KeyPath) -> Scan:
    """Yield a key and the contents of its value."""
    key = _TOML_KEY.match(text, at)
    assert key is not None
    path = (*table, *_parts(key[0]))
    yield path, at
    return (yield from _value(text, _after_blanks(text, text.index("=", key.end()) + 1), path))


def _value(text: str, at: int, path: KeyPath) -> Scan:
    """Yield the contents of a value if it is an array or an inline table."""
    if text[at] in "[{":
        return (yield from _held(text, at, path))
    match = _TOML_STRING.match(text, at) or _TOML_PLAIN.match(text, at)
    assert match is not None
    return match.end()


def _held(text: str, at: int, path: KeyPath) -> Scan:
    array, number = text[at] == "[", 0
    at = _after_comments(text, at + 1)
    while text[at] not in "]}":
        if array:
            yield (*path, number), at
            at = yield from _value(text, at, (*path, number))
        else:
            at = yield from _pair(text, at, path)
        at = _after_comments(text, at)
        if text[at] == ",":
            at, number = _after_comments(text, at + 1), number + 1
    return at + 1


def _after_comments(text: str, at: int) -> int:
    return _BLANK_OR_COMMENT.match(text, at).end()  # type: ignore[union-attr]


def _parts(key: str) -> KeyPath:
    """Return the names in a dotted key."""
    if _BARE_KEY.fullmatch(key):
        return (key,)
    parts: list[str] = []
    table = tomllib.loads(f"{key} = 0")
    while isinstance(table, dict):
        ((name, table),) = table.items()
        parts.append(name)
    return tuple(parts)
