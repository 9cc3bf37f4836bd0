"""The places of a head's features, measured on its shape, so that colours and hairs fit any head."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

from ..core.arrays import Array, FloatArray
from ..face.head.head import Head


@dataclass(frozen=True, slots=True, eq=False)
class Anatomy:
    """Places at rest in mm: `skin` (N1, 3), its `masks` (N1,) 0..1 by name, and features of the face.

    `unit` is the scale of the face: half the distance between the eyes, divided by 28.9 mm. Distances in this
    package are written for a head of unit 1.
    """

    skin: Array
    masks: dict[str, Array]
    unit: float
    eye_height: float
    nose_tip: Array
    mouth: Array
    mouth_half_width: float
    top: float
    chin: float

    def measures(self) -> tuple[npt.ArrayLike, ...]:
        """Return all values in one order, as a key for results computed from them."""
        names = sorted(self.masks)
        masks = [self.masks[name] for name in names]
        values = (getattr(self, field.name) for field in fields(self) if field.name != "masks")
        return *values, np.array(names), *masks

    def sphere(self) -> tuple[Array, float]:
        """Return centre (3,) and radius in mm of the sphere within which the head casts shadows."""
        middle = 0.5 * (self.top + self.chin)
        centre = np.array([0.0, middle - 25.0 * self.unit, -45.0 * self.unit])
        return centre, 0.5 * (self.top - self.chin) + 62.0 * self.unit


def find_anatomy(head: Head) -> Anatomy:
    """Measure a head at rest."""
    matrix = head.skin.matrix
    skin = np.asarray(matrix @ head.rest)
    masks = {name: np.clip(matrix @ mask, 0.0, 1.0) for name, mask in head.masks.items()}
    eyes = head.eye_centre
    lips = head.rest[head.lip_pairs].reshape(-1, 3)
    mouth = np.array([0.0, lips[:, 1].mean(), lips[:, 2].max()])
    middle = np.abs(skin[:, 0]) < 3.0
    between = middle & (skin[:, 1] > mouth[1] + 8.0) & (skin[:, 1] < eyes[:, 1].mean())
    nose = skin[between][np.argmax(skin[between, 2])]
    # The chest may stand further forward than the chin. The chin lies below the mouth by at most three
    # quarters of the distance between eyes and mouth.
    lowest = mouth[1] - 0.75 * (eyes[:, 1].mean() - mouth[1])
    below = middle & (skin[:, 1] < mouth[1] - 12.0) & (skin[:, 1] > lowest) & (skin[:, 2] > 0.0)
    return Anatomy(
        skin=skin,
        masks=masks,
        unit=float(eyes[0, 0] - eyes[1, 0]) / 57.8,
        eye_height=float(eyes[:, 1].mean()),
        nose_tip=nose,
        mouth=mouth,
        mouth_half_width=float(np.abs(lips[:, 0]).max()),
        top=float(skin[:, 1].max()),
        chin=float(skin[below, 1].min()),
    )


def smoothstep(low: float, high: float, x: FloatArray) -> Array:
    """Return 0 up to `low`, 1 from `high` on, and a smooth curve in between."""
    t = np.clip((np.asarray(x, np.float64) - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
