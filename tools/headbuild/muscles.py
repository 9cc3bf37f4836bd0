"""Displacement fields of the muscles, from the recipes of `muscles.toml`."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray
from risorius.core.parameters import MUSCLES
from risorius.face.head.head_file import AND
from risorius.face.muscles.activations import joint_share

from .bust import Bust
from .folds import unfolded
from .lids import close_lids, lid_pairs
from .masks import smoothstep
from .mouth import LipSeal, lip_rings, narrowed
from .terms import FLESH, Terms, of_one, partners, read_terms

SIDES = ("left", "right")
_BOTH = 0.3  # activation of both muscles at which the lips of a joint field are made to touch
_SEAM = 8.0  # half width in mm of the ramp that splits a shape of both sides
_GLABELLA = (-6.0, 18.0)  # |x| in mm between which the skin between the brows passes into the brow

_KEYS = ("shapes", "part", "origin", "insertion", "action")
# The anatomy of a row, which the recipe does not need: `risorius.face.head.muscle_table` reads it.
_ANATOMY = ("type", "line", "zone", "source")
_DEFAULTS = {"lips": "free", "smooth": 0.0, "narrow": 0.0}
_MEETING = ("lids to their meeting", "lower lip to the teeth")
_LIPS = ("free", "together", "no overlap")

Split = Callable[[AnyArray, AnyArray], AnyArray]


def _upper_lip_inner(points: AnyArray, field: AnyArray) -> AnyArray:
    return field * (1.0 - smoothstep(10.0, 24.0, np.abs(points[:, 0])))[:, None]


def _below_brow(points: AnyArray, field: AnyArray) -> AnyArray:
    return field * (1.0 - smoothstep(0.0, 12.0, points[:, 1]))[:, None]


def _between_brows(points: AnyArray, field: AnyArray) -> AnyArray:
    far, near = _brow_ramp(points)
    return np.asarray(_without_sideways(field) * (near / np.cbrt(near**3 + far**3))[:, None])


def _brow_downwards(points: AnyArray, field: AnyArray) -> AnyArray:
    far, near = _brow_ramp(points)
    return np.asarray(_inner_brow(points, field) * (far / np.cbrt(near**3 + far**3))[:, None])


def _brow_inwards(points: AnyArray, field: AnyArray) -> AnyArray:
    return field - _inner_brow(points, field)


def _inner_brow(points: AnyArray, field: AnyArray) -> AnyArray:
    return _without_sideways(field) * (1.0 - smoothstep(22.0, 40.0, np.abs(points[:, 0])))[:, None]


def _brow_ramp(points: AnyArray) -> tuple[AnyArray, AnyArray]:
    """Shares whose cubes add up to 1 once divided by the cube root of that sum: two that pull alike then give
    the whole shape together, for n parallel pulls give the cube root of the sum of their cubes.
    """
    share = np.clip((np.abs(points[:, 0]) - _GLABELLA[0]) / (_GLABELLA[1] - _GLABELLA[0]), 0.0, 1.0)
    return share**1.5, (1.0 - share) ** 1.5


def _without_sideways(field: AnyArray) -> AnyArray:
    return np.asarray(field * np.array([0.0, 1.0, 1.0]))


PARTS: dict[str, Split] = {
    "all": lambda _, field: field,
    "lids to their meeting": lambda _, field: field,
    "lower lip to the teeth": lambda _, field: field,
    "upper lip, inner": _upper_lip_inner,
    "upper lip, outer": lambda points, field: field - _upper_lip_inner(points, field),
    "below the brow": _below_brow,
    "between the brows": _between_brows,
    "brow, downwards": _brow_downwards,
    "brow, inwards": _brow_inwards,
}


def read_recipes(path: Path) -> dict[str, dict[str, Any]]:
    """Recipes by muscle; raise ValueError if a muscle is missing, or a part is unknown."""
    recipes = tomllib.loads(path.read_text(encoding="utf-8"))
    recipes.pop("masseter", None)
    wanted = {m.base for m in MUSCLES if m.base != "masseter"} | {"lip_tuck"}
    if set(recipes) != wanted:
        raise ValueError(f"{path.name} and the table of parameters differ: {sorted(set(recipes) ^ wanted)}")
    flesh = read_terms(path.with_name(FLESH), wanted)
    for name, recipe in recipes.items():
        for key in sorted(set(recipe) - set(_KEYS) - set(_ANATOMY) - set(_DEFAULTS)):
            raise ValueError(
                f"{path.name}: {name}: unknown key '{key}'; expected {', '.join((*_KEYS, *_DEFAULTS))}"
            )
        recipes[name] = _DEFAULTS | recipe | {"terms": flesh.get(name, [])}
        if recipe["part"] not in PARTS:
            raise ValueError(f"{path.name}: {name}: unknown part '{recipe['part']}'")
        if recipes[name]["lips"] not in _LIPS:
            raise ValueError(f"{path.name}: {name}: lips must be one of {', '.join(_LIPS)}")
    return recipes


def muscle_fields(
    bust: Bust, rest: AnyArray, seal: LipSeal, terms: Terms, recipes: dict[str, dict[str, Any]]
) -> dict[str, AnyArray]:
    """Field name → displacement (N0, 3) in mm; left and right are exact mirror images."""
    paired = {m.base for m in MUSCLES if m.side}
    fields = {}
    for name, recipe in recipes.items():
        if name in paired:
            left = _field(bust, rest, recipe, "left")
            left = 0.5 * (left + mirrored(bust, _field(bust, rest, recipe, "right")))
            left = left + terms.field(of_one(recipe["terms"])) * _left_share(bust.places)
            change = _lips_change(bust, rest, seal, left + mirrored(bust, left), recipe)
            left = _with_room(bust, rest, left + change * _left_share(bust.places), recipe)
            fields[f"{name}.left"], fields[f"{name}.right"] = left, mirrored(bust, left)
        else:
            both = sum((_field(bust, rest, recipe, side) for side in SIDES), np.zeros_like(rest))
            both = 0.5 * (both + mirrored(bust, both)) + terms.field(of_one(recipe["terms"]))
            both = narrowed(bust, rest + both, recipe["narrow"]) - rest
            both = both + _lips_change(bust, rest, seal, both, recipe)
            fields[name] = _with_room(bust, rest, both, recipe)
    return fields


def joint_fields(
    bust: Bust,
    rest: AnyArray,
    seal: LipSeal,
    terms: Terms,
    recipes: dict[str, dict[str, Any]],
    fields: dict[str, AnyArray],
) -> dict[str, AnyArray]:
    """Displacement (N0, 3) in mm of what two muscles move only together, of each side, by both names.

    `fields` are those of the muscles alone. The lips touch while both act by `_BOTH`, if one of them alone
    keeps them so.
    """
    found = {}
    for name, recipe in recipes.items():
        for other, rows in partners(recipe["terms"]).items():
            names = {side: [_of_side(fields, base, side) for base in (name, other)] for side in SIDES}
            left = terms.field(rows) * _left_share(bust.places)
            if "together" in (recipe["lips"], recipes[other]["lips"]):
                alone = sum(fields[n] for n in dict.fromkeys((*names["left"], *names["right"])))
                share = joint_share(_BOTH, _BOTH)
                both = _BOTH * alone + share * (left + mirrored(bust, left))
                change = seal.together(rest + both) - rest - both
                left += change / share * _left_share(bust.places)
            for side, field in (("left", left), ("right", mirrored(bust, left))):
                found[AND.join(names[side])] = field
    return found


def posed_field(
    bust: Bust, fields: dict[str, AnyArray], joint: dict[str, AnyArray], pose: dict[str, float], side: str
) -> AnyArray:
    """Displacement (N0, 3) in mm of one side by muscles that act together, by name without side."""
    share = _left_share(bust.places) if side == "left" else 1.0 - _left_share(bust.places)
    amounts = {_of_side(fields, base, side): amount for base, amount in pose.items()}
    total = np.zeros_like(bust.places)
    for name, amount in amounts.items():
        total += amount * fields[name] * (1.0 if name.endswith(side) else share)
    for pair, field in joint.items():
        first, second = (amounts.get(name, 0.0) for name in pair.split(AND))
        total += joint_share(first, second) * field
    return total


def _of_side(fields: dict[str, AnyArray], base: str, side: str) -> str:
    sided = f"{base}.{side}"
    return sided if sided in fields else base


def _with_room(bust: Bust, rest: AnyArray, field: AnyArray, recipe: dict[str, Any]) -> AnyArray:
    """The field, with room left for the skin unless its part is to bring parts together."""
    return field if recipe["part"] in _MEETING else unfolded(bust, rest, field)


def _lips_change(
    bust: Bust, rest: AnyArray, seal: LipSeal, both: AnyArray, recipe: dict[str, Any]
) -> AnyArray:
    """Return the change (N0, 3) of `both`, the field of the two sides, that makes the lips as the recipe
    says.
    """
    if recipe["lips"] == "free":
        return np.zeros_like(rest)
    return seal.together(rest + both, close=recipe["lips"] == "together") - rest - both


def _left_share(places: AnyArray) -> AnyArray:
    share: AnyArray = smoothstep(-_SEAM, _SEAM, places[:, 0])[:, None]
    return share


def mirrored(bust: Bust, field: AnyArray) -> AnyArray:
    """The field (N0, 3) of the other side."""
    return np.asarray(field[bust.mirror] * np.array([-1.0, 1.0, 1.0]))


def _field(bust: Bust, rest: AnyArray, recipe: dict[str, Any], side: str) -> AnyArray:
    total = sum((w * _sided(bust, shape, side) for shape, w in recipe["shapes"].items()), np.zeros_like(rest))
    field = ironed(bust, PARTS[recipe["part"]](bust.places, total), recipe["smooth"])
    return close_lids(bust, rest, field, side) if recipe["part"] == "lids to their meeting" else field


def ironed(bust: Bust, field: AnyArray, stiffness: float) -> AnyArray:
    """The field without the sharp folds of the sculpt, by bending energy; lips and lids are held."""
    if stiffness == 0.0:
        return field
    held = np.zeros(len(field))
    held[np.concatenate([lip_rings(bust), *(lid_pairs(bust, side).ravel() for side in SIDES)])] = 50.0
    curvature = sp.diags(1.0 / bust.laplacian.diagonal()) @ bust.laplacian
    system = sp.identity(len(field)) + sp.diags(held) + stiffness * (curvature.T @ curvature)
    return np.asarray(splu(system.tocsc()).solve((1.0 + held)[:, None] * field))


def _sided(bust: Bust, shape: str, side: str) -> AnyArray:
    if bust.source.has_shape(shape):
        share = _left_share(bust.places)
        return bust.shape(shape) * (share if side == "left" else 1.0 - share)
    return bust.shape(shape + side.capitalize())
