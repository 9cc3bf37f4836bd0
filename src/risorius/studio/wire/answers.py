"""The answers of the server that are not takes: explanations, files, and acknowledgements."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .takes import Previewed, State, TakeChange, TakeView


@dataclass(frozen=True, slots=True)
class FacesSent:
    """The number of faces that were sent."""

    sent: int


@dataclass(frozen=True, slots=True)
class Done:
    """The request was carried out."""


@dataclass(frozen=True, slots=True)
class DialState:
    """The value of every parameter of the dialled face; `notes` name the parts that could not be shown."""

    values: Mapping[str, float]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Download:
    """A file, to be downloaded from `path`."""

    path: str
    name: str


@dataclass(frozen=True, slots=True)
class ContributionView:
    """A movement's request for a parameter and the part applied, deviations from neutral, with the reason."""

    channel: str
    what: str
    rule: str
    place: str
    asked: float
    given: float
    reason: str
    movement: str = ""


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a parameter has its value: the winner (null at rest), each loser with its reason, later steps."""

    parameter: str
    value: float
    unit: str
    winner: ContributionView | None
    losers: tuple[ContributionView, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Explanations:
    """Explanations as data, and as the sentences that `risorius explain` prints."""

    time: float
    reasons: tuple[Reason, ...]
    sentences: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ChannelCurve:
    """A channel's request for a parameter and the part that is applied, `frames` values each.

    Spans [start, end] in seconds. `inhibited`: nothing of it shows; `limited`: it is given less than it asks.
    """

    channel: str
    asked: str
    given: str
    inhibited: tuple[tuple[float, float], ...]
    limited: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class ParameterDetail:
    """The curves of all channels for one parameter."""

    parameter: str
    channels: tuple[ChannelCurve, ...]


@dataclass(frozen=True, slots=True)
class FiredRule:
    """A rule, its comment, the ids of its blocks and the start of each."""

    rule: str
    comment: str
    blocks: tuple[str, ...]
    times: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class FiredRules:
    """The rules that fired in a take, in order of their ids."""

    rules: tuple[FiredRule, ...]


@dataclass(frozen=True, slots=True)
class ProfileFile:
    """A profile as TOML, to be saved as a file or performed with `choices.profile_text`."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class PoseFile:
    """A pose saved under a name, as a file: an emotion (TOML), or the command that makes the pose."""

    name: str
    file: str
    text: str


@dataclass(frozen=True, slots=True)
class Job:
    """An export that has begun."""

    job: int


ANSWERS: tuple[type, ...] = (
    TakeView, TakeChange, State, FacesSent, Done, DialState, Download, Explanations, ParameterDetail,
    FiredRules, ProfileFile, PoseFile, Job, Previewed,
)  # fmt: skip
