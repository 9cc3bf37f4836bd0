"""Action units of several channels add and are clipped at 1 before they become muscles (paper B, 6.4).

The curves of channels are those of muscles already. By how much a unit's sum exceeds 1, times the weight of a
muscle, is taken from the muscle's sum.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..core.action_units import unit_weights
from ..core.arrays import Array
from ..core.movement import Movement
from ..core.score import Score
from .concatenate import concatenate
from .curve_pieces import MovementCurve
from .ledger import Ledger

_SIDES = ("left", "right")


@dataclass(frozen=True, slots=True)
class UnitPart:
    """A unit as one layer of a channel moves it, on one side."""

    channel: str
    layer: str
    curve: MovementCurve


class ActionUnitSums:
    """The units that several channels of a score move, by the parameter that they contract."""

    def __init__(self, score: Score) -> None:
        self._parts: dict[str, dict[str, list[UnitPart]]] = defaultdict(dict)
        self._weights: dict[tuple[str, str], float] = {}
        layers: dict[tuple[str, str], list[Movement]] = defaultdict(list)
        for movement in score.movements:
            if not movement.on_top:
                layers[movement.channel, movement.layer].append(movement)
        shared = _shared({name for name, _ in layers}, layers)
        for unit in sorted(shared):
            self._add(unit, layers, score.settings.onset_function)

    def __bool__(self) -> bool:
        return bool(self._parts)

    def _add(self, unit: str, layers: Mapping[tuple[str, str], list[Movement]], function: str | None) -> None:
        for name, weight in unit_weights(unit).items():
            side = name.rpartition(".")[2] if "." in name else ""
            parts = []
            for (channel, layer), movements in layers.items():
                moved = [replace(m, targets={name: _on_side(m, unit, side)}) for m in movements]
                curve = concatenate(moved, function).curves.get(name)
                if curve is not None and any(m.targets[name] > 0.0 for m in moved):
                    parts.append(UnitPart(channel, layer, curve))
            if len({part.channel for part in parts}) > 1:
                self._parts[name][unit] = parts
                self._weights[name, unit] = weight

    def clipped(self, ledger: Ledger, total: Array) -> Array:
        """Return the sum of a parameter's channels, shape (n,), with every unit clipped at 1."""
        least = np.zeros(len(total))
        for unit, parts in self._parts.get(ledger.name, {}).items():
            weight, activity = self._weights[ledger.name, unit], np.zeros(len(total))
            for name in dict.fromkeys(part.channel for part in parts):
                activity += self._activity([p for p in parts if p.channel == name], ledger)
            total = total - weight * np.maximum(activity - 1.0, 0.0)
            least = np.maximum(least, weight * np.minimum(activity, 1.0))
        return np.maximum(total, least)

    def _activity(self, parts: Iterable[UnitPart], ledger: Ledger) -> Array:
        """Return the largest that a channel's layers move a unit, after conflicts and limits, shape (n,)."""
        highest = np.zeros(len(ledger.times))
        for part in parts:
            values = np.zeros(len(ledger.times))
            index, moved = part.curve.sample(ledger.times)
            values[index] = moved
            np.maximum(highest, values * _share_left(part, ledger), out=highest)
        return highest


def _share_left(part: UnitPart, ledger: Ledger) -> Array:
    """Return the share of a channel's request for a parameter that conflicts and limits leave, (n,)."""
    share = np.zeros(len(ledger.times))
    for channel in ledger.channels:
        if channel.name == part.channel and not channel.on_top and channel.stratum in (None, part.layer):
            entry = ledger.entry(channel)
            left = np.divide(
                entry.applied, entry.requested, out=np.zeros(len(entry.index)), where=entry.requested > 0.0
            )
            share[entry.index] = np.maximum(share[entry.index], left)
    return np.minimum(share, 1.0)


def _shared(channels: set[str], layers: Mapping[tuple[str, str], list[Movement]]) -> set[str]:
    """Return the units, without sides, that more than one channel moves."""
    used = {
        name: set(_units(m for key, ms in layers.items() if key[0] == name for m in ms)) for name in channels
    }
    return {unit for units in used.values() for unit in units if sum(unit in u for u in used.values()) > 1}


def _units(movements: Iterable[Movement]) -> Iterator[str]:
    for movement in movements:
        for name in movement.targets:
            if unit_weights(name):
                yield name.partition(".")[0]


def _on_side(movement: Movement, unit: str, side: str) -> float:
    """Return how far a movement moves a unit on a side; of a muscle without sides the larger of both."""
    sides = (side,) if side else _SIDES
    return max(movement.targets.get(unit, 0.0), *(movement.targets.get(f"{unit}.{s}", 0.0) for s in sides))
