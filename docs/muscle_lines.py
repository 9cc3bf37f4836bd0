"""Draw the muscles' lines of pull on the standard head to docs/pictures/muscle-lines.png.

Run from the repository's root: `PYTHONPATH=src python docs/muscle_lines.py`. On the subject's left the line
from origin (its number) to insertion (dot), coloured by type; on the right the calibrated field at full
contraction, as the paths of the skin's points.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from risorius.core.parameters import MUSCLES
from risorius.face.head.head import Head, load_head

PICTURE = Path(__file__).parent / "pictures" / "muscle-lines.png"
COLOURS = {
    "linear": "#c0392b",
    "sheet": "#2471a3",
    "sphincter": "#229954",
    "rotation": "#7d3c98",
    "bulge": "#d68910",
    "protrusion": "#117a8b",
}
LIGHT = np.array([0.25, 0.35, 0.9])


def draw_skin(axes: plt.Axes, head: Head, view: list[int], towards: np.ndarray) -> None:
    """Draw the shaded skin, seen along `towards`, far faces first."""
    corners = head.rest[head.quads]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    order = np.argsort(corners.mean(axis=1) @ towards)
    order = order[normals[order] @ towards > 0.0]
    shade = 0.62 + 0.36 * np.clip(normals @ (LIGHT / np.linalg.norm(LIGHT)), 0.0, 1.0)
    skin = np.clip(shade[order, None] * [0.98, 0.94, 0.90], 0.0, 1.0)
    faces = corners[order][:, :, view]
    axes.add_collection(PolyCollection(faces, facecolors=skin, edgecolors=skin, lw=0.3))


def numbers() -> dict[str, str]:
    """Return the mark of each row: the muscle's number in paper A, Table 1; "t" for the lip's tuck."""
    return {m.base: f"{m.number:02d}" for m in MUSCLES} | {"lip_tuck": "t"}


def draw_lines(axes: plt.Axes, head: Head, view: list[int]) -> None:
    """Draw each muscle's line of pull with its number at the origin."""
    for name, (row, _) in head.muscles().items():
        origin, insertion = (np.array(point)[view] for point in row.line)
        colour = COLOURS[row.type]
        axes.plot(
            *zip(origin, insertion, strict=True), color=colour, lw=2.2, solid_capstyle="round", zorder=5
        )
        axes.plot(*insertion, "o", color=colour, ms=4, zorder=6)
        axes.plot(*origin, "o", mfc="white", mec=colour, mew=1.5, ms=15, zorder=7)
        axes.annotate(numbers()[name], origin, ha="center", va="center", fontsize=8, color=colour, zorder=8)


def draw_fields(axes: plt.Axes, head: Head) -> None:
    """Draw the paths of the right muscles' fields."""
    for name, (row, _) in head.muscles().items():
        field = head.fields.get(f"{name}.right")
        if field is None:
            continue
        length = np.linalg.norm(field.displacement, axis=1)
        strong = np.flatnonzero(length > 0.35 * length.max())
        start = head.rest[field.vertices[strong]]
        paths = np.stack([start, start + field.displacement[strong]], axis=1)[:, :, :2]
        axes.add_collection(
            LineCollection(list(paths), colors=COLOURS[row.type], lw=0.7, alpha=0.8, zorder=4)
        )


def main() -> None:
    """Draw both views."""
    head = load_head()
    figure, (front, side) = plt.subplots(1, 2, figsize=(18, 9.5), width_ratios=[1.1, 1.0])
    figure.subplots_adjust(left=0.0, right=0.8, wspace=0.02)
    draw_skin(front, head, [0, 1], np.array([0.0, 0.0, 1.0]))
    draw_lines(front, head, [0, 1])
    draw_fields(front, head)
    draw_skin(side, head, [2, 1], np.array([1.0, 0.0, 0.0]))
    draw_lines(side, head, [2, 1])
    front.set(xlim=(-88, 88), ylim=(-118, 75), title="front (lines: subject's left; fields: right)")
    side.set(xlim=(58, -98), ylim=(-118, 75), title="the subject's left side")
    for axes in (front, side):
        axes.set_aspect("equal")
        axes.set_axis_off()
    types = [plt.Line2D([], [], color=colour, lw=3, label=name) for name, colour in COLOURS.items()]
    rows = [
        plt.Line2D(
            [], [], color=COLOURS[row.type], lw=3, label=f"{numbers()[name]}  {name.replace('_', ' ')}"
        )
        for name, (row, _) in head.muscles().items()
    ]
    rows.sort(key=lambda line: str(line.get_label()))
    figure.legend(handles=types, loc="lower center", ncols=6, frameon=False)
    figure.legend(handles=rows, loc="center right", frameon=False, fontsize=10, labelspacing=0.7)
    PICTURE.parent.mkdir(exist_ok=True)
    figure.savefig(PICTURE, dpi=80, bbox_inches="tight")


if __name__ == "__main__":
    main()
