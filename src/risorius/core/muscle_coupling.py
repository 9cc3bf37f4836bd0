"""Links between muscles: fibres that interleave pull each other along (paper B, section 6.3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..errors import ParameterError, unknown
from .parameters import MUSCLES, RIVALS, Parameter
from .units import Share

_BASES = tuple(dict.fromkeys(m.base for m in MUSCLES))


@dataclass(frozen=True, slots=True)
class Link:
    """One row: `linked` contracts at least `weight` times as much as `muscle`.

    Muscles are named without a side; `sides`: whether the link is to the same or to the other side. Raises
    ParameterError for an unknown muscle, for a muscle linked to itself, and for muscles that conflict (paper
    A, Table 2).
    """

    muscle: str
    linked: str
    weight: Share
    source: str
    sides: Literal["same", "other"] = "same"

    def __post_init__(self) -> None:
        for name in (self.muscle, self.linked):
            if name not in _BASES:
                raise ParameterError(unknown("muscle", name, _BASES))
        if not 0.0 <= self.weight <= 1.0:
            raise ParameterError(f"weight = {self.weight} is out of range; expected 0 to 1")
        pairs = self.pairs()
        if not pairs or any(a is b for a, b in pairs):
            raise ParameterError(
                f"'{self.muscle}' cannot be linked with '{self.linked}' on the {self.sides} side; "
                "expected two different muscles"
            )
        for a, b in pairs:
            if b.name in RIVALS[a.name]:
                raise ParameterError(f"'{a.name}' and '{b.name}' conflict; expected muscles that do not")

    def pairs(self) -> list[tuple[Parameter, Parameter]]:
        """Return the parameters (from, to) that the row links."""
        return [(a, b) for a in _of(self.muscle) for b in _of(self.linked) if self._meets(a.side, b.side)]

    def _meets(self, one: str, other: str) -> bool:
        if not one or not other:
            return self.sides == "same"
        return (one == other) == (self.sides == "same")


def _of(base: str) -> list[Parameter]:
    return [m for m in MUSCLES if m.base == base]
