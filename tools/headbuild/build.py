"""Put the parts of the head together into the arrays of `head.npz`."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from risorius.face.head_file import FORMAT

from .arrays import Array
from .bust import Bust, cut_bust
from .jaw import Jaw, fit_jaw
from .landmarks import landmarks
from .lids import lid_pairs
from .masks import masks, neck_weight
from .mouth import LipSeal, lip_pairs
from .muscles import muscle_fields, read_recipes
from .pack import quantized
from .source import Source
from .teeth import build_teeth, incisor_edge
from .tongue import tongue, tongue_fields
from .tuck import tuck

HEAD_PIVOT = np.array([0.0, -45.0, -74.0])  # between the ears' lobes: about where the skull sits on the neck


def build(source: Source, recipes: Path) -> dict[str, Array]:
    """All arrays of the head file, by name; `recipes` is the head's `muscles.toml`."""
    bust = cut_bust(source)
    seal = LipSeal.of(bust)
    rest = seal.together(bust.rest)
    jaw = fit_jaw(bust, rest)
    line = float(seal.line(rest)[1])
    fields = muscle_fields(bust, rest, seal, read_recipes(recipes))
    fields["lip_tuck"] = tuck(rest, fields["lip_tuck"], seal, jaw, incisor_edge(line))
    return {
        "format": np.array(FORMAT, np.int32),
        **_skin(bust, rest),
        **_jaw(jaw),
        **_packed({f"field/{name}": field for name, field in fields.items()}),
        **_teeth(line),
        **_tongue(bust),
        **_landmarks(bust, rest, seal),
    }


def _skin(bust: Bust, rest: Array) -> dict[str, Array]:
    return {
        "rest": _short(rest),
        "quads": _index(bust.quads),
        "uv": _short(bust.uv),
        "mirror": _index(bust.mirror),
        "head_pivot": HEAD_PIVOT,
        "neck_weight": _short(neck_weight(bust)),
        "lip_pairs": _index(lip_pairs(bust, rest)),
        "lid_pairs_left": _index(lid_pairs(bust, "left")),
        "lid_pairs_right": _index(lid_pairs(bust, "right")),
        "eye_centre": bust.eye_centre,
        "eye_radius": bust.eye_radius,
        **{f"mask/{name}": _short(mask) for name, mask in masks(bust).items()},
    }


def _jaw(jaw: Jaw) -> dict[str, Array]:
    return {
        "jaw_point": jaw.point,
        "jaw_axis": jaw.axis,
        "jaw_angle": np.array(jaw.angle),
        "jaw_weight": _short(jaw.weight),
        **_packed({"jaw/corrective": jaw.corrective}),
    }


def _teeth(line: float) -> dict[str, Array]:
    arrays = {}
    for name, part in build_teeth(line).items():
        arrays[f"{name}/vertices"] = _short(part.vertices)
        arrays[f"{name}/triangles"] = _index(part.triangles)
        arrays[f"{name}/material"] = _short(part.material)
    return arrays


def _tongue(bust: Bust) -> dict[str, Array]:
    rest, quads = tongue(bust)
    fields = {f"tongue/{name}": field for name, field in tongue_fields(rest).items()}
    return {"tongue/rest": _short(rest), "tongue/quads": _index(quads), **_packed(fields)}


def _landmarks(bust: Bust, rest: Array, seal: LipSeal) -> dict[str, Array]:
    triangles, weights = landmarks(bust, rest, seal)
    return {"landmark_triangles": _index(triangles), "landmark_weights": _short(weights)}


def _packed(fields: dict[str, Array]) -> dict[str, Array]:
    return {
        f"{name}/{key}": value for name, field in fields.items() for key, value in quantized(field).items()
    }


def _short(values: Array) -> Array:
    return values.astype(np.float32)


def _index(values: Array) -> Array:
    return values.astype(np.uint16)
