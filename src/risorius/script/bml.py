"""BML 1.0 blocks: speech with sync points, and behaviours of face, gaze and head around it.

A new behaviour is a function in `bml_behaviours`, and its lines there and in `bml_shapes`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

from ..core.directions import Directions
from ..errors import InputError, Place, RisoriusError, unknown
from .anchor import Anchor, Base
from .apart import check_apart
from .bml_behaviours import BEHAVIOURS, Times
from .bml_shapes import ANY, ATTRIBUTES, SHAPES
from .bml_speech import in_text, read_words
from .model import Mark, Script, SpokenLine, script_of
from .quote import one_line
from .speakable import check_speakable
from .sync import Behaviour, Timetable, read_reference
from .tree import Unknowns, XmlNode, read_tree

ROOT = "bml"
SPEECH = "speech"


def parse_bml(text: str, source: str = "text") -> Script:
    """Return the script of a BML block.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected;
    warns (ScriptWarning) of what is not understood.
    """
    reading = BmlReading(source)
    for node in read_tree(text, source, ROOT).elements():
        reading.add(node)
    return reading.script(reading.table())


@dataclass
class BmlReading:
    """The content of a block, as far as it has been read. A dialect has readings of its own."""

    source: str
    unknowns: Unknowns = field(default_factory=Unknowns)
    behaviours: dict[str, Behaviour] = field(default_factory=dict)
    nodes: dict[str, XmlNode] = field(default_factory=dict)
    lines: dict[str, SpokenLine] = field(default_factory=dict)
    constraints: list[XmlNode] = field(default_factory=list)
    characters: int = 0

    def add(self, node: XmlNode) -> None:
        """Take up a behaviour, a constraint, or the contents of a container."""
        if node.name == "required":
            for child in node.elements():
                self.add(child)
        elif node.name == "constraint":
            self.constraints += node.elements()
        elif node.name == "face":
            self._face(node)
        elif node.name == SPEECH:
            self._speak(node)
        elif node.name in SHAPES:
            self._behave(node)
        else:
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place)

    def _face(self, node: XmlNode) -> None:
        """Take up the contents of a face, or, if it is empty, the face itself."""
        children = list(node.elements())
        kind = "faceFacs" if node.get("au") is not None else "faceLexeme"
        for child in children or [replace(node, name=kind)]:
            self.add(child.inheriting(node))

    def _behave(self, node: XmlNode) -> None:
        name = self.name_of(node)
        self.unknowns.check(node, (*ANY, *SHAPES[node.name](node), *ATTRIBUTES[node.name]))
        behaviour = Behaviour(name, node.place, SHAPES[node.name](node))
        for point in behaviour.shape:
            if (attribute := node.get(point)) is not None:
                behaviour.given[point] = read_reference(attribute)
        self.behaviours[name] = behaviour
        self.nodes[name] = node

    def name_of(self, node: XmlNode) -> str:
        """Return a behaviour's name: its id, or one of its kind and number."""
        own_name = node.get("id")
        name = own_name.value.strip() if own_name is not None else f"{node.name}.{len(self.behaviours) + 1}"
        if name in self.behaviours:
            place = own_name.place if own_name is not None else node.place
            raise InputError(f"id '{one_line(name)}' is given twice; expected another", place)
        return name

    def _speak(self, node: XmlNode) -> None:
        name = self.name_of(node)
        offset = self.characters
        text, directions = self.words_of(name, node)
        check_speakable(text, self.source, node.place)
        if (end := node.get("end")) is not None:
            self.unknowns.tell("end of <speech>", end.place)
        begin = node.get("start")
        line = SpokenLine(text, None, node.place, directions=directions)
        reference = read_reference(begin) if begin is not None else None
        self.lines[name] = line
        self.characters += len(text) + 1
        fixed = {sync.name: in_text(sync, text, offset) for sync in directions.syncs}
        fixed["start"] = Anchor(Base.TEXT, 0.0, character=offset, place=node.place)
        fixed["end"] = Anchor(Base.TEXT_END, 0.0, character=offset + len(text), place=node.place)
        references = {"start": reference} if reference is not None else {}
        self.behaviours[name] = Behaviour(name, node.place, {}, references, fixed)

    def words_of(self, name: str, node: XmlNode) -> tuple[str, Directions]:
        """Return the words of the speech `name`."""
        return read_words(node, self.unknowns)

    def _constrain(self, node: XmlNode) -> None:
        """Let points of behaviours follow another point."""
        if node.name not in ("synchronize", "after", "before"):
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place)
            return
        reference = read_reference(node.required("ref", 'ref="speech1:start"'))
        for child in node.elements():
            behaviour, point, seconds = self._point(child)
            if node.name != "synchronize" and point in behaviour.given:
                self.unknowns.tell(f"<{node.name}> for a point with a time", child.place, "the point stays")
                continue
            # "after" and "before" hold at the very moment, too.
            behaviour.given[point] = replace(reference, seconds=reference.seconds - seconds)

    def _point(self, node: XmlNode) -> tuple[Behaviour, str, float]:
        """Return the point that a constraint's `<sync ref="…">` names, and the seconds it names after it."""
        target = read_reference(node.required("ref", 'ref="gaze1:start"'))
        if node.name != "sync" or target.point is None:
            raise InputError(f'<{node.name}>: expected e.g. <sync ref="gaze1:start" />', node.place)
        name, point = target.point
        if name not in self.behaviours:
            known: tuple[str, ...] = tuple(self.behaviours) or ("none",)
            raise InputError(unknown("behaviour", one_line(name), known), target.place)
        shape = self.behaviours[name].shape
        if point not in shape:
            known = tuple(shape) or ("none that can be moved",)
            raise InputError(unknown(f"sync point of '{name}'", one_line(point), known), target.place)
        return self.behaviours[name], point, target.seconds

    def table(self) -> Timetable:
        """Return when all points are reached that have been read."""
        for node in self.constraints:
            self._constrain(node)
        return Timetable(self.behaviours)

    def script(self, table: Timetable) -> Script:
        """Return the script that has been read, all references resolved."""
        marks = [mark for name in self.nodes for mark in self.marks_of(name, table)]
        check_apart((mark, mark.start) for mark in marks)
        if not marks and not self.lines:
            raise InputError("the script has no behaviour; expected at least one", Place(self.source, 1))
        lines = tuple(self._placed(name, before) for before, name in pairwise((None, *self.lines)) if name)
        return script_of(lines, tuple(marks), timed=True, source=self.source)

    def marks_of(self, name: str, table: Timetable) -> Iterator[Mark]:
        """Yield the marks of the behaviour `name`."""
        node = self.nodes[name]
        times = Times(name, table)
        try:
            yield from BEHAVIOURS[node.name](node, times, self.unknowns)
        except RisoriusError as error:
            raise error.at(node.place) from None

    def _placed(self, name: str, before: str | None) -> SpokenLine:
        """Return a spoken line with its time: seconds, or how long after the one `before`."""
        line = self.lines[name]
        begin = self.behaviours[name].given.get("start")
        if begin is None:
            return line
        if begin.point is None:
            return replace(line, start=begin.seconds)
        if begin.point[0] not in self.behaviours:
            raise InputError(unknown("behaviour", one_line(begin.point[0]), self.behaviours), begin.place)
        if begin.point[0] == name:
            raise InputError(
                f"a cycle of sync references: {name}:start → {':'.join(begin.point)}", begin.place
            )
        if begin.point != (before, "end") or begin.seconds < 0.0:
            message = "speech starts at a time or after the end of the speech before; expected e.g. "
            raise InputError(f'{message}start="{before or "speech1"}:end+0.5"', begin.place)
        return replace(line, gap=begin.seconds)
