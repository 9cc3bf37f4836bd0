"""Draw the heads at rest and smiling into `docs/pictures/heads.webp`, one above at 25, 50 and 75 years into
`heads-ages.webp`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head.head import Head, load_head, shipped_heads
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.render.software_renderer import SoftwareRenderer

PICTURES = Path(__file__).parent / "pictures"
SIZE = 300
SMILE = {"AU6": 0.7, "AU12": 0.75, "AU25": 0.3, "masseter": 0.08}
TURNED = {"head_yaw": 38.0}
AGED = ("standard", "amara", "kenji", "olaf")
AGES = (25.0, 50.0, 75.0)
QUALITY = 88  # with a palette of 256 colours for seven skins, lips look brown


def pictures(head: Head, *poses: dict[str, float]) -> np.ndarray:
    """Return the poses of one head, one below the other."""
    solver = FaceSolver(head, age=head.identity.age)
    renderer = SoftwareRenderer(head_model(head), (SIZE, SIZE), "normal")
    rows = []
    for pose in poses:
        values = np.array(NEUTRAL)
        for name, value in resolve_targets(pose).items():
            values[INDEX[name]] = value
        rows.append(renderer.render(solver.solve(values)))
    return np.vstack(rows)


def save(columns: list[np.ndarray], name: str) -> None:
    """Write columns side by side."""
    Image.fromarray(np.hstack(columns)).save(PICTURES / name, quality=QUALITY, method=6)


def main() -> None:
    """Write both sheets."""
    PICTURES.mkdir(exist_ok=True)
    columns = [pictures(load_head(name), {}, SMILE, TURNED) for name in shipped_heads() if name != "standard"]
    save(columns, "heads.webp")
    aged = [np.vstack([pictures(load_head(name, age=age), {}) for age in AGES]) for name in AGED]
    save(aged, "heads-ages.webp")


if __name__ == "__main__":
    main()
