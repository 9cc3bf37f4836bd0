"""From inputs to the score: rules propose, rivals are resolved, every channel builds.

All channels build, each with random numbers of its own; a channel that is left out is dropped afterwards, so
that the others are as they were (paper B, section 3.2).
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from ..core.channels import CHANNELS
from ..core.counter_rng import CounterRng
from ..core.movement import LipSegment, Movement
from ..core.score import BlendSettings, Score, check_course
from ..core.speech.characters import shown
from ..errors import ParameterError, unknown
from ..rules.habits import with_habits
from ..rules.match import Event, events_of
from ..rules.resolve import resolve
from ..rules.speakers import rules_of_speaker
from .inputs import ChannelInputs, Context
from .registry import builder_of

HORIZON = 0.55
"""The reach of appended text, in seconds: up to this long before the end of the last sentence so far, no
movement begins, goes on or ends in another way because of it.

That is .9 s before the end of a live turn (DESIGN, section 6), which is silent for .35 s. The package's rules
and profiles keep to it. A user's rule that acts before the end of a turn reaches back by its own `lead`.
"""


def compose(
    inputs: ChannelInputs,
    *,
    seed: int = 0,
    without: Collection[str] = (),
    settings: BlendSettings | None = None,
) -> Score:
    """Return the score that all channels but those in `without` build.

    Raises ParameterError for an unknown channel, InputError for a duration out of range and if two movements
    of a channel start together. All else is checked when the score is planned.
    """
    channels = built_channels()
    for name in without:
        if name not in channels:
            raise ParameterError(unknown("channel", name, channels))
    inputs = replace(inputs, rules=rules_of_speaker(inputs.rules, inputs.profile, inputs.attitudes))
    if inputs.rules.habits:
        inputs = replace(inputs, profile=with_habits(inputs.profile, inputs.rules.habits))
    events = proposed(inputs, seed)
    movements: list[Movement] = []
    segments: list[LipSegment] = []
    for name in channels:
        context = Context(name, events, tuple(movements), CounterRng(seed, name))
        for built in builder_of(CHANNELS.get(name))(inputs, context):
            if isinstance(built, LipSegment):
                segments.append(built)
            else:
                movements.append(built)
    performed = sorted(
        (m for m in movements if m.channel not in without), key=lambda m: (m.start, m.channel, m.layer)
    )
    score = Score(
        inputs.duration,
        tuple(performed),
        () if "lips" in without else tuple(segments),
        settings=settings or BlendSettings(),
        text=shown(inputs.utterance.text) if inputs.utterance else "",
        seed=seed,
    )
    check_course(score)
    return score


def built_channels() -> tuple[str, ...]:
    """Return the names of the channels that are built, in the order in which they are."""
    channels = [channel for channel in map(CHANNELS.get, CHANNELS) if channel.built]
    return tuple(c.name for c in sorted(channels, key=lambda c: (c.order, c.name)))


def proposed(inputs: ChannelInputs, seed: int) -> tuple[Event, ...]:
    """Return the events of the rules that happen; a still face has none."""
    if not inputs.lively:
        return ()
    events = events_of(
        inputs.rules, inputs.units, CounterRng(seed), modulations=inputs.modulations, side=inputs.profile.side
    )
    exclusive = [m for m in inputs.marks if CHANNELS.get(m.channel).exclusive]
    return tuple(resolve(events, [(m.start, m.end, frozenset(m.parameters)) for m in exclusive]))
