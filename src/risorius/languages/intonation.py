"""Rules of intonation from text (`intonation.toml` in a language's folder)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from ..core.speech.tobi import boundary_tone, pitch_accent
from ..core.speech.utterance import Ending
from ..core.units import Share
from ..reading.hints import Range


@dataclass(frozen=True, slots=True)
class Candidate:
    """A syllable that might be accented.

    `content`: of a content word. `contrast`: of a word that is contrasted with another. `only`: no word of
    the phrase is one, and this is its strongest syllable.
    `nuclear`: the last candidate of its phrase. `focus`, `after_focus`: the word is emphasised, or follows
    one that is. `ends`: how the phrase ends. `lexical_tone`: pitch tells words apart in the language.
    """

    content: bool
    only: bool
    nuclear: bool
    focus: bool
    after_focus: bool
    ends: Ending
    lexical_tone: bool = False
    deaccented: bool = False
    contrast: bool = False


@dataclass(frozen=True, slots=True)
class AccentRule:
    """Conditions on a candidate (None: any value), and the accent it gets; no accent without a label."""

    content: bool | None = None
    only: bool | None = None
    nuclear: bool | None = None
    focus: bool | None = None
    after_focus: bool | None = None
    lexical_tone: bool | None = None
    deaccented: bool | None = None
    contrast: bool | None = None
    ends: tuple[Ending, ...] = ()
    label: str | None = None
    confidence: Share = 1.0

    def __post_init__(self) -> None:
        if self.label is not None:
            pitch_accent(self.label)

    def fits(self, candidate: Candidate) -> bool:
        """Tell whether a candidate is all that the rule names."""
        pairs = (
            (self.content, candidate.content),
            (self.only, candidate.only),
            (self.nuclear, candidate.nuclear),
            (self.focus, candidate.focus),
            (self.after_focus, candidate.after_focus),
            (self.lexical_tone, candidate.lexical_tone),
            (self.deaccented, candidate.deaccented),
            (self.contrast, candidate.contrast),
        )
        return all(wanted in (None, given) for wanted, given in pairs) and (
            not self.ends or candidate.ends in self.ends
        )


@dataclass(frozen=True, slots=True)
class BoundaryRule:
    """The tones of phrases that end in one of these ways."""

    ends: tuple[Ending, ...]
    label: str
    confidence: Share

    def __post_init__(self) -> None:
        boundary_tone(self.label)


@dataclass(frozen=True, slots=True)
class Voicing:
    """The sound of tones: semitones on an accented word, the punctuation that ends a phrase so."""

    accents: Mapping[str, Annotated[float, Range(-12.0, 12.0)]]
    boundaries: Mapping[str, str]

    def __post_init__(self) -> None:
        for label in self.accents:
            pitch_accent(label)
        for label in self.boundaries:
            boundary_tone(label)


@dataclass(frozen=True, slots=True)
class IntonationTable:
    """The file `intonation.toml`."""

    accent: tuple[AccentRule, ...]
    boundary: tuple[BoundaryRule, ...]
    voice: Voicing

    def accent_of(self, candidate: Candidate) -> AccentRule | None:
        """Return the first rule that fits a candidate, None if it gets no accent."""
        rule = next((rule for rule in self.accent if rule.fits(candidate)), None)
        return rule if rule is not None and rule.label is not None else None

    def boundary_of(self, ends: Ending) -> BoundaryRule | None:
        """Return the rule for phrases that end so."""
        return next((rule for rule in self.boundary if ends in rule.ends), None)
