"""The looks of a head in a picture: its own, changed by the settings of the picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..core.look import ByteColour
from ..face.head.identity import Looks
from ..settings import Look

# The colours of skin, lips and the mouth's lining for five complexions, evenly spaced from 0 to 1.
_TONES: tuple[tuple[ByteColour, ByteColour, ByteColour], ...] = (
    ((236, 196, 176), (200, 120, 114), (168, 88, 84)),
    ((222, 174, 146), (186, 106, 97), (162, 85, 80)),
    ((196, 146, 112), (164, 92, 84), (156, 80, 76)),
    ((142, 96, 71), (122, 72, 66), (142, 68, 65)),
    ((92, 60, 46), (96, 57, 53), (128, 60, 58)),
)
_CLAY: ByteColour = (176, 172, 168)
_BONE: ByteColour = (186, 178, 170)
_SLATE: ByteColour = (74, 84, 98)
_PLAIN: dict[str, tuple[ByteColour, ByteColour]] = {
    "clay": (_CLAY, (120, 116, 112)),
    "muscles": (_BONE, (120, 104, 96)),
    "wireframe": (_SLATE, (150, 176, 200)),
}


def apply_look(looks: Looks, look: Look) -> Looks:
    """Return a head's looks with the complexion, the hair and the style's material that `look` chooses."""
    if look.complexion is not None:
        skin, lips, lining = (_between(look.complexion, column) for column in range(3))
        looks = replace(looks, skin=skin, lips=lips, lining=lining)
    if look.hair is not None:
        looks = replace(looks, hair_style=look.hair)
    if look.style in _PLAIN:
        matter, hair = _PLAIN[look.style]
        looks = replace(looks, skin=matter, lips=matter, lining=matter, cloth=matter, flush=0.0, beard=0.0)
        looks = replace(looks, hair=hair, brows=hair, grey=0.0, hair_style=look.hair or "bald")
    return looks


def _between(tone: float, column: int) -> ByteColour:
    scale = np.linspace(0.0, 1.0, len(_TONES))
    colours = np.array([row[column] for row in _TONES])
    red, green, blue = (round(float(np.interp(tone, scale, channel))) for channel in colours.T)
    return red, green, blue
