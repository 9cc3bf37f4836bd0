"""The channels of a score, compiled: each with its priority over time and its curves by parameter."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..core.arrays import Array, IndexArray
from ..core.channels import CHANNELS
from ..core.score import Score
from .concatenate import LayerCurves
from .curve import Curve
from .intervals import Spans, union
from .layer_priority import layer_priorities
from .layers import CompiledLayers
from .manual import ManualOverride, drawn_layers, replaced_spans
from .mouth.lips import CompiledLips, LipCurve
from .priority_curve import PriorityClaim, PriorityCurve, priority_curve


@dataclass(slots=True)
class Channel:
    """A channel: its priority, and its curves by parameter in each layer.

    `on_top`: these curves are of movements that add to what the others leave. `stratum`: they are of one
    layer, which conflicts with another. The rest of the channel is another Channel of the same name.
    `harmless`: the parameters in which it inhibits no rival.
    """

    name: str
    levels: PriorityCurve
    layers: Sequence[Mapping[str, Curve]]
    on_top: bool = False
    stratum: str | None = None
    harmless: frozenset[str] = frozenset()
    curves: dict[str, list[Curve]] = field(init=False)
    """All curves by parameter, one for each layer that moves it."""
    _above: dict[tuple[str, float], Spans] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        names = sorted({name for layer in self.layers for name in layer})
        self.curves = {name: [layer[name] for layer in self.layers if name in layer] for name in names}

    @property
    def key(self) -> str:
        """The channel's name with its marker and layer: unique within a plan."""
        names = (self.name, self.on_top and "on top", self.stratum is not None and f"layer {self.stratum}")
        return ", ".join(name for name in names if name)

    def sample(self, parameter: str, times: Array) -> tuple[IndexArray, Array]:
        """Return the times at which a parameter is not at rest, and the highest value of all layers."""
        curves = self.curves[parameter]
        if len(curves) == 1:
            return curves[0].sample(times)
        dense = _highest((curve.sample(times) for curve in curves), len(times))
        index = np.flatnonzero(dense)
        return index, dense[index]

    def lines(self, parameter: str, times: Array) -> Array:
        """Return a parameter's highest value of all layers, by straight lines between knots, shape (n,)."""
        return _highest((curve.lines(times) for curve in self.curves[parameter]), len(times))

    def above(self, parameter: str, threshold: float) -> Spans:
        """Return when the channel requests more than `threshold` of a parameter, shape (n, 2)."""
        if parameter not in self.curves:
            return union(())
        key = (parameter, threshold)
        if key not in self._above:
            self._above[key] = union([curve.above(threshold) for curve in self.curves[parameter]])
        return self._above[key]


def _highest(sampled: Iterable[tuple[IndexArray, Array]], count: int) -> Array:
    dense = np.zeros(count)
    for index, values in sampled:
        dense[index] = np.maximum(dense[index], values)
    return dense


def compile_channels(
    score: Score, lips: CompiledLips | None, compiled: CompiledLayers
) -> tuple[Channel, ...]:
    """Return the channels that the score uses, highest default priority first; `compiled` are its layers."""
    drawn, replaced = drawn_layers(score.manual), replaced_spans(score.manual)
    channels = []
    for name in CHANNELS:
        layers = compiled.of(name)
        levels = priority_curve(_claims(name, layers.values(), lips), CHANNELS.get(name).priority)
        priorities = layer_priorities(layers, levels, compiled.order)
        parts: list[Channel] = []
        for on_top in (False, True):
            together: list[ParameterCurves] = [
                layer.curves for key, layer in layers.items() if key[0] is on_top and key not in priorities
            ]
            harmless = frozenset[str]()
            if name == "lips" and lips is not None and not on_top:
                harmless = lips.harmless.difference(*together)
                together = [{p: LipCurve(lips, p) for p in lips.parameters}, *together]
            parts.append(Channel(name, levels, together, on_top, harmless=harmless))
        parts += [Channel(name, own, [layers[k].curves], *k) for k, own in priorities.items()]
        for part in parts:
            own = part.layers if name == "manual" else [_under(replaced, layer) for layer in part.layers]
            if name == "manual" and part.key == name:
                own = [*drawn, *own]
            if any(own):
                channels.append(replace(part, layers=own))
    return tuple(channels)


ParameterCurves = Mapping[str, Curve]
"""One layer's curve of each parameter."""


def _under(replaced: Mapping[str, Spans], layer: ParameterCurves) -> ParameterCurves:
    """Return a layer's curves, at rest while curves drawn by hand replace them."""
    return {n: ManualOverride(c, replaced[n]) if n in replaced else c for n, c in layer.items()}


def _claims(name: str, layers: Iterable[LayerCurves], lips: CompiledLips | None) -> list[PriorityClaim]:
    """Return what decides the channel's priority; speech without a break counts as one movement."""
    claims = [step.claim() for layer in layers for step in layer.steps]
    if name == "lips" and lips is not None:
        own = CHANNELS.get(name).priority
        claims.extend(PriorityClaim(start, end, end, own, own) for start, end in lips.speech.tolist())
    return claims
