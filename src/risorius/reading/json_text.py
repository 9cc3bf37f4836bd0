"""Reading of strict JSON from texts and files."""

from __future__ import annotations

import json
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from ..errors import InputError, Place
from .depth import TOO_DEEP, is_too_deep
from .positions import KeyPath
from .schema import build
from .source_text import SourceText, Syntax, read_file

JsonObject = dict[str, Any]
T = TypeVar("T")
MAX_BYTES = 200_000_000
# Escapes of two surrogates, or of a lone one (the group); an escaped backslash starts no escape.
_HALVES = re.compile(
    r"(?<!\\)(?:\\\\)*(?:\\u[dD][89abAB][0-9a-fA-F]{2}\\u[dD][c-fC-F][0-9a-fA-F]{2}|(\\u[dD][89a-fA-F][0-9a-fA-F]{2}))"
)


@dataclass(frozen=True, slots=True)
class JsonDocument:
    """A parsed document, and the text that says where its values stand."""

    data: object
    source: SourceText

    def read(self, cls: type[T], path: KeyPath = ()) -> T:
        """Return the document as a `cls`; raise InputError, with its place, if it does not fit.

        `path`: where `data` stands if it is part of a larger text.
        """
        return build(cls, self.data, self.source, path)


def load_json(path: Path) -> JsonDocument:
    """Return the document in a file.

    Raises InputError, with line and column for a fault of syntax: not readable, over MAX_BYTES, not UTF-8,
    not JSON, a key given twice, nested too deeply, a number that no program reads.
    """
    return parse_json(read_file(path, MAX_BYTES, Syntax.JSON), str(path))


def parse_json(text: str, name: str) -> JsonDocument:
    """Return the document in a JSON text; `name` is that of its file. Raises InputError as `load_json`."""
    place = Place(name)
    try:
        data = json.loads(text, object_pairs_hook=_object, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        message = f"is not JSON: {error.msg[:1].lower()}{error.msg[1:]}"
        raise InputError(message, Place(name, error.lineno, error.colno)) from None
    except RecursionError:
        raise InputError(TOO_DEEP, place) from None
    except InputError as error:
        raise error.at(place) from None
    except ValueError:
        # The only other fault: digits beyond what Python turns into an integer.
        raise InputError("holds a number with too many digits; expected fewer", place) from None
    if is_too_deep(data):
        raise InputError(TOO_DEEP, place)
    if not is_unicode(data, text):
        raise InputError(HALF_A_CHARACTER, _place_of_half(text, name))
    return JsonDocument(data, SourceText(name, text, Syntax.JSON))


HALF_A_CHARACTER = "holds an escape of half a character (\\ud800 to \\udfff); expected both halves"


def is_unicode(data: object, text: str) -> bool:
    """Whether all texts in data, which was read from JSON, can be written: an escape may be half a character.

    Python takes such a text for one until it is written to a file, a program or a database.
    """
    if "\\u" not in text:
        return True
    try:
        json.dumps(data, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        return False
    return True


def _place_of_half(text: str, name: str) -> Place:
    at = next((halves.start(1) for halves in _HALVES.finditer(text) if halves[1]), -1)
    if at < 0:
        return Place(name)
    return Place(name, text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at))


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        names = [name for name, _ in pairs]
        twice = Counter(names).most_common(1)[0][0]
        raise InputError(f"the key '{twice}' is given twice in one object; expected it once")
    return members


def _no_constant(name: str) -> float:
    raise InputError(f"{name} is not a number; expected a finite one")
