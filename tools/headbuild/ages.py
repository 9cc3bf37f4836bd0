"""The shapes of an identity at other ages."""

from __future__ import annotations

import numpy as np
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray
from risorius.face.head.head_file import FORMAT
from risorius.face.head.identity import OLD, YOUNG, Identity

from .build import Shape, packed
from .jaw import fit_jaw
from .lining import INSIDE
from .loops import fill_inside
from .mouth import VERMILION, lip_rings
from .pack import settled
from .source import Source


def build_ages(source: Source, identity: Identity, shape: Shape) -> dict[str, AnyArray]:
    """All arrays of the ages file: the identity when young, as it is, and when old."""
    years = sorted({YOUNG, identity.age, OLD})
    template = shape.template or shape
    others = [shape if y == identity.age else Shape.of(source, identity.at(y), template) for y in years]
    skins = [shape.rest if other is shape else _aged(shape, other) for other in others]
    lips = lip_rings(shape.bust)
    moved = [(skin - shape.rest)[lips].mean(axis=0) * np.array([0.0, 1.0, 1.0]) for skin in skins]
    return {
        "format": np.array(FORMAT, np.int32),
        "years": np.array(years),
        **packed({f"rest/{k}": skin - shape.rest for k, skin in enumerate(skins) if skin is not shape.rest}),
        "eye_centre": settled(np.array([other.bust.eye_centre for other in others])),
        "eye_radius": settled(np.array([other.bust.eye_radius for other in others])),
        "jaw_point": settled(np.array([fit_jaw(other.bust, other.bust.rest).point for other in others])),
        "head_pivot": settled(np.array([other.pivot for other in others])),
        "mouth": settled(np.array(moved)),
    }


def _aged(shape: Shape, other: Shape) -> AnyArray:
    """(N0, 3) the skin at rest of `shape` when it is as old as `other`.

    The lips keep their form and go with the skin around them: the source's old lips do not meet as its young
    ones do.
    """
    bust = shape.bust
    change = other.bust.rest - bust.rest
    border = bust.loop(*VERMILION)
    inside = fill_inside(bust.loops, bust.quads, int(bust.local(np.array([INSIDE]))[0]), border)
    outside = np.setdiff1d(np.arange(len(bust.ids)), inside)
    rows = bust.laplacian[inside]
    change[inside] = splu(rows[:, inside].tocsc()).solve(-(rows[:, outside] @ change[outside]))
    return shape.seal.together(shape.rest + change)
