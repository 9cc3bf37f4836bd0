"""Collect the inputs of channels from a script and what is said of it."""

from __future__ import annotations

from ..core.speech.utterance import Utterance
from ..rules.emotions import Display
from ..script import Script, felt_in, information_in, listening_in, movements_of
from .inputs import ChannelInputs

# Seconds that a script without speech lasts at least, unless it says how long.
SILENT_DURATION = 1.0


def inputs_of(
    script: Script, utterance: Utterance | None, emotions: tuple[Display, ...] = ()
) -> ChannelInputs:
    """Return the inputs of channels: the utterance, if any, the marks of the script, and `emotions`.

    Who speaks, and in which manner, is as the fields of `ChannelInputs` have it by default.
    """
    words, spoken = utterance.words if utterance else (), script.duration or SILENT_DURATION
    spoken = utterance.duration if utterance else spoken
    duration = script.lasting(words, spoken)
    marks = movements_of(script, words, duration)
    return ChannelInputs(
        duration=max([duration, *(m.end for m in marks)]),
        utterance=utterance,
        marks=marks,
        emotions=emotions,
        felt=felt_in(script, words, duration),
        listening=listening_in(script, words, duration),
        information=information_in(script, words, duration),
    )
