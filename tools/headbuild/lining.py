"""The inside of the lips and of the mouth, which the source's identities leave folded or offset."""

from __future__ import annotations

import numpy as np
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray

from .bust import Bust
from .loops import fill_inside

_BORDER = (416, 417)  # an edge of the loop along the crest of the lips, in the base mesh
INSIDE = 535  # a vertex of the mouth's lining


def lining(bust: Bust) -> AnyArray:
    """Positions (N0, 3) of a bust whose mouth, from the lips' crest inwards, is shaped as the template's.

    It is hung into the lips by its Laplacian coordinates, turned and scaled to the face (Sorkine et al.
    2004), so that upper and lower lip stand above each other wherever they do on the template.
    """
    border = bust.loop(*_BORDER)
    seed = int(bust.local(np.array([INSIDE]))[0])
    inside = fill_inside(bust.loops, bust.quads, seed, border)
    outside = np.setdiff1d(np.arange(len(bust.ids)), inside)
    wanted = np.einsum("nij,nj->ni", bust.maps, bust.laplacian @ bust.places)[inside]
    rows = bust.laplacian[inside]
    result = bust.rest.copy()
    held = wanted - rows[:, outside] @ result[outside]
    result[inside] = splu(rows[:, inside].tocsc()).solve(held)
    return result
