"""The 52 sculpted ARKit shapes carried onto a head: fields of the skin, and how the lower teeth move."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from risorius.core.arkit import SHAPES
from risorius.core.arrays import AnyArray
from risorius.face.head.head_file import FORMAT

from .build import Shape
from .muscles import SIDES, ironed, joint_fields, muscle_fields, posed_field, read_recipes
from .pack import quantized
from .terms import Terms

# Shapes for which muscles are better than the source's sculpt, because flesh swells and is lifted in them
# (`flesh.toml`): the muscles whose fields, of the shape's side, add up to it.
MUSCLES = {
    "browInnerUp": ("frontalis_medialis",),
    "browOuterUp": ("frontalis_lateralis",),
    "browDown": ("corrugator_supercilii", "depressor_supercilii", "depressor_glabellae"),
    "cheekSquint": ("orbicularis_oculi_orbitalis",),
    "noseSneer": ("levator_labii_nasi",),
    "mouthSmile": ("zygomatic_major",),
    "mouthFrown": ("triangularis",),
    "mouthStretch": ("risorius",),
    "mouthUpperUp": ("levator_labii_superioris", "zygomatic_minor"),
    "mouthShrugLower": ("mentalis",),
}
# Shapes of two muscles that act together (rows of `flesh.toml` with another one), as AU14 and AU24 are.
POSES = {
    "mouthDimple": {"zygomatic_major": 0.25, "risorius": 0.25, "triangularis": 0.25},
    "mouthPress": {"orbicularis_oris_presser": 0.4, "mentalis": 0.4},
}
# Apple's lips are rounded apart in mouthFunnel, closed in mouthPucker: one muscle, and contact.
FUNNEL, PUCKER = "mouthFunnel", "mouthPucker"
_ROUNDING = "orbicularis_oris_funneler"
_TEETH = "helper-lower-teeth"
_SMALLEST = 0.02  # mm: what a sculpt moves less is left out


def build_shapes(shape: Shape, recipes: Path) -> dict[str, AnyArray]:
    """All arrays of the shapes file: per shape a field of the skin, and the lower teeth's way (52, 3) mm.

    Sharp folds of a sculpt are ironed out as in the muscles made from it (`recipes`): both are one face.
    """
    bust, stiffness = shape.bust, _stiffness(recipes)
    terms, table = Terms(bust, shape.jaw.weight), read_recipes(recipes)
    muscles = muscle_fields(bust, shape.rest, shape.seal, terms, table)
    joint = joint_fields(bust, shape.rest, shape.seal, terms, table, muscles)
    rounded = muscles[_ROUNDING]
    lips = {FUNNEL: rounded, PUCKER: shape.seal.together(shape.rest + rounded) - shape.rest}
    lips |= {
        name + side.capitalize(): posed_field(bust, muscles, joint, pose, side)
        for name, pose in POSES.items()
        for side in SIDES
    }
    teeth = bust.source.parts[_TEETH].vertices
    arrays = {
        "format": np.array(FORMAT, np.int32),
        "teeth": np.array([bust.source.shape(name)[teeth].mean(axis=0) for name in SHAPES], np.float32),
    }
    for name in SHAPES:
        own = lips[name] if name in lips else _of_muscles(muscles, name)
        field = ironed(bust, bust.shape(name), stiffness.get(name, 0.0)) if own is None else own
        for key, values in quantized(field, _SMALLEST).items():
            arrays[f"shape/{name}/{key}"] = values
    return arrays


def _of_muscles(fields: dict[str, AnyArray], name: str) -> AnyArray | None:
    """Return the field (N0, 3) of a shape as its muscles have it, None if they have none."""
    for shape, muscles in MUSCLES.items():
        for sides in (("left", "right"), ("left",), ("right",)):
            if name == shape + (sides[0].capitalize() if len(sides) == 1 else ""):
                return np.asarray(np.sum([fields[f"{m}.{side}"] for m in muscles for side in sides], axis=0))
    return None


def _stiffness(recipes: Path) -> dict[str, float]:
    """The bending stiffness of each shape: the greatest of the muscles that are made from it."""
    found: dict[str, float] = {}
    for recipe in read_recipes(recipes).values():
        for name in recipe["shapes"]:
            for sided in (name, f"{name}Left", f"{name}Right"):
                found[sided] = max(found.get(sided, 0.0), recipe["smooth"])
    return found
