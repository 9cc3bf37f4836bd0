"""Activations that act on the skin at given values of the muscles: their own, and those of joint fields.

Muscles that push one lip from two sides hold each other: one at activation a whose partner is at b keeps
a (1 − y a b), with y of `YIELDS`. Each alone is exact, and more activation never moves the skin less, because
no muscle can lose more than a half.

Two muscles can also move together what neither moves alone: if the muscles that draw the corner of the
mouth back and down hold each other, it goes in. Such a joint field acts by the share p / (p + HALF²) (1 − p²)
of the product p of both activations: it needs both, is half where each is HALF, and ends where both contract
fully: there their own fields are the whole.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ...core.arrays import Array, UInt32Array
from ...core.parameters import INDEX, parameters_named
from ...machine.kernels.jit import device, kernel

# The share of its activation that each of two muscles loses where both contract fully. Numbers are ours: with
# them lips that are sucked in stay shut while the chin rises.
YIELDS = {
    ("orbicularis_oris_presser", "mentalis"): 0.4,
    ("orbicularis_oris_presser", "levator_labii_superioris"): 0.1,
    ("zygomatic_major", "mentalis"): 0.1,
}
HALF = 0.2  # activation of both muscles at which a joint field is half


class Yields(NamedTuple):
    """Muscles that hold each other: parameters `holding` (y, 2), and the `share` (y,) the first loses."""

    holding: UInt32Array
    share: Array


def yields_of(shares: Mapping[tuple[str, str], float]) -> Yields:
    """Return the loss of each muscle of each pair to the other; one without sides, half to either of them."""
    rows = []
    for pair, share in shares.items():
        for own, other in (pair, pair[::-1]):
            for muscle in parameters_named(own):
                sides = ("left", "right", "") if not muscle.side else ("", muscle.side)
                facing = [INDEX[o.name] for o in parameters_named(other) if o.side in sides]
                rows += [(INDEX[muscle.name], o, share / len(facing)) for o in facing]
    first, second, lost = zip(*rows, strict=True)
    return Yields(np.array([first, second], np.uint32).T.copy(), np.array(lost))


@device(inlined=True)
def joint_share(first: float, second: float) -> float:
    """Return the activation of a joint field for those of its two muscles."""
    both = max(first, 0.0) * max(second, 0.0)
    return both / (both + HALF * HALF) * (1.0 - both * both)


@kernel("u4[:, :], u4[:, :], f8[:], f8[:, :], f8[:, :]")
def activate(pairs: UInt32Array, holding: UInt32Array, share: Array, values: Array, out: Array) -> None:
    """Write the activations of parameters and joint fields at each row of `values` (k, 46) to a row of `out`.

    The last one counts for the rows that are left over. `holding` and `share` are those of `Yields`.
    """
    last, count = values.shape[0] - 1, values.shape[1]
    for lane in range(len(out)):
        row = min(lane, last)
        for k in range(count):
            out[lane, k] = values[row, k]
        for y in range(len(share)):
            own, other = values[row, holding[y, 0]], values[row, holding[y, 1]]
            if own > 0.0 and other > 0.0:
                out[lane, holding[y, 0]] -= share[y] * own * own * other
        for j in range(len(pairs)):
            out[lane, count + j] = joint_share(out[lane, pairs[j, 0]], out[lane, pairs[j, 1]])
