"""Fit the weights of the anatomical mode to the fields of the standard head, and print how well they do.

Run from the repository's root: `PYTHONPATH=src python tools/fit_anatomy.py`. Writes `anatomy.npz` beside the
standard head's `head.npz`. R² = 1 − Σ|d − d̂|² / Σ|d|², the calibrated field d against the anatomical one.
"""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import Array
from risorius.face.head.anatomy import FILE, Pull, Skin, directions, from_line, influence
from risorius.face.head.head import Head, load_head
from risorius.face.head.muscle_table import NAMES, Muscle, load_muscles

SPACING = 4.5  # mm between places
STIFF = 5e-5  # how much large weights cost
JAW = "masseter"


def field_of(head: Head, base: str) -> Array:
    """Return the calibrated field (N, 3) of the left muscle, or of the only one."""
    field = head.fields.get(f"{base}.left") or head.fields[base]
    whole = np.zeros_like(head.rest)
    whole[field.vertices] = field.displacement
    return whole


def spread(points: Array) -> Array:
    """Return indices of points (n, 4), SPACING apart, each the furthest from those before it."""
    chosen = [0]
    distance = np.linalg.norm(points - points[0], axis=1)
    while distance.max() > SPACING:
        chosen.append(int(distance.argmax()))
        distance = np.minimum(distance, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return np.array(chosen)


def fit(skin: Skin, muscle: Muscle, field: Array) -> Pull:
    """Return the weights whose displacement is nearest to `field` (N, 3)."""
    length = np.linalg.norm(field, axis=1)
    inside = np.flatnonzero((from_line(muscle, skin.rest) < muscle.zone) & (length > 0.01 * length.max()))
    places = skin.places[inside][spread(skin.places[inside])]
    share = influence(skin.places, places)
    ways = directions(muscle, skin.rest, skin.normals)
    forces = np.einsum("nk,ndc->kdnc", share, ways).reshape(-1, *skin.rest.shape)
    moved = np.stack([skin.network.solve(force) for force in forces]).reshape(len(forces), -1)
    gram = moved @ moved.T
    weights = np.linalg.solve(
        gram + STIFF * np.trace(gram) / len(gram) * np.eye(len(gram)), moved @ field.ravel()
    )
    return Pull(places, weights.reshape(len(places), -1))


def main() -> None:
    """Fit all muscles."""
    head = load_head()
    skin = Skin(head.rest, head.quads, head.jaw_weight)
    arrays = {}
    muscles = load_muscles(head.folder)
    for name in NAMES:
        if name == JAW:
            continue
        field = field_of(head, name)
        pull = fit(skin, muscles[name], field)
        arrays[f"{name}/places"] = pull.places.astype(np.float32)
        arrays[f"{name}/weights"] = pull.weights.astype(np.float32)
        left = field - skin.displaced(muscles[name], pull)
        print(f"{name:30s} R² {1.0 - (left**2).sum() / (field**2).sum():.3f}  ({len(pull.places)} places)")
    np.savez_compressed(head.folder / FILE, **arrays)  # type: ignore[arg-type]


if __name__ == "__main__":
    main()
