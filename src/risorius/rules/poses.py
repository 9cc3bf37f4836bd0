"""One face from muscles, action units and emotions."""

from __future__ import annotations

from collections.abc import Mapping

from ..core.action_units import resolve_targets
from ..core.arrays import Array
from ..core.parameters import INDEX, NEUTRAL
from .emotions import emotion_key
from .fuzzy import blended


def posed(targets: Mapping[str, float], emotion: Mapping[str, float]) -> dict[str, float]:
    """Return a pose's values by parameter: `targets` by muscle, action unit, alias or other parameter, with
    emotions (intensities 0..1 by name) on top. Raises ParameterError.
    """
    units = dict(targets)
    for name, value in blended({emotion_key(name): value for name, value in emotion.items()}).items():
        units[name] = max(units.get(name, 0.0), value, key=abs)
    return resolve_targets(units)


def pose_values(targets: Mapping[str, float], emotion: Mapping[str, float]) -> Array:
    """Return all parameters of a pose, shape (46,), as `posed` has them. Raises ParameterError."""
    values = NEUTRAL.copy()
    for name, value in posed(targets, emotion).items():
        values[INDEX[name]] = value
    return values
