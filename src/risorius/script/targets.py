"""Targets named by attributes: emotions, action units, muscles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from ..core.action_units import ACTION_UNITS, action_unit, kept_units, unit_weights
from ..core.parameters import ALIASES, BASES, PARAMETERS
from ..errors import RisoriusError
from ..rules.emotions import Emotion, emotion, emotion_names
from ..rules.fuzzy import blended
from .attributes import Attributes, number_of
from .elements import Attribute

_TARGET_NAMES = (*BASES, *ALIASES, *(f"AU{number}" for number in ACTION_UNITS))


def take_targets(attributes: Attributes) -> dict[str, float]:
    """Return the targets that all remaining attributes give, action units kept as such; they add up.

    Raises ParameterError, with the place, for an unknown name and for a value out of range.
    """
    return combined(_resolved(attributes, name, a, _TARGET_NAMES) for name, a in attributes.rest())


class TakenEmotions(NamedTuple):
    """The parameters' values, the emotions with their intensities 0..1, and the strongest of them."""

    targets: dict[str, float]
    intensities: dict[str, float]
    strongest: Emotion | None


def take_emotions(attributes: Attributes, *, emblem: bool) -> TakenEmotions:
    """Return as `take_targets`, and emotions by name or alias with their intensity; displays blend."""
    parts: list[Mapping[str, float]] = []
    felt: dict[str, tuple[float, Emotion]] = {}
    for name, attribute in attributes.rest():
        if name not in emotion_names():
            parts.append(_resolved(attributes, name, attribute, (*emotion_names(), *_TARGET_NAMES)))
            continue
        known_emotion, intensity = emotion(name), number_of(attribute, 0.0, 1.0)
        if known_emotion.name in felt:
            raise attributes.error(f"{known_emotion.name} is given twice; expected it once", attribute.place)
        felt[known_emotion.name] = (intensity, known_emotion)
        if emblem:
            parts.append(known_emotion.emblem_units(intensity))
    intensities = {name: intensity for name, (intensity, _) in felt.items()}
    if not emblem:
        alone = len(felt) == 1
        parts += (
            [found.shown_units(value) for value, found in felt.values()] if alone else [blended(intensities)]
        )
    strongest = max(felt.values(), key=lambda pair: (pair[0], pair[1].name), default=None)
    return TakenEmotions(combined(parts), intensities, strongest[1] if strongest else None)


def combined(parts: Iterable[Mapping[str, float]]) -> dict[str, float]:
    """Add values up and clip them to the range of their unit or parameter (paper B, section 6.4).

    Action units come first, then parameters in the table's order.
    """
    total: dict[str, float] = {}
    for part in parts:
        for name, value in part.items():
            total[name] = total.get(name, 0.0) + value
    units = {name: min(value, 1.0) for name, value in total.items() if unit_weights(name)}
    return units | {p.name: min(max(total[p.name], p.low), p.high) for p in PARAMETERS if p.name in total}


def _resolved(
    attributes: Attributes, name: str, attribute: Attribute, known: Iterable[str]
) -> dict[str, float]:
    try:
        stem = name.partition(".")[0]
        written = attribute.name.replace("-", "_")
        if stem not in BASES and stem not in ALIASES and action_unit(written) is None:
            raise attributes.unknown(attribute, known)
        return kept_units({written: number_of(attribute)})
    except RisoriusError as error:
        raise error.at(attribute.place) from None
