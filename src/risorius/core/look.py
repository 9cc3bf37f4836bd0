"""The look of a performance: the choices by name, and the parsers of their texts."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated

from ..errors import InputError, nearest, unknown
from ..reading.hints import Range

Size = tuple[int, int]
"""Width and height of a picture in pixels."""
Byte = Annotated[int, Range(0, 255)]
ByteColour = tuple[Byte, Byte, Byte]
"""A colour in sRGB: red, green and blue."""
STYLES = ("realistic", "clay", "muscles", "wireframe")
FRAMINGS = ("portrait", "close-up", "eyes", "mouth", "three-quarter", "profile")
LIGHTS = ("studio", "daylight", "dark")
QUALITIES: Mapping[str, int] = MappingProxyType({"draft": 1, "normal": 2, "high": 4})
"""Samples per pixel and side."""
HAIR_STYLES = ("short", "medium", "tied", "shaved", "bald")
COMPLEXIONS: Mapping[str, float] = MappingProxyType(
    {"fair": 0.0, "light": 0.25, "tan": 0.5, "brown": 0.75, "dark": 1.0}
)
"""Skin tones on a scale from the fairest to the darkest."""
OVERLAYS = ("caption", "phones", "bars", "lanes")
TRANSPARENT = "transparent"
USUAL_LENS = 85.0
"""Focal length in mm."""


def parse_camera(text: str) -> tuple[str, float]:
    """Return framing and focal length of a text such as "close-up" or "close-up:135"; raise InputError."""
    name, colon, length = text.partition(":")
    try:
        return name, float(length.removesuffix("mm")) if colon else USUAL_LENS
    except ValueError:
        raise InputError(f"camera '{text}' has no focal length in mm; expected e.g. close-up:85") from None


def parse_colour(text: str) -> ByteColour:
    """Return the colour of a CSS text such as "#203040" or "white"; raise InputError for any other text."""
    from PIL import ImageColor

    try:
        red, green, blue = ImageColor.getrgb(text)[:3]
    except ValueError:
        near = nearest(text, [TRANSPARENT, *ImageColor.colormap])
        expected = f"did you mean '{near}'?" if near else f"expected e.g. '#203040', 'white', '{TRANSPARENT}'"
        message = f"background '{text}' is neither a colour nor the file of a picture; {expected}"
        raise InputError(message) from None
    return red, green, blue


def parse_complexion(text: str) -> float:
    """Return a complexion by name, or a number from 0 (the fairest) to 1 (the darkest); raise InputError."""
    if text in COMPLEXIONS:
        return COMPLEXIONS[text]
    try:
        return float(text)
    except ValueError:
        names = unknown("complexion", text, COMPLEXIONS)
        raise InputError(f"{names}; or a number from 0 (the fairest) to 1 (the darkest)") from None


def parse_overlay(text: str) -> tuple[str, ...]:
    """Return the overlays of a text such as "caption,bars", in the order of `OVERLAYS`; raise InputError."""
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in OVERLAYS:
            raise InputError(unknown("overlay", name, OVERLAYS))
    return tuple(name for name in OVERLAYS if name in names)
