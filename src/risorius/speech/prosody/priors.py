"""Prior values from which running statistics start (`data/priors.toml`)."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from importlib import resources
from typing import Annotated

from ...core.units import Share
from ...reading.hints import Range
from ...reading.toml import parse

Deviation = Annotated[float, Range(0.01, 20.0)]


@dataclass(frozen=True, slots=True)
class NormalPrior:
    """Mean and standard deviation of values before any is known."""

    mean: float
    deviation: Deviation


@dataclass(frozen=True, slots=True)
class PitchPrior:
    """Semitones above 1 Hz: the mean of all speakers, the deviation of their means, and one speaker's."""

    mean: float
    between: Deviation
    deviation: Deviation


@dataclass(frozen=True, slots=True)
class RangePrior:
    """Semitones from a speaker's median to the quantiles 0.05, 0.25, 0.75 and 0.95."""

    low: float
    lower: float
    upper: float
    high: float


@dataclass(frozen=True, slots=True)
class VoicePrior:
    """Deviation of a synthesizer's voice, in semitones."""

    deviation: Deviation


@dataclass(frozen=True, slots=True)
class Priors:
    """The file. `seconds`: how much speech each prior counts like."""

    seconds: Annotated[float, Range(0.1, 60.0)]
    syllables: Annotated[float, Range(0.5, 20.0)]
    voiced: Share
    pitch: PitchPrior
    range_: RangePrior = field(metadata={"key": "range"})
    peak: NormalPrior
    loudness: NormalPrior
    stress: NormalPrior
    length: NormalPrior
    lengthening: NormalPrior
    standing: NormalPrior
    voice: VoicePrior


@functools.cache
def priors() -> Priors:
    """Return the package's table."""
    text = resources.files(__package__).joinpath("data/priors.toml").read_text("utf-8")
    return parse(Priors, text, "priors.toml")
