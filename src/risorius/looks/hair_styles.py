"""The hair of a head by the name of its style."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import numpy as np

from ..core.arrays import AnyArray, Array
from ..face.head.identity import Looks
from .anatomy import Anatomy
from .hair_cache import cached_hairs
from .hairline import grow_hairline
from .medium_hair import grow_medium
from .parting import aside
from .scalp import Combed, flow
from .short_hair import grow_short
from .srgb import linear
from .strands import Strands
from .stubble import grow_stubble
from .surface import Surface
from .tied_hair import grow_tied, tied_back

_Grow: TypeAlias = Callable[[Anatomy, Surface, Array, Looks], Strands]
_STYLES: dict[str, _Grow] = {
    "short": grow_short,
    "medium": grow_medium,
    "tied": grow_tied,
    "shaved": grow_stubble,
}
# How the fine hairs lie with which a style begins.
_EDGED: dict[str, Combed] = {"short": flow, "medium": aside, "tied": tied_back}


def grow_hair(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> dict[str, Strands]:
    """Return the hair by part in the style of `looks`, of linear albedo `colour` (3,): none if bald."""
    style = looks.hair_style
    if style not in _STYLES:
        return {}
    inputs = [*grown_on(anatomy, surface), colour, np.asarray([looks.hairs, looks.wave])]
    grow = partial(_STYLES[style], anatomy, surface, colour, looks)
    grown = {"hair": cached_hairs(f"hair-{style}", inputs, grow)}
    if style in _EDGED:
        skin = linear(looks.skin)
        edge = partial(grow_hairline, anatomy, surface, colour, skin, looks.hairs, _EDGED[style])
        grown["hairline"] = cached_hairs(f"hairline-{style}", [*inputs, skin], edge)
    return grown


def grown_on(anatomy: Anatomy, surface: Surface) -> list[AnyArray]:
    """Return the arrays that describe the surface on which a head's hairs grow."""
    return [surface.points, surface.normals, surface.triangles, *map(np.asarray, anatomy.measures())]
