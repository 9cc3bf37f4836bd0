"""The muscles or the mesh that diagrams show on the skin, frame by frame."""

from __future__ import annotations

from copy import copy

import numpy as np

from ..core.arrays import Array, Float32Array
from ..core.parameters import NEUTRAL
from ..face.head.head import Head
from ..looks.muscle_paint import MusclePaint, colours, place_muscles
from ..looks.wireframe import edge_strengths
from .inputs import Paint

_NO_LINES, _LINES = (0.0, 0.0, 0.0, 0.0), (0.75, 1.15, 1.5, 0.9)  # linear colour and opacity


class DiagramPaint:
    """The paint on the skin in the styles of diagrams; `paint` is that of the last `update`."""

    def __init__(self, head: Head, triangles: int, style: str) -> None:
        """Prepare for a scene of `triangles` triangles; `style` is clay, muscles or wireframe."""
        self._muscles = place_muscles(head, triangles) if style == "muscles" else _no_muscles(triangles)
        edges: Float32Array = np.zeros((triangles, 3), np.float32)
        ink = np.array(_NO_LINES, np.float32)
        if style == "wireframe":
            edges, ink = edge_strengths(head, triangles), np.array(_LINES, np.float32)
        count = len(self._muscles.columns)
        still = np.zeros((count, 4), np.float32)
        self.paint = Paint(self._muscles.covered, self._muscles.place, still, edges, ink)

    def clone(self) -> DiagramPaint:
        """Return a copy that another thread can update at the same time."""
        other = copy(self)
        other.paint = self.paint._replace(colours=self.paint.colours.copy())
        return other

    def update(self, parameters: Array, suppression: Array | None = None) -> None:
        """Colour the muscles by their activations (46,) and by how much rivals suppress them (46,)."""
        hot = np.zeros(len(NEUTRAL)) if suppression is None else suppression
        self.paint.colours[:] = colours(self._muscles, parameters, hot)


def _no_muscles(triangles: int) -> MusclePaint:
    place: Float32Array = np.zeros((1, 1, 2), np.float32)
    return MusclePaint(np.zeros(triangles, np.int64), place, np.zeros(0, np.intp))
