"""Edits by hand made again on another plan of a line: they follow its words and phones.

An edit names a movement, and times. The movement is the one of the same channel and layer at the same place
of the same word; each time lies where its phone lies. An edit whose word is gone is lost: it is named, it is
made again as soon as the words are there again, and can be put back before at the nearest place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import cast

from ...core.edits import Add, ClearKeys, Delete, Edit, Keys, Move, Stretch
from ...core.movement import Movement
from ...errors import RisoriusError
from ..wire.marks import Marker
from .revision import LostEdit, Revision, worded
from .word_times import Fit, WordTimes

NEAR = 0.25
"""Seconds from its place at which a movement is still the same one."""
MOST_LOST = 50


class _MisfitEditError(Exception):
    """An edit has no place in the new plan."""


@dataclass(slots=True)
class _Places:
    """The movement and the times of a new plan that correspond to those of the old one."""

    times: WordTimes
    before: Revision
    after: Revision
    found: dict[str, Movement | None]

    def movement(self, name: str) -> Movement | None:
        """Return the movement of the new plan that an old one is."""
        if name not in self.found:
            taken = {m.id for m in self.found.values() if m is not None}
            self.found[name] = self._nearest(name, taken)
        return self.found[name]

    def _nearest(self, name: str, taken: set[str]) -> Movement | None:
        old = next((m for m in self.before.base.movements if m.id == name), None)
        if old is None:
            return None
        fixed = self.before.utterance is self.after.utterance or "@" not in name
        start, fit = self.times.at(old.start)

        def rank(m: Movement) -> tuple[bool, bool, float]:
            return not (fixed and m.id == name), m.cause.rule != old.cause.rule, abs(m.start - start)

        near = [
            m
            for m in self.after.base.movements
            if (m.channel, m.layer) == (old.channel, old.layer)
            and m.id not in taken
            and ((fixed and m.id == name) or (fit > Fit.GONE and abs(m.start - start) <= NEAR))
        ]
        return min(near, key=rank, default=None)


def rebase(before: Revision, after: Revision) -> Revision:
    """Return the new plan `after` with the edits of `before`; edits that do not fit are in its `lost`."""
    version, left = _made(before.edits, before, after, after)
    lost: list[LostEdit] = []
    for entry in before.lost:
        again, still = (version, entry.edits) if entry.origin is None else _retried(entry, after, version)
        if still or entry.origin is None:
            lost.append(entry)
        else:
            version = again
    named = list(_lost(left, before, WordTimes(before.utterance, after.utterance)))
    texts = [entry.text for entry in named if entry.edit is not None]
    warnings = after.warnings
    if texts:
        some = "; ".join(texts[:3]) + ("; …" if len(texts) > 3 else "")
        warnings = (*warnings, f"{len(texts)} of the changes by hand did not fit any more: {some}")
    newest = (*lost, *named)[-MOST_LOST:]
    return replace(
        version,
        warnings=warnings,
        milliseconds=after.milliseconds,
        lost=newest,
        markers=_moved_markers(before, WordTimes(before.utterance, after.utterance), version.score.duration),
        lanes=before.lanes,
    )


def _moved_markers(before: Revision, times: WordTimes, duration: float) -> tuple[Marker, ...]:
    """Return the markers where their words are; those of words that are gone stand where these would."""
    return tuple(replace(marker, time=min(times.at(marker.time)[0], duration)) for marker in before.markers)


def _made(
    edits: Sequence[Edit], before: Revision, plan: Revision, version: Revision
) -> tuple[Revision, list[Edit]]:
    """Return `version`, of the plan `plan`, with the edits of `before` that fit; and those that do not."""
    same = before.utterance is plan.utterance
    places = _Places(WordTimes(before.utterance, plan.utterance), before, plan, {})
    left: list[Edit] = []
    for edit in edits:
        try:
            version = version.changed(edit if same and _is_free(edit) else _translated(edit, places, version))
        except (RisoriusError, _MisfitEditError):
            left.append(edit)
    return version, left


def _retried(entry: LostEdit, plan: Revision, version: Revision) -> tuple[Revision, list[Edit]]:
    assert entry.origin is not None
    return _made(entry.edits, entry.origin, plan, version)


def _is_free(edit: Edit) -> bool:
    """Whether an edit names no movement of the plan."""
    return isinstance(edit, Add | Keys | ClearKeys)


def _translated(edit: Edit, places: _Places, version: Revision) -> Edit:
    """Return an edit as it is in the new plan; raise _MisfitEditError if it has no place there."""
    if isinstance(edit, ClearKeys):
        return edit
    if isinstance(edit, Keys):
        return replace(edit, keys=tuple((_time(at, places, Fit.SAME), value) for at, value in edit.keys))
    if isinstance(edit, Add):
        start = _time(edit.start, places)
        end, fit = places.times.at(edit.end)
        return replace(edit, start=start, end=end if fit and end > start else start + edit.end - edit.start)
    return _of_movement(edit, places, version)


def _of_movement(edit: Edit, places: _Places, version: Revision) -> Edit:
    name = cast(Move, edit).movement
    if all(m.id != name for m in places.before.base.movements):
        # Added by hand: it keeps its name.
        old = new = next((m for m in version.score.movements if m.id == name), None)
    else:
        old = next(m for m in places.before.base.movements if m.id == name)
        new = places.movement(name)
    if old is None or new is None:
        raise _MisfitEditError
    if isinstance(edit, Delete) and old.cause.rule != new.cause.rule:
        raise _MisfitEditError
    moved = replace(cast(Move, edit), movement=new.id)
    shift = new.start - old.start
    if isinstance(edit, Move):
        return replace(edit, movement=new.id, start=_near(edit.start, places, shift))
    if isinstance(edit, Stretch):
        return replace(
            edit,
            movement=new.id,
            start=None if edit.start is None else _near(edit.start, places, shift),
            end=None if edit.end is None else _near(edit.end, places, shift),
        )
    return moved


def _time(time: float, places: _Places, at_least: Fit = Fit.REPLACED) -> float:
    place, fit = places.times.at(time)
    if fit < at_least:
        raise _MisfitEditError
    return place


def _near(time: float, places: _Places, shift: float) -> float:
    """Return where a time of a movement lies: at its phone, else as far from the movement as it was."""
    place, fit = places.times.at(time)
    return place if fit else max(0.0, time + shift)


def _lost(edits: list[Edit], before: Revision, times: WordTimes) -> Iterator[LostEdit]:
    """Yield the results of edits, once for each movement and curve."""
    seen: set[str] = set()
    for edit in edits:
        name = _name(edit)
        if name in seen:
            continue
        seen.add(name)
        text, again = worded(edit, before.score, before.base), _again(name, before, times)
        yield LostEdit(text, again, tuple(e for e in edits if _name(e) == name), before)


def _name(edit: Edit) -> str:
    if isinstance(edit, Keys | ClearKeys):
        return f"curve {edit.parameter}"
    return str(edit.id if isinstance(edit, Add) else edit.movement)


def _again(name: str, before: Revision, times: WordTimes) -> Add | Keys | None:
    """Return the edit that makes a changed movement, or a drawn curve, as it was; None if it was deleted."""
    if name.startswith("curve "):
        return _keys_again(name.removeprefix("curve "), before, times)
    m = next((m for m in before.score.movements if m.id == name), None)
    if m is None:
        return None
    start, _ = times.at(m.start)
    length = m.end - m.start
    return Add(m.channel, start, start + length, m.targets, m.onset, m.offset, function=m.function)


def _keys_again(parameter: str, before: Revision, times: WordTimes) -> Keys | None:
    last = None
    for edit in before.edits:
        if isinstance(edit, Keys | ClearKeys) and edit.parameter == parameter:
            last = edit
    if not isinstance(last, Keys) or not last.keys:
        return None
    shift = times.at(last.keys[0][0])[0] - last.keys[0][0]
    return replace(last, keys=tuple((time + shift, value) for time, value in last.keys))


def restore(version: Revision, number: int) -> Revision:
    """Return the version with something lost made again, as near to its place as the clip has room."""
    entry = version.lost_made[number]
    assert entry.edit is not None
    remaining = replace(version, lost=tuple(other for other in version.lost if other is not entry))
    return remaining.changed(_inside(entry.edit, version.score.duration))


def _inside(edit: Add | Keys, duration: float) -> Add | Keys:
    if isinstance(edit, Keys):
        shift = min(0.0, duration - edit.keys[-1][0])
        keys = tuple((time + shift, value) for time, value in edit.keys)
        inside = tuple(key for key in keys if key[0] >= 0.0)
        return replace(edit, keys=inside, shapes=edit.shapes[len(keys) - len(inside) :])
    shift = min(0.0, duration - edit.end)
    return replace(edit, start=max(0.0, edit.start + shift), end=edit.end + shift)
