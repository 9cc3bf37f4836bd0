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
from .srgb import linear
from .strands import Strands
from .stubble import grow_stubble
from .surface import Surface

_Grow: TypeAlias = Callable[[Anatomy, Surface, Array, int], Strands]
_STYLES: dict[str, _Grow] = {"short": grow_short, "medium": grow_medium, "shaved": grow_stubble}
_EDGED = ("short", "medium")  # styles that begin with fine hairs


def grow_hair(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> dict[str, Strands]:
    """Return the hair by part in the style of `looks`, of linear albedo `colour` (3,): none if bald."""
    style, count = looks.hair_style, looks.hairs
    if style not in _STYLES:
        return {}
    inputs = [*grown_on(anatomy, surface), colour, np.asarray(count)]
    grow = partial(_STYLES[style], anatomy, surface, colour, count)
    grown = {"hair": kept_hairs(f"hair-{style}", inputs, grow)}
    if style in _EDGED:
        skin = linear(looks.skin)
        edge = partial(grow_hairline, anatomy, surface, colour, skin, count)
        grown["hairline"] = kept_hairs(f"hairline-{style}", [*inputs, skin], edge)
    return grown


def grown_on(anatomy: Anatomy, surface: Surface) -> list[AnyArray]:
    """Return the arrays that say what hairs of a head grow on."""
    return [surface.points, surface.normals, surface.triangles, *map(np.asarray, anatomy.measures())]
