"""Changes of a score by hand: blocks moved, stretched, retargeted, added and deleted, curves drawn.

An edit is data, and `edited` is a function from a score to a score. Scores are frozen, so undo returns to the
earlier score, and the same edits can be applied to a score that was planned again. A movement keeps its id
through all edits, and its cause, which then says that it was changed by hand.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ..errors import InputError, unknown
from .action_units import kept_units
from .functions import DEFAULT_FUNCTION
from .key_shapes import KeyShape
from .movement import Cause, ManualCurve, Movement
from .parameters import parameters_named
from .score import Score, check_score
from .units import Seconds

BY_HAND = "by hand"
CHANGED = f"changed {BY_HAND}"
# Channels whose entries are not movements.
_NOT_MOVED = ("lips", "manual")


@dataclass(frozen=True, slots=True)
class Move:
    """Move a block so that it starts at `start`."""

    movement: str
    start: Seconds


@dataclass(frozen=True, slots=True)
class Stretch:
    """Change the times of a block; None leaves a time as it is. Onset, offset: seconds of rise and fall."""

    movement: str
    start: Seconds | None = None
    end: Seconds | None = None
    onset: Seconds | None = None
    offset: Seconds | None = None


@dataclass(frozen=True, slots=True)
class Retarget:
    """Change the targets of a block, by parameter, action unit or alias, or its priority."""

    movement: str
    targets: Mapping[str, float] | None = None
    priority: float | None = None


@dataclass(frozen=True, slots=True)
class Add:
    """Add a block. Targets are parameters, action units or aliases.

    Without `layer` it gets a layer of its own, so that no other block of its channel interrupts it; without
    `id` it gets the next free one, without `priority` that of its channel.
    """

    channel: str
    start: Seconds
    end: Seconds
    targets: Mapping[str, float]
    onset: Seconds = 0.1
    offset: Seconds = 0.2
    layer: str | None = None
    function: str | None = None
    id: str | None = None
    priority: float | None = None


@dataclass(frozen=True, slots=True)
class Delete:
    """Delete a block."""

    movement: str


@dataclass(frozen=True, slots=True)
class Keys:
    """Draw a parameter's curve by hand: keys [time, value] with increasing times replace earlier keys.

    A name without its side means both sides. `replaces`: from the first key to the last, the curve replaces
    all other channels; else the highest value shows. `shapes`: how it passes each key;
    none is straight.
    """

    parameter: str
    keys: tuple[tuple[float, float], ...]
    replaces: bool = True
    shapes: tuple[KeyShape, ...] = ()


@dataclass(frozen=True, slots=True)
class ClearKeys:
    """Delete the curves drawn by hand for a parameter; a name without its side means both sides."""

    parameter: str


Edit = Move | Stretch | Retarget | Add | Delete | Keys | ClearKeys


def edited(score: Score, edit: Edit) -> Score:
    """Return the score after an edit, checked like any score.

    Raises InputError or ParameterError, with the block's name, if the block does not exist or the result
    cannot be performed.
    """
    changed = _MAKE[type(edit)](score, edit)
    check_score(changed)
    return changed


def named(score: Score, edit: Edit) -> Edit:
    """Return an edit that has the same effect on other scores: a new block gets its id now."""
    if not isinstance(edit, Add) or edit.id is not None:
        return edit
    taken = {m.id for m in score.movements}
    number = 1
    while f"hand.{number}" in taken:
        number += 1
    return replace(edit, id=f"hand.{number}")


def is_edited(movement: Movement) -> bool:
    """Return whether a movement was changed or added by hand."""
    return movement.cause.rule == BY_HAND or movement.cause.place.endswith(CHANGED)


def _changed(m: Movement, **values: Any) -> Movement:
    """Return a movement with other values; its cause says once that it was changed."""
    cause = m.cause
    if not is_edited(m):
        cause = replace(cause, place=f"{cause.place}, {CHANGED}" if cause.place else CHANGED)
    return replace(m, cause=cause, **values)


def _with(score: Score, name: str, change: Callable[[Movement], Movement | None]) -> Score:
    """Return the score with one movement changed, or without it if `change` returns None."""
    if all(m.id != name for m in score.movements):
        raise InputError(unknown("block", name, (m.id for m in score.movements)))
    changed = (change(m) if m.id == name else m for m in score.movements)
    return replace(score, movements=tuple(m for m in changed if m is not None))


def _move(score: Score, edit: Move) -> Score:
    def moved(m: Movement) -> Movement:
        return _placed(score, _changed(m, start=edit.start, end=edit.start + (m.end - m.start)))

    return _with(score, edit.movement, moved)


def _stretch(score: Score, edit: Stretch) -> Score:
    times = {name: getattr(edit, name) for name in ("start", "end", "onset", "offset")}
    values = {name: value for name, value in times.items() if value is not None}
    return _with(score, edit.movement, lambda m: _placed(score, _changed(m, **values)))


def _placed(score: Score, m: Movement) -> Movement:
    if m.start >= score.duration:
        raise InputError(
            f"movement '{m.label}' would start at {m.start:g} s, after the end at {score.duration:g} s"
        )
    return m


def _retarget(score: Score, edit: Retarget) -> Score:
    values: dict[str, Any] = {}
    if edit.targets is not None:
        values["targets"] = kept_units(edit.targets)
    if edit.priority is not None:
        values["priority"] = edit.priority
    return _with(score, edit.movement, lambda m: _changed(m, **values))


def _add(score: Score, edit: Add) -> Score:
    if edit.channel in _NOT_MOVED:
        raise InputError(f"a block cannot be added to channel {edit.channel}; draw keys instead")
    named_edit = named(score, edit)
    assert isinstance(named_edit, Add)
    name = str(named_edit.id)
    if any(m.id == name for m in score.movements):
        raise InputError(f"block '{name}' already exists; expected another id")
    added = Movement(
        edit.channel,
        edit.start,
        edit.end,
        edit.onset,
        edit.offset,
        kept_units(edit.targets),
        id=name,
        layer=name if edit.layer is None else edit.layer,
        function=edit.function or DEFAULT_FUNCTION,
        priority=edit.priority,
        cause=Cause(BY_HAND, "added"),
    )
    _placed(score, added)
    before = score.movements
    place = next((i for i, m in enumerate(before) if m.start > added.start), len(before))
    return replace(score, movements=(*before[:place], added, *before[place:]))


def _delete(score: Score, edit: Delete) -> Score:
    return _with(score, edit.movement, lambda m: None)


def _keys(score: Score, edit: Keys) -> Score:
    names = [p.name for p in parameters_named(edit.parameter)]
    if edit.keys and not (edit.keys[0][0] >= 0.0 and edit.keys[-1][0] <= score.duration):
        raise InputError(
            f"keys of {edit.parameter} lie outside the clip; expected times from 0 to {score.duration:g} s"
        )
    others = _undrawn(score, names)
    shapes = dict.fromkeys(names, edit.shapes) if edit.shapes else {}
    curve = ManualCurve(dict.fromkeys(names, edit.keys), Cause(BY_HAND, "drawn"), edit.replaces, shapes)
    return replace(score, manual=(*others, curve))


def _clear(score: Score, edit: ClearKeys) -> Score:
    others = _undrawn(score, [p.name for p in parameters_named(edit.parameter)])
    if others == score.manual:
        raise InputError(f"no curve is drawn by hand for '{edit.parameter}'")
    return replace(score, manual=others)


def _undrawn(score: Score, names: Collection[str]) -> tuple[ManualCurve, ...]:
    """Return the drawn curves without those of some parameters."""
    curves = []
    for curve in score.manual:
        keys = {name: keys for name, keys in curve.keys.items() if name not in names}
        if keys:
            shapes = {name: shapes for name, shapes in curve.shapes.items() if name in keys}
            curves.append(curve if len(keys) == len(curve.keys) else replace(curve, keys=keys, shapes=shapes))
    return tuple(curves)


_MAKE: dict[type, Callable[[Score, Any], Score]] = {
    Move: _move,
    Stretch: _stretch,
    Retarget: _retarget,
    Add: _add,
    Delete: _delete,
    Keys: _keys,
    ClearKeys: _clear,
}


def identified(score: Score) -> Score:
    """Return the score with a unique id for every movement; the first movement with an id keeps it.

    Other movements are named by channel, layer and start, or by their id and a number.
    """
    proposed = [m.id or _by_place(m) for m in score.movements]
    names = _distinct(proposed, {m.id for m in score.movements if m.id})
    pairs = zip(score.movements, names, strict=True)
    return replace(score, movements=tuple(m if m.id == name else replace(m, id=name) for m, name in pairs))


def _by_place(m: Movement) -> str:
    return ".".join(part for part in (m.channel, m.layer) if part) + f"@{m.start:.3f}"


def _distinct(names: list[str], existing: set[str]) -> Iterator[str]:
    seen: Counter[str] = Counter()
    taken = set(existing)
    for name in names:
        seen[name] += 1
        number, own = seen[name], name
        while number > 1 and (own := f"{name}#{number}") in taken:
            number += 1
        taken.add(own)
        yield own
