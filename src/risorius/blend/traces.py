"""What every channel makes of one parameter over time: asked, given, and where it was held back."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array, BoolArray
from ..core.parameters import INDEX
from ..errors import ParameterError, unknown
from .channels import Channel
from .concatenate import SIGNED
from .directions import shares_of
from .limits import LIPS
from .manual import hidden
from .plan import Moment, Plan

_LEAST = 1e-9
Run = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Trace:
    """A channel's part in one parameter, as deviations from its neutral, at n times.

    `requested`: what its movements want; `applied`: what is left of it after the policy, the jaw's sharing
    and the limits of speech; both shape (n,).
    """

    channel: str
    requested: Array
    applied: Array

    @property
    def inhibited(self) -> tuple[Run, ...]:
        """Runs [first, last] of indices at which something was asked and nothing is left."""
        return tuple(_runs(self._active & (np.abs(self.applied) <= _LEAST)))

    @property
    def limited(self) -> tuple[Run, ...]:
        """Runs [first, last] of indices at which less than was asked is left, but something."""
        less = np.abs(self.applied) < np.abs(self.requested) - _LEAST
        return tuple(_runs(self._active & less & (np.abs(self.applied) > _LEAST)))

    @property
    def _active(self) -> BoolArray:
        return np.asarray(np.abs(self.requested) > _LEAST)


def _runs(mask: BoolArray) -> Iterator[Run]:
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(np.int8)))
    for first, after in edges.reshape(-1, 2).tolist():
        yield first, after - 1


def traces(plan: Plan, parameter: str, times: Array) -> tuple[Trace, ...]:
    """Return the part of every channel that moves a parameter, at sorted times (n,), highest priority first.

    Raises ParameterError for an unknown name.
    """
    if parameter not in INDEX:
        raise ParameterError(unknown("parameter", parameter, INDEX))
    wanted = np.asarray(times, dtype=np.float64)
    moving = [c.name for c in plan.channels if parameter in c.curves]
    found = {name: Trace(name, *np.zeros((2, len(wanted)))) for name in moving}
    start = 0
    for batch in plan.batches(wanted) if len(wanted) else ():
        moment, here = Moment(plan, batch), slice(start, start + len(batch))
        for channel, requested, applied in (_turned if parameter in SIGNED else _moved)(moment, parameter):
            found[channel].requested[here] += requested
            found[channel].applied[here] += applied
        start += len(batch)
    return tuple(found.values())


def _turned(moment: Moment, name: str) -> Iterator[tuple[str, Array, Array]]:
    terms = moment.terms(name)
    shares = shares_of(name, [term for _, term in terms])
    for ((channel, curve), term), share in zip(terms, shares, strict=True):
        yield channel.name, term + hidden(curve, moment.times), share


def _moved(moment: Moment, name: str) -> Iterator[tuple[str, Array, Array]]:
    own = moment.own(name)
    for channel in moment.plan.channels:
        if name in channel.curves:
            yield channel.name, *_contribution(moment, channel, name, own)


def _contribution(moment: Moment, channel: Channel, name: str, own: Array) -> tuple[Array, Array]:
    requested, applied = np.zeros((2, len(moment.times)))
    index, values = channel.sample(name, moment.times)
    requested[index] = values
    left = moment.resolve(channel, name, moment.times[index], values)
    applied[index] = left if channel.name == LIPS else moment.bounded(channel, name, index, left, own)
    replaced = [hidden(curve, moment.times) for curve in channel.curves[name]]
    return np.maximum(requested, np.max(replaced, axis=0)), applied
