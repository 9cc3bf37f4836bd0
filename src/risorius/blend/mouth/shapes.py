"""From the segments' blended targets to parameters: articulators by the head's rig, others unchanged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...core.arrays import Array
from ...core.functions import positive_part
from ...core.lips.articulators import ARTICULATORS
from ...core.lips.lip_rig import SEAL, Averages, LipRig
from ...core.movement import LipSegment
from ...core.parameters import INDEX, PARAMETERS, Kind
from ...errors import InputError
from .contact import CONTACTS

ROUNDED, TONGUE = 0.02, 0.2
"""The share of a parameter's range over which it turns to an end of it; that of the tongue, which passes it
within 15 ms."""


class Shapes:
    """The parameters that the targets of some segments move.

    `parameters`: their names, without contact goals; `averaged`: the targets that move them; `rig`: turns
    articulators into muscles, None if no target is an articulator. Raises InputError if a target is an
    articulator and there is no rig.
    """

    def __init__(self, segments: Sequence[LipSegment], rig: LipRig | None, contact: bool) -> None:
        names = {name for s in segments for name in s.targets}
        self._direct = tuple(sorted(names - set(ARTICULATORS) - set(CONTACTS)))
        self._articulators = frozenset(names & set(ARTICULATORS))
        if self._articulators and rig is None:
            raise InputError(
                f"lips are given as articulators ({min(self._articulators)}); expected a head to perform them"
            )
        self.rig = rig if self._articulators else None
        self.averaged = (*(ARTICULATORS if self.rig else ()), *self._direct)
        moved = rig.moved(self._articulators) if rig is not None else frozenset[str]()
        self._driven = moved if contact else moved - {SEAL}
        self.parameters = tuple(sorted(self._driven | set(self._direct)))

    def by_rig(self, name: str) -> bool:
        """Return whether a parameter is moved by articulators alone, which have no sides."""
        return name in self._driven and name not in self._direct

    def values(self, average: Averages) -> Mapping[str, Array]:
        """Return all `parameters` by name, (n,) each; `average` returns the average of a target (n,)."""
        values: dict[str, Array] = {}
        if self.rig is not None:
            by_rig = self.rig.parameters(average, self._articulators)
            values = {name: by_rig[name] for name in self._driven}
        for name in self._direct:
            own = _within_range(name, average(name))
            values[name] = np.minimum(values[name] + own, 1.0) if name in values else own
        return values


def _within_range(name: str, value: Array) -> Array:
    """Return a blended parameter that nowhere leaves its range: a blend may overshoot its targets."""
    limits = PARAMETERS[INDEX[name]]
    length = limits.high - limits.low
    rounded = (TONGUE if limits.kind is Kind.TONGUE else ROUNDED) * length
    above = positive_part(value - limits.low, rounded)
    below = positive_part(length - above, rounded)
    return limits.high - below


def performed(segments: Sequence[LipSegment], rig: LipRig | None) -> tuple[LipSegment, ...]:
    """Return the segments with the articulators that the rig blends (`LipRig.actives`)."""
    if rig is None:
        return tuple(segments)
    distinct = {id(segment.targets): segment.targets for segment in segments}
    actives = rig.actives(list(distinct.values()))
    targets = {
        number: {n: v for n, v in own.items() if n not in ARTICULATORS} | active
        for (number, own), active in zip(distinct.items(), actives, strict=True)
    }
    return tuple(s.with_targets(targets[id(s.targets)]) for s in segments)
