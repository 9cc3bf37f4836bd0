"""Sentences of our own, spoken once, and the curves that the channels make of them."""

from __future__ import annotations

from functools import cache

import numpy as np

import risorius
from risorius.channels import ChannelInputs, Display, compose
from risorius.core.arrays import Array
from risorius.core.movement import Movement
from risorius.core.score import Score
from risorius.core.speech.utterance import Utterance

from ..paper_curves import FPS, Curves, performed

RIVER = "Well, the river rose again last night, and nobody noticed the boats."
ROPES = "Did you bring the maps, the ropes and the lanterns? We must leave before dawn!"
BROTHER = "My brother, who never hurries, missed the last bus. Perhaps he will walk home."
WINDOW = "No, I would rather stay here, beside the window, until the rain is over."
SENTENCES = (RIVER, ROPES, BROTHER, WINDOW)


@cache
def spoken(text: str, rate: int | None = None, **settings: object) -> risorius.Take:
    """Perform a sentence at `FPS` frames a second."""
    chosen = risorius.Settings(fps=FPS, rate=rate, **settings)
    return risorius.speak(text, text=True, settings=chosen)


def utterance(text: str, rate: int | None = None) -> Utterance:
    said = spoken(text, rate).utterance
    assert said is not None
    return said


def score_of(said: Utterance, *emotions: Display, seed: int = 0, **inputs: object) -> Score:
    """Return the score of an utterance whose voice is not coloured by the emotions."""
    given = ChannelInputs(said.duration, said, emotions=emotions, **inputs)  # type: ignore[arg-type]
    return compose(given, seed=seed)


def curves_of(score: Score, *rules: str) -> Curves:
    """Return the curves of the movements of a score whose rules begin so; of all without lips if none."""
    found = [m for m in score.movements if not rules or m.cause.rule.startswith(rules)]
    return performed(found, score.duration, FPS)


def by_rule(score: Score, *rules: str) -> list[Movement]:
    return [m for m in score.movements if m.cause.rule.startswith(rules)]


def speed(curves: Curves, names: tuple[str, ...]) -> Array:
    """Return the speed of several directions together, degrees a second, shape (frames − 1,)."""
    return FPS * np.sqrt(sum(np.diff(curves[name]) ** 2 for name in names))


def index(time: float) -> int:
    return round(time * FPS)
