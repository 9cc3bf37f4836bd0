"""The contents of an explanation, and its wording."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..core.movement import Cause
from ..core.parameters import INDEX, PARAMETERS

_PRINTED = 5e-4


@dataclass(frozen=True, slots=True)
class Contribution:
    """The request of one movement, segment or drawn curve for a parameter at a time, and the part applied.

    `label` names it, `cause` says why it exists. `requested` and `applied` are deviations from the
    parameter's neutral. `reason`: why less is applied than requested, or why it does not show; else "".
    `on_top`: whether it adds to what the others leave. `added`: whether it is added to the others, as all are
    that turn head or eyes.
    """

    channel: str
    layer: str
    label: str
    cause: Cause
    requested: float
    applied: float
    reason: str = ""
    on_top: bool = False
    added: bool = False

    @property
    def what(self) -> str:
        """Its origin, for a sentence: the phone and word, or the mark, or its own label."""
        return self.cause.trigger or self.label


@dataclass(frozen=True, slots=True)
class Explanation:
    """A parameter's value at a time: the winning contribution (None at rest), the others, the last steps."""

    time: float
    parameter: str
    value: float
    winner: Contribution | None
    losers: tuple[Contribution, ...]
    notes: tuple[str, ...]

    @property
    def is_seen(self) -> bool:
        """Whether it moves, or anything is requested or applied, in the decimals that are printed."""
        parts = (*self.losers, *(() if self.winner is None else (self.winner,)))
        moved = abs(self.value - PARAMETERS[INDEX[self.parameter]].neutral) >= _PRINTED
        return moved or any(max(abs(part.requested), abs(part.applied)) >= _PRINTED for part in parts)

    def __str__(self) -> str:
        """Return it in words, as the command line prints it."""
        value, *lines = reasons(self)
        return "\n    ".join((f"{self.parameter} = {value}", *lines))


def reasons(explanation: Explanation) -> Iterator[str]:
    """Yield the value, then a line for each contribution and for each of the last steps."""
    unit = PARAMETERS[INDEX[explanation.parameter]].unit
    yield f"{explanation.value:.3f}{f' {unit}' if unit else ''}"
    winner = explanation.winner
    yield _sentence(winner) if winner else "at rest"
    for loser in explanation.losers:
        both = loser.on_top or loser.added or (winner is not None and winner.on_top)
        yield f"{'and' if both else 'not'} {_sentence(loser)}"
    yield from explanation.notes


def _sentence(contribution: Contribution) -> str:
    cause, applied, requested = contribution.cause, contribution.applied, contribution.requested
    place = f", {cause.place}" if cause.place else ""
    amount = f"{applied:.3f}" if abs(applied - requested) < _PRINTED else f"{applied:.3f} of {requested:.3f}"
    reason = f": {contribution.reason}" if contribution.reason else ""
    return f"{amount} from {contribution.channel}: {contribution.what} ({cause.rule}{place}){reason}"
