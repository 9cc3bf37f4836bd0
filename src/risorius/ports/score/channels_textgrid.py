"""`.channels.TextGrid`: words, phones, and every channel and layer as a tier of its movements, for Praat.

A linguist sees what the face does when. Movements of one layer that overlap go to tiers `channel 2`, `channel
3` …, because intervals of one tier may not. Lost: the curves; see `.muscles.csv`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ...core.movement import Movement
from ...core.performance import Performance
from ...script.textgrid import INTERVALS, Label, Tier, textgrid_lines
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..speech.textgrid import speech_tiers
from ..table import write_lines


def write_channels_textgrid(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the tiers; without speech only those of the channels."""
    speech = () if take.utterance is None else speech_tiers(take.utterance)
    tiers = [*speech, *_channels(take.performance)]
    write_lines(path, textgrid_lines(take.performance.duration, tiers))


def _channels(performance: Performance) -> Iterator[Tier]:
    by_channel: dict[str, list[Movement]] = {}
    for movement in performance.score.movements:
        layer = f"/{movement.layer}" if movement.layer else ""
        by_channel.setdefault(f"{movement.channel}{layer}", []).append(movement)
    for name in sorted(by_channel):
        for number, row in enumerate(_apart(by_channel[name]), 1):
            yield Tier(name if number == 1 else f"{name} {number}", INTERVALS, tuple(row))


def _apart(movements: list[Movement]) -> list[list[Label]]:
    """Return intervals in as few rows as keep those of a row apart."""
    rows: list[list[Label]] = []
    for movement in sorted(movements, key=lambda m: (m.start, m.end)):
        interval = Label(movement.start, movement.end, label(movement))
        row = next((r for r in rows if r[-1].end <= movement.start), None)
        if row is None:
            rows.append([interval])
        else:
            row.append(interval)
    return rows


def label(movement: Movement) -> str:
    """Return a movement in a few words: its parameters, both sides as one, with the largest value."""
    values: dict[str, float] = {}
    for name, value in movement.targets.items():
        base = name.partition(".")[0]
        values[base] = max(values.get(base, value), value, key=abs)
    return " ".join(f"{base}={value:.2g}" for base, value in values.items())


register(".channels.TextGrid", "every channel as a tier, for Praat", {"movements"}, write_channels_textgrid)
