"""Traces of one parameter over time: what each channel requests and applies, and when it is inhibited."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array, BoolArray
from ..core.parameters import INDEX
from ..errors import ParameterError, unknown
from .concatenate import SIGNED
from .manual import replaced_values
from .plan import Plan, PlanSample

_LEAST = 1e-9
IndexRun = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Trace:
    """One channel's requests for a parameter at n times and what is applied, as deviations from its neutral.

    `requested`: by its movements; `applied`: what remains after all stages of the ledger; both shape (n,).
    """

    channel: str
    requested: Array
    applied: Array

    def __repr__(self) -> str:
        """Return one line: the channel, and how often it is inhibited or limited."""
        held_back = f"{len(self.inhibited)} times inhibited, {len(self.limited)} limited"
        return f"<Trace of {self.channel} at {len(self.requested)} times, {held_back}>"

    @property
    def inhibited(self) -> tuple[IndexRun, ...]:
        """Runs [first, last] of indices at which something is requested and nothing is applied."""
        return tuple(_runs(self._active & (np.abs(self.applied) <= _LEAST)))

    @property
    def limited(self) -> tuple[IndexRun, ...]:
        """Runs [first, last] of indices at which less is applied than requested, but not nothing."""
        less = np.abs(self.applied) < np.abs(self.requested) - _LEAST
        return tuple(_runs(self._active & less & (np.abs(self.applied) > _LEAST)))

    @property
    def _active(self) -> BoolArray:
        return np.asarray(np.abs(self.requested) > _LEAST)


def _runs(mask: BoolArray) -> Iterator[IndexRun]:
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(np.int8)))
    for first, after in edges.reshape(-1, 2).tolist():
        yield first, after - 1


def traces(plan: Plan, parameter: str, times: Array) -> tuple[Trace, ...]:
    """Return the trace of every channel that moves a parameter, at sorted times (n,), highest priority first.

    Raises ParameterError for an unknown name.
    """
    if parameter not in INDEX:
        raise ParameterError(unknown("parameter", parameter, INDEX))
    all_times = np.asarray(times, dtype=np.float64)
    moving = [c.name for c in plan.channels if parameter in c.curves]
    by_channel = {name: Trace(name, *np.zeros((2, len(all_times)))) for name in moving}
    start = 0
    for batch in plan.batches(all_times) if len(all_times) else ():
        sample, here = PlanSample(plan, batch), slice(start, start + len(batch))
        for channel, requested, applied in (_turned if parameter in SIGNED else _moved)(sample, parameter):
            join = np.add if parameter in SIGNED else np.maximum
            trace = by_channel[channel]
            trace.requested[here] = join(trace.requested[here], requested)
            trace.applied[here] = join(trace.applied[here], applied)
        start += len(batch)
    return tuple(by_channel.values())


def _turned(sample: PlanSample, name: str) -> Iterator[tuple[str, Array, Array]]:
    """Yield the channel, the requested and the applied values (n,) of a direction, for every curve."""
    for entry in sample.direction_entries(name):
        yield entry.channel.name, entry.requested + replaced_values(entry.curve, sample.times), entry.applied


def _moved(sample: PlanSample, name: str) -> Iterator[tuple[str, Array, Array]]:
    """Yield the same of any other parameter, for every channel."""
    for entry in sample.ledger(name).entries():
        requested, applied = np.zeros((2, len(sample.times)))
        requested[entry.index], applied[entry.index] = entry.requested, entry.applied
        replaced = [replaced_values(curve, sample.times) for curve in entry.channel.curves[name]]
        yield entry.channel.name, np.maximum(requested, np.max(replaced, axis=0)), applied
