"""Explanations in words."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from .blend import Contribution, Explanation, Tally
from .console import table
from .core.parameters import INDEX, PARAMETERS

if TYPE_CHECKING:
    from .ports.rig import Rig, Shown


def narrate(explanations: Iterable[Explanation], time: float) -> Iterator[str]:
    """Yield the lines that say why parameters have their values at `time` seconds; equal sides once."""
    told: dict[tuple[str, ...], list[str]] = {}
    for explanation in explanations:
        base = explanation.parameter.partition(".")[0]
        told.setdefault((base, *_lines(explanation)), []).append(explanation.parameter)
    for (base, value, *reasons), names in told.items():
        yield f"{base if len(names) > 1 else names[0]} = {value}"
        yield from (f"    {reason}" for reason in reasons)
    if not told:
        yield f"at {time:g} s nothing moves"


def _lines(explanation: Explanation) -> Iterator[str]:
    unit = PARAMETERS[INDEX[explanation.parameter]].unit
    yield f"{explanation.value:.3f}{f' {unit}' if unit else ''}"
    yield _sentence(explanation.winner) if explanation.winner else "at rest"
    yield from (f"not {_sentence(loser)}" for loser in explanation.losers)
    yield from explanation.notes


def _sentence(contribution: Contribution) -> str:
    cause, applied, requested = contribution.cause, contribution.applied, contribution.requested
    place = f", {cause.place}" if cause.place else ""
    amount = f"{applied:.3f}" if abs(applied - requested) < 5e-4 else f"{applied:.3f} of {requested:.3f}"
    reason = f": {contribution.reason}" if contribution.reason else ""
    return f"{amount} from {contribution.channel}: {contribution.what} ({cause.rule}{place}){reason}"


def tell(summary: Mapping[str, Tally]) -> Iterator[str]:
    """Yield the table of how each channel fared, in percent of the frames in which it moved something."""
    header = ("channel", "active", "won", "inhibited", "limited")
    rows = []
    for channel, tally in summary.items():
        shares = (tally.won, tally.inhibited, tally.limited)
        percents = [f"{100.0 * n / tally.active:.1f} %" if tally.active else "" for n in shares]
        rows.append((channel, str(tally.active), *percents))
    yield from table(header, rows)


def tell_rig(rig: Rig, rows: Sequence[Shown], *, guessed: bool) -> Iterator[str]:
    """Yield lines on what a character can show; a guessed map is shown as TOML, to correct and give back."""
    yield f"# {len(rig.shapes)} of 52 ARKit shapes{' by name; correct what is wrong' if guessed else ''}"
    yield "[shapes]"
    yield from (f"{shape} = {json.dumps(target, ensure_ascii=False)}" for shape, target in rig.shapes.items())
    yield ""
    if rig.missing:
        yield f"# missing: {', '.join(rig.missing)}"
    if rig.unused:
        yield f"# targets that are no ARKit shape: {', '.join(rig.unused)}"
    for verdict in ("well", "partly", "not"):
        names = [row for row in rows if row.verdict == verdict]
        if names:
            told = ", ".join(f"{row.parameter} ({row.left_over:.0%}, {row.rms:.1f} mm)" for row in names)
            yield f"# shown {verdict}: {told}" if verdict != "not" else f"# not shown: {told}"
    yield "# in brackets: what is left over of the movement, and that in mm (root mean square on our head)"
