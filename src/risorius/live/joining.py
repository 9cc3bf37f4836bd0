"""Sentences that join a turn while it plays: performed in another thread, heard from a fixed frame on."""

from __future__ import annotations

import os
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from math import ceil

from .turn import LiveStretch, PerformedTurn, TurnPlan
from .waiting import LiveSentence

# Seconds that a turn plays on before those that join it are heard, and more for each character of it: about
# twice what performing takes. Which frame it is must not depend on how fast that goes.
_WAIT, _WAIT_A_CHARACTER = 0.2, 0.002


@dataclass(frozen=True, slots=True)
class Joining:
    """The turn with the `sentences` that join it, which plays from the frame `at` on."""

    at: int
    sentences: tuple[LiveSentence, ...]
    turn: Future[PerformedTurn]


def join_later(playing: LiveStretch, new: tuple[LiveSentence, ...], plan: TurnPlan, frame: int) -> Joining:
    """Perform a turn that plays `frame` next with new sentences: from their last call on at the latest."""
    fps, sentences = plan.settings.fps, (*playing.sentences, *new)
    wait = _WAIT + _WAIT_A_CHARACTER * sum(len(sentence.text) for sentence in sentences)
    at = max(frame, min(frame + ceil(wait * fps), playing.last_call(fps)))
    return Joining(at, new, _threads().submit(plan.extended, playing.sentences, new))


@cache
def _threads() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(os.cpu_count() or 1, "join")
