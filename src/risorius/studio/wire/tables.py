"""The tables that the page fetches at first: all of the library, and how faces are unpacked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...ports.page.stage_table import (
    StageBlood,
    StageEye,
    StageFolds,
    StageLamp,
    StageLight,
    StagePart,
    StageShading,
    StageShadow,
    StageTable,
)
from .shared import Choices


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """A column of every curve, as `core.parameters.Parameter`; `rivals` are those that it conflicts with."""

    name: str
    base: str
    side: str
    kind: str
    group: str
    unit: str
    low: float
    high: float
    neutral: float
    number: int | None
    threshold: float
    min_onset: float
    min_offset: float
    signed: bool
    rivals: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class UnitRow:
    """An action unit, with the parameters' values at full intensity."""

    name: str
    number: int
    title: str
    approximate: bool
    targets: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class EmotionRow:
    """An emotion: its action units, and the parameters' values at full intensity. Seconds."""

    name: str
    aliases: tuple[str, ...]
    description: str
    units: Mapping[str, float]
    targets: Mapping[str, float]
    onset: float
    offset: float


@dataclass(frozen=True, slots=True)
class NumberRow:
    """A number of a profile by its dotted key; null if its range has no end."""

    key: str
    value: float
    low: float | None
    high: float | None


@dataclass(frozen=True, slots=True)
class ProfileRow:
    """A speaker, its numbers by key, and its file."""

    name: str
    description: str
    source: str
    numbers: Mapping[str, NumberRow]
    text: str


@dataclass(frozen=True, slots=True)
class AttitudeRow:
    """An attitude that a speaker may convey."""

    name: str
    description: str
    source: str


@dataclass(frozen=True, slots=True)
class VoiceRow:
    """A voice; those named `+name` change the timbre of any other."""

    name: str
    language: str
    title: str


@dataclass(frozen=True, slots=True)
class HeadRow:
    """A head: its title, age and hair."""

    name: str
    title: str
    age: float
    hair: str


@dataclass(frozen=True, slots=True)
class ChannelRow:
    """A channel and its default priority."""

    name: str
    priority: float


@dataclass(frozen=True, slots=True)
class OnsetRow:
    """An onset function, with its values at even steps from 0 to 1."""

    name: str
    description: str
    samples: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class RuleRow:
    """A rule of the package."""

    id: str
    channel: str
    level: str
    probability: float
    comment: str
    conditions: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class OutputRow:
    """A format of files, by suffix."""

    suffix: str
    description: str
    needs: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ChoiceRow:
    """A value that a setting may have: its name, its description, and the value that is sent for it."""

    name: str
    description: str
    value: str | float


@dataclass(frozen=True, slots=True)
class SettingRow:
    """A setting as a control: `key` of the choices or, if it is `exported`, of an export.

    `control`: "choice" (of `choices`), "several" (of them), "check", "number", "slider" or "text".
    `optional`: whether it may be null, which `unset` says in words.
    """

    key: str
    label: str
    group: str
    control: str
    exported: bool
    help: str
    low: float | None
    high: float | None
    step: float | None
    optional: bool
    unset: str
    default: object
    choices: tuple[ChoiceRow, ...]


@dataclass(frozen=True, slots=True)
class LimitsTable:
    """Characters of a script; bytes of a recording, a project, a message; requests at once; undos."""

    script: int
    recording: int
    project: int
    message: int
    pending: int
    undo: int


@dataclass(frozen=True, slots=True)
class Catalogue:
    """`GET /api/catalogue`: all that can be named. `choices` are the defaults."""

    version: str
    parameters: tuple[ParameterRow, ...]
    aliases: Mapping[str, str]
    action_units: tuple[UnitRow, ...]
    emotions: tuple[EmotionRow, ...]
    profiles: tuple[ProfileRow, ...]
    attitudes: tuple[AttitudeRow, ...]
    voices: tuple[VoiceRow, ...]
    heads: tuple[HeadRow, ...]
    channels: tuple[ChannelRow, ...]
    onset_functions: tuple[OnsetRow, ...]
    settings: tuple[SettingRow, ...]
    formats: tuple[str, ...]
    rules: tuple[RuleRow, ...]
    outputs: tuple[OutputRow, ...]
    choices: Choices
    limits: LimitsTable


TABLES: tuple[type, ...] = (
    ParameterRow, UnitRow, EmotionRow, NumberRow, ProfileRow, AttitudeRow, VoiceRow, HeadRow, ChannelRow,
    OnsetRow, RuleRow, OutputRow, ChoiceRow, SettingRow, LimitsTable, Catalogue, StagePart, StageLamp,
    StageEye, StageBlood, StageFolds, StageShading, StageShadow, StageLight, StageTable,
)  # fmt: skip
