"""The layers of a score, concatenated: those that another plan has in common with it are not made again."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace

from ..core.antagonists import antagonist_pairs, without_antagonists
from ..core.movement import Movement
from ..core.score import Score
from .concatenate import LayerCurves, concatenate
from .layer_priority import LayerKey


class CompiledLayers:
    """All layers of a score by channel; `order` is the place in the score of each movement, by its `id()`.

    `like` are those of another score: a layer of the very same movements under the same settings is shared.
    """

    def __init__(self, score: Score, like: CompiledLayers | None = None) -> None:
        self._score, self.order = score, dict[int, int]()
        if like is not None and like._score.settings != score.settings:
            like = None
        # By the `id()` of the score's movements, which live as long as the score.
        self._performed: dict[int, Movement] = {}
        performed = {} if like is None else like._performed
        movements: dict[str, dict[LayerKey, list[Movement]]] = defaultdict(lambda: defaultdict(list))
        for number, written in enumerate(score.movements):
            movement = performed.get(id(written)) or _without_rivals(written, score.settings.conflict)
            self._performed[id(written)] = movement
            movements[movement.channel][movement.on_top, movement.layer].append(movement)
            self.order[id(movement)] = number
        self._movements = movements
        self._curves: dict[str, dict[LayerKey, LayerCurves]] = {
            channel: {key: self._concatenated(channel, key, like) for key in sorted(layers)}
            for channel, layers in movements.items()
        }

    def of(self, channel: str) -> dict[LayerKey, LayerCurves]:
        """Return the layers of a channel, in the order of their keys."""
        return self._curves.get(channel, {})

    def _concatenated(self, channel: str, key: LayerKey, like: CompiledLayers | None) -> LayerCurves:
        own = self._movements[channel][key]
        if like is not None and key in like.of(channel):
            others = like._movements[channel][key]
            if len(own) == len(others) and all(a is b for a, b in zip(own, others, strict=True)):
                return like.of(channel)[key]
        return concatenate(own, self._score.settings.onset_function)


def _without_rivals(movement: Movement, conflict: str) -> Movement:
    """Return a movement whose rivals sum to 1 at most; other systems, which `sum` stands for, leave them."""
    targets = movement.parameters
    if conflict == "sum" or not any(antagonist_pairs(targets)):
        return movement
    return replace(movement, targets=without_antagonists(targets))
