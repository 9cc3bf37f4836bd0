"""Draw docs/pictures/emotions-ages.webp: six emotions at three ages.

Run from the repository's root: python docs/wrinkle_sheets.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import risorius
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.render.software_renderer import SoftwareRenderer

EMOTIONS = ("surprise", "anger", "disgust", "happiness", "sadness", "fear")
AGES = (25, 45, 70)
SIDE = 544
FACE = (160, 109, 384, 439)  # left, top, right, bottom of what is kept of a picture, in pixels
CAPTION = 18
QUALITY = 88
TARGET = Path(__file__).parent / "pictures" / "emotions-ages.webp"


def draw() -> Image.Image:
    """Return the sheet: a row per age, a column per emotion."""
    head = load_head()
    renderer = SoftwareRenderer(head_model(head), (SIDE, SIDE))
    values = [risorius.pose({}, emotion={name: 1.0}).performance.values[0] for name in EMOTIONS]
    left, top, right, bottom = FACE
    sheet = Image.new("RGB", (len(EMOTIONS) * (right - left), len(AGES) * (bottom - top) + CAPTION), "white")
    for row, age in enumerate(AGES):
        solver = FaceSolver(head, age=float(age))
        for column, face in enumerate(values):
            picture = Image.fromarray(np.asarray(renderer.render(solver.solve(face)))).crop(FACE)
            sheet.paste(picture, (column * (right - left), CAPTION + row * (bottom - top)))
    pen = ImageDraw.Draw(sheet)
    for column, name in enumerate(EMOTIONS):
        pen.text((column * (right - left) + 6, 3), name, fill="black")
    for row, age in enumerate(AGES):
        pen.text((6, CAPTION + row * (bottom - top) + 4), str(age), fill="white")
    return sheet


if __name__ == "__main__":
    TARGET.parent.mkdir(exist_ok=True)
    draw().save(TARGET, quality=QUALITY, method=6)
