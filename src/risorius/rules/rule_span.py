"""A unit: a stretch of a performance that rules are tried on, with all that a rule may ask about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..core.speech.utterance import Accent, PauseKind, Question
from ..reading.frozen import FrozenDict
from .rule import InformationPart, Level, Position, TurnState
from .synchrony import synchrony


@dataclass(frozen=True, slots=True)
class RuleSpan:
    """A stretch of seconds [start, end] and its facts.

    `text`: how messages name it. `accented`: where its accented syllable begins, the nuclear one of several.
    `rate`: syllables a second of its phrase. `group`: which run of related utterances it belongs to. `phrase`
    and `number`: its phrase, and which it is of its level there; they count the random numbers of rules.
    `before`: when the pause before a pause has ended, and when the word before it begins; `after`: when the
    word after it ends, and when the next pause begins.
    """

    level: Level
    phrase: int
    number: int
    start: float
    end: float
    text: str
    accents: tuple[Accent, ...] = ()
    accented: float | None = None
    boundary: str | None = None
    pause: PauseKind | None = None
    question: Question = Question.NONE
    stress: int = -1
    position: Position = Position.ONLY
    phone: str = ""
    words: frozenset[str] = frozenset()
    rate: float = field(default_factory=lambda: synchrony().usual_rate)
    group: int = 0
    emotions: Mapping[str, float] = field(default_factory=FrozenDict)
    turn: TurnState = TurnState.SPEAKING
    information: InformationPart | None = None
    before: tuple[float, float] | None = None
    after: tuple[float, float] | None = None

    @property
    def middle(self) -> float:
        """Seconds."""
        return 0.5 * (self.start + self.end)
