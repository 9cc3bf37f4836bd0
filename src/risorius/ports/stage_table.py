"""How a page unpacks the faces of a head, and in which light it draws them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StagePart:
    """A mesh of which vertices are sent: the first of them, how many, and its mesh's origin in mm."""

    name: str
    first: int
    count: int
    about: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class StageLamp:
    """A lamp: from where it shines, and its linear colour."""

    direction: tuple[float, float, float]
    colour: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class StageLight:
    """The light that a head is drawn in: lamps, and the linear ambient light from above and below."""

    lamps: tuple[StageLamp, ...]
    sky: tuple[float, float, float]
    ground: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class StageBlood:
    """How skin changes its colour, as `looks/perfusion.py` says it.

    What the usual blood absorbs of red, green and blue in skin and in lips, and the least and the most that
    moving skin gains of the usual blood.
    """

    skin: tuple[float, float, float]
    lips: tuple[float, float, float]
    least: float
    most: float


@dataclass(frozen=True, slots=True)
class StageTable:
    """`GET /api/stage`: how faces are unpacked: `origin + step * value` mm; `pose` floats a face; mm.

    `lips` are the skin's vertices of the upper and the lower lip that touch when the mouth is shut; `cloth`
    is the linear colour of what is worn.
    """

    vertices: int
    pose: int
    step: float
    origin: tuple[float, float, float]
    pivot: tuple[float, float, float]
    eyes: tuple[tuple[float, float, float], tuple[float, float, float]]
    lips: tuple[tuple[int, int], ...]
    light: StageLight
    cloth: tuple[float, float, float]
    blood: StageBlood
    parts: tuple[StagePart, ...]
