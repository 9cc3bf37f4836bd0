"""Draw the standard head in a few shapes that sliders give it into `docs/pictures/sliders.png`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from risorius.core.parameters import NEUTRAL
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.render.software_renderer import SoftwareRenderer

TARGET = Path(__file__).parent / "pictures" / "sliders.png"
SIZE, CAPTION = 320, 16
SHAPES: tuple[dict[str, float], ...] = (
    {},
    {"fullness": 1.0, "nose_width": 1.0},
    {"face_length": 1.0, "cheekbones": 1.0, "nose_hump": 1.0},
    {"face_width": 1.0, "jaw_width": 1.0, "ear_wing": 1.0},
)


def cell(shape: dict[str, float]) -> Image.Image:
    """Return the head in one shape, under the sliders that make it."""
    head = load_head(shape=shape)
    face = Image.new("RGB", (SIZE, SIZE + CAPTION), "white")
    picture = SoftwareRenderer(head_model(head), (SIZE, SIZE)).render(FaceSolver(head).solve(NEUTRAL))
    face.paste(Image.fromarray(np.asarray(picture)), (0, CAPTION))
    named = ", ".join(f"{name} {amount:g}" for name, amount in shape.items()) or "as it is"
    ImageDraw.Draw(face).text((4, 2), named, fill="black")
    return face


def main() -> None:
    """Write the sheet."""
    cells = [np.asarray(cell(shape)) for shape in SHAPES]
    Image.fromarray(np.hstack(cells)).quantize(200).save(TARGET, optimize=True)


if __name__ == "__main__":
    main()
