"""Framings: the part of the head that a picture shows, and the direction of the camera."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..looks.anatomy import Anatomy
from .camera import Camera

_FILM = 24.0  # mm: the short side of 24 × 36 mm film, which a focal length refers to


@dataclass(frozen=True, slots=True)
class Framing:
    """A part of the head and a direction.

    `top` and `bottom` are heights of the picture's edges: landmarks of `_heights` and mm of an average face
    above them. `azimuth` is in degrees from the front towards the subject's left; `depth` is how far behind
    the eyes (z) the middle of the picture lies, in mm; `narrow` is the least width over height before the
    picture widens to keep the head in it.
    """

    top: tuple[str, float]
    bottom: tuple[str, float]
    azimuth: float = 0.0
    depth: float = 0.0
    narrow: float = 0.9


_FRAMINGS = {
    "portrait": Framing(("top", 22.0), ("chin", -44.0)),
    "close-up": Framing(("eyes", 62.0), ("chin", -12.0), narrow=0.8),
    "eyes": Framing(("eyes", 28.0), ("eyes", -24.0), narrow=2.0),
    "mouth": Framing(("mouth", 32.0), ("mouth", -36.0), narrow=1.0),
    "three-quarter": Framing(("top", 22.0), ("chin", -44.0), azimuth=-38.0, depth=-32.0),
    "profile": Framing(("top", 22.0), ("chin", -44.0), azimuth=-90.0, depth=-58.0, narrow=1.0),
}


def frame_head(anatomy: Anatomy, aspect: float, name: str = "portrait", lens: float = 85.0) -> Camera:
    """Return the camera of a framing by name, for a picture of width / height `aspect` and a lens in mm."""
    framing, u = _FRAMINGS[name], anatomy.unit
    heights = _heights(anatomy)
    top = heights[framing.top[0]] + framing.top[1] * u
    bottom = heights[framing.bottom[0]] + framing.bottom[1] * u
    half = 0.5 * (top - bottom) * max(1.0, framing.narrow / aspect)
    # The angle of the lens is that over the short side.
    half_angle = math.atan(0.5 * _FILM / lens) if aspect >= 1.0 else math.atan(0.5 * _FILM / lens / aspect)
    distance = half / math.tan(half_angle)
    turn = math.radians(framing.azimuth)
    target = (0.0, 0.5 * (top + bottom), framing.depth * u)
    eye = (math.sin(turn) * distance, target[1], target[2] + math.cos(turn) * distance)
    return Camera(eye, target, math.degrees(2 * half_angle))


def _heights(anatomy: Anatomy) -> dict[str, float]:
    return {
        "top": anatomy.top,
        "eyes": anatomy.eye_height,
        "mouth": float(anatomy.mouth[1]),
        "chin": anatomy.chin,
    }
