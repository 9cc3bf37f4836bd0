"""The face's motion beside that of scanned people, unit by unit.

Run from the repository's root: `python benchmarks/scan_motion.py FOLDER [--head NAME[@AGE]]`. FOLDER holds
`points.csv` (point, region, x, y, z, nx, ny, nz, v0, v1, v2, w0, w1, w2: mm on the standard head, the outward
normal, vertices and weights of the skin at level 1) and `motion.csv` (point, shape, dx, dy, dz: mm by which a
shape of scanned people moves a point). They are not part of Risorius.

Printed for each unit: the greatest displacement of scans and of ours in mm; *peak*, ours by theirs; *cosine*
of the whole fields; *error* |ours − scans| / |scans|, 0 the same and 1 as bad as not moving. Targets (issue:
scanned expressions): median error at most .45, median cosine at least .90, peak within .8 to 1.25 in 20 of 22
units, the skin of the cheek at least 3 mm out of the face in AU6 with AU12.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from risorius.core.arrays import AnyArray
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.rules.poses import pose_values

# Unit → shapes of the scans, whose sum it is beside.
UNITS: Mapping[str, tuple[str, ...]] = {
    "AU1": ("browInnerUp",),
    "AU2": ("browOuterUp",),
    "AU1+AU2": ("browInnerUp", "browOuterUp"),
    "AU4": ("browDown",),
    "AU5": ("eyeWide",),
    "AU6": ("cheekSquint",),
    "AU7": ("eyeSquint",),
    "AU9": ("noseSneer",),
    "AU10": ("mouthUpperUp",),
    "AU12": ("mouthSmile",),
    "AU6+AU12": ("mouthSmile", "cheekSquint"),
    "AU14": ("mouthDimple",),
    "AU15": ("mouthFrown",),
    "AU16": ("mouthLowerDown",),
    "AU17": ("mouthShrugLower",),
    "AU18": ("mouthPucker",),
    "AU20": ("mouthStretch",),
    "AU22": ("mouthFunnel",),
    "AU24": ("mouthPress",),
    "AU28": ("mouthRollLower", "mouthRollUpper"),
    "AU45": ("eyeBlink",),
    "masseter": ("jawOpen",),
}
CHEEK = "infraorbital"
PEAK = (0.8, 1.25)


@dataclass(frozen=True, slots=True)
class Points:
    """Points of the skin: names, regions, `normals` (k, 3), and what carries them: `triangles`, `weights`."""

    names: list[str]
    regions: list[str]
    normals: AnyArray
    triangles: AnyArray
    weights: AnyArray

    @classmethod
    def read(cls, folder: Path) -> Points:
        """Read the points in `folder`."""
        rows = _rows(folder / "points.csv")

        def columns(*names: str) -> AnyArray:
            return np.array([[float(row[name]) for name in names] for row in rows])

        return cls(
            [row["point"] for row in rows],
            [row["region"] for row in rows],
            columns("nx", "ny", "nz"),
            columns("v0", "v1", "v2").astype(int),
            columns("w0", "w1", "w2"),
        )

    def on(self, skin: AnyArray) -> AnyArray:
        """Return the places (k, 3) of the points on a `skin` (N1, 3)."""
        return np.asarray(np.einsum("kcd,kc->kd", skin[self.triangles], self.weights))

    def out(self, motion: AnyArray, region: str) -> float:
        """Return the mean mm by which a region moves out of the skin in `motion` (k, 3)."""
        inside = np.array([name == region for name in self.regions])
        return float((motion * self.normals).sum(axis=1)[inside].mean())


def scans(folder: Path, points: Points) -> dict[str, AnyArray]:
    """Return the displacement (k, 3) mm of the points by each shape of the scans."""
    index = {name: k for k, name in enumerate(points.names)}
    shapes: dict[str, AnyArray] = {}
    for row in _rows(folder / "motion.csv"):
        field = shapes.setdefault(row["shape"], np.zeros((len(index), 3)))
        field[index[row["point"]]] = [float(row[axis]) for axis in ("dx", "dy", "dz")]
    return shapes


def ours(head: str, points: Points) -> dict[str, AnyArray]:
    """Return the displacement (k, 3) mm of the points by each unit on a head, `NAME` or `NAME@AGE`."""
    name, _, age = head.partition("@")
    solver = FaceSolver(load_head(name, age=float(age)) if age else load_head(name))

    def posed(unit: str) -> AnyArray:
        values = pose_values(dict.fromkeys(unit.split("+"), 1.0) if unit else {}, {})
        return points.on(solver.solve(values).skin.astype(np.float64))

    rest = posed("")
    return {unit: posed(unit) - rest for unit in UNITS}


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def main() -> None:
    """Print the table, the worst unit first."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--head", default="standard", metavar="NAME[@AGE]")
    options = parser.parse_args()
    points = Points.read(options.folder)
    shapes, motions = scans(options.folder, points), ours(options.head, points)
    rows = []
    for unit, motion in motions.items():
        scan = np.sum([shapes[name] for name in UNITS[unit]], axis=0)
        lengths = [float(np.linalg.norm(field)) for field in (scan, motion)]
        greatest = [float(np.linalg.norm(field, axis=1).max()) for field in (scan, motion)]
        cosine = float((scan * motion).sum()) / max(lengths[0] * lengths[1], 1e-9)
        error = float(np.linalg.norm(motion - scan)) / lengths[0]
        rows.append((error, unit, *greatest, greatest[1] / greatest[0], cosine))
    print(f"{'':10s} {'scans':>6s} {'ours':>6s} {'peak':>6s} {'cosine':>6s} {'error':>6s}")
    for error, unit, theirs, own, peak, cosine in sorted(rows, reverse=True):
        print(f"{unit:10s} {theirs:6.1f} {own:6.1f} {peak:6.2f} {cosine:6.2f} {error:6.2f}")
    within = sum(PEAK[0] <= row[4] <= PEAK[1] for row in rows)
    print(f"median error {np.median([row[0] for row in rows]):.2f} (at most 0.45)")
    print(f"median cosine {np.median([row[5] for row in rows]):.2f} (at least 0.90)")
    print(f"peak within {PEAK[0]} to {PEAK[1]}: {within} of {len(rows)} (at least 20)")
    print(
        f"cheek out of the skin in AU6+AU12: {points.out(motions['AU6+AU12'], CHEEK):.1f} mm (at least 3.0)"
    )


if __name__ == "__main__":
    main()
