"""Thresholds and minimum durations of every parameter, from the table or a score's settings."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..core.functions import ONSET_FUNCTIONS
from ..core.parameters import PARAMETERS, Kind
from ..core.score import BlendSettings
from ..errors import InputError


@dataclass(frozen=True, slots=True)
class Tuning:
    """For each parameter by name: activation threshold, minimum onset and offset in seconds."""

    threshold: dict[str, float]
    min_onset: dict[str, float]
    min_offset: dict[str, float]

    @property
    def longest(self) -> float:
        """The longest minimum duration, seconds: a conflict has an effect over no longer time."""
        return max(*self.min_onset.values(), *self.min_offset.values())


def tune(settings: BlendSettings) -> Tuning:
    """Return the table's values; the settings may override them for all muscles.

    Raises InputError for values out of range and ParameterError for an unknown onset function.
    """
    check_settings(settings)

    def column(name: str, override: float | None) -> dict[str, float]:
        return {
            p.name: override if override is not None and p.kind is Kind.MUSCLE else float(getattr(p, name))
            for p in PARAMETERS
        }

    return Tuning(
        column("threshold", settings.activation_threshold),
        column("min_onset", settings.min_onset),
        column("min_offset", settings.min_offset),
    )


def check_settings(settings: BlendSettings) -> None:
    """Raise InputError or ParameterError if a setting is out of range or unknown."""
    threshold = settings.activation_threshold
    if threshold is not None and not 0.0 <= threshold <= 1.0:
        raise InputError(f"activation_threshold = {threshold} is out of range; expected 0 to 1")
    for name in ("min_onset", "min_offset"):
        seconds = getattr(settings, name)
        if seconds is not None and not (seconds >= 0.0 and math.isfinite(seconds)):
            raise InputError(f"{name} = {seconds} must be 0 or more seconds")
    if settings.onset_function is not None:
        ONSET_FUNCTIONS.get(settings.onset_function)
