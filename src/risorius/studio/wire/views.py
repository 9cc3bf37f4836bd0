"""The view of a page, as it is saved with the project; bounded, because others may have made the project."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal, TypeVar

from ...core.units import Seconds
from ...errors import InputError
from ...reading.hints import Range, Then

MOST_NAMES = 200
LONGEST_NAME = 60

_Names = TypeVar("_Names", tuple[str, ...], Mapping[str, str])


def _few(names: _Names) -> _Names:
    if len(names) > MOST_NAMES:
        raise InputError(f"has {len(names)} entries; expected up to {MOST_NAMES}")
    if any(len(name) > LONGEST_NAME for name in names):
        raise InputError(f"has a name of more than {LONGEST_NAME} characters")
    return names


def _short(name: str) -> str:
    return name[:LONGEST_NAME]


Metres = Annotated[float, Range(-10.0, 10.0)]
AnyDegrees = Annotated[float, Range(-1e6, 1e6)]
Side = Literal["both", "left", "right"]
FewNames = Annotated[tuple[str, ...], Then(_few)]


@dataclass(frozen=True, slots=True)
class CameraView:
    """The camera: centre and height of its picture in metres, turn and tilt in degrees."""

    centre: tuple[Metres, Metres, Metres]
    height: Annotated[float, Range(0.01, 10.0)]
    turn: AnyDegrees
    tilt: Annotated[float, Range(-90.0, 90.0)]


@dataclass(frozen=True, slots=True)
class GraphsView:
    """The muscles with graphs (null: those that move most), their sides, and the folded lanes."""

    chosen: FewNames | None = None
    sides: Annotated[Mapping[str, Side], Then(_few)] = field(default_factory=dict)
    folded: FewNames = ()


@dataclass(frozen=True, slots=True)
class PageView:
    """The open panel, the camera, the playhead and the graphs; null if nothing was chosen."""

    tab: Annotated[str, Then(_short)] | None = None
    camera: CameraView | None = None
    time: Seconds | None = None
    graphs: GraphsView | None = None
