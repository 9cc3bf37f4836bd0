"""The emotions that a face can show, each a table in `rules/data/emotions`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any

from ..core.action_units import check_intensity, kept_units, resolve_targets
from ..core.antagonists import antagonist_pairs
from ..core.functions import FunctionName
from ..core.units import MAX_SECONDS, RiseSeconds, Seconds, Share
from ..errors import InputError, ParameterError, unknown
from ..reading.frozen import FrozenDict
from ..reading.hints import Range
from ..reading.toml import read_tables, written
from .fuzzy_sets import concluded
from .load import DATA, load_file, load_folder
from .modulation import Modulation

# The share of a muscle's full contraction at each of five intensities.
Degrees = tuple[Share, Share, Share, Share, Share]
PriorityLevel = Annotated[float, Range(0.0, 9999.0)]
# Priorities over other channels at the same five intensities.
Priorities = tuple[PriorityLevel, PriorityLevel, PriorityLevel, PriorityLevel, PriorityLevel]
# Seconds, as emotions of the package rise and fall.
HAND_ONSET, HAND_APEX, HAND_OFFSET = 0.45, 2.0, 0.75
HAND_EMBLEM: Mapping[str, float] = MappingProxyType({"onset": 0.25, "offset": 0.35, "duration": 1.0})
INTENSITIES = (0.0, 0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True, slots=True)
class Emblem:
    """An emotion that is referred to, not felt (paper A, section 2): a part of the face, for a short while.

    `units`: action units or muscles with their value at intensity 1. Seconds.
    """

    onset: RiseSeconds
    offset: RiseSeconds
    duration: Annotated[float, Range(0.1, 10.0)]
    units: Mapping[str, float] = field(metadata={"key": "targets"})


@dataclass(frozen=True, slots=True)
class Emotion:
    """The display of an emotion. `units`: action units or muscles at intensity 1. Seconds.

    `apex`: how long a display that has a start and no end stays at its height. `function`: how it rises and
    falls, an onset function. `priority`: over other channels at no, low, medium, high and full intensity
    (paper A, section 1: "too happy to speak"); the channel's if None.
    `degrees`: for units that do not grow with the intensity in proportion, their shares of full contraction
    at no, low, medium, high and full intensity. `modulation`: what one who feels it does more or less of.
    `own_emblem`: if it is None, an emblem is the whole display for a short while.
    """

    name: str
    description: str
    source: str
    units: Mapping[str, float] = field(metadata={"key": "targets"})
    onset: RiseSeconds = HAND_ONSET
    offset: RiseSeconds = HAND_OFFSET
    own_emblem: Emblem | None = field(default=None, metadata={"key": "emblem"})
    aliases: tuple[str, ...] = ()
    modulation: Modulation = field(default_factory=Modulation)
    degrees: Mapping[str, Degrees] = field(default_factory=FrozenDict)
    apex: Seconds = HAND_APEX
    function: FunctionName = "minimum_jerk"
    priority: Priorities | None = None

    def __post_init__(self) -> None:
        for units in (self.units, self.emblem.units):
            for larger, smaller in antagonist_pairs(resolve_targets(units)):
                raise InputError(
                    f"{smaller} conflicts with {larger}, and together they are above 1; expected 1 at most"
                )
        for unit in self.degrees:
            if unit not in self.units:
                raise ParameterError(unknown("target with degrees", unit, self.units))

    @property
    def emblem(self) -> Emblem:
        """The emotion's emblem."""
        return self.own_emblem or Emblem(units=self.units, **HAND_EMBLEM)

    def targets(self, intensity: float) -> dict[str, float]:
        """Return the parameters' values in a display of `intensity` 0..1."""
        return resolve_targets(self.shown_units(intensity))

    def shown_units(self, intensity: float) -> dict[str, float]:
        """Return the values of action units and muscles in a display of `intensity` 0..1, by fuzzy rules.

        They are continuous and never fall as it rises: linear but for units with degrees of their own.
        """
        check_intensity(self.name, intensity)
        return kept_units({unit: value * self._share(unit, intensity) for unit, value in self.units.items()})

    @property
    def seconds(self) -> float:
        """The duration of a display that has a start and no end."""
        return self.onset + self.apex + self.offset

    def priority_at(self, intensity: float) -> float | None:
        """Return the priority of a display of `intensity` 0..1, None for its channel's."""
        return None if self.priority is None else concluded(intensity, INTENSITIES, self.priority)

    def _share(self, unit: str, intensity: float) -> float:
        return concluded(intensity, INTENSITIES, self.degrees.get(unit, INTENSITIES))

    def emblem_targets(self, intensity: float) -> dict[str, float]:
        """Return the parameters' values in an emblem of `intensity` 0..1."""
        return resolve_targets(self.emblem_units(intensity))

    def emblem_units(self, intensity: float) -> dict[str, float]:
        """Return the values of units and muscles in an emblem of `intensity` 0..1; they are linear in it."""
        factor = check_intensity(self.name, intensity)
        return {name: factor * value for name, value in kept_units(self.emblem.units).items()}


@dataclass(frozen=True, slots=True)
class Display:
    """An emotion to show: intensity 0..1 over [start, end] seconds, the whole clip if they are None.

    `priority`: over other channels (paper A, section 1: "too happy to speak"); None for the channel's.
    """

    emotion: str
    intensity: float
    start: float | None = None
    end: float | None = None
    priority: float | None = None


Displays = tuple[Display, ...]


@dataclass(frozen=True, slots=True)
class _Known:
    """Emotions by name, and the name for every name and alias."""

    emotions: Mapping[str, Emotion]
    names: Mapping[str, str]


_IN_FORCE: ContextVar[_Known | None] = ContextVar("emotions", default=None)


@contextmanager
def emotions_in_force(changed: Mapping[str, Emotion]) -> Iterator[None]:
    """Let other emotions be in force in place of the package's; InputError if one alias names two."""
    token = _IN_FORCE.set(_Known(changed, _by_any_name(changed)))
    try:
        yield
    finally:
        _IN_FORCE.reset(token)


def emotion_tables() -> dict[str, dict[str, Any]]:
    """Return the package's tables as TOML has them, by the emotion's name."""
    files = sorted(f.name for f in (DATA / "emotions").iterdir() if f.name.endswith(".toml"))
    tables = (read_tables((DATA / "emotions" / f).read_text(encoding="utf-8"), f) for f in files)
    return {table["name"]: table for table in tables}


def emotions() -> Mapping[str, Emotion]:
    """Return all emotions by name, in alphabetical order."""
    known = _IN_FORCE.get()
    return shipped_emotions() if known is None else known.emotions


@cache
def shipped_emotions() -> Mapping[str, Emotion]:
    """Return the emotions of the package by name, in alphabetical order."""
    found: dict[str, Emotion] = {}
    for emotion_ in load_folder(Emotion, "emotions").values():
        found[emotion_.name] = emotion_
    _by_any_name(found)
    return MappingProxyType(found)


def emotion_names() -> Mapping[str, str]:
    """Return the emotion's name for every name and alias, in lower case."""
    known = _IN_FORCE.get()
    return _shipped_names() if known is None else known.names


@cache
def _shipped_names() -> Mapping[str, str]:
    return MappingProxyType(_by_any_name(shipped_emotions()))


def emotion(name: str) -> Emotion:
    """Return the emotion of that name or alias, in any case, or of that file (`.toml`).

    Raises ParameterError, naming the nearest, for an unknown name, InputError for a file that does not fit.
    """
    key = emotion_key(name)
    return _from_file(key) if key.endswith(_FILE) else emotions()[key]


def emotion_key(name: str) -> str:
    """Return the key by which `emotion` finds the emotion called `name`: its own name, or its file's path.

    Raises ParameterError, naming the nearest one, for an unknown name.
    """
    if name.endswith(_FILE):
        return name
    known = emotion_names()
    key = name.strip().lower()
    if key not in known:
        raise ParameterError(unknown("emotion", name, known))
    return known[key]


@cache
def _from_file(path: str) -> Emotion:
    return load_file(Emotion, Path(path))


_NUMBER = r"(?:\d++(?:\.\d*+)?|\.\d++)"
_LEVEL = r"\d{1,4}(?:\.\d{1,6})?"
_FILE = ".toml"
_NAME = re.compile(r"[\w -]++", re.ASCII)
_INTENSITY = re.compile(rf":({_NUMBER})(?:@({_NUMBER})(?:-({_NUMBER}))?)?(?:/({_LEVEL}))?\Z", re.ASCII)


def emotion_text(name: str, units: Mapping[str, float]) -> str:
    """Return the file (TOML) of an emotion whose full display is `units`, action units or parameters.

    Raises ParameterError for an unknown unit or a value out of its range.
    """
    resolve_targets(units)
    shown = {unit: value for unit, value in units.items() if value != 0.0}
    return written(
        {
            "name": name,
            "description": f"{name}, set by hand.",
            "source": "by hand",
            "onset": HAND_ONSET,
            "offset": HAND_OFFSET,
            "targets": shown,
            "emblem": {**HAND_EMBLEM, "targets": shown},
        }
    )


def parse_display(text: str) -> Display:
    """Return the display that an option such as `joy:0.7`, `fear:1@0.5-2/80` or `mine.toml:1` asks for.

    One with a start alone, `surprise:1@0.5`, lasts as long as its emotion does.
    Raises InputError if it is not of that form, ParameterError for an unknown emotion or intensity above 1.
    """
    match = _INTENSITY.search(text.strip())
    name = text.strip()[: match.start()] if match else ""
    if match is None or not (_NAME.fullmatch(name) or name.endswith(_FILE)):
        is_name = text.strip().lower() in emotion_names()
        fault, example = ("has no intensity", text.strip()) if is_name else ("is not understood", "joy")
        raise InputError(f"emotion '{text}' {fault}; expected e.g. {example}:0.7 or {example}:0.7@1-2.5")
    found = emotion(name)
    key = emotion_key(name)
    intensity = check_intensity(found.name, float(match[1]))
    priority = None if match[4] is None else float(match[4])
    if match[2] is None:
        return Display(key, intensity, priority=priority)
    start = float(match[2])
    end = start + found.seconds if match[3] is None else float(match[3])
    if not start < end <= MAX_SECONDS:
        raise InputError(
            f"emotion {found.name}: from {start:g} to {end:g} s is not a span; "
            f"expected start < end, at most {MAX_SECONDS:g} s"
        )
    return Display(key, intensity, start, end, priority)


def _by_any_name(table: Mapping[str, Emotion]) -> dict[str, str]:
    names = {name: name for name in table}
    for found in table.values():
        for alias in found.aliases:
            if names.setdefault(alias.lower(), found.name) != found.name:
                raise InputError(f"'{alias}' names two emotions: {names[alias.lower()]} and {found.name}")
    return names
