"""The table by which a page unpacks the faces of a head, and the light in which it draws them."""

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
class StageEye:
    """An eye in mm: its centre, its radius, and the pairs of the skin's vertices of its lids' margins.

    `axes` are the rows of the rotation from the line of sight to the pupil.
    """

    centre: tuple[float, float, float]
    radius: float
    axes: tuple[float, ...]
    lids: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class StageLamp:
    """A lamp: from where it shines, its linear colour, and how much its size widens gloss."""

    direction: tuple[float, float, float]
    colour: tuple[float, float, float]
    softness: float


@dataclass(frozen=True, slots=True)
class StageLight:
    """The light that a head is drawn in: lamps, and the linear ambient light from above and below."""

    lamps: tuple[StageLamp, ...]
    sky: tuple[float, float, float]
    ground: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class StageBlood:
    """Changes of the skin's colour, as computed in `looks/perfusion.py`.

    `skin` and `lips`: absorption of red, green and blue by the usual amount of blood; `least` and `most`:
    limits of the change in moving skin, as a share of the usual; `rounds`: smoothing steps of the areas.
    """

    skin: tuple[float, float, float]
    lips: tuple[float, float, float]
    least: float
    most: float
    rounds: int


@dataclass(frozen=True, slots=True)
class StageFolds:
    """The fine wrinkles of a head: the number of heights of a face, in steps of `step` mm.

    There is room for those of `slots` regions at each vertex.
    `styles` has for each region of wrinkles its kind, the width of its furrows in mm, how dark these are, and
    the share of the height that is shaded.
    """

    count: int
    step: float
    slots: int
    styles: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class StageShadow:
    """The key lamp's shadow map: rows of the matrix that gives x and y in texels and mm towards the lamp.

    It has `size` texels a side and is `depth` mm deep; a surface nearer by at most `bias` mm casts no shadow.
    """

    matrix: tuple[float, ...]
    size: int
    depth: float
    bias: float


@dataclass(frozen=True, slots=True)
class StageShading:
    """The data that skin is shaded by: formulas as GLSL, and the sizes of the tables (`GET /api/skin`).

    `grain` cells each way of the pores' heights, which are at most `highest`; light that leaves skin, at
    `angles` angles and `curvatures` curvatures. The margins of lids and lips are known at `lids` and `lips`
    places from one corner to the other.
    """

    formulas: str
    grain: int
    angles: int
    curvatures: int
    highest: float
    lids: int
    lips: int


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
    eyes: tuple[StageEye, ...]
    lips: tuple[tuple[int, int], ...]
    light: StageLight
    cloth: tuple[float, float, float]
    blood: StageBlood
    shading: StageShading
    shadow: StageShadow
    folds: StageFolds
    parts: tuple[StagePart, ...]
