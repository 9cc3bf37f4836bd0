"""Sentences that join a turn while it plays: performed in another thread, heard from a fixed frame on."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from math import ceil

from .turn import LiveStretch, PerformedTurn, TurnPlan
from .waiting import LiveSentence

# Seconds that a turn plays on before those that join it are heard, and more for each character of it: about
# twice what performing takes. Which frame it is must not depend on how fast that goes.
_WAIT, _WAIT_A_CHARACTER = 0.2, 0.002


@dataclass(frozen=True, slots=True)
class Joining:
    """The turn with the `sentences` that join it, which plays from the frame `at` on; with none it ends."""

    at: int
    sentences: tuple[LiveSentence, ...]
    turn: Future[PerformedTurn]


def join_later(
    playing: LiveStretch, new: tuple[LiveSentence, ...], plan: TurnPlan, frame: int, *, goes_on: bool
) -> Joining:
    """Perform a turn that plays `frame` next with new sentences: from their last call on at the latest.

    With `goes_on` still more will be said.
    """
    at = max(
        frame, min(frame + _wait((*playing.sentences, *new), plan), playing.last_call(plan.settings.fps))
    )
    turn = _threads(plan.performer.threads).submit(plan.extended, playing.sentences, new, goes_on=goes_on)
    return Joining(at, new, turn)


def end_later(playing: LiveStretch, plan: TurnPlan, frame: int, *, told: bool) -> Joining | None:
    """Perform a turn that plays `frame` next as one that ends; None while there is time for more.

    `told`: nothing more will be said.
    """
    at = playing.last_call(plan.settings.fps)
    if not (told or frame >= at - _wait(playing.sentences, plan)):
        return None
    joining = join_later(playing, (), plan, frame, goes_on=False)
    return joining if told else replace(joining, at=max(frame, at))


def _wait(sentences: tuple[LiveSentence, ...], plan: TurnPlan) -> int:
    """Return the frames that performing sentences may take."""
    characters = sum(len(sentence.text) for sentence in sentences)
    return ceil((_WAIT + _WAIT_A_CHARACTER * characters) * plan.settings.fps)


@cache
def _threads(most: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(most, "join")
