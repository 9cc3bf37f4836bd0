"""The hair of a head by the name of its style."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from ..core.array_cache import cached_arrays
from ..core.arrays import AnyArray, Array
from ..face.identity import Looks
from .anatomy import Anatomy
from .medium_hair import grow_medium
from .short_hair import grow_short
from .strands import Strands
from .stubble import grow_stubble
from .surface import Surface

_STYLES = {"short": grow_short, "medium": grow_medium, "shaved": grow_stubble}
_FIELDS = tuple(field.name for field in fields(Strands))


def grow_hair(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> list[Strands]:
    """Return the hair in the style of `looks`, of linear albedo `colour` (3,); a bald head has none."""
    grow = _STYLES.get(looks.hair_style)
    if grow is None:
        return []

    def compute() -> tuple[AnyArray, ...]:
        strands = grow(anatomy, surface, colour, looks.hairs)
        return tuple(np.asarray(getattr(strands, name)) for name in _FIELDS)

    shape = (surface.points, surface.normals, surface.triangles, *anatomy.measures())
    arrays = cached_arrays(f"hair-{looks.hair_style}", [*shape, colour, looks.hairs], compute)
    columns: dict[str, Any] = dict(zip(_FIELDS, arrays, strict=True))
    return [Strands(**{name: array if array.ndim else array.item() for name, array in columns.items()})]
