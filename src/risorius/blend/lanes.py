"""What every channel asks of a parameter over time, and what is left of it after the others."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..core.parameters import INDEX
from ..errors import ParameterError, unknown
from .concatenate import SIGNED
from .directions import shares_of
from .intervals import Array, Indices
from .limits import LIPS
from .plan import Moment, Plan

Flags = npt.NDArray[np.bool_]
LEAST = 1e-9


@dataclass(frozen=True, slots=True)
class Lane:
    """A channel in one parameter: what it asks and what it gets, deviations from neutral, shape (n,) each."""

    channel: str
    asked: Array
    given: Array

    @property
    def inhibited(self) -> Flags:
        """Where nothing is left of what it asks, shape (n,)."""
        return np.asarray((np.abs(self.asked) > LEAST) & (np.abs(self.given) <= LEAST))

    @property
    def limited(self) -> Flags:
        """Where less is left than it asks, but something, shape (n,)."""
        less = np.abs(self.given) < np.abs(self.asked) - LEAST
        return np.asarray(less & (np.abs(self.given) > LEAST))


def lanes_of(plan: Plan, name: str, times: Array) -> tuple[Lane, ...]:
    """Return the channels that move a parameter, at sorted times (n,); ParameterError for an unknown name."""
    if name not in INDEX:
        raise ParameterError(unknown("parameter", name, INDEX))
    found = [c.name for c in plan.channels if name in c.curves]
    asked = {channel: np.zeros(len(times)) for channel in found}
    given = {channel: np.zeros(len(times)) for channel in found}
    done = 0
    for piece in plan.pieces(times):
        moment, here = Moment(plan, piece), slice(done, done + len(piece))
        for channel, index, wants, gets in asked_and_given(moment, name):
            asked[channel][here][index] += wants
            given[channel][here][index] += gets
        done += len(piece)
    return tuple(Lane(channel, asked[channel], given[channel]) for channel in found)


def asked_and_given(moment: Moment, name: str) -> Iterator[tuple[str, Indices, Array, Array]]:
    """Yield each channel that moves a parameter: its name, where, what it asks and gets there."""
    if name in SIGNED:
        yield from _directed(moment, name)
        return
    own = moment.own(name)
    for channel in moment.plan.channels:
        if name not in channel.curves:
            continue
        _, asked = channel.sample(name, moment.times)
        index, given = moment.settled(channel, name)
        if channel.name != LIPS:
            given = moment.bounded(channel, name, index, given, own)
        yield channel.name, index, asked, given


def _directed(moment: Moment, name: str) -> Iterator[tuple[str, Indices, Array, Array]]:
    """Yield each layer of each channel that turns the head or the eyes."""
    everywhere = np.arange(len(moment.times))
    terms = moment.terms(name)
    shares = shares_of(name, [term for _, term in terms])
    for ((channel, _), term), share in zip(terms, shares, strict=True):
        yield channel.name, everywhere, term, share
