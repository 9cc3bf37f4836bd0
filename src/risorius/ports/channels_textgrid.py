"""`.channels.TextGrid`: words, phones, and every channel and layer as a tier of its movements, for Praat.

A linguist sees what the face does when. Movements of one layer that overlap go to tiers `channel 2`, `channel
3` …, because intervals of one tier may not. Lost: the curves; see `.muscles.csv`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..core.movement import Movement
from ..core.performance import Performance
from .formats import register
from .table import write_lines
from .textgrid import Interval, grid_lines, phone_label
from .writable import WritableTake, WriteOptions


def write_channels_textgrid(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the tiers; without speech only those of the channels."""
    write_lines(path, grid_lines(take.performance.duration, list(_tiers(take))))


def _tiers(take: WritableTake) -> Iterator[tuple[str, list[Interval]]]:
    utterance = take.utterance
    if utterance is not None:
        yield "words", [(w.start, w.end, w.text) for w in utterance.words]
        yield "phones", [(p.start, p.end, phone_label(p, utterance.language)) for p in utterance.phones]
    yield from _channels(take.performance)


def _channels(performance: Performance) -> Iterator[tuple[str, list[Interval]]]:
    found: dict[str, list[Movement]] = {}
    for movement in performance.score.movements:
        layer = f"/{movement.layer}" if movement.layer else ""
        found.setdefault(f"{movement.channel}{layer}", []).append(movement)
    for name in sorted(found):
        for number, row in enumerate(_apart(found[name]), 1):
            yield name if number == 1 else f"{name} {number}", row


def _apart(movements: list[Movement]) -> list[list[Interval]]:
    """Return intervals in as few rows as keep those of a row apart."""
    rows: list[list[Interval]] = []
    for movement in sorted(movements, key=lambda m: (m.start, m.end)):
        interval = (movement.start, movement.end, label(movement))
        row = next((r for r in rows if r[-1][1] <= movement.start), None)
        if row is None:
            rows.append([interval])
        else:
            row.append(interval)
    return rows


def label(movement: Movement) -> str:
    """Return a movement in a few words: what it moves, both sides as one, with the largest value."""
    values: dict[str, float] = {}
    for name, value in movement.targets.items():
        base = name.partition(".")[0]
        values[base] = max(values.get(base, value), value, key=abs)
    return " ".join(f"{base}={value:.2g}" for base, value in values.items())


register(".channels.TextGrid", "every channel as a tier, for Praat", {"curves"}, write_channels_textgrid)
