"""How a performance is pictured: the choices by name, with their defaults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ..errors import InputError, unknown

Size = tuple[int, int]
"""Width and height of a picture in pixels."""
STYLES = ("realistic", "clay", "muscles", "wireframe")
FRAMINGS = ("portrait", "close-up", "eyes", "mouth", "three-quarter", "profile")
LIGHTS = ("studio", "daylight", "dark")
QUALITIES: Mapping[str, int] = MappingProxyType({"draft": 1, "normal": 2, "high": 4})
"""Samples per pixel and side."""
HAIR_STYLES = ("short", "medium", "shaved", "bald")
COMPLEXIONS: Mapping[str, float] = MappingProxyType(
    {"fair": 0.0, "light": 0.25, "tan": 0.5, "brown": 0.75, "dark": 1.0}
)
"""Skin tones on a scale from the fairest to the darkest."""
OVERLAYS = ("caption", "phones", "bars", "lanes")
TRANSPARENT = "transparent"
SHORTEST_LENS, LONGEST_LENS = 20.0, 400.0


@dataclass(frozen=True, slots=True)
class Look:
    """How a head is drawn; frozen, checked on creation (InputError names the choice at fault).

    `lens` is the focal length in mm on 24 × 36 mm film. `background` is the light's own where None, else
    "transparent", a colour as CSS writes it, or the path of a picture. `hair` is the head's own style where
    None, and so is `complexion`, 0 (the fairest) to 1 (the darkest). `overlay` names what explains the
    picture on it or, for lanes, below it.
    """

    style: str = "realistic"
    camera: str = "portrait"
    lens: float = 85.0
    light: str = "studio"
    background: str | None = None
    quality: str = "normal"
    hair: str | None = None
    complexion: float | None = None
    overlay: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for kind, name, known in (
            ("style", self.style, STYLES),
            ("camera", self.camera, FRAMINGS),
            ("light", self.light, LIGHTS),
            ("quality", self.quality, QUALITIES),
            ("hair style", self.hair or HAIR_STYLES[0], HAIR_STYLES),
            *(("overlay", name, OVERLAYS) for name in self.overlay),
        ):
            if name not in known:
                raise InputError(unknown(kind, name, known))
        for what, value, low, high in (
            ("lens", self.lens, SHORTEST_LENS, LONGEST_LENS),
            ("complexion", self.complexion or 0.0, 0.0, 1.0),
        ):
            if not low <= value <= high:
                raise InputError(f"{what} = {value:g} is out of range; expected {low:g} to {high:g}")

    @property
    def transparent(self) -> bool:
        """Whether pictures have an alpha channel."""
        return self.background == TRANSPARENT


def parse_camera(text: str) -> tuple[str, float]:
    """Return framing and focal length of a text such as "close-up" or "close-up:135"; raise InputError."""
    name, colon, length = text.partition(":")
    try:
        return name, float(length.removesuffix("mm")) if colon else Look().lens
    except ValueError:
        raise InputError(f"camera '{text}' has no focal length in mm; expected e.g. close-up:85") from None


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
    """Return the overlays named in a text such as "caption,bars", in their own order; raise InputError."""
    asked = [name.strip() for name in text.split(",")]
    for name in asked:
        if name not in OVERLAYS:
            raise InputError(unknown("overlay", name, OVERLAYS))
    return tuple(name for name in OVERLAYS if name in asked)
