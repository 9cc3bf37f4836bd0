"""The ARKit shapes of which a head's own contact is a part: closed lids, and lips that come together.

Sculpted shapes move surfaces past each other or leave them apart, each head's a little differently. Weights
that shut an eye or a mouth need shapes that do exactly that. So `eyeBlink` is the face's own closed lid.
`mouthClose` brings together what `jawOpen` opens, as our own lips close: both lips move, and nothing else
does. `mouthPucker` opens and overlaps them half as much as its sculpt. Others close a part of the mouth
besides what their sculpt does, because our lips close from the corners: `mouthPress` its side, most near the
corner, and `mouthShrugUpper` the corners. `mouthRollLower` also draws the lower lip under the upper teeth, as
ours does at /f/ and /v/.
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
PUCKERED = 0.5  # share of what the sculpted `mouthPucker` opens and overlaps that is undone
CORNERS = 4.0  # mm that `mouthShrugUpper` closes at the corners
BEYOND, WHOLE = (
    0.15,
    0.75,
)  # shares of half a mouth: so far over the middle a press reaches; there it is whole
# Places by how far the jaw opens them, as shares of its widest opening: a press is whole from the first on
# and less towards the corner, which lies below the second.
CORNER, AT_CORNER = 0.4, 0.15
TUCK_OPENING = 0.1  # of the jaw, at which the lower lip is drawn under the teeth
SMALLEST = 1e-3  # mm: smaller displacements count as 0


def contact_shapes(head: Head, sculpted: Sequence[Array]) -> Iterator[tuple[int, Array]]:
    """Yield shapes by index with the displacement (N1, 3) of the skin; `sculpted` (N0, 3) are all 52."""
    solver = FaceSolver(head)
    yield from _shut_lids(solver)
    for shape, field in _lips(head, sculpted):
        yield shape, head.skin.matrix @ _without_small(field)
    roll = INDEX["mouthRollLower"]
    yield roll, head.skin.matrix @ sculpted[roll] + _tuck(solver)


def _shut_lids(solver: FaceSolver) -> Iterator[tuple[int, Array]]:
    rest = _skin(solver)
    for side in ("left", "right"):
        shut = _skin(solver, **{f"orbicularis_oculi_palpebralis.{side}": 1.0})
        yield INDEX[f"eyeBlink{side.title()}"], _without_small(shut - rest)


def _tuck(solver: FaceSolver) -> Array:
    """Return the displacement (N1, 3) of the skin by a lower lip that is drawn under the upper teeth."""
    opened = _skin(solver, masseter=TUCK_OPENING)
    return _without_small(_skin(solver, masseter=TUCK_OPENING, lip_tuck=1.0) - opened)


def _skin(solver: FaceSolver, **values: float) -> Array:
    """Return the level-1 skin (N1, 3) mm with some parameters not at rest."""
    row = NEUTRAL.copy()
    row[[PARAMETER[name] for name in values]] = list(values.values())
    return solver.solve(row).skin.astype(np.float64)


def _lips(head: Head, sculpted: Sequence[Array]) -> Iterator[tuple[int, Array]]:
    """Yield the lips' shapes by index, with the displacement (N0, 3) of the level-0 skin."""
    mouth = Mouth.of(head)
    rest = mouth.matrix @ head.rest
    handles = Handles(mouth.line, plate_compliance(head.quads, mouth.matrix, nearby(head.rest, rest)))

    def brought_together(way: Array) -> Array:
        field = np.zeros((len(head.rest), 4))
        handles.move(field, np.pad(-way, ((0, 0), (0, 1))))
        return field[:, :3]

    def and_together(name: str, gap: Array) -> tuple[int, Array]:
        way = np.zeros((len(gap), 3))
        way[:, 1] = gap
        return INDEX[name], sculpted[INDEX[name]] + brought_together(way)

    def opened_by(name: str) -> Array:
        return np.asarray(mouth.line @ (mouth.matrix @ sculpted[INDEX[name]]))

    opened = opened_by("jawOpen")
    yield INDEX["mouthClose"], brought_together(opened)
    yield and_together("mouthPucker", PUCKERED * opened_by("mouthPucker")[:, 1])
    open_by = opened[:, 1] / opened[:, 1].max()
    wide = np.minimum(open_by / CORNER, 1.0)
    for side, share in zip(("Left", "Right"), _sides(0.5 * np.abs(mouth.line) @ rest[:, 0]), strict=True):
        yield and_together(f"mouthPress{side}", PRESSED * wide * share)
    yield and_together("mouthShrugUpper", CORNERS * (np.minimum(open_by / AT_CORNER, 1.0) - wide))


def _sides(x: Array) -> Iterator[Array]:
    """Yield the shares (n,) by which places at `x` (n,) mm belong to the left, and to the right side."""
    aside = x / np.abs(x).max()
    for sign in (1.0, -1.0):
        yield np.clip((sign * aside + BEYOND) / (WHOLE + BEYOND), 0.0, 1.0)


def _without_small(field: Array) -> Array:
    field[np.abs(field).max(axis=1) < SMALLEST] = 0.0
    return field
