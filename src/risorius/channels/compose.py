"""From a brief to the score: every channel builds, one generator each."""

from __future__ import annotations

from collections.abc import Collection

from ..core.movement import LipSegment, Movement
from ..core.score import BlendSettings, Score, check_score
from . import emotion, idle, lips, manipulators, marks  # noqa: F401 - each registers its channels
from .registry import CHANNEL_BUILDERS, Brief, generator


def compose(
    brief: Brief, *, seed: int = 0, without: Collection[str] = (), settings: BlendSettings | None = None
) -> Score:
    """Return the score that all channels but those in `without` build.

    Raises ParameterError for an unknown channel, InputError if two movements of a channel start together.
    """
    for name in without:
        CHANNEL_BUILDERS.get(name)
    movements: list[Movement] = []
    segments: list[LipSegment] = []
    for name in CHANNEL_BUILDERS:
        if name in without:
            continue
        for built in CHANNEL_BUILDERS.get(name)(brief, generator(seed, name)):
            if isinstance(built, LipSegment):
                segments.append(built)
            else:
                movements.append(built)
    movements.sort(key=lambda m: (m.start, m.channel, m.layer))
    text = brief.utterance.text if brief.utterance else ""
    score = Score(
        brief.duration,
        tuple(movements),
        tuple(segments),
        settings=settings or BlendSettings(),
        text=text,
        seed=seed,
    )
    check_score(score)
    return score
