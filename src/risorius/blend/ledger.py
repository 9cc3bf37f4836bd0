"""The ledger of a parameter: the requests of each channel, and the rest after each stage.

A muscle, a contact or the tongue goes through four stages. A channel's movements *request* a value; the
policy *resolves* it against rivals in other channels; of the jaw, the channel gets a *share* beside speech;
and the value that is *applied* lies within the limits of speech. Head and gaze have no rivals: all channels
turn them, each less because of the others, whichever axis those turn. Curves, explanations, traces and
summaries read the same ledger.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..core.arrays import Array, IndexArray
from ..core.parameters import INDEX, PARAMETERS, Kind
from .channels import Channel
from .conflict import Resolver
from .curve import Curve
from .directions import shares_of
from .manual import KeyCurve
from .mouth.limits import LIPS, SpeechLimits
from .mouth.speech_mouth import JAW


class LedgerEntry:
    """One channel's requests for a parameter while it moves it, and the rest after each stage, shape (m,).

    `index`: at which of the ledger's times, shape (m,).
    """

    def __init__(self, ledger: Ledger, channel: Channel, index: IndexArray, requested: Array) -> None:
        self._ledger, self.channel, self.index, self.requested = ledger, channel, index, requested

    @cached_property
    def _times(self) -> Array:
        return self._ledger.times[self.index]

    @cached_property
    def resolved(self) -> Array:
        """The requests after the policy."""
        return self._ledger.resolve(self.channel, self._ledger.name, self._times, self.requested)

    @cached_property
    def shared(self) -> Array:
        """The resolved requests; for the jaw, the part that is added to the jaw of speech."""
        limits = self._ledger.limits
        if self._ledger.name != JAW or limits is None or self.channel.name == LIPS:
            return self.resolved
        return self.resolved * limits.jaw_share(self.channel, self._times, self._ledger.speech[self.index])

    @cached_property
    def applied(self) -> Array:
        """The requests after the limits of speech."""
        ledger, limits = self._ledger, self._ledger.limits
        if limits is None or self.channel.name == LIPS:
            return self.shared
        return limits.applied(self.channel, ledger.name, self._times, self.shared, ledger.speech[self.index])


class Ledger:
    """All channels' entries for one muscle, contact or part of the tongue at sorted times (n,), at least one.

    `channels`: those of the plan; `resolve`: the policy's decision at these times; `limits`: those of
    speech, None if nothing is said.
    """

    def __init__(
        self,
        name: str,
        times: Array,
        channels: Sequence[Channel],
        resolve: Resolver,
        limits: SpeechLimits | None,
    ) -> None:
        self.name, self.times, self.resolve, self.limits = name, times, resolve, limits
        self.channels = tuple(channel for channel in channels if name in channel.curves)

    @cached_property
    def speech(self) -> Array:
        """The lips' own movements after the policy, 0 if they do not move the parameter; shape (n,)."""
        values = np.zeros(len(self.times))
        for channel in self.channels:
            if channel.name == LIPS:
                entry = self.entry(channel)
                values[entry.index] = entry.resolved
        return values

    def entries(self) -> Iterator[LedgerEntry]:
        """Yield the entry of every channel that moves the parameter, highest priority first."""
        return map(self.entry, self.channels)

    def entry(self, channel: Channel) -> LedgerEntry:
        """Return the entry of a channel: of all its layers the highest value."""
        return LedgerEntry(self, channel, *channel.sample(self.name, self.times))

    def curve_entry(self, channel: Channel, curve: Curve) -> LedgerEntry:
        """Return the entry of one curve, ignoring the channel's other curves."""
        return LedgerEntry(self, channel, *curve.sample(self.times))


@dataclass(frozen=True, slots=True)
class DirectionEntry:
    """One curve's request for a direction, and the part that the others leave of it: deviations (n,)."""

    channel: Channel
    curve: Curve
    requested: Array
    applied: Array


def direction_entries(
    kind: Kind, times: Array, channels: Sequence[Channel]
) -> dict[str, list[DirectionEntry]]:
    """Return the entries of all curves for the directions of a kind, by parameter, at sorted times (n,)."""
    turns = [
        (channel, own) for channel in channels for layer in channel.layers if (own := _axes(kind, layer))
    ]
    requested = [{name: _everywhere(curve, times) for name, curve in own.items()} for _, own in turns]
    exact = [i for i, (_, own) in enumerate(turns) if any(_replaces(curve) for curve in own.values())]
    applied = shares_of(kind, requested, exact)
    entries: dict[str, list[DirectionEntry]] = defaultdict(list)
    for (channel, own), wanted, left in zip(turns, requested, applied, strict=True):
        for name, curve in own.items():
            entries[name].append(DirectionEntry(channel, curve, wanted[name], left[name]))
    return entries


def _axes(kind: Kind, layer: Mapping[str, Curve]) -> dict[str, Curve]:
    return {name: curve for name, curve in layer.items() if PARAMETERS[INDEX[name]].kind is kind}


def _replaces(curve: Curve) -> bool:
    return isinstance(curve, KeyCurve) and curve.replaces


def _everywhere(curve: Curve, times: Array) -> Array:
    """Return a curve's values at all times, 0 at rest, shape (n,)."""
    values = np.zeros(len(times))
    index, moved = curve.sample(times)
    values[index] = moved
    return values
