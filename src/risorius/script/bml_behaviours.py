"""BML's behaviours: each is a function from its node and its times to marks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

from ..core.action_units import kept_units
from ..core.channels import channel_timing
from ..errors import InputError, RisoriusError
from ..rules.bml import bml_table
from ..rules.markup import markup_table
from .anchor import Anchor, Base
from .bml_shapes import PEAKS, SHIFT_SECONDS, USUAL_AMOUNT, gesture_of, limited
from .model import WHOLE, Mark, MarkKind
from .quote import one_line
from .sync import Timetable
from .tree import Unknowns, XmlNode


@dataclass(frozen=True)
class Times:
    """A behaviour's name and when its sync points are reached."""

    name: str
    table: Timetable

    def at(self, point: str) -> Anchor:
        """Return when a sync point is reached."""
        return self.table.anchor(self.name, point)

    def between(self, a: str, b: str, usual: float) -> float:
        """Return the seconds from one point to another, `usual` if that depends on the speech."""
        first, second = self.at(a), self.at(b)
        return max(second.seconds - first.seconds, 0.0) if first.same_base(second) else usual

    def span(self, node: XmlNode) -> tuple[Anchor, Anchor]:
        """Return start and end; raise InputError if they are the wrong way round."""
        start, end = self.at("start"), self.at("end")
        if start.same_base(end) and not start.seconds < end.seconds:
            raise InputError(f"'{self.name}' ends at {end}, not after its start at {start}", node.place)
        return start, end


def _mark(node: XmlNode, times: Times, kind: MarkKind, channel: str, targets: Mapping[str, float]) -> Mark:
    """Return a mark from the behaviour's start to its end."""
    return Mark(kind, channel, *times.span(node), targets, _label(node, times.name), node.place)


def _label(node: XmlNode, name: str) -> str:
    shown = " ".join(f'{a.name}="{a.value}"' for a in node.attributes if a.name in ("lexeme", "au", "target"))
    return one_line(f"{node.name} {name} {shown}".strip(), 80)


def _faded(mark: Mark, times: Times) -> Mark:
    """Return a mark of the face with the onset and offset that its sync points give."""
    timing = channel_timing(mark.channel)
    onset = times.between("start", PEAKS["face"], timing.onset)
    offset = times.between("relax", "end", timing.offset)
    return replace(mark, onset=onset, offset=offset, layer=times.name)


def _units(node: XmlNode) -> dict[str, float]:
    """Return the targets of a lexeme or an action unit."""
    amount = node.number("amount", 0.0, 1.0, USUAL_AMOUNT)
    if node.name == "faceFacs" or node.get("au") is not None:
        au = node.required("au", 'au="12"')
        side = node.choice("side", ("BOTH", "LEFT", "RIGHT"), "BOTH")
        name = f"AU{au.value.strip()}" + ("" if side == "BOTH" else f".{side.lower()}")
        try:
            return kept_units({name: amount})
        except RisoriusError as error:
            raise error.at(au.place) from None
    lexemes = bml_table().lexeme
    node.required("lexeme", 'lexeme="RAISE_BROWS"')
    chosen = lexemes[node.choice("lexeme", tuple(lexemes), "")]
    return kept_units({unit: amount * value for unit, value in chosen.items()})


def _face(node: XmlNode, times: Times, unknowns: Unknowns) -> Iterator[Mark]:
    yield _faded(_mark(node, times, MarkKind.MOVEMENT, "signals", _units(node)), times)


def _face_shift(node: XmlNode, times: Times, unknowns: Unknowns) -> Iterator[Mark]:
    for child in list(node.elements()) or [node]:
        own = child.inheriting(node)
        mark = _mark(node, times, MarkKind.MOVEMENT, "emotion", _units(own))
        onset = times.between("start", "end", SHIFT_SECONDS)
        yield _lasting(replace(mark, onset=onset, layer=times.name))


def _lasting(mark: Mark) -> Mark:
    return replace(mark, end=Anchor(Base.END, 0.0, place=mark.place))


def _direction(node: XmlNode, unknowns: Unknowns) -> tuple[float, float]:
    """Return pitch and yaw in degrees of a target, its offset included."""
    known = markup_table().gaze
    target_name = node.required("target", 'target="listener"')
    target = known.get(target_name.value.strip().lower())
    if target is None:
        unknowns.tell(
            f"target '{one_line(target_name.value)}'", target_name.place, "the listener stands for it"
        )
        target = known["listener"]
    angle = node.number("offsetAngle", -90.0, 90.0, 0.0)
    directions = bml_table().direction
    if (node.text_of("offsetDirection") or "").upper() == "POLAR":
        unknowns.tell("offsetDirection 'POLAR'", target_name.place)
        return target.pitch, target.yaw
    heading = directions[node.choice("offsetDirection", tuple(directions), "RIGHT")]
    return target.pitch + angle * heading.pitch, target.yaw + angle * heading.yaw


def _gaze(node: XmlNode, times: Times, unknowns: Unknowns) -> Iterator[Mark]:
    influences = bml_table().influence
    influence = node.choice("influence", tuple(influences), "EYES")
    if influence in ("SHOULDER", "WAIST", "WHOLE"):
        unknowns.tell(f"influence '{influence}'", node.place, "the head turns instead")
    pitch, yaw = _direction(node, unknowns)
    share = influences[influence]
    eyes = {"gaze_pitch": (1.0 - share) * pitch, "gaze_yaw": (1.0 - share) * yaw}
    yield _mark(node, times, MarkKind.GAZE, "gaze", limited(eyes))
    if share:
        head = {"head_pitch": share * pitch, "head_yaw": share * yaw}
        yield _mark(node, times, MarkKind.HEAD, "head", limited(head))


def _gaze_shift(node: XmlNode, times: Times, unknowns: Unknowns) -> Iterator[Mark]:
    yield from (_lasting(mark) for mark in _gaze(node, times, unknowns))


def _head(node: XmlNode, times: Times, unknowns: Unknowns) -> Iterator[Mark]:
    parts, targets, _ = gesture_of(node)
    mark = _mark(node, times, MarkKind.HEAD, "head", targets)
    yield replace(mark, parts=parts, layer="gesture")


def _head_shift(node: XmlNode, times: Times, unknowns: Unknowns) -> Iterator[Mark]:
    pitch, yaw = _direction(node, unknowns)
    targets = limited({"head_pitch": pitch, "head_yaw": yaw})
    mark = _mark(node, times, MarkKind.HEAD, "head", targets)
    onset = times.between("start", "end", SHIFT_SECONDS)
    yield replace(_lasting(mark), onset=onset, parts=WHOLE)


BehaviourMarks = Callable[[XmlNode, Times, Unknowns], Iterator[Mark]]
BEHAVIOURS: Mapping[str, BehaviourMarks] = {
    "faceLexeme": _face,
    "faceFacs": _face,
    "faceShift": _face_shift,
    "gaze": _gaze,
    "gazeShift": _gaze_shift,
    "head": _head,
    "headDirectionShift": _head_shift,
}
