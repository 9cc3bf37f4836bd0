"""The hair of a head by the name of its style."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import numpy as np

from ..core.arrays import AnyArray, Array
from ..face.identity import Looks
from .anatomy import Anatomy
from .hairline import grow_hairline
from .kept_hairs import kept_hairs
from .medium_hair import grow_medium
from .short_hair import grow_short
from .strands import Strands
from .stubble import grow_stubble
from .surface import Surface

_Grow: TypeAlias = Callable[[Anatomy, Surface, Array, int], Strands]
# What grows on a head of each style, by the name of its part.
_STYLES: dict[str, dict[str, _Grow]] = {
    "short": {"hair": grow_short, "hairline": grow_hairline},
    "medium": {"hair": grow_medium, "hairline": grow_hairline},
    "shaved": {"hair": grow_stubble},
}


def grow_hair(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> dict[str, Strands]:
    """Return the hair by part in the style of `looks`, of linear albedo `colour` (3,): none if bald."""
    inputs = [*grown_on(anatomy, surface), colour, np.asarray(looks.hairs)]
    return {
        name: kept_hairs(
            f"{name}-{looks.hair_style}", inputs, partial(grow, anatomy, surface, colour, looks.hairs)
        )
        for name, grow in _STYLES.get(looks.hair_style, {}).items()
    }


def grown_on(anatomy: Anatomy, surface: Surface) -> list[AnyArray]:
    """Return the arrays that say what hairs of a head grow on."""
    return [surface.points, surface.normals, surface.triangles, *map(np.asarray, anatomy.measures())]
