"""The channels of a score, compiled: each with its priority over time and its curves by parameter."""

from __future__ import annotations

from collections import defaultdict
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
from .manual import ManualOverride, key_curves, replaced_spans
from .mouth.lips import CompiledLips, LipCurve
from .priority_curve import PriorityClaim, PriorityCurve, priority_curve


@dataclass(slots=True)
class Channel:
    """A channel: its priority, and all curves by parameter, one for each layer that moves it.

    `on_top`: these curves are of movements that add to what the others leave. `stratum`: they are of one
    layer, which conflicts with another. The rest of the channel is another Channel of the same name.
    `harmless`: the parameters in which it inhibits no rival.
    """

    name: str
    levels: PriorityCurve
    curves: dict[str, list[Curve]]
    on_top: bool = False
    stratum: str | None = None
    harmless: frozenset[str] = frozenset()
    _above: dict[tuple[str, float], Spans] = field(default_factory=dict, init=False)

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
    drawn = {name: list[Curve](curves) for name, curves in key_curves(score.manual).items()}
    replaced = replaced_spans(score.manual)
    channels = []
    for name in CHANNELS:
        layers = compiled.of(name)
        levels = priority_curve(_claims(name, layers.values(), lips), CHANNELS.get(name).priority)
        priorities = layer_priorities(layers, levels, compiled.order)
        parts: list[Channel] = []
        for on_top in (False, True):
            together = [layer for key, layer in layers.items() if key[0] is on_top and key not in priorities]
            curves, harmless = _layered(together), frozenset[str]()
            if name == "lips" and lips is not None and not on_top:
                harmless = lips.harmless - set(curves)
                curves = _joined({p: [LipCurve(lips, p)] for p in lips.parameters}, curves)
            parts.append(Channel(name, levels, curves, on_top, harmless=harmless))
        parts += [Channel(name, own, _layered([layers[k]]), *k) for k, own in priorities.items()]
        for part in parts:
            curves = part.curves if name == "manual" else _under(replaced, part.curves)
            if name == "manual" and part.key == name:
                curves = _joined(drawn, curves)
            if curves:
                channels.append(replace(part, curves=dict(sorted(curves.items()))))
    return tuple(channels)


Curves = dict[str, list[Curve]]


def _layered(layers: Iterable[LayerCurves]) -> Curves:
    """Return the curves of all layers by parameter."""
    curves: Curves = defaultdict(list)
    for layer in layers:
        for parameter, curve in layer.curves.items():
            curves[parameter].append(curve)
    return curves


def _joined(first: Mapping[str, Sequence[Curve]], then: Curves) -> Curves:
    return {name: [*first.get(name, ()), *then.get(name, ())] for name in {**first, **then}}


def _under(replaced: Mapping[str, Spans], curves: Curves) -> Curves:
    """Return the curves, at rest while curves drawn by hand replace them."""
    return {
        name: [ManualOverride(curve, replaced[name]) for curve in own] if name in replaced else own
        for name, own in curves.items()
    }


def _claims(name: str, layers: Iterable[LayerCurves], lips: CompiledLips | None) -> list[PriorityClaim]:
    """Return what decides the channel's priority; speech without a break counts as one movement."""
    claims = [step.claim() for layer in layers for step in layer.steps]
    if name == "lips" and lips is not None:
        own = CHANNELS.get(name).priority
        claims.extend(PriorityClaim(start, end, end, own, own) for start, end in lips.speech.tolist())
    return claims
