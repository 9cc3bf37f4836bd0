"""The attributes of one element, consumed one by one; any left over is reported as unknown."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ..core.units import MAX_SECONDS
from ..errors import InputError, ParameterError, Place, unknown
from .anchor import Anchor, parse_anchor, parse_number
from .elements import Attribute, Element
from .quote import one_line, quoted


class Attributes:
    """Reads an element's attributes, whatever their case; raises InputError, with the place, for bad ones."""

    def __init__(self, element: Element) -> None:
        self.element = element
        self._left: dict[str, Attribute] = {}
        self._asked: list[str] = []
        for attribute in element.attributes:
            name = attribute.name.lower().replace("-", "_")
            if name in self._left:
                message = f"'{one_line(attribute.name)}' is given twice; expected it once"
                raise InputError(message, attribute.place)
            self._left[name] = attribute

    @property
    def place(self) -> Place:
        """The place of the element."""
        return self.element.place

    def error(self, message: str, place: Place | None = None) -> InputError:
        """Return an error about the element as a whole, at `place` in it."""
        return InputError(f"{self.element.name}: {message}", place or self.place)

    def take(self, name: str) -> Attribute | None:
        """Return the attribute `name`, None if it is not given."""
        self._asked.append(name)
        return self._left.pop(name, None)

    def number(self, name: str, low: float = -math.inf, high: float = math.inf) -> float | None:
        """Return a number from `low` to `high`."""
        attribute = self.take(name)
        return None if attribute is None else number_of(attribute, low, high)

    def duration(self, name: str) -> float | None:
        """Return a number of seconds above 0."""
        attribute = self.take(name)
        if attribute is None:
            return None
        seconds = number_of(attribute)
        if not 0.0 < seconds <= MAX_SECONDS:
            expected = f"more than 0, at most {MAX_SECONDS:g} s"
            message = f"{name} = {quoted(attribute.value)} is out of range; expected {expected}"
            raise InputError(message, attribute.place)
        return seconds

    def anchor(self, name: str) -> Anchor | None:
        """Return a time."""
        attribute = self.take(name)
        return None if attribute is None else parse_anchor(name, attribute.value, attribute.place)

    def choice(self, name: str, known: Iterable[str]) -> str | None:
        """Return one of the words in `known`."""
        attribute = self.take(name)
        if attribute is None:
            return None
        value = attribute.value.strip().lower()
        if value not in known:
            raise ParameterError(unknown(name, one_line(attribute.value), known), attribute.place)
        return value

    def rest(self) -> list[tuple[str, Attribute]]:
        """Return, and take, all that is left, each with its name in lower case."""
        left = list(self._left.items())
        self._left.clear()
        return left

    def unknown(self, attribute: Attribute, more: Iterable[str] = ()) -> ParameterError:
        """Return the error for an attribute that was not asked for and is not among `more`."""
        known = (*self._asked, *more)
        return ParameterError(unknown("attribute", one_line(attribute.name), known), attribute.place)

    def finish(self) -> None:
        """Raise ParameterError if anything is left."""
        for _, attribute in self.rest():
            raise self.unknown(attribute)


def number_of(attribute: Attribute, low: float = -math.inf, high: float = math.inf) -> float:
    """Return an attribute's number from `low` to `high`; raise InputError, with its place, for other text."""
    number = parse_number(attribute.value)
    shown = f"{one_line(attribute.name)} = {quoted(attribute.value)}"
    if number is None:
        raise InputError(f"{shown} is not a number; expected e.g. 0.5", attribute.place)
    if not low <= number <= high:
        expected = f"{low:g} or more" if math.isinf(high) else f"{low:g} to {high:g}"
        raise InputError(f"{shown} is out of range; expected {expected}", attribute.place)
    return number
