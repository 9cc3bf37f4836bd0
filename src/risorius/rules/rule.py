"""Rules: the level they look at, their conditions, their effects and times (paper B, sections 3.1 to 4.2).

The dataclasses are the schema of the rule files: a key that they lack, an unknown phone, emotion, tone or
action unit, and a probability above 1 are errors with their place.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, fields
from enum import StrEnum
from typing import Annotated

from ..core.action_units import resolve_targets
from ..core.channels import CHANNELS
from ..core.functions import ONSET_FUNCTIONS
from ..core.parameters import PARAMETERS, Kind
from ..core.speech.tobi import boundary_tone, pitch_accent
from ..core.speech.utterance import PauseKind, Question
from ..core.units import RiseSeconds, Share
from ..errors import InputError, ParameterError, unknown
from ..reading.frozen import FrozenDict
from ..reading.hints import Range
from .articulation import is_known
from .emotions import emotion
from .lips import lip_table
from .markup import markup_table

ANY, NOTHING_FELT = "any", "none"
HEAD = tuple(p.name for p in PARAMETERS if p.kind is Kind.HEAD)
AWAY = "away"
Shift = Annotated[float, Range(-5.0, 5.0)]


class Level(StrEnum):
    """The stretches of a performance that a rule is tried on, one after another.

    ITEM is the word, in slow speech the syllable (paper B, section 4.1). An UTTERANCE is a sentence, a TURN
    all that is said up to the next listening, INFORMATION a theme or a rheme that the script marks, a
    MOMENT a second of the clip.
    """

    PHONEME = "phoneme"
    SYLLABLE = "syllable"
    WORD = "word"
    ITEM = "item"
    PHRASE = "phrase"
    UTTERANCE = "utterance"
    TURN = "turn"
    PAUSE = "pause"
    INFORMATION = "information"
    MOMENT = "moment"


class Position(StrEnum):
    """The position of a unit among those of its level within the next larger stretch."""

    FIRST = "first"
    INNER = "inner"
    LAST = "last"
    ONLY = "only"


class InformationPart(StrEnum):
    """The topic of an utterance, and what is said of it (Steedman 1991)."""

    THEME = "theme"
    RHEME = "rheme"


class TurnState(StrEnum):
    """Whether it is the speaker's turn or the other's."""

    SPEAKING = "speaking"
    LISTENING = "listening"


class RuleAnchor(StrEnum):
    """The point of a unit from which a movement starts; ANYWHERE is drawn, WHOLE spans the unit.

    AROUND a pause a movement rises over the word before and falls over the word after.
    """

    START = "start"
    MIDDLE = "middle"
    END = "end"
    ACCENT = "accent"
    ANYWHERE = "anywhere"
    WHOLE = "whole"
    AROUND = "around"


@dataclass(frozen=True, slots=True)
class When:
    """The conditions on a unit; an empty condition asks for nothing.

    `accent`, `boundary`: ToBI labels, or "any". `pause`: the pause's kind, or that of the one after the unit.
    `rate`: lowest and highest, syllables a second; `lasting`: likewise, seconds. `emotion`: the strongest one
    felt, by name, at `intensity` at least; "none" if nothing is felt. `information`: the part of what is said
    that the unit is. `profile`, `attitude`: names of
    speakers' profiles, and of attitudes one of which the speaker has.
    """

    accent: tuple[str, ...] = ()
    nuclear: bool | None = None
    boundary: tuple[str, ...] = ()
    pause: tuple[PauseKind, ...] = ()
    question: tuple[Question, ...] = ()
    stress: tuple[Annotated[int, Range(-1, 2)], ...] = ()
    position: tuple[Position, ...] = ()
    phones: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    rate: tuple[float, float] | None = None
    lasting: tuple[float, float] | None = None
    emotion: tuple[str, ...] = ()
    intensity: Share = 0.0
    turn: tuple[TurnState, ...] = ()
    information: tuple[InformationPart, ...] = ()
    profile: tuple[str, ...] = ()
    attitude: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self._check_names()
        for what, limits in (("rate", self.rate), ("lasting", self.lasting)):
            if limits is not None and not 0.0 <= limits[0] < limits[1]:
                raise InputError(
                    f"{what} = {list(limits)} can never be met; expected [low, high], low < high"
                )

    def _check_names(self) -> None:
        for label in {*self.accent} - {ANY}:
            pitch_accent(label)
        for label in {*self.boundary} - {ANY}:
            boundary_tone(label)
        for phone in self.phones:
            if not is_known(phone):
                lip_table().shape(phone)
        for name in {*self.emotion} - {NOTHING_FELT}:
            emotion(name)

    def suits(self, profile: str, attitudes: Collection[str]) -> bool:
        """Return whether a speaker with a profile and attitudes, by name, is one whom the rule is for."""
        return (not self.profile or profile in self.profile) and (
            not self.attitude or not set(self.attitude).isdisjoint(attitudes)
        )

    def asked(self) -> tuple[str, ...]:
        """Return the names of the conditions that ask for something."""
        return tuple(f.name for f in fields(self) if getattr(self, f.name) not in ((), None, 0.0))


@dataclass(frozen=True, slots=True)
class Effect:
    """The effect of a rule: targets at full size, a gesture of the head, a look, a blink.

    `targets`: action units, muscles, degrees. `gesture`: a name in `markup.toml`, made `times` times at
    `size` times its amplitude. `look`: a direction there; "away" draws one. `blink`: how far the lids
    close, in a natural blink that is complete.
    `emblem`: an emotion's. `vary`: the standard deviation of the size from one event to the next, as a share.
    `on_top`: the targets add to what other channels leave of them, as those on a display do.
    `mirror`: the head's turns and tilts go to either side, by the speaker's preference; `grouped`: alike for
    related utterances.
    """

    targets: Mapping[str, float] = field(default_factory=FrozenDict)
    gesture: str | None = None
    times: Annotated[int, Range(1, 10)] = 1
    size: Annotated[float, Range(0.0, 3.0)] = 1.0
    look: str | None = None
    blink: Share | None = None
    emblem: str | None = None
    vary: Share = 0.0
    on_top: bool = False
    mirror: bool = False
    grouped: bool = False

    def __post_init__(self) -> None:
        resolve_targets(self.targets)
        table = markup_table()
        if self.gesture is not None and self.gesture not in table.head:
            raise ParameterError(unknown("gesture", self.gesture, table.head))
        if self.look is not None and self.look not in table.gaze:
            raise ParameterError(unknown("direction", self.look, table.gaze))
        if self.emblem is not None:
            emotion(self.emblem)
        if not (self.targets or self.gesture or self.look or self.blink or self.emblem):
            raise InputError("the effect does nothing; expected targets, gesture, look, blink or emblem")


@dataclass(frozen=True, slots=True)
class Timing:
    """The timing of a rule's movement, seconds.

    It starts `lead` before the anchor, is held for `apex` (to the unit's end if None), and is snapped to
    the phonemes' boundaries unless `snap` is false. `function`: an onset function, the channel's if None.
    `shortest`: how long a movement lasts at least that spans its unit.
    """

    at: RuleAnchor = RuleAnchor.START
    lead: Shift = 0.0
    onset: RiseSeconds = 0.1
    apex: RiseSeconds | None = None
    offset: RiseSeconds = 0.2
    snap: bool = True
    function: str | None = None
    shortest: RiseSeconds = 0.1

    def __post_init__(self) -> None:
        if self.function is not None:
            ONSET_FUNCTIONS.get(self.function)


_ID = re.compile(r"(?<![a-z_])[a-z_]++(?:\.[\w-]++){2,}")
RULED_CHANNELS = tuple(name for name in CHANNELS if CHANNELS.get(name).rules)
# Conditions that units of a level can meet; all others would keep a rule from ever firing.
_ALWAYS = frozenset({"rate", "lasting", "emotion", "intensity", "turn", "profile", "attitude"})
_SPOKEN = frozenset({"accent", "nuclear", "boundary", "pause", "question", "stress", "position", "words"})
CONDITIONS: Mapping[Level, frozenset[str]] = {
    Level.PHONEME: _ALWAYS | {"phones", "stress", "position", "words", "question", "pause"},
    Level.SYLLABLE: _ALWAYS | _SPOKEN,
    Level.WORD: _ALWAYS | _SPOKEN,
    Level.ITEM: _ALWAYS | _SPOKEN,
    Level.PHRASE: _ALWAYS | (_SPOKEN - {"stress", "words", "nuclear"}),
    Level.UTTERANCE: _ALWAYS | {"boundary", "pause", "question", "position"},
    Level.TURN: _ALWAYS | {"question", "position"},
    Level.PAUSE: _ALWAYS | {"pause", "question", "position"},
    Level.INFORMATION: _ALWAYS | {"information", "boundary", "pause", "question", "position"},
    Level.MOMENT: _ALWAYS - {"lasting"},
}


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule. `id`: the channel, the part that moves (a layer of the channel), and a name.

    `pauses`: ids, or their beginnings up to a dot, of rules that do not act while this one does. `replaces`:
    ids of the rules that this one stands for. `source`: where it comes from; `comment`: why it is so.
    """

    id: str
    level: Level
    effect: Effect
    source: str
    comment: str
    when: When = field(default_factory=When)
    timing: Timing = field(default_factory=Timing)
    probability: Share = 1.0
    pauses: tuple[str, ...] = ()
    replaces: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.channel not in RULED_CHANNELS:
            raise ParameterError(unknown(f"channel of rule '{self.id}'", self.channel, RULED_CHANNELS))
        if not _ID.fullmatch(self.id):
            raise InputError(f"rule id '{self.id}' cannot be used; expected channel.part.name")
        if self.timing.at is RuleAnchor.AROUND and self.level is not Level.PAUSE:
            raise InputError(
                f"rule '{self.id}': only a pause has words around it; expected level = \"pause\""
            )
        for name in self.when.asked():
            if name not in CONDITIONS[self.level]:
                known = ", ".join(sorted(CONDITIONS[self.level]))
                message = f"rule '{self.id}' can never fire: no {self.level} has '{name}'; expected {known}"
                raise InputError(message)

    @property
    def channel(self) -> str:
        """The channel that performs it."""
        return self.id.partition(".")[0]

    @property
    def part(self) -> str:
        """The part of the face that moves."""
        return self.id.split(".")[1]

    @property
    def moves_head_in_speech(self) -> bool:
        """Whether it moves the head together with words: not in pauses, nor about the end of a turn."""
        turns = any(name in HEAD for name in self.effect.targets) or self.effect.gesture is not None
        return turns and self.level not in (Level.PAUSE, Level.TURN, Level.MOMENT)
