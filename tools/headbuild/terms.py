"""Movements that no sculpt of the source has: flesh that a muscle lifts or swells, in smooth regions."""

from __future__ import annotations

import tomllib
from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from risorius.core.arrays import AnyArray

from .bust import Bust
from .masks import smoothstep

FLESH = "flesh.toml"
_KEYS = ("what", "place", "size", "move", "skin")
_WITH = "with"  # optional: the other muscle of a joint term
_SKINS = ("all", "upper", "lower")
_END = 0.02  # height of the bell, of 1, at which it ends: far skin stays
_MIDDLE = 6.0  # mm from the middle within which the sideways movement grows from nothing
_EYE = (0.5, 5.0)  # mm from the eyeball between which a movement grows from nothing: the lids' margins stay
_JAW = (0.25, 0.75)  # share of the jaw between which the skin of the upper lip passes into that of the lower


def read_terms(path: Path, muscles: Collection[str]) -> dict[str, list[dict[str, Any]]]:
    """Terms by muscle, none without a file; raise ValueError for a term that does not fit."""
    if not path.is_file():
        return {}
    terms: dict[str, list[dict[str, Any]]] = tomllib.loads(path.read_text(encoding="utf-8"))
    for name, rows in terms.items():
        if name not in muscles:
            raise ValueError(f"{path.name}: unknown muscle '{name}'")
        for row in rows:
            if wrong := sorted((set(row) - {_WITH}) ^ set(_KEYS)):
                raise ValueError(f"{path.name}: {name}: key '{wrong[0]}'; expected {', '.join(_KEYS)}")
            if row.get(_WITH, name) not in muscles or row.get(_WITH) == name:
                raise ValueError(f"{path.name}: {name}: '{row[_WITH]}' is not another muscle")
            if row["skin"] not in _SKINS:
                raise ValueError(f"{path.name}: {name}: skin must be one of {', '.join(_SKINS)}")
    return terms


@dataclass(frozen=True)
class Terms:
    """The surface that terms are laid out on: a bust, and the jaw's share (N0,) of its skin."""

    bust: Bust
    jaw_weight: AnyArray

    def field(self, terms: list[dict[str, Any]]) -> AnyArray:
        """The displacement (N0, 3) in mm of both sides: the sum of `terms`, fitted to this face."""
        field = sum((self._one(term) for term in terms), np.zeros_like(self.bust.places))
        if self.bust.template is None:
            return np.asarray(field)
        return np.asarray(np.einsum("nij,nj->ni", self.bust.maps, field))

    def _one(self, term: dict[str, Any]) -> AnyArray:
        points = self.bust.places
        side = np.column_stack([np.abs(points[:, 0]), points[:, 1:]])
        distance = (side - np.array(term["place"])) / np.array(term["size"])
        bell = np.exp(-0.5 * (distance**2).sum(axis=1))
        share = np.maximum((bell - _END) / (1.0 - _END), 0.0) * self._off_eyes * self._skins[term["skin"]]
        way = np.clip(points[:, 0] / _MIDDLE, -1.0, 1.0)
        x, y, z = term["move"]
        return np.asarray(
            share[:, None] * np.column_stack([way * x, np.full(len(way), y), np.full(len(way), z)])
        )

    @cached_property
    def _off_eyes(self) -> AnyArray:
        template = self.bust.template or self.bust
        share = np.ones(len(self.bust.ids))
        for centre, radius in zip(template.eye_centre, template.eye_radius, strict=True):
            share *= smoothstep(*_EYE, np.linalg.norm(self.bust.places - centre, axis=1) - radius)
        return share

    @cached_property
    def _skins(self) -> dict[str, AnyArray]:
        lower = smoothstep(*_JAW, self.jaw_weight)
        return {"all": np.ones_like(lower), "upper": 1.0 - lower, "lower": lower}


def of_one(terms: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those of a muscle's terms that act with this muscle alone."""
    return [term for term in terms if _WITH not in term]


def partners(terms: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Those that act only while another muscle contracts too, by that muscle."""
    names = dict.fromkeys(term[_WITH] for term in terms if _WITH in term)
    return {name: [term for term in terms if term.get(_WITH) == name] for name in names}
