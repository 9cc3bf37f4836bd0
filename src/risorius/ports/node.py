"""Strict reading of JSON: every value is asked for by kind, and every fault names its place in the file."""

from __future__ import annotations

import json
import math
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError, Place, RisoriusError, unknown

MAX_BYTES = 200_000_000
_SHOWN = 40


@dataclass(frozen=True, slots=True)
class Node:
    """A value of a JSON document and its path in it, such as `movements[3].onset`; "" for the whole."""

    value: object
    path: str = ""

    def fault(self, message: str) -> InputError:
        """Return an error that names this value's place."""
        return InputError(f"{self.path}: {message}" if self.path else message)

    def entries(self, known: Collection[str], required: Collection[str] = ()) -> dict[str, Node]:
        """Return the members of an object by name; InputError for an unknown or a missing one."""
        members = self.members()
        for name, node in members.items():
            if name not in known:
                raise node.fault(unknown("key", name, known))
        for name in required:
            if name not in members:
                raise self.fault(f"'{name}' is missing")
        return members

    def members(self) -> dict[str, Node]:
        """Return the members of an object whose names are free."""
        if not isinstance(self.value, dict):
            raise self._wrong("an object {…}")
        prefix = f"{self.path}." if self.path else ""
        return {name: Node(value, f"{prefix}{name}") for name, value in self.value.items()}

    def items(self, count: int | None = None) -> list[Node]:
        """Return the items of a list, which must be `count` if that is given."""
        if not isinstance(self.value, list) or (count is not None and len(self.value) != count):
            raise self._wrong("a list […]" if count is None else f"a list of {count}")
        return [Node(value, f"{self.path}[{i}]") for i, value in enumerate(self.value)]

    def number(self, low: float = -math.inf, high: float = math.inf) -> float:
        """Return a finite number from `low` to `high`."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            raise self._wrong("a number")
        try:
            number = float(self.value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise self.fault("the number is too large")
        if not low <= number <= high:
            limits = f"{low:g} or more" if high == math.inf else f"{low:g} to {high:g}"
            raise self.fault(f"{number:g} is out of range; expected {limits}")
        return number

    def integer(self) -> int:
        """Return a whole number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self._wrong("a whole number")
        return self.value

    def text(self) -> str:
        """Return a string."""
        if not isinstance(self.value, str):
            raise self._wrong("a text")
        return self.value

    def flag(self) -> bool:
        """Return true or false."""
        if not isinstance(self.value, bool):
            raise self._wrong("true or false")
        return self.value

    @contextmanager
    def located(self) -> Iterator[None]:
        """Give this place to any RisoriusError (and ValueError) raised in the block."""
        try:
            yield
        except (RisoriusError, ValueError) as error:
            kind = type(error) if isinstance(error, RisoriusError) else InputError
            raise kind(f"{self.path}: {error}" if self.path else str(error)) from None

    def _wrong(self, expected: str) -> InputError:
        return self.fault(f"expected {expected}, found {_shown(self.value)}")


def _shown(value: object) -> str:
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"


def load(path: Path) -> Node:
    """Return the document in a JSON file.

    Raises InputError, with line and column for a fault of syntax: not readable, over MAX_BYTES, not UTF-8,
    not JSON, a key given twice, nested too deeply.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", Place(str(path))) from error
    if len(data) > MAX_BYTES:
        raise InputError(f"is larger than {MAX_BYTES // 1_000_000} MB", Place(str(path)))
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"is not UTF-8 text (byte {error.start})", Place(str(path))) from error
    return parse(text, str(path))


def parse(text: str, file: str) -> Node:
    """Return the document in a JSON text; `file` names it in errors. Raises InputError as `load`."""
    try:
        return Node(json.loads(text, object_pairs_hook=_object, parse_constant=_no_constant))
    except json.JSONDecodeError as error:
        message = f"is not JSON: {error.msg[:1].lower()}{error.msg[1:]}"
        raise InputError(message, Place(file, error.lineno, error.colno)) from None
    except RecursionError:
        raise InputError("is nested too deeply", Place(file)) from None
    except InputError as error:
        raise error.at(Place(file)) from None
    except ValueError:
        # The only other fault: digits beyond what Python turns into an integer.
        raise InputError("holds a number with too many digits", Place(file)) from None


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for i, name in enumerate(names) if name in names[:i])
        raise InputError(f"the key '{twice}' is given twice in one object")
    return members


def _no_constant(name: str) -> float:
    raise InputError(f"{name} is not a number; expected a finite one")
