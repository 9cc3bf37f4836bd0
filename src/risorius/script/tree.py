"""XML documents as trees with the place of everything: as safe and strict as the markup's elements."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace

from ..errors import InputError, ParameterError, Place, RisoriusWarning, unknown, warn
from .attributes import number_of
from .elements import Attribute, XmlReader
from .quote import one_line, quoted


class ScriptWarning(RisoriusWarning):
    """Something in a script is not understood and was left out."""


@dataclass(frozen=True, slots=True)
class Text:
    """Characters between tags, and where they begin."""

    text: str
    place: Place


@dataclass(frozen=True, slots=True)
class XmlNode:
    """An element: its name without the namespace's prefix, its attributes, its place, its contents.

    `written`: the name with its prefix.
    """

    name: str
    attributes: tuple[Attribute, ...]
    place: Place
    children: list[XmlNode | Text] = field(default_factory=list)
    written: str = ""

    def get(self, *names: str) -> Attribute | None:
        """Return the first of the attributes `names` that is given, whatever its prefix."""
        by_name = {a.name: a for a in self.attributes}
        bare = {a.name.rpartition(":")[2]: a for a in self.attributes if not a.name.startswith("xmlns")}
        return next(
            (attribute for n in names if (attribute := by_name.get(n) or bare.get(n)) is not None), None
        )

    def text_of(self, name: str) -> str | None:
        """Return an attribute's text without the blanks around it, None if it is not given."""
        attribute = self.get(name)
        return attribute.value.strip() if attribute is not None else None

    def required(self, name: str, example: str) -> Attribute:
        """Return an attribute; raise InputError if it is not given."""
        attribute = self.get(name)
        if attribute is None:
            raise InputError(f"<{self.name}>: {name} is missing; expected e.g. {example}", self.place)
        return attribute

    def choice(self, name: str, known: Sequence[str], default: str) -> str:
        """Return an attribute that is one of `known`, in any case; raise ParameterError for others."""
        attribute = self.get(name)
        if attribute is None:
            return default
        value = next((k for k in known if k.lower() == attribute.value.strip().lower()), None)
        if value is None:
            raise ParameterError(unknown(name, one_line(attribute.value), known), attribute.place)
        return value

    def number(self, name: str, low: float, high: float, default: float) -> float:
        """Return an attribute that is a number; raise InputError if it is not one or is out of range."""
        attribute = self.get(name)
        return default if attribute is None else number_of(attribute, low, high)

    def inheriting(self, container: XmlNode) -> XmlNode:
        """Return the node with the attributes of its container that it does not have itself, but the id."""
        own = {attribute.name for attribute in self.attributes} | {"id"}
        attributes = (attribute for attribute in container.attributes if attribute.name not in own)
        return replace(self, attributes=(*self.attributes, *attributes))

    def elements(self) -> Iterator[XmlNode]:
        """Yield the elements in it; raise InputError for text between them."""
        for child in self.children:
            if isinstance(child, XmlNode):
                yield child
            elif child.text.strip():
                where = f"in <{self.name}>" if self.name else "outside elements"
                raise InputError(f"{quoted(child.text.strip())} stands {where}", child.place)


class Unknowns:
    """Warns of unsupported parts, by name and place, once for each."""

    def __init__(self) -> None:
        self._told: set[str] = set()

    def tell(self, what: str, place: Place, instead: str = "it is left out") -> None:
        """Warn that `what`, at `place`, is not supported."""
        if what not in self._told:
            self._told.add(what)
            warn(f"{place}: {what} is not understood; {instead}", ScriptWarning)

    def misunderstood(self, message: str, place: Place, instead: str) -> None:
        """Warn, once, of a value that is not as expected, with the error's message."""
        shown = f"{place}: {message}"
        if shown not in self._told:
            self._told.add(shown)
            warn(f"{shown}; {instead}", ScriptWarning)

    def check(self, node: XmlNode, known: Collection[str]) -> None:
        """Warn of a node's attributes that are not `known`; those of XML itself are."""
        for attribute in node.attributes:
            prefix, _, bare = attribute.name.rpartition(":")
            if prefix not in ("xml", "xmlns") and bare != "xmlns" and bare not in known:
                self.tell(f"{one_line(attribute.name)} of <{one_line(node.written)}>", attribute.place)


def read_tree(text: str, source: str, root: str, *other_roots: str) -> XmlNode:
    """Return the root element, which has to be `root`, or one of `other_roots`.

    Raises InputError with its place for what is not well-formed, and for document types and entities.
    """
    reader = _TreeReader(text.replace("\r\n", "\n").replace("\r", "\n"), source)
    reader.parse()
    roots = list(reader.top.elements())
    wrong = next(
        (r for r in roots if r.name not in (root, *other_roots)), roots[1] if len(roots) > 1 else None
    )
    if wrong is not None:
        shown = one_line(wrong.name)
        raise InputError(f"<{shown}> stands outside; expected one <{root}> around everything", wrong.place)
    if not roots:
        raise InputError(f"there is no element; expected <{root}>", Place(source, 1))
    return roots[0]


class _TreeReader(XmlReader):
    """Builds the tree."""

    example = "one element around everything"

    def __init__(self, text: str, source: str) -> None:
        super().__init__(text, source)
        self.top = XmlNode("", (), Place(source, 1))
        self._stack = [self.top]

    def _start(self, name: str, values: list[str]) -> None:
        if self.parser.CurrentByteIndex == 0:
            return
        element = self._element(name, values)
        node = XmlNode(name.rpartition(":")[2], element.attributes, element.place, written=name)
        self.open.append(element)
        self._stack[-1].children.append(node)
        self._stack.append(node)

    def _end(self, name: str) -> None:
        if len(self._stack) > 1:
            self._stack.pop()
            self.open.pop()

    def _characters(self, data: str) -> None:
        place = self._place(self._index(self.parser.CurrentByteIndex))
        self._stack[-1].children.append(Text(data, place))
