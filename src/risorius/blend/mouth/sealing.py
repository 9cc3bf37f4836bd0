"""The last step of a contact: its goals, and a seal that takes back what other channels open too far."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...core.arrays import Array
from ...core.lips.lip_rig import LipRig
from .closure_speed import MouthGaps
from .contact import SEAL, TUCK, beside_tuck
from .lips import CompiledLips

GapsByRig = Callable[[LipRig], MouthGaps | None]
"""The gaps of the mouth by a head's rig; None if only speech parts the lips."""


def apply_contact_goals(
    name: str, value: Array, speech: Array, times: Array, lips: CompiledLips, gaps: GapsByRig
) -> Array:
    """Return a contact (n,) at sorted times with its goals; each contact gives way to the other's goal.

    `speech`: what the segments target of `value`, rounded as it is: unlike curves would cross in corners.
    The goal of a seal closes only what remains open on the way to the closure (`approach`), so that the gap
    changes no faster when the goal begins. A tuck leaves of the seal what `beside_tuck` says.
    """
    tuck = lips.goals[TUCK].at(times)
    if name == TUCK:
        return np.minimum(np.maximum(value, tuck), 1.0 - lips.goals[SEAL].at(times))
    rig = lips.mouth.shapes.rig
    if rig is None:
        return np.asarray(1.0 - (1.0 - value * (1.0 - tuck)) * (1.0 - lips.goals[SEAL].at(times)))
    seal = lips.mouth.approach.sealed(speech, times, gaps(rig))
    # Other channels may seal what speech leaves open.
    left_open = np.divide(1.0 - value, 1.0 - speech, out=np.ones(len(speech)), where=speech < value)
    return (1.0 - (1.0 - seal) * left_open) * beside_tuck(tuck)
