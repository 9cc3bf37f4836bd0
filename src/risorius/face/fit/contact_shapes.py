"""The ARKit shapes of which a head's own contact is a part: closed lids, and lips that come together.

Sculpted shapes move surfaces past each other or leave them apart, each head's a little differently. Weights
that shut an eye or a mouth need shapes that do exactly that. So `eyeBlink` is the face's own closed lid.
`mouthClose` brings together what `jawOpen` opens, as our own lips close: both lips move, and nothing else
does. `mouthPress` also presses the lips of its side together, up to `PRESSED` mm, most near the corner.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...core.arkit import INDEX
from ...core.arrays import Array
from ...core.parameters import INDEX as PARAMETER
from ...core.parameters import NEUTRAL
from ..contact.lips import Handles
from ..contact.mouth import Mouth
from ..contact.plate import nearby, plate_compliance
from ..head.head import Head
from ..solve import FaceSolver

PRESSED = 8.0  # mm by which a side's lips come together if they are that far apart
BEYOND, WHOLE = (
    0.15,
    0.75,
)  # shares of half a mouth: a press reaches over the middle; from there on it is whole
CORNER = 0.4  # share of the jaw's widest opening from which on a place is pressed wholly, less at the corner
SMALLEST = 1e-3  # mm: smaller displacements count as 0
_SIDES = ("left", 1.0), ("right", -1.0)


def contact_shapes(head: Head, sculpted: Sequence[Array]) -> Iterator[tuple[int, Array]]:
    """Yield shapes by index with the displacement (N1, 3) of the skin; `sculpted` (N0, 3) are all 52."""
    yield from _shut_lids(head)
    for shape, field in _lips(head, sculpted):
        yield shape, head.skin.matrix @ _without_small(field)


def _shut_lids(head: Head) -> Iterator[tuple[int, Array]]:
    solver = FaceSolver(head)
    rest = solver.solve(NEUTRAL).skin.astype(np.float64)
    for side, _ in _SIDES:
        values = NEUTRAL.copy()
        values[PARAMETER[f"orbicularis_oculi_palpebralis.{side}"]] = 1.0
        yield INDEX[f"eyeBlink{side.title()}"], _without_small(solver.solve(values).skin - rest)


def _lips(head: Head, sculpted: Sequence[Array]) -> Iterator[tuple[int, Array]]:
    """Yield the lips' shapes by index, with the displacement (N0, 3) of the level-0 skin."""
    mouth = Mouth.of(head)
    rest = mouth.matrix @ head.rest
    handles = Handles(mouth.line, plate_compliance(head.quads, mouth.matrix, nearby(head.rest, rest)))

    def brought_together(way: Array) -> Array:
        field = np.zeros((len(head.rest), 4))
        handles.move(field, np.pad(-way, ((0, 0), (0, 1))))
        return field[:, :3]

    opened = mouth.line @ (mouth.matrix @ sculpted[INDEX["jawOpen"]])
    yield INDEX["mouthClose"], brought_together(opened)
    aside = (0.5 * np.abs(mouth.line) @ rest)[:, 0]
    aside /= np.abs(aside).max()
    wide = np.minimum(opened[:, 1] / (CORNER * opened[:, 1].max()), 1.0)
    for side, sign in _SIDES:
        shape = INDEX[f"mouthPress{side.title()}"]
        way = np.zeros_like(opened)
        way[:, 1] = PRESSED * wide * np.clip((sign * aside + BEYOND) / (WHOLE + BEYOND), 0.0, 1.0)
        yield shape, sculpted[shape] + brought_together(way)


def _without_small(field: Array) -> Array:
    field[np.abs(field).max(axis=1) < SMALLEST] = 0.0
    return field
