"""Masks of the skin: lips, inside of the mouth, lids, ears, garment; and the neck's share of the head's
rotation.
"""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import AnyArray

from .bust import Bust

_NECKLINE = (1518, 1519)  # an edge of the loop that the garment's neckline follows, in the base mesh


def masks(bust: Bust) -> dict[str, AnyArray]:
    """Mask name → (N0,) 0..1."""
    return {
        "lips": bust.texture("lips"),
        "inner_mouth": bust.texture("inside-mouth"),
        "lids": bust.texture("eyelids"),
        "ears": bust.texture("ears"),
        "garment": _garment(bust),
    }


def _garment(bust: Bust) -> AnyArray:
    """1 below the neckline, 0.5 on it, 0 above."""
    neckline = bust.loop(*_NECKLINE)
    crown = int(np.argmax(bust.rest[:, 1]))
    result = np.ones(len(bust.ids))
    result[bust.quads[bust.loops.fill(crown, [neckline])]] = 0.0
    result[neckline] = 0.5
    return result


def neck_weight(bust: Bust) -> AnyArray:
    """(N0,) share of the head's rotation: the rig's head bones take it all, the neck's bones a part, the
    torso none.
    """
    share = {"head": 1.0, "neck03": 0.75, "neck02": 0.45, "neck01": 0.15}
    total, moved = np.full(len(bust.ids), 1e-9), np.zeros(len(bust.ids))
    for bone, weights in bust.source.bone_weights().items():
        here = weights[bust.ids]
        total += here
        moved += here * (share[bone] if bone in share else float(_is_face(bone)))
    return np.asarray(np.clip(moved / total, 0.0, 1.0))


def _is_face(bone: str) -> bool:
    prefixes = (
        "jaw",
        "special",
        "oris",
        "levator",
        "orbicularis",
        "temporalis",
        "oculi",
        "risorius",
        "tongue",
        "eye",
    )
    return bone.startswith(prefixes)


def smoothstep(low: float, high: float, x: AnyArray) -> AnyArray:
    """0 below `low`, 1 above `high`, a smooth cubic between."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
