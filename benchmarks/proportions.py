"""The proportions of a head at rest beside those of scanned people.

Run from the repository's root: `python benchmarks/proportions.py [HEAD[@AGE] …]`. Printed are mm on the head,
and what is expected on a face of the standard head's size (57.8 mm between the eyes): means of scanned
people. Only the standard head, which is nobody, is held to them.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping

import numpy as np

from risorius.core.arrays import Array
from risorius.face.head.head import Head, load_head
from risorius.looks.anatomy import Anatomy, find_anatomy
from risorius.looks.brows import brow_line
from risorius.looks.scalp import inside_hairline

EARS = 0.5  # a vertex whose mask is higher is the ear's
MIDDLE = 1.5  # mm from the midline
NEAR = 8.0  # mm from the hairline
JAW, CORNERS, NOSE_BASE, LIPS, CHIN = slice(0, 17), (48, 54), 33, (62, 66), 8


class Rest:
    """A head at rest: its skin (N1, 3), its 68 points and the places of its features."""

    def __init__(self, head: Head) -> None:
        self.anatomy: Anatomy = find_anatomy(head)
        self.skin = self.anatomy.skin
        self.points: Array = head.landmarks(self.skin)
        self.eyes: Array = head.eye_centre

    @property
    def mouth(self) -> float:
        """The height in mm at which the lips meet."""
        return float(self.points[list(LIPS), 1].mean())

    def face_width(self, height: float) -> float:
        """Return the distance of the face's two outlines, as seen from the front, at a height in mm."""
        outline = self.points[JAW]
        sides = (outline[:9], outline[8:])
        ends = [np.interp(height, *side[np.argsort(side[:, 1])][:, [1, 0]].T) for side in sides]
        return float(ends[1] - ends[0])

    def brow(self, end: float) -> tuple[float, float]:
        """Return where the drawn brow is at its head (0) or tail (1): mm from the midline, over the eyes."""
        x, y, _ = brow_line(self.anatomy, np.array([end]))
        return float(x[0]), float(y[0] - self.anatomy.eye_height)

    def hairline(self) -> float:
        """Return the height in mm over the eyes of the hairline above the pupil."""
        front = self.skin[(np.abs(self.skin[:, 0] - self.eyes[0, 0]) < 4.0) & (self.skin[:, 2] > 0.0)]
        inside = inside_hairline(self.anatomy, front)
        near = np.abs(inside) < NEAR
        return float((front[near, 1] - inside[near]).mean() - self.anatomy.eye_height)

    def depth(self) -> float:
        """Return the way in mm from the glabella straight back to the occiput."""
        middle = self.skin[np.abs(self.skin[:, 0]) < MIDDLE]
        over = middle[:, 1] - self.anatomy.eye_height
        glabella = middle[(over > 8.0) & (over < 25.0)][:, 2].max()
        return float(glabella - middle[over > -45.0][:, 2].min())

    def ear(self) -> float:
        """Return the height of the ear in mm."""
        return float(np.ptp(self.skin[self.anatomy.masks["ears"] > EARS, 1]))


MEASURES: Mapping[str, tuple[Callable[[Rest], float], str]] = {
    "face width at mouth level": (lambda r: r.face_width(r.mouth), "109.5"),
    "face width at mid chin": (lambda r: r.face_width(0.5 * (r.mouth + r.points[CHIN, 1])), "87.5"),
    "face width at the nose's base": (lambda r: r.face_width(r.points[NOSE_BASE, 1]), "118"),
    "mouth width": (lambda r: float(np.ptp(r.points[list(CORNERS), 0])), "45 to 47.6"),
    "inner brow over the eyes, as drawn": (lambda r: r.brow(0.0)[1], "18 or more"),
    "inner brow over the eyes, point 22": (
        lambda r: float(r.points[22, 1] - r.eyes[:, 1].mean()),
        "18 or more",
    ),
    "brow's tail from the midline, as drawn": (lambda r: r.brow(1.0)[0], "48 to 52"),
    "brow's tail from the midline, point 26": (lambda r: float(r.points[26, 0]), "48 to 52"),
    "hairline over the pupil": (Rest.hairline, "62"),
    "glabella to occiput": (Rest.depth, "174"),
    "ear length": (Rest.ear, "50 to 52"),
}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*", default=["standard"], metavar="HEAD[@AGE]")
    for head in parser.parse_args().heads:
        name, _, age = head.partition("@")
        rest = Rest(load_head(name, age=float(age) if age else None))
        print(f"{head:40s} {'mm':>6s}  expected")
        for what, (measure, expected) in MEASURES.items():
            print(f"{what:40s} {measure(rest):6.1f}  {expected}")


if __name__ == "__main__":
    main()
