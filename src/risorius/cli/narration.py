"""Summaries of a clip and of a character, in words."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from .messages import table

if TYPE_CHECKING:
    from ..blend import Tally
    from ..ports.mesh.rig import MuscleCoverage, Rig


def tell(summary: Mapping[str, Tally]) -> Iterator[str]:
    """Yield the table of how each channel fared, in percent of the frames in which it moved something."""
    header = ("channel", "active", "won", "inhibited", "limited")
    rows = []
    for channel, tally in summary.items():
        shares = (tally.won, tally.inhibited, tally.limited)
        percents = [f"{100.0 * n / tally.active:.1f} %" if tally.active else "" for n in shares]
        rows.append((channel, str(tally.active), *percents))
    yield from table(header, rows)


def tell_rig(rig: Rig, rows: Sequence[MuscleCoverage], *, guessed: bool) -> Iterator[str]:
    """Yield lines on what a character can show; a guessed map is shown as TOML, to correct and give back."""
    yield f"# {len(rig.shapes)} of 52 ARKit shapes{' by name; correct wrong ones' if guessed else ''}"
    yield "[shapes]"
    for shape, targets in rig.shapes.items():
        named = targets[0] if len(targets) == 1 else targets
        yield f"{shape} = {json.dumps(named, ensure_ascii=False)}"
    yield ""
    if rig.missing:
        yield f"# missing: {', '.join(rig.missing)}"
    if rig.unused:
        yield f"# targets that are not ARKit shapes: {', '.join(rig.unused)}"
    for verdict in ("well", "partly", "not"):
        names = [row for row in rows if row.verdict == verdict]
        if names:
            muscles = ", ".join(f"{row.parameter} ({row.left_over:.0%}, {row.rms:.1f} mm)" for row in names)
            yield f"# shown {verdict}: {muscles}" if verdict != "not" else f"# not shown: {muscles}"
    yield "# in brackets: the share of the movement that is not shown, and its root mean square in mm"
