"""The numbers by which accents and boundaries are told (`data/prosody.toml`)."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, field
from importlib import resources

from ...reading.toml import parse


@dataclass(frozen=True, slots=True)
class ProminenceRule:
    """Shares of the cues."""

    pitch: float
    loudness: float
    length: float


@dataclass(frozen=True, slots=True)
class AccentOdds:
    """Log odds of an accent."""

    base: float
    content: float
    prominence: float
    excursion: float
    least_excursion: float
    largest_excursion: float
    threshold: float


@dataclass(frozen=True, slots=True)
class TypeRule:
    """Shapes of pitch accents: semitones, seconds, shares of the range."""

    before: float
    after: float
    late_peak: float
    steep_rise: float
    low_share: float
    high_before: float
    valley: float
    valley_share: float
    valley_flat: float
    scooped_rise: float
    downstep: float


@dataclass(frozen=True, slots=True)
class BoundaryOdds:
    """Log odds of a boundary, and the shapes of its tones."""

    pause: float
    base: float
    lengthening: float
    reset: float
    threshold: float
    window: float
    movement: float
    high_share: float


@dataclass(frozen=True, slots=True)
class ProsodyRules:
    """The file."""

    prominence: ProminenceRule
    accent: AccentOdds
    type_: TypeRule = field(metadata={"key": "type"})
    boundary: BoundaryOdds


@functools.cache
def prosody_rules() -> ProsodyRules:
    """Return the package's rules."""
    text = resources.files(__package__).joinpath("data/prosody.toml").read_text("utf-8")
    return parse(ProsodyRules, text, "prosody.toml")


def probability(log_odds: float) -> float:
    """Return the probability (0..1) of log odds."""
    return 1.0 / (1.0 + math.exp(-max(min(log_odds, 50.0), -50.0)))
