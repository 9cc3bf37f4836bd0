"""Sentences that join a turn while it plays: performed in another thread, heard from a fixed frame on."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass
from math import ceil

from .sentence_queue import LiveSentence
from .threads import threads
from .turn import LiveStretch, PerformedTurn, TurnPlan

# Seconds that a turn plays on before those that join it are heard, and more for each character of it: about
# twice what performing takes. Which frame it is must not depend on how fast that goes.
_WAIT, _WAIT_A_CHARACTER = 0.2, 0.002


@dataclass(frozen=True, slots=True)
class TurnExtension:
    """The turn with the `sentences` that join it, which plays from the frame `at` on."""

    at: int
    sentences: tuple[LiveSentence, ...]
    turn: Future[PerformedTurn]


def join_later(
    playing: LiveStretch, new: tuple[LiveSentence, ...], plan: TurnPlan, frame: int
) -> TurnExtension:
    """Perform a turn that plays `frame` next with new sentences: from their last call on at the latest."""
    at = _heard_from(playing, (*playing.sentences, *new), plan, frame)
    turn = threads("join", plan.performer.threads).submit(plan.extended, playing.sentences, new)
    return TurnExtension(at, new, turn)


def lead_on_later(playing: LiveStretch, following: LiveSentence, plan: TurnPlan, frame: int) -> TurnExtension:
    """Perform a full turn that plays `frame` next as one that another follows at once."""
    at = _heard_from(playing, (*playing.sentences, following), plan, frame)
    turn = threads("join", plan.performer.threads).submit(plan.led_on, playing, following)
    return TurnExtension(at, (), turn)


def _heard_from(playing: LiveStretch, sentences: tuple[LiveSentence, ...], plan: TurnPlan, frame: int) -> int:
    """Return the frame from which on a turn of these sentences is heard in place of the one that plays."""
    return max(frame, min(frame + _wait(sentences, plan), playing.join_deadline(plan.settings.fps)))


def _wait(sentences: tuple[LiveSentence, ...], plan: TurnPlan) -> int:
    """Return the frames that performing sentences may take."""
    characters = sum(len(sentence.text) for sentence in sentences)
    return ceil((_WAIT + _WAIT_A_CHARACTER * characters) * plan.settings.fps)
