"""A version of a performance: the score as it was planned, and the edits made on it since."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from ...core.edits import Add, ClearKeys, Edit, Keys, edited, named
from ...core.movement import Movement
from ...core.score import Score
from ...core.speech.utterance import Utterance
from ...settings import Settings
from ..wire.marks import LaneStates, Marker
from ..wire.shared import TakeInputs


@dataclass(frozen=True, slots=True)
class LostEdit:
    """A change by hand that did not fit the line when it was planned anew.

    `text` names it; `edit` makes its movement or curve again, and is None for a movement that was deleted
    (its absence need not be reported). `edits` of `origin` did not fit; they are tried on each plan again.
    """

    text: str
    edit: Add | Keys | None = None
    edits: tuple[Edit, ...] = ()
    origin: Revision | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Revision:
    """The state of a take: its inputs, score and edits.

    `base`: the score as planned; `score`: with all edits made; `lost`: those that have no place in it.
    `lanes`: those that are muted.
    """

    inputs: TakeInputs
    base: Score
    score: Score
    settings: Settings
    utterance: Utterance | None
    edits: tuple[Edit, ...] = ()
    warnings: tuple[str, ...] = ()
    lost: tuple[LostEdit, ...] = ()
    markers: tuple[Marker, ...] = ()
    lanes: LaneStates = field(default_factory=LaneStates)
    milliseconds: dict[str, float] = field(default_factory=dict, compare=False)

    @property
    def lost_made(self) -> tuple[LostEdit, ...]:
        """Those lost edits that had made something."""
        return tuple(entry for entry in self.lost if entry.edit is not None)

    @property
    def audible(self) -> Score:
        """The score without the movements on muted lanes."""
        silent, score = self.lanes.silent, self.score
        if not silent:
            return score
        return replace(
            score,
            movements=tuple(m for m in score.movements if m.channel not in silent),
            lips=() if "lips" in silent else score.lips,
            manual=() if "manual" in silent else score.manual,
        )

    def annotated(self, **values: Any) -> Revision:
        """Return the version with other markers or lanes."""
        return replace(self, warnings=(), milliseconds={}, **values)

    def changed(self, edit: Edit) -> Revision:
        """Return the version with one more edit; raise InputError or ParameterError if it does not fit."""
        fixed = named(self.score, edit)
        return replace(
            self,
            score=edited(self.score, fixed),
            edits=(*self.edits, fixed),
            warnings=(),
            milliseconds={},
        )


def worded(edit: Edit, *scores: Score) -> str:
    """Return a short description of an edit; movements are looked up in `scores`."""
    verb = _WORDS[type(edit).__name__]
    if isinstance(edit, Add):
        return f"{verb} a movement of {edit.channel} at {edit.start:.2f} s"
    if isinstance(edit, Keys | ClearKeys):
        return f"{verb} {edit.parameter.replace('_', ' ')}"
    movement = next((m for score in scores for m in score.movements if m.id == edit.movement), None)
    return f"{verb} {edit.movement if movement is None else _said(movement)}"


def lanes_worded(before: LaneStates, after: LaneStates) -> str:
    """Return a short description of a change of lanes, as "mute head"."""
    for verb, undo, was, now in (
        ("mute", "unmute", before.muted, after.muted),
        ("solo", "end solo of", before.solo, after.solo),
        ("lock", "unlock", before.locked, after.locked),
    ):
        added, gone = [n for n in now if n not in was], [n for n in was if n not in now]
        if added or gone:
            return f"{verb if added else undo} {', '.join(added or gone)}"
    return "change the lanes"


def _said(m: Movement) -> str:
    what = m.channel if m.layer in ("", m.id, m.channel) else f"{m.layer} ({m.channel})"
    return f"{what} on {m.cause.trigger}" if m.cause.trigger else f"{what} at {m.start:.2f} s"


_WORDS = {
    "Move": "move",
    "Stretch": "stretch",
    "Retarget": "change the targets of",
    "Add": "add",
    "Delete": "delete",
    "Keys": "draw",
    "ClearKeys": "delete the drawn curve of",
}
