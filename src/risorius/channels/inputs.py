"""The inputs of channels."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from ..core.counter_rng import CounterRng
from ..core.movement import Movement
from ..core.speech.utterance import Utterance
from ..rules.emotions import Display
from ..rules.match import Event, felt_modulations
from ..rules.modulation import Modulation
from ..rules.profiles import NEUTRAL, Attitude, Profile, profile
from ..rules.rule_set import RuleSet, shipped
from ..rules.rule_spans import RuleSpans
from ..rules.situation import PartSpan, Situation


@dataclass(frozen=True)
class ChannelInputs:
    """All that a channel may build from.

    `utterance` is None if nothing is said. `marks`: the script's movements, of all channels. `emotions`:
    the displays asked for beside the script; `felt`: those that the script marks. `listening`: spans of
    listening, seconds. `information`: themes and rhemes. `lively`: whether rules, random
    blinks, small head and eye movements are wanted.
    `rules`: those in force.
    """

    duration: float
    utterance: Utterance | None = None
    marks: tuple[Movement, ...] = ()
    emotions: tuple[Display, ...] = ()
    felt: tuple[Display, ...] = ()
    listening: tuple[tuple[float, float], ...] = ()
    information: tuple[PartSpan, ...] = ()
    articulation: float = 1.0
    manner: str = "plain"
    lively: bool = True
    profile: Profile = field(default_factory=lambda: profile(NEUTRAL))
    attitudes: tuple[Attitude, ...] = ()
    rules: RuleSet = field(default_factory=shipped)

    @cached_property
    def situation(self) -> Situation:
        """The situation that rules are matched against."""
        felt = (*self.felt, *self.emotions)
        return Situation(self.duration, self.utterance, felt, self.listening, self.information)

    @cached_property
    def units(self) -> RuleSpans:
        """The stretches that rules are tried on."""
        return RuleSpans(self.situation)

    @cached_property
    def modulations(self) -> tuple[Modulation, ...]:
        """The speaker's modulations, without those of emotions."""
        return (self.profile.modulation, *(a.modulation for a in self.attitudes))

    def modulations_at(self, time: float) -> tuple[Modulation, ...]:
        """Return the speaker's modulations at a time, including those of emotions."""
        return (*self.modulations, *felt_modulations(self.situation.emotions_at(time)))

    def marked(self, channel: str) -> tuple[Movement, ...]:
        """Return the script's movements of a channel."""
        return tuple(m for m in self.marks if m.channel == channel)


@dataclass(frozen=True, slots=True)
class Context:
    """The context of a channel while it builds: its own `name`, the events of all rules, the movements that
    the channels before it `built`, and its random numbers.
    """

    name: str
    events: tuple[Event, ...]
    built: tuple[Movement, ...]
    numbers: CounterRng
