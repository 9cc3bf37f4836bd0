"""Explanations in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..core.parameters import INDEX, PARAMETERS
from .explain import Contribution, Explanation


def narrate(explanations: Iterable[Explanation], time: float) -> Iterator[str]:
    """Yield the lines that say why parameters have their values at `time` seconds; equal sides once."""
    by_reasons: dict[tuple[str, ...], list[str]] = {}
    for explanation in explanations:
        base = explanation.parameter.partition(".")[0]
        by_reasons.setdefault((base, *_lines(explanation)), []).append(explanation.parameter)
    for (base, value, *reasons), names in by_reasons.items():
        yield f"{base if len(names) > 1 else names[0]} = {value}"
        yield from (f"    {reason}" for reason in reasons)
    if not by_reasons:
        yield f"at {time:g} s nothing moves"


def _lines(explanation: Explanation) -> Iterator[str]:
    unit = PARAMETERS[INDEX[explanation.parameter]].unit
    yield f"{explanation.value:.3f}{f' {unit}' if unit else ''}"
    winner = explanation.winner
    yield _sentence(winner) if winner else "at rest"
    for loser in explanation.losers:
        both = loser.on_top or (winner is not None and winner.on_top)
        yield f"{'and' if both else 'not'} {_sentence(loser)}"
    yield from explanation.notes


def _sentence(contribution: Contribution) -> str:
    cause, applied, requested = contribution.cause, contribution.applied, contribution.requested
    place = f", {cause.place}" if cause.place else ""
    amount = f"{applied:.3f}" if abs(applied - requested) < 5e-4 else f"{applied:.3f} of {requested:.3f}"
    reason = f": {contribution.reason}" if contribution.reason else ""
    return f"{amount} from {contribution.channel}: {contribution.what} ({cause.rule}{place}){reason}"
