"""A version of a performance: the score as it was planned, and the edits made on it since."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from ..core.edits import Add, Edit, edited, named
from ..core.score import Score
from ..core.utterance import Utterance
from ..errors import RisoriusError
from ..settings import Settings
from .wire.shared import TakeInputs


@dataclass(frozen=True, slots=True)
class Version:
    """What a take is made from. `base`: the score as planned; `score`: with all edits made."""

    inputs: TakeInputs
    base: Score
    score: Score
    settings: Settings
    utterance: Utterance | None
    edits: tuple[Edit, ...] = ()
    warnings: tuple[str, ...] = ()
    milliseconds: dict[str, float] = field(default_factory=dict, compare=False)

    def changed(self, edit: Edit) -> Version:
        """Return the version with one more edit; raise InputError or ParameterError if it does not fit."""
        fixed = named(self.score, edit)
        return replace(
            self,
            score=edited(self.score, fixed),
            edits=(*self.edits, fixed),
            warnings=(),
            milliseconds={},
        )

    def with_edits(self, edits: Iterable[Edit]) -> Version:
        """Return the version with other edits; an edit that does not fit is named and left out."""
        version, dropped = self, list(self.warnings)
        for edit in edits:
            try:
                version = version.changed(edit)
            except RisoriusError as error:
                dropped.append(f"an edit could not be applied again ({worded(edit)}): {error}")
        return replace(version, warnings=tuple(dropped), milliseconds=self.milliseconds)


def worded(edit: Edit) -> str:
    """Return a short description of an edit."""
    verb = _WORDS[type(edit).__name__]
    if isinstance(edit, Add):
        return f"{verb} {edit.id or f'to {edit.channel}'}"
    return f"{verb} {getattr(edit, 'movement', '') or getattr(edit, 'parameter', '')}"


_WORDS = {
    "Move": "move",
    "Stretch": "stretch",
    "Retarget": "change the targets of",
    "Add": "add",
    "Delete": "delete",
    "Keys": "draw",
    "ClearKeys": "delete the drawn curve of",
}
