"""The hair of a head by the name of its style."""

from __future__ import annotations

from ..core.arrays import Array
from ..face.identity import Looks
from .anatomy import Anatomy
from .medium_hair import grow_medium
from .short_hair import grow_short
from .strands import Strands
from .stubble import grow_stubble
from .surface import Surface

_STYLES = {"short": grow_short, "medium": grow_medium, "shaved": grow_stubble}


def grow_hair(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> list[Strands]:
    """Return the hair in the style of `looks`, of linear albedo `colour` (3,); a bald head has none."""
    grow = _STYLES.get(looks.hair_style)
    return [grow(anatomy, surface, colour, looks.hairs)] if grow else []
