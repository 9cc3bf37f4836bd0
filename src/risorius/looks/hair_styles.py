"""The hair of a head by the name of its style."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from functools import partial
from typing import Any, TypeAlias

import numpy as np

from ..core.array_cache import cached_arrays
from ..core.arrays import AnyArray, Array
from ..face.identity import Looks
from .anatomy import Anatomy
from .hairline import grow_hairline
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
_FIELDS = tuple(field.name for field in fields(Strands))


def grow_hair(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> dict[str, Strands]:
    """Return the hair by part in the style of `looks`, of linear albedo `colour` (3,): none if bald."""
    shape = (surface.points, surface.normals, surface.triangles, *anatomy.measures())
    inputs = [*shape, colour, looks.hairs]

    def grown(grow: _Grow) -> tuple[AnyArray, ...]:
        strands = grow(anatomy, surface, colour, looks.hairs)
        return tuple(np.asarray(getattr(strands, name)) for name in _FIELDS)

    hair = {}
    for name, grow in _STYLES.get(looks.hair_style, {}).items():
        arrays = cached_arrays(f"{name}-{looks.hair_style}", inputs, partial(grown, grow))
        columns: dict[str, Any] = {n: a if a.ndim else a.item() for n, a in zip(_FIELDS, arrays, strict=True)}
        hair[name] = Strands(**columns)
    return hair
