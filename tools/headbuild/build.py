"""Put the parts of a head together into the arrays of `head.npz`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from risorius.core.arrays import AnyArray
from risorius.face.head.head_file import FORMAT, JOINT
from risorius.face.head.identity import Identity

from .bite import Bite, find_bite
from .bust import Bust, cut_bust
from .fissure import set_eyes
from .jaw import Jaw, fit_jaw
from .landmarks import INNER_LIPS, inner_lips, landmarks
from .lids import clear_of_eyes, lid_pairs
from .lining import lining
from .masks import masks, neck_weight
from .mouth import LipSeal, lip_pairs
from .muscles import joint_fields, muscle_fields, read_recipes
from .pack import quantized, settled, short
from .source import Source
from .teeth import build_teeth, incisor_edge
from .terms import Terms
from .tongue import tongue, tongue_fields
from .tuck import tuck

JOINT_STEP = 0.005  # mm: joint fields need not be finer, and coarser values take less room
HEAD_PIVOT = np.array([0.0, -45.0, -74.0])  # between the ears' lobes: about where the skull sits on the neck


@dataclass(frozen=True)
class Shape:
    """An identity at one age: its bust, and what is measured on it; `template` is the shape that the
    builder's distances were drawn for, None for itself.
    """

    bust: Bust
    template: Shape | None = None

    @classmethod
    def of(cls, source: Source, identity: Identity, template: Shape | None = None) -> Shape:
        """Blend and cut the identity, set its eyes and lids, hang the template's linings into its lips and
        lids, clear its eyes of the lids.
        """
        bust = set_eyes(cut_bust(source, identity, template.bust if template else None), identity.age)
        if template:
            bust = bust.reshaped(lining(bust))
            bust = bust.reshaped(clear_of_eyes(bust))
        return cls(bust, template)

    @cached_property
    def seal(self) -> LipSeal:
        """The movement that brings its lips together."""
        return LipSeal.of(self.bust)

    @cached_property
    def rest(self) -> AnyArray:
        """(N0, 3) the skin with lips together."""
        return self.seal.together(self.bust.rest)

    @cached_property
    def jaw(self) -> Jaw:
        """Its jaw."""
        return fit_jaw(self.bust, self.rest)

    @cached_property
    def bite(self) -> Bite:
        """The place of its teeth."""
        there = (self.template.seal, self.template.rest) if self.template else None
        return find_bite(self.bust, self.seal, self.rest, there)

    @cached_property
    def landmarks(self) -> tuple[AnyArray, AnyArray]:
        """The 68 points: those of the template, but for the inner lips."""
        if self.template is None:
            return landmarks(self.bust, self.rest, self.seal)
        triangles, weights = (part.copy() for part in self.template.landmarks)
        triangles[INNER_LIPS], weights[INNER_LIPS] = inner_lips(self.rest, self.seal)
        return triangles, weights

    @cached_property
    def pivot(self) -> AnyArray:
        """(3,) where the head turns: it goes with the ears."""
        ears = self.bust.texture("ears")
        moved = (ears[:, None] * (self.bust.rest - self.bust.places)).sum(axis=0) / ears.sum()
        return np.asarray(HEAD_PIVOT + moved * np.array([0.0, 1.0, 1.0]))


def build(shape: Shape, recipes: Path) -> dict[str, AnyArray]:
    """All arrays of the head file, by name; `recipes` is the `muscles.toml`."""
    bust, rest, bite = shape.bust, shape.rest, shape.bite
    template = shape.template or shape
    terms = Terms(bust, shape.jaw.weight)
    table = read_recipes(recipes)
    fields = muscle_fields(bust, rest, shape.seal, terms, table)
    joint = joint_fields(bust, rest, shape.seal, terms, table, fields)
    edge = bite.place(incisor_edge(template.bite.line)[None])[0]
    fields["lip_tuck"] = tuck(rest, fields["lip_tuck"], shape.seal, shape.jaw, edge)
    return {
        "format": np.array(FORMAT, np.int32),
        **_skin(shape),
        **_jaw(shape.jaw),
        **packed({f"field/{name}": field for name, field in fields.items()}),
        **packed({f"{JOINT}{name}": field for name, field in joint.items()}, JOINT_STEP),
        **_teeth(template.bite.line, bite),
        **_tongue(template.bust, bite),
        **_landmarks(shape),
    }


def _skin(shape: Shape) -> dict[str, AnyArray]:
    bust = shape.bust
    return {
        "rest": short(shape.rest),
        "quads": _index(bust.quads),
        "uv": short(bust.uv),
        "mirror": _index(bust.mirror),
        "head_pivot": settled(shape.pivot),
        "neck_weight": short(neck_weight(bust)),
        "lip_pairs": _index(lip_pairs(bust, shape.rest)),
        "lid_pairs_left": _index(lid_pairs(bust, "left")),
        "lid_pairs_right": _index(lid_pairs(bust, "right")),
        "eye_centre": settled(bust.eye_centre),
        "eye_radius": settled(bust.eye_radius),
        **{f"mask/{name}": short(mask) for name, mask in masks(bust).items()},
    }


def _jaw(jaw: Jaw) -> dict[str, AnyArray]:
    return {
        "jaw_point": settled(jaw.point),
        "jaw_axis": jaw.axis,
        "jaw_angle": settled(np.array(jaw.angle)),
        "jaw_weight": short(jaw.weight),
        **packed({"jaw/corrective": jaw.corrective}),
    }


def _teeth(line: float, bite: Bite) -> dict[str, AnyArray]:
    arrays = {}
    for name, part in build_teeth(line).items():
        arrays[f"{name}/vertices"] = short(bite.place(part.vertices))
        arrays[f"{name}/triangles"] = _index(part.triangles)
        arrays[f"{name}/material"] = short(part.material)
    return arrays


def _tongue(template: Bust, bite: Bite) -> dict[str, AnyArray]:
    rest, quads = tongue(template)
    fields = {f"tongue/{name}": field for name, field in tongue_fields(rest).items()}
    return {"tongue/rest": short(bite.place(rest)), "tongue/quads": _index(quads), **packed(fields)}


def _landmarks(shape: Shape) -> dict[str, AnyArray]:
    triangles, weights = shape.landmarks
    return {"landmark_triangles": _index(triangles), "landmark_weights": short(weights)}


def packed(fields: dict[str, AnyArray], step: float | None = None) -> dict[str, AnyArray]:
    """The arrays in which fields (n, 3) mm are kept, by name; `step` as for `quantized`."""
    return {
        f"{name}/{key}": value
        for name, field in fields.items()
        for key, value in quantized(field, step=step).items()
    }


def _index(values: AnyArray) -> AnyArray:
    return values.astype(np.uint16)
