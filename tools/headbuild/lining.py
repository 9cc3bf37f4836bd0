"""The inside of the lips and of the mouth, which the source's identities leave folded or offset, and what
lines the eyes' sockets, which they crowd at the corners of narrow eyes.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray

from .bust import Bust
from .lids import behind_lids
from .loops import fill_inside

_BORDER = (416, 417)  # an edge of the loop along the crest of the lips, in the base mesh
INSIDE = 535  # a vertex of the mouth's lining


def lining(bust: Bust) -> AnyArray:
    """Positions (N0, 3) of a bust whose mouth, from the lips' crest inwards, and whose sockets, from the
    lids' margins inwards, are shaped as the template's.

    They are hung into lips and lids by their Laplacian coordinates, turned and scaled to the face (Sorkine et
    al. 2004), so that upper and lower lip stand above each other wherever they do on the template.
    """
    seed = int(bust.local(np.array([INSIDE]))[0])
    mouth = fill_inside(bust.loops, bust.quads, seed, bust.loop(*_BORDER))
    left = behind_lids(bust)
    wanted = np.einsum("nij,nj->ni", bust.maps, bust.laplacian @ bust.places)
    result = bust.rest.copy()
    for inside in (mouth, left, bust.mirror[left]):
        outside = np.setdiff1d(np.arange(len(bust.ids)), inside)
        rows = bust.laplacian[inside]
        held = wanted[inside] - rows[:, outside] @ result[outside]
        result[inside] = splu(rows[:, inside].tocsc()).solve(held)
    return result
