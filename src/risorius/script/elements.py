"""Markup as a list of elements, each with its place: safe, strict, several roots allowed.

The paper prints several elements without one around them, which is not an XML document, so the parser is
given a root of its own. Document types and entities are not part of the markup: no bombs, nothing external.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Collection
from dataclasses import dataclass
from xml.parsers import expat

from ..errors import InputError, ParameterError, Place, unknown
from ..reading.depth import MAX_DEPTH, TOO_DEEP
from .quote import one_line, quoted

MAX_BYTES = 2_000_000
CONTAINER = "SCRIPT"
"""The element that may stand around the others."""

EXAMPLE = '<PHONEME time="0" text="Hello." />'
_ROOT = "_"
_OPENING, _CLOSING = f"<{_ROOT}>".encode(), f"</{_ROOT}>".encode()
_DECLARATION = re.compile(r"\A\s*+<\?xml\b[^>]*?\?>")
_ENCODING = re.compile(r"""encoding\s*+=\s*+["']([^"']*+)["']""")
_ENCODINGS = frozenset({"utf-8", "utf8", "utf-16", "utf-16le", "utf-16be", "us-ascii", "ascii"})
_TAG = re.compile(r"<[^\s/>]+")
_ATTRIBUTE = re.compile(r"""(?<!\s)\s++([^\s=/>]++)\s*+=\s*+(?:"[^"]*+"|'[^']*+')""")
_ENTITY = re.compile(r"&[^;\s\"'<]{0,40};")


@dataclass(frozen=True, slots=True)
class Attribute:
    """An attribute as written, and where."""

    name: str
    value: str
    place: Place


@dataclass(frozen=True, slots=True)
class Element:
    """An element: its name in capitals, its attributes, and where it starts."""

    name: str
    attributes: tuple[Attribute, ...]
    place: Place


def read_elements(text: str, source: str, known: Collection[str] = ()) -> list[Element]:
    """Return all elements of the markup `text` in their order.

    Raises InputError with its place for what is not well-formed, nested, or not an element; for document
    types and entities; and for more than MAX_BYTES. Raises ParameterError for an element that is not one of
    the `known` ones, if any are named, and holds something.
    """
    return _ElementReader(text.replace("\r\n", "\n").replace("\r", "\n"), source, known).read()


def unknown_element(element: Element, known: Collection[str]) -> ParameterError:
    """Return the error for an element that the markup does not know."""
    return ParameterError(unknown("element", one_line(element.name), known), element.place)


class XmlReader:
    """One reading of XML: it counts positions and keeps the open elements. Subclasses keep what they find."""

    # The example that messages give as expected.
    example = EXAMPLE

    def __init__(self, text: str, source: str) -> None:
        self.text = self._without_declaration(text, source)
        self.source = source
        self.open: list[Element] = []
        self.data = self.text.encode("utf-8", "surrogatepass")
        if len(self.data) > MAX_BYTES:
            raise InputError(f"the markup is larger than {MAX_BYTES:,} bytes; expected less", Place(source))
        self.line_starts = [0, *(m.end() for m in re.finditer("\n", text))]
        # The last position found, as a number of bytes and of characters.
        self.known = (0, 0)

    @staticmethod
    def _without_declaration(text: str, source: str) -> str:
        declaration = _DECLARATION.match(text)
        if declaration is None:
            return text
        encoding = _ENCODING.search(declaration[0])
        if encoding and encoding[1].lower() not in _ENCODINGS:
            raise InputError(
                f"encoding {quoted(encoding[1])} cannot be read; expected UTF-8", Place(source, 1)
            )
        return re.sub(r"[^\n]", " ", declaration[0]) + text[declaration.end() :]

    def parse(self) -> None:
        """Read everything; raise InputError, with its place, if the markup is not well-formed."""
        parser = expat.ParserCreate("utf-8")
        parser.ordered_attributes = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._characters
        self.parser = parser
        try:
            parser.Parse(_OPENING + self.data + _CLOSING, True)
        except expat.ExpatError as error:
            raise self._syntax_error(error.code, self._index(parser.ErrorByteIndex)) from None

    def _start(self, name: str, values: list[str]) -> None:
        raise NotImplementedError

    def _end(self, name: str) -> None:
        raise NotImplementedError

    def _characters(self, data: str) -> None:
        raise NotImplementedError

    def _element(self, name: str, values: list[str]) -> Element:
        """Return the element that starts where the parser is."""
        index = self._index(self.parser.CurrentByteIndex)
        if len(self.open) >= MAX_DEPTH:
            raise InputError(TOO_DEEP, self._place(index))
        return Element(name, self._attributes(index, values), self._place(index))

    def _attributes(self, tag: int, values: list[str]) -> tuple[Attribute, ...]:
        """Pair the parser's names and values with the positions that the tag's own text gives."""
        attributes: list[Attribute] = []
        name = _TAG.match(self.text, tag)
        end = name.end() if name else tag
        for key, value in zip(values[::2], values[1::2], strict=True):
            written = _ATTRIBUTE.match(self.text, end)
            index = written.start(1) if written else tag
            end = written.end() if written else end
            attributes.append(Attribute(key, value, self._place(index)))
        return tuple(attributes)

    def _index(self, byte: int) -> int:
        """Return the index of the character at the parser's position `byte`."""
        target = min(max(byte - len(_OPENING), 0), len(self.data))
        known_byte, known_index = self.known if self.known[0] <= target else (0, 0)
        piece = self.data[known_byte:target].decode("utf-8", "ignore")
        self.known = (target, known_index + len(piece))
        return self.known[1]

    def _place(self, index: int) -> Place:
        line = bisect_right(self.line_starts, index)
        return Place(self.source, line, index - self.line_starts[line - 1] + 1)

    def _syntax_error(self, code: int, index: int) -> InputError:
        tag = max(self.text.rfind("<", 0, index + 1), 0)
        if self.text.startswith("<!", tag) and not self.text.startswith(("<!--", "<![CDATA["), tag):
            return InputError(
                f"document types and entity declarations are not allowed; expected {self.example}",
                self._place(tag),
            )
        if code == expat.errors.codes[expat.errors.XML_ERROR_TAG_MISMATCH] and self.open:
            last = self.open[-1]
            name = one_line(last.name)
            return InputError(f"{name} is not closed; expected it to end with '/>' or </{name}>", last.place)
        if index >= len(self.text):
            return InputError("not closed: a quotation mark or '/>' is missing", self._place(tag))
        return InputError(self._syntax_message(code, index), self._place(index))

    def _syntax_message(self, code: int, index: int) -> str:
        entity = _ENTITY.search(self.text, index)
        if code == expat.errors.codes[expat.errors.XML_ERROR_UNDEFINED_ENTITY] and entity:
            return f"unknown entity {quoted(entity[0])}; expected &amp;, &lt;, &gt;, &quot; or &apos;"
        if self.text[index - 1 : index] == "&":
            return "a bare '&'; expected &amp;"
        invalid = code == expat.errors.codes[expat.errors.XML_ERROR_INVALID_TOKEN]
        if invalid and self.text[index : index + 1] == "<":
            return "a '<' inside an element; expected &lt;, or a closing quotation mark before it"
        return f"{expat.ErrorString(code)}; expected e.g. {self.example}"


class _ElementReader(XmlReader):
    """Collects a flat list of elements; only CONTAINER may hold others."""

    def __init__(self, text: str, source: str, known: Collection[str]) -> None:
        super().__init__(text, source)
        self._known = known
        self.elements: list[Element] = []

    def read(self) -> list[Element]:
        """Return all elements in their order."""
        self.parse()
        return self.elements

    def _start(self, name: str, values: list[str]) -> None:
        if self.parser.CurrentByteIndex == 0:
            return
        element = self._element(name.upper(), values)
        self._check_outer()
        if self.open and not (self.open[-1].name == CONTAINER and element.name != CONTAINER):
            outer = self.open[-1].name
            raise InputError(f"{one_line(name)} stands inside {outer}; expected it after", element.place)
        self.open.append(element)
        self.elements.append(element)

    def _check_outer(self) -> None:
        """Raise ParameterError if what is open, and holds something, is an element that nobody knows."""
        if self.open and self._known and self.open[-1].name not in self._known:
            if len(self.open) > 1:
                raise unknown_element(self.open[-1], self._known)
            name = one_line(self.open[-1].name)
            raise ParameterError(f"unknown element {name}; a root is {CONTAINER}", self.open[-1].place)

    def _end(self, name: str) -> None:
        if self.open:
            self.open.pop()

    def _characters(self, data: str) -> None:
        bare = data.strip()
        if bare:
            self._check_outer()
            index = self._index(self.parser.CurrentByteIndex) + len(data) - len(data.lstrip())
            raise InputError(
                f"{quoted(bare)} stands outside elements; expected {EXAMPLE}", self._place(index)
            )
