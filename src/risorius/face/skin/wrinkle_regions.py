"""The wrinkle regions of the table `face/skin/data/wrinkles.toml`, laid out on a head."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...core.arrays import Array
from ...core.units import Share
from ...errors import InputError, unknown
from ...machine.array_cache import cached_arrays
from ...reading.toml import package_text, parse_rows
from ..head.face_coordinates import FaceCoordinates
from ..head.head import Head
from .compression import Zone
from .wrinkle_layouts import Dimples, Fan, Fold, Layout, Lines, Millimetres, Spacing

TABLE = "wrinkles.toml"
_LAYOUTS = ("lines", "fan", "fold", "dimples")
_HIDDEN = ("lips", "inner_mouth", "lids", "ears", "garment")


@dataclass(frozen=True, slots=True)
class Sizes:
    """The sizes of a region in mm, beside its layout; see `wrinkles.toml`."""

    source: str
    cap: Spacing
    static: Millimetres
    width: Spacing
    furrow: Spacing
    shadow: Share
    relief: Share
    slack: Share = 1.0
    muscle: str = ""


@dataclass(frozen=True, slots=True)
class RegionRow(Sizes):
    """A region's table: its sizes, and one layout."""

    lines: Lines | None = None
    fan: Fan | None = None
    fold: Fold | None = None
    dimples: Dimples | None = None

    def __post_init__(self) -> None:
        if len(self._layouts()) != 1:
            names = ", ".join(self._layouts()) or "none"
            raise InputError(f"has the layouts {names}; expected one of {', '.join(_LAYOUTS)}")

    def _layouts(self) -> dict[str, Lines | Fan | Fold | Dimples]:
        return {name: getattr(self, name) for name in _LAYOUTS if getattr(self, name) is not None}

    def region(self, name: str) -> Region:
        """Return the region that the row describes."""
        (layout,) = self._layouts().values()
        return Region(name, self, layout)


@dataclass(frozen=True, slots=True)
class Region:
    """One region of wrinkles: its name, sizes and layout."""

    name: str
    sizes: Sizes
    layout: Lines | Fan | Fold | Dimples


class PlacedRegion(NamedTuple):
    """A region on a head at level 1: phases (N1,), creases at the integers, and the zone that drives it."""

    region: Region
    phase: Array
    zone: Zone


@lru_cache(maxsize=1)
def regions() -> tuple[Region, ...]:
    """Return the regions in the order of `FaceFrame.wrinkles`."""
    return parse_regions(package_text(str(__package__), TABLE), TABLE)


def parse_regions(text: str, name: str) -> tuple[Region, ...]:
    """Return the regions of a table's text; raise InputError, with its place, if it does not fit."""
    return tuple(row.region(key) for key, row in parse_rows(RegionRow, text, name).items())


def region_names() -> tuple[str, ...]:
    """Return the names of the regions, in order."""
    return tuple(region.name for region in regions())


def check_factors(factors: Mapping[str, float]) -> Array:
    """Return one factor (R,) per region, 1 for regions that `factors` does not name.

    Raises InputError for a region that does not exist, and for a factor outside 0 to 2.
    """
    names = region_names()
    result = np.ones(len(names))
    for name, factor in factors.items():
        if name not in names:
            raise InputError(unknown("wrinkle region", name, names))
        if not 0.0 <= factor <= 2.0:
            raise InputError(f"wrinkles '{name}' = {factor} is out of range; expected 0 to 2")
        result[names.index(name)] = factor
    return result


@lru_cache(maxsize=4)
def place_regions(head: Head) -> tuple[PlacedRegion, ...]:
    """Lay all regions out on a head; a mirrored vertex gets the same phase and mask."""
    marks = FaceCoordinates.of(head)
    fine = head.skin.matrix @ head.rest
    middles = head.rest[head.quads].mean(axis=1)
    seen = np.ones(len(fine))
    for name in _HIDDEN:
        seen *= 1.0 - np.clip(head.skin.matrix @ head.masks[name], 0.0, 1.0)
    table = np.frombuffer(package_text(str(__package__), TABLE).encode(), np.uint8)
    charts = cached_arrays(
        "regions",
        [table, marks.landmarks, marks.unit, fine, middles, seen],
        lambda: tuple(
            np.stack(arrays)
            for arrays in zip(*(_place(r.layout, marks, fine, middles, seen) for r in regions()), strict=True)
        ),
    )
    return tuple(
        PlacedRegion(region, phase, Zone(mask, pull))
        for region, phase, mask, pull in zip(regions(), *charts, strict=True)
    )


def _place(
    layout: Layout, marks: FaceCoordinates, fine: Array, middles: Array, seen: Array
) -> tuple[Array, Array, Array]:
    """Return the phase and the mask (N1,) of a layout, and its pull (Q0, 3)."""
    chart = layout.chart(marks, marks.left_half(fine))
    pull = layout.chart(marks, marks.left_half(middles)).pull
    pull[:, 0] *= np.where(middles[:, 0] < 0.0, -1.0, 1.0)
    mask = chart.mask * seen
    mask[mask < 1e-3] = 0.0
    return chart.phase, mask, pull
