"""BML 1.0 blocks: speech with sync points, and behaviours of face, gaze and head around it.

A new behaviour is a function from a behaviour's node and its times to marks, and its line in `BEHAVIOURS`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from ..core.action_units import resolve_targets
from ..core.parameters import INDEX, PARAMETERS
from ..errors import InputError, Place, RisoriusError, unknown
from ..rules.bml import bml_table
from ..rules.markup import markup_table
from ..rules.timing import channel_timing
from .anchor import Anchor, Base
from .apart import check_apart
from .directions import Directions, Sync
from .gestures import strokes_of
from .model import WHOLE, Mark, MarkKind, Script, SpokenLine, Stroke, script_of
from .quote import one_line
from .speakable import check_speakable
from .ssml import ROOT as SSML_ROOT
from .ssml import Writer
from .sync import Behaviour, Timetable, read_reference
from .tree import Node, Unknowns, read_tree

ROOT = "bml"
SPEECH = "speech"
SSML_TYPE = "application/ssml+xml"
_MOST_REPETITIONS = 10
_USUAL_AMOUNT = 0.5
_SHIFT_SECONDS = 0.4
_HEAD_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")


def parse_bml(text: str, source: str = "text") -> Script:
    """Return the script of a BML block.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected;
    warns (ScriptWarning) of what is not understood.
    """
    reading = _Reading(source)
    for node in read_tree(text, source, ROOT).elements():
        reading.add(node)
    return reading.script()


@dataclass
class _Reading:
    """What has been read of a block."""

    source: str
    unknowns: Unknowns = field(default_factory=Unknowns)
    behaviours: dict[str, Behaviour] = field(default_factory=dict)
    nodes: dict[str, Node] = field(default_factory=dict)
    lines: dict[str, SpokenLine] = field(default_factory=dict)

    def add(self, node: Node) -> None:
        """Take up a behaviour, a constraint, or what a container holds."""
        if node.name == "required":
            for child in node.elements():
                self.add(child)
        elif node.name == "constraint":
            for child in node.elements():
                self._constrain(child)
        elif node.name == "face":
            for child in node.elements():
                self.add(_with_attributes(child, node))
        elif node.name == SPEECH:
            self._speak(node)
        elif node.name in SHAPES:
            self._behave(node)
        else:
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place)

    def _behave(self, node: Node) -> None:
        name = self._name(node)
        behaviour = Behaviour(name, node.place, SHAPES[node.name](node))
        for point in behaviour.shape:
            if (attribute := node.get(point)) is not None:
                behaviour.given[point] = read_reference(attribute)
        self.behaviours[name] = behaviour
        self.nodes[name] = node

    def _name(self, node: Node) -> str:
        given = node.get("id")
        name = given.value.strip() if given is not None else f"{node.name}.{len(self.behaviours) + 1}"
        if name in self.behaviours:
            place = given.place if given is not None else node.place
            raise InputError(f"id '{one_line(name)}' is given twice; expected another", place)
        return name

    def _speak(self, node: Node) -> None:
        name = self._name(node)
        offset = sum(len(line.text) + 1 for line in self.lines.values())
        text, directions = _words(node, self.unknowns)
        check_speakable(text, self.source, node.place)
        if (end := node.get("end")) is not None:
            self.unknowns.tell("end of <speech>", end.place)
        begin = node.get("start")
        line = SpokenLine(text, None, node.place, directions=directions)
        reference = read_reference(begin) if begin is not None else None
        self.lines[name] = line
        fixed = {sync.name: _in_text(sync, text, offset) for sync in directions.syncs}
        fixed["start"] = Anchor(Base.TEXT, 0.0, character=offset, place=node.place)
        fixed["end"] = Anchor(Base.TEXT_END, 0.0, character=offset + len(text), place=node.place)
        given = {"start": reference} if reference is not None else {}
        self.behaviours[name] = Behaviour(name, node.place, {}, given, fixed)

    def _constrain(self, node: Node) -> None:
        if node.name not in ("synchronize", "after", "before"):
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place)
            return
        reference = read_reference(node.required("ref", 'ref="speech1:start"'))
        for child in node.elements():
            target = read_reference(child.required("ref", 'ref="gaze1:start"'))
            if child.name != "sync" or target.point is None:
                raise InputError(f'<{child.name}>: expected e.g. <sync ref="gaze1:start" />', child.place)
            name, point = target.point
            if name not in self.behaviours:
                raise InputError(
                    unknown("behaviour", one_line(name), self.behaviours or ("none",)), target.place
                )
            if point not in self.behaviours[name].shape:
                known = (*self.behaviours[name].shape,) or ("none that can be moved",)
                raise InputError(unknown(f"sync point of '{name}'", one_line(point), known), target.place)
            # "after" and "before" hold at the moment itself too; a point that is given stays.
            moved = replace(reference, seconds=reference.seconds - target.seconds)
            if node.name == "synchronize" or point not in self.behaviours[name].given:
                self.behaviours[name].given[point] = moved

    def script(self) -> Script:
        """Return what has been read, all references resolved."""
        table = Timetable(self.behaviours)
        marks = [mark for name in self.nodes for mark in self._marks(name, table)]
        check_apart((mark, mark.start) for mark in marks)
        if not marks and not self.lines:
            raise InputError("nothing is said or shown; expected a behaviour", Place(self.source, 1))
        lines = tuple(self._placed(name) for name in self.lines)
        return script_of(lines, tuple(marks), timed=True, source=self.source)

    def _marks(self, name: str, table: Timetable) -> Iterator[Mark]:
        node = self.nodes[name]
        times = _Times(name, table, self.behaviours[name])
        try:
            yield from BEHAVIOURS[node.name](node, times, self.unknowns)
        except RisoriusError as error:
            raise error.at(node.place) from None

    def _placed(self, name: str) -> SpokenLine:
        """Return a spoken line with its time: seconds, or how long after the one before."""
        line = self.lines[name]
        begin = self.behaviours[name].given.get("start")
        if begin is None:
            return line
        if begin.point is None:
            return replace(line, start=begin.seconds)
        names = list(self.lines)
        before = names[names.index(name) - 1] if names.index(name) else None
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


def _with_attributes(child: Node, container: Node) -> Node:
    """Return a child of a container, which gives it its sync points and amount unless it has its own."""
    own = {a.name for a in child.attributes}
    given = (a for a in container.attributes if a.name not in own and a.name not in ("id",))
    return replace(child, attributes=(*child.attributes, *given))


class _SpeechWriter(Writer):
    """Writes a speech's text; `<sync id="tm1"/>` names a place in it."""

    def perform(self, node: Node) -> None:
        """Do what an element asks for."""
        if node.name != "sync":
            super().perform(node)
            return
        name = node.required("id", 'id="tm1"').value.strip()
        if any(sync.name == name for sync in self.syncs):
            raise InputError(f"sync point '{one_line(name)}' is set twice; expected it once", node.place)
        self.syncs.append(Sync(name, len(self.text), node.place))


def _words(node: Node, unknowns: Unknowns) -> tuple[str, Directions]:
    """Return what a speech says: its SSML where it has some, else its text."""
    parts = [child for child in node.children if isinstance(child, Node)]
    writer = _SpeechWriter(unknowns)
    for part in parts:
        if part.name == "description" and (part.text_of("type") or SSML_TYPE) == SSML_TYPE:
            inner = [c for c in part.children if isinstance(c, Node) and c.name == SSML_ROOT]
            for speak in inner:
                writer.write(speak)
            if inner:
                return writer.finished()
        elif part.name == "description":
            unknowns.tell(f"description of type '{one_line(part.text_of('type') or '')}'", part.place)
        elif part.name != "text":
            unknowns.tell(f"<{one_line(part.name)}> in <speech>", part.place)
    texts = [part for part in parts if part.name == "text"]
    if not texts:
        raise InputError("<speech>: text is missing; expected <text>Hello.</text>", node.place)
    writer.write(texts[0])
    return writer.finished()


def _in_text(sync: Sync, text: str, offset: int) -> Anchor:
    if sync.at >= len(text):
        return Anchor(Base.TEXT_END, 0.0, character=offset + len(text), place=sync.place)
    return Anchor(Base.TEXT, 0.0, character=offset + sync.at, place=sync.place)


@dataclass(frozen=True)
class _Times:
    """A behaviour's name and when its sync points are reached."""

    name: str
    table: Timetable
    behaviour: Behaviour

    def at(self, point: str) -> Anchor:
        return self.table.anchor(self.name, point)

    def between(self, a: str, b: str, usual: float) -> float:
        """Return the seconds from one point to another, `usual` where that depends on the speech."""
        first, second = self.at(a), self.at(b)
        return max(second.seconds - first.seconds, 0.0) if first.same_base(second) else usual

    def span(self, node: Node) -> tuple[Anchor, Anchor]:
        """Return start and end; raise InputError where they are the wrong way round."""
        start, end = self.at("start"), self.at("end")
        if start.same_base(end) and not start.seconds < end.seconds:
            raise InputError(f"'{self.name}' ends at {end}, not after its start at {start}", node.place)
        return start, end


def _mark(node: Node, times: _Times, kind: MarkKind, channel: str, targets: Mapping[str, float]) -> Mark:
    """Return a mark from the behaviour's start to its end."""
    return Mark(kind, channel, *times.span(node), targets, _label(node, times.name), node.place)


def _label(node: Node, name: str) -> str:
    shown = " ".join(f'{a.name}="{a.value}"' for a in node.attributes if a.name in ("lexeme", "au", "target"))
    return one_line(f"{node.name} {name} {shown}".strip(), 80)


def _faded(mark: Mark, times: _Times) -> Mark:
    """Return a mark of the face with the onset and offset that its sync points give."""
    timing = channel_timing(mark.channel)
    onset = times.between("start", "attackPeak", timing.onset)
    offset = times.between("relax", "end", timing.offset)
    return replace(mark, onset=onset, offset=offset, layer=times.name)


def _units(node: Node) -> dict[str, float]:
    """Return the targets of a lexeme or an action unit."""
    amount = node.number("amount", 0.0, 1.0, _USUAL_AMOUNT)
    if node.name == "faceFacs" or node.get("au") is not None:
        au = node.required("au", 'au="12"')
        side = node.choice("side", ("BOTH", "LEFT", "RIGHT"), "BOTH")
        name = f"AU{au.value.strip()}" + ("" if side == "BOTH" else f".{side.lower()}")
        try:
            return resolve_targets({name: amount})
        except RisoriusError as error:
            raise error.at(au.place) from None
    lexemes = bml_table().lexeme
    node.required("lexeme", 'lexeme="RAISE_BROWS"')
    chosen = lexemes[node.choice("lexeme", tuple(lexemes), "")]
    return resolve_targets({unit: amount * value for unit, value in chosen.items()})


def _face(node: Node, times: _Times, unknowns: Unknowns) -> Iterator[Mark]:
    yield _faded(_mark(node, times, MarkKind.MOVEMENT, "signals", _units(node)), times)


def _face_shift(node: Node, times: _Times, unknowns: Unknowns) -> Iterator[Mark]:
    for child in list(node.elements()) or [node]:
        own = _with_attributes(child, node)
        mark = _mark(node, times, MarkKind.MOVEMENT, "emotion", _units(own))
        onset = times.between("start", "end", _SHIFT_SECONDS)
        yield _lasting(replace(mark, onset=onset, layer=times.name))


def _lasting(mark: Mark) -> Mark:
    return replace(mark, end=Anchor(Base.END, 0.0, place=mark.place))


def _direction(node: Node, unknowns: Unknowns) -> tuple[float, float]:
    """Return pitch and yaw in degrees of a target, its offset included."""
    known = markup_table().gaze
    given = node.required("target", 'target="listener"')
    target = known.get(given.value.strip().lower())
    if target is None:
        unknowns.tell(f"target '{one_line(given.value)}'", given.place, "the listener stands for it")
        target = known["listener"]
    angle = node.number("offsetAngle", -90.0, 90.0, 0.0)
    directions = bml_table().direction
    if (node.text_of("offsetDirection") or "").upper() == "POLAR":
        unknowns.tell("offsetDirection 'POLAR'", given.place)
        return target.pitch, target.yaw
    heading = directions[node.choice("offsetDirection", tuple(directions), "RIGHT")]
    return target.pitch + angle * heading.pitch, target.yaw + angle * heading.yaw


def _limited(values: Mapping[str, float]) -> dict[str, float]:
    parameters = {name: PARAMETERS[INDEX[name]] for name in values}
    return {
        name: min(max(value, parameters[name].low), parameters[name].high) for name, value in values.items()
    }


def _gaze(node: Node, times: _Times, unknowns: Unknowns) -> Iterator[Mark]:
    influences = bml_table().influence
    influence = node.choice("influence", tuple(influences), "EYES")
    if influence in ("SHOULDER", "WAIST", "WHOLE"):
        unknowns.tell(f"influence '{influence}'", node.place, "the head turns instead")
    pitch, yaw = _direction(node, unknowns)
    share = influences[influence]
    eyes = {"gaze_pitch": (1.0 - share) * pitch, "gaze_yaw": (1.0 - share) * yaw}
    yield _mark(node, times, MarkKind.GAZE, "gaze", _limited(eyes))
    if share:
        head = {"head_pitch": share * pitch, "head_yaw": share * yaw}
        yield _mark(node, times, MarkKind.HEAD, "head", _limited(head))


def _gaze_shift(node: Node, times: _Times, unknowns: Unknowns) -> Iterator[Mark]:
    yield from (_lasting(mark) for mark in _gaze(node, times, unknowns))


def _gesture(node: Node) -> tuple[tuple[Stroke, ...], dict[str, float], float]:
    """Return the strokes, targets and seconds of a head's lexeme."""
    gestures = markup_table().head
    node.required("lexeme", 'lexeme="NOD"')
    gesture = gestures[node.choice("lexeme", tuple(gestures), "nod")]
    times = int(node.number("repetition", 1, _MOST_REPETITIONS, 1))
    size = gesture.amplitude * node.number("amount", 0.0, 1.0, _USUAL_AMOUNT) / _USUAL_AMOUNT
    strokes = strokes_of(gesture, times)
    return strokes, _limited({gesture.parameter: size}), gesture.seconds * (len(strokes) + 1)


def _head(node: Node, times: _Times, unknowns: Unknowns) -> Iterator[Mark]:
    strokes, targets, _ = _gesture(node)
    mark = _mark(node, times, MarkKind.HEAD, "head", targets)
    yield replace(mark, strokes=strokes, layer="gesture")


def _head_shift(node: Node, times: _Times, unknowns: Unknowns) -> Iterator[Mark]:
    pitch, yaw = _direction(node, unknowns)
    targets = _limited({"head_pitch": pitch, "head_yaw": yaw})
    mark = _mark(node, times, MarkKind.HEAD, "head", targets)
    onset = times.between("start", "end", _SHIFT_SECONDS)
    yield replace(_lasting(mark), onset=onset, strokes=WHOLE)


Performer = Callable[[Node, _Times, Unknowns], Iterator[Mark]]
BEHAVIOURS: Mapping[str, Performer] = {
    "faceLexeme": _face,
    "faceFacs": _face,
    "faceShift": _face_shift,
    "gaze": _gaze,
    "gazeShift": _gaze_shift,
    "head": _head,
    "headDirectionShift": _head_shift,
}


def _face_shape(node: Node) -> Mapping[str, float]:
    timing, length = channel_timing("signals"), bml_table().duration.face
    return {"start": 0.0, "attackPeak": timing.onset, "relax": length - timing.offset, "end": length}


def _gaze_shape(node: Node) -> Mapping[str, float]:
    timing, length = channel_timing("gaze"), bml_table().duration.gaze
    return {"start": 0.0, "ready": timing.onset, "relax": length - timing.offset, "end": length}


def _shift_shape(node: Node) -> Mapping[str, float]:
    return {"start": 0.0, "end": _SHIFT_SECONDS}


def _head_shape(node: Node) -> Mapping[str, float]:
    _, _, seconds = _gesture(node)
    # Ready at the start; the strokes lie in the middle, and the last swing leads back to rest.
    shares = (0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0)
    return {point: share * seconds for point, share in zip(_HEAD_POINTS, shares, strict=True)}


SHAPES: Mapping[str, Callable[[Node], Mapping[str, float]]] = {
    "faceLexeme": _face_shape,
    "faceFacs": _face_shape,
    "faceShift": _shift_shape,
    "gaze": _gaze_shape,
    "gazeShift": _shift_shape,
    "head": _head_shape,
    "headDirectionShift": _shift_shape,
}
"""The sync points of each behaviour in seconds after its start."""
