"""Draw the sliders at -1 and 1 on the standard head into `docs/pictures/sliders.png`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from risorius.core.parameters import NEUTRAL
from risorius.face.head import load_head
from risorius.face.sliders import slider_names
from risorius.face.solve import FaceSolver
from risorius.render.renderer import Renderer

TARGET = Path(__file__).parent / "pictures" / "sliders.png"
SIZE, COLUMNS, CAPTION = 180, 5, 14


def cell(name: str) -> Image.Image:
    """Return a slider at -1 and at 1, side by side under its name."""
    pair = Image.new("RGB", (2 * SIZE, SIZE + CAPTION), "white")
    for k, amount in enumerate((-1.0, 1.0)):
        head = load_head(shape={name: amount})
        renderer = Renderer(head, (SIZE, SIZE), "draft")
        picture = Image.fromarray(np.asarray(renderer.render(FaceSolver(head).solve(NEUTRAL))))
        pair.paste(picture, (k * SIZE, CAPTION))
    ImageDraw.Draw(pair).text((4, 1), name, fill="black")
    return pair


def main() -> None:
    """Write the sheet."""
    names = slider_names()
    rows = -(-len(names) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * 2 * SIZE, rows * (SIZE + CAPTION)), "white")
    for k, name in enumerate(names):
        sheet.paste(cell(name), (k % COLUMNS * 2 * SIZE, k // COLUMNS * (SIZE + CAPTION)))
    sheet.quantize(200).save(TARGET, optimize=True)


if __name__ == "__main__":
    main()
