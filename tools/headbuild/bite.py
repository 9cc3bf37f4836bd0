"""The places of a head's teeth and tongue, relative to those on the template."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from risorius.core.arrays import AnyArray

from .bust import Bust
from .mouth import LipSeal

_VESTIBULE = ((535, 536), (552, 553))  # edges of the loops behind the lips, in the base mesh
_FRONT_TEETH = 9.0  # |x| in mm


@dataclass(frozen=True)
class Bite:
    """`line` is the y where the lips meet at rest, `shift` (3,) mm and `width` what carries the template's
    mouth here.
    """

    line: float
    shift: AnyArray
    width: float

    def place(self, points: AnyArray) -> AnyArray:
        """Points (n, 3) of the template's mouth in this head's."""
        return np.asarray(points * np.array([self.width, 1.0, 1.0]) + self.shift)


def find_bite(bust: Bust, seal: LipSeal, rest: AnyArray, template: tuple[LipSeal, AnyArray] | None) -> Bite:
    """Measure the mouth at `rest` (N0, 3); `template` is the seal and the rest of the template, None for
    itself.

    The teeth go with the skin right behind the lips, so that they keep their distance from it.
    """
    line = float(seal.line(rest)[1])
    if bust.template is None or template is None:
        return Bite(line, np.zeros(3), 1.0)
    there_seal, there = template
    ring = np.unique([v for a, b in _VESTIBULE for v in bust.loop(a, b)])
    near = ring[np.abs(there[ring, 0]) < _FRONT_TEETH]
    forward = float((rest[near, 2] - there[near, 2]).mean())
    width = rest[seal.corner, 0] / there[seal.corner, 0]
    return Bite(
        line,
        np.array([0.0, line - float(there_seal.line(there)[1]), forward]),
        float(np.clip(width, 0.92, 1.08)),
    )
