"""APML (De Carolis, Pelachaud, Poggi and Steedman 2004): what a speaker means, around the words that say it.

A new element is a function from the writer and the node, and its lines in `ELEMENTS` and `ATTRIBUTES`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from ..rules.rule import InformationPart
from .anchor import Anchor, Base
from .apart import check_apart
from .apml_acts import Span, marks_of_act, marks_of_affect, marks_of_turn
from .apml_words import ENGLISH, WORD_ATTRIBUTES, WORD_ELEMENTS, ApmlWriter
from .fml_apml import FML_ROOTS, script_of_fml
from .model import Mark, PartMark, Script, SpokenLine, script_of
from .prolog import without_document_type
from .speakable import check_speakable
from .tree import Unknowns, XmlNode, read_tree

ROOTS = ("apml", "APML")


def parse_apml(text: str, source: str = "text") -> Script:
    """Return the script of a document in APML or FML-APML, by its root.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected;
    warns (ScriptWarning) of what is not understood.
    """
    root = read_tree(without_document_type(text), source, *ROOTS, *FML_ROOTS)
    return script_of_fml(root, source) if root.name in FML_ROOTS else _script_of_apml(root, source)


def _script_of_apml(root: XmlNode, source: str) -> Script:
    unknowns = Unknowns()
    unknowns.check(root, ATTRIBUTES["apml"])
    language = root.text_of("lang")
    writer = _DocumentWriter(unknowns, language=language or ENGLISH)
    _act(writer, root)
    spoken, directions = writer.finished()
    check_speakable(spoken, source, root.place)
    check_apart((mark, mark.start) for mark in writer.marks)
    line = SpokenLine(spoken, None, root.place, directions=directions)
    script = script_of((line,), tuple(writer.marks), timed=False, source=source, language=language)
    return replace(script, information=tuple(writer.information))


@dataclass
class _DocumentWriter(ApmlWriter):
    """Writes the words of a document down, and the marks of the acts around them.

    `depth`: how many affects are open.
    """

    marks: list[Mark] = field(default_factory=list)
    information: list[PartMark] = field(default_factory=list)
    depth: int = 0

    @property
    def elements(self) -> Mapping[str, Callable[..., None]]:
        """The functions that apply elements, by their names in lower case."""
        return ELEMENTS

    @property
    def attributes(self) -> Mapping[str, Sequence[str]]:
        """The attributes of each element that are understood."""
        return ATTRIBUTES


def _anchors(span: tuple[int, int], node: XmlNode) -> Span:
    first, last = span
    return (
        Anchor(Base.TEXT, 0.0, character=first, place=node.place),
        Anchor(Base.TEXT_END, 0.0, character=last, place=node.place),
    )


def _act(writer: _DocumentWriter, node: XmlNode) -> Span | None:
    """Write the words of an act and mark its affect; return when they are said, None without words."""
    affect = node.get("affect")
    layer = f"affect {writer.depth}" if writer.depth else ""
    writer.depth += affect is not None
    span = writer.span_of(node)
    writer.depth -= affect is not None
    placed = _anchors(span, node) if span is not None else None
    if affect is not None:
        anywhere = placed or _anchors((0, 0), node)
        shown = list(marks_of_affect(affect, node, anywhere, layer))
        writer.marks += shown if placed is not None else []
    return placed


def _sentence(writer: _DocumentWriter, node: XmlNode) -> Span | None:
    """Write an act that ends what is said: a sentence of its own."""
    writer.put(" ")
    span = _act(writer, node)
    writer.closing = writer.closing or ("." if span is not None else "")
    writer.put(" ")
    return span


def _performative(writer: _DocumentWriter, node: XmlNode) -> None:
    span = _sentence(writer, node)
    if span is not None:
        writer.marks += marks_of_act(node, "performative", span, "performative", writer.unknowns)


def _certainty(writer: _DocumentWriter, node: XmlNode) -> None:
    span = _act(writer, node)
    if span is not None:
        writer.marks += marks_of_act(node, "certainty", span, "certainty", writer.unknowns)


def _turn(writer: _DocumentWriter, node: XmlNode) -> None:
    span = _sentence(writer, node)
    if span is not None:
        writer.marks += marks_of_turn(node, span)


def _part(writer: _DocumentWriter, node: XmlNode) -> None:
    span = _act(writer, node)
    if span is not None:
        writer.information.append(PartMark(InformationPart(node.name.lower()), *span, node.place))


ELEMENTS: Mapping[str, Callable[..., None]] = {
    **WORD_ELEMENTS,
    "turn-allocation": _turn,
    "turnallocation": _turn,
    "performative": _performative,
    "certainty": _certainty,
    "theme": _part,
    "rheme": _part,
}
_AFFECTED = ("affect", "intensity")
ATTRIBUTES: Mapping[str, Sequence[str]] = {
    **WORD_ATTRIBUTES,
    "apml": _AFFECTED,
    "turn-allocation": ("type",),
    "turnallocation": ("type",),
    "performative": ("type", *_AFFECTED),
    "certainty": ("type", "intensity"),
    "theme": _AFFECTED,
    "rheme": _AFFECTED,
}
"""The attributes of each element that are understood; none of the others."""
