"""FML-APML, as Greta reads it: speech in BML with marks of time, and functions that refer to these.

A new function is a function from the reading, the node and its span, and its line in `FUNCTIONS`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from ..core.directions import DirectedSpan, Directions, ToneMark
from ..errors import InputError, RisoriusError, nearest
from ..rules.apml import apml_table
from ..rules.rule import InformationPart
from .anchor import Anchor, Base
from .apml_acts import Span, marks_of_act, marks_of_emotion, marks_of_turn
from .apml_words import ENGLISH, ApmlWriter, accented_words, emphasis_of, label_of
from .bml import SPEECH, BmlReading
from .model import Mark, PartMark, Script
from .notation import accent_manner
from .quote import one_line
from .sync import Behaviour, Timetable, read_reference
from .tree import XmlNode

FML_ROOTS = ("fml-apml", "FML-APML")
TIME_MARKS = ("tm", "sync", "mark")
_TIMED = ("id", "start", "end", "importance")
FUNCTIONS: Mapping[str, tuple[str, ...]] = {
    "performative": (*_TIMED, "type", "intensity"),
    "certainty": (*_TIMED, "type", "intensity"),
    "backchannel": (*_TIMED, "type", "intensity"),
    "emotion": (*_TIMED, "type", "intensity", "regulation"),
    "turntaking": (*_TIMED, "type"),
    "theme": _TIMED,
    "rheme": _TIMED,
    "emphasis": (*_TIMED, "level", "type"),
    "pitchaccent": (*_TIMED, "type", "level"),
    "boundary": (*_TIMED, "type"),
}
"""The attributes of each function that are understood."""
SPEECH_ATTRIBUTES = ("id", "start", "end", "language", "text", "voice", "type")
"""The attributes of speech; `voice` and `type` name an engine of Greta's, which is not used."""
_ACTS = ("performative", "certainty", "backchannel")


def script_of_fml(root: XmlNode, source: str) -> Script:
    """Return the script of a document in FML-APML."""
    reading = _Reading(source)
    parts = list(root.elements())
    for part in parts:
        if part.name == "fml" or part.name == "bml":
            reading.collect(part)
    for part in parts:
        if part.name == "bml":
            for node in part.elements():
                reading.add(node)
        elif part.name != "fml":
            reading.unknowns.tell(f"<{one_line(part.written)}>", part.place)
    return reading.whole()


@dataclass
class _Reading(BmlReading):
    """The content of a document: BML, and `functions` by name."""

    functions: dict[str, XmlNode] = field(default_factory=dict)
    # Boundaries by the speech and the mark of time at which they stand.
    boundaries: dict[tuple[str, str], list[XmlNode]] = field(default_factory=dict)
    offsets: dict[str, int] = field(default_factory=dict)
    language: str | None = None

    def collect(self, part: XmlNode) -> None:
        """Take up the functions of a part: those of FML, and the tones within the speech of BML."""
        for node in part.elements():
            if part.name == "fml":
                self._function(node)
            elif node.name == SPEECH:
                for child in node.children:
                    if isinstance(child, XmlNode) and _is_referring(child):
                        self._function(child)

    def _function(self, node: XmlNode) -> None:
        name = node.name.lower()
        if name not in FUNCTIONS:
            near = nearest(name, FUNCTIONS)
            meant = f"did you mean <{near}>? " if near else ""
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place, f"{meant}it is left out")
            return
        self.unknowns.check(node, FUNCTIONS[name])
        identity = self.name_of(node)
        behaviour = Behaviour(identity, node.place, {"start": 0.0, "end": apml_table().usual.seconds})
        for point in behaviour.shape:
            if (attribute := node.get(point)) is not None:
                behaviour.given[point] = read_reference(attribute)
        self.behaviours[identity] = behaviour
        self.functions[identity] = node
        at = behaviour.given.get("start")
        if name == "boundary" and at is not None and at.point is not None and not at.seconds:
            self.boundaries.setdefault(at.point, []).append(node)

    def words_of(self, name: str, node: XmlNode) -> tuple[str, Directions]:
        """Return the words of a speech, and its directions."""
        self.unknowns.check(node, SPEECH_ATTRIBUTES)
        language = self._language_of(node)
        writer = _SpeechWriter(self.unknowns, language=language, speech=name, tones=self.boundaries)
        writer.write(node)
        if not writer.text.strip() and (text := node.get("text")) is not None:
            writer.put(text.value)
        self.offsets[name] = self.characters
        spoken, directions = writer.finished()
        if language != self.language:
            whole = DirectedSpan(0, len(spoken), node.place, language=language)
            directions = replace(directions, spans=(whole, *directions.spans))
        return spoken, directions

    def _language_of(self, node: XmlNode) -> str:
        """Return the language of a speech; the first one's is that of the script."""
        written = node.text_of("language") or self.language or ENGLISH
        language = apml_table().language.get(written.lower(), written)
        self.language = self.language or language
        return language

    def whole(self) -> Script:
        """Return the script of all that has been read."""
        table = self.table()
        information: list[PartMark] = []
        for name, node in self.functions.items():
            span = (table.anchor(name, "start"), table.anchor(name, "end"))
            kind = node.name.lower()
            if kind in ("theme", "rheme"):
                information.append(PartMark(InformationPart(kind), *span, node.place))
            elif kind in ("pitchaccent", "emphasis"):
                self._tone(node, span)
            elif kind != "boundary":
                self.nodes[name] = node
            elif span[0].base not in (Base.TEXT, Base.TEXT_END) or span[0].seconds:
                self.unknowns.tell("<boundary> that is not at a mark of time in the words", node.place)
        if not self.nodes and not self.lines and information:
            raise InputError("themes and rhemes have no words; expected a <speech>", information[0].place)
        script = self.script(table)
        return replace(script, language=self.language, information=tuple(information))

    def marks_of(self, name: str, table: Timetable) -> Iterator[Mark]:
        """Yield the marks of a function, or of a behaviour of BML."""
        if name not in self.functions:
            yield from super().marks_of(name, table)
            return
        node = self.functions[name]
        span = (table.anchor(name, "start"), table.anchor(name, "end"))
        if span[0].same_base(span[1]) and not span[0].seconds < span[1].seconds:
            raise InputError(f"'{one_line(name)}' ends at its start; expected a later end", node.place)
        try:
            yield from self._marks_of_function(node, name, span)
        except RisoriusError as error:
            raise error.at(node.place) from None

    def _marks_of_function(self, node: XmlNode, name: str, span: Span) -> Iterator[Mark]:
        kind = node.name.lower()
        if kind in _ACTS:
            yield from marks_of_act(node, kind, span, name, self.unknowns)
        elif kind == "emotion":
            yield from marks_of_emotion(node, span, name, self.unknowns)
        else:
            yield from marks_of_turn(node, span)

    def _tone(self, node: XmlNode, span: Span) -> None:
        """Direct the words of an accent or an emphasis."""
        level = emphasis_of(node) if node.get("level") is not None or node.name != "pitchaccent" else None
        label = (
            label_of(node.required("type", 'type="Hstar"'), "accent") if node.name == "pitchaccent" else ""
        )
        placed = self._in_speech(*span)
        if placed is None:
            self.unknowns.tell(f"<{one_line(node.written)}> that has no words", node.place)
            return
        speech, characters = placed
        line = self.lines[speech]
        words = accented_words(line.text, characters, self.language or ENGLISH)
        directions = line.directions
        if level is not None:
            directions = directions.joined(
                Directions((DirectedSpan(words[0][0], words[-1][1], node.place, emphasis=level),))
            )
        if label:
            # One accent for all these words: it is on the last of them.
            first, last = words[-1]
            directions = directions.joined(
                Directions(
                    (DirectedSpan(first, last, node.place, accent_manner(label)),),
                    accents=(ToneMark(first, label, node.place),),
                )
            )
        self.lines[speech] = replace(line, directions=directions)

    def _in_speech(self, start: Anchor, end: Anchor) -> tuple[str, tuple[int, int]] | None:
        """Return the speech that a span begins in, and its characters there; None without words."""
        if start.base is not Base.TEXT:
            return None
        for name, offset in self.offsets.items():
            text = self.lines[name].text
            first, last = start.character - offset, len(text)
            if not 0 <= first < last:
                continue
            if end.base in (Base.TEXT, Base.TEXT_END) and end.character > start.character:
                last = min(end.character - offset, last)
            return (name, (first, last)) if accented_words(text, (first, last), ENGLISH) else None
        return None


def _is_referring(node: XmlNode) -> bool:
    """Tell whether an element in a speech says by reference where it stands."""
    return node.name.lower() in FUNCTIONS and node.get("start") is not None


@dataclass
class _SpeechWriter(ApmlWriter):
    """Writes a speech down; at its marks of time stand the boundaries of `tones`."""

    speech: str = ""
    tones: Mapping[tuple[str, str], list[XmlNode]] = field(default_factory=dict)

    def perform(self, node: XmlNode) -> None:
        """Apply an element."""
        if node.name in TIME_MARKS:
            self._mark(node)
        elif node.name == "description":
            kind = one_line(node.text_of("type") or "")
            self.unknowns.tell(f"description of type '{kind}'", node.place)
        elif not _is_referring(node):
            super().perform(node)

    def _mark(self, node: XmlNode) -> None:
        self.at_edge = True
        name = (node.text_of("id") or node.text_of("name") or "").rpartition(":")[2]
        if not name:
            node.required("id", 'id="tm1"')
        if any(sync.name == name for sync in self.syncs):
            raise InputError(f"sync point '{one_line(name)}' is set twice; expected it once", node.place)
        for boundary in self.tones.get((self.speech, name), ()):
            self._bound(boundary)
        self.name_place(name, node)

    def _bound(self, node: XmlNode) -> None:
        """End a phrase; the boundary may say how long its pause is: up to its end."""
        self.bound(label_of(node.required("type", 'type="LL"'), "boundary"), node)
        start, end = node.get("start"), node.get("end")
        if start is None or end is None:
            return
        first, last = read_reference(start), read_reference(end)
        if first.point == last.point and last.seconds > first.seconds:
            self.pause(last.seconds - first.seconds, node)
