"""Draw the gallery: six heads, six emotions, the styles, and the demonstration as a moving picture.

Run from the repository's root: `PYTHONPATH=src python docs/gallery.py [NAME …]`; all are drawn if none is
named, and written to docs/pictures.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

from risorius.api import pose, speak
from risorius.core.look import FRAMINGS, HAIR_STYLES, LIGHTS, STYLES
from risorius.settings import Look, Settings

Picture = npt.NDArray[np.uint8]

ROOT = Path(__file__).parent.parent
PICTURES = ROOT / "docs" / "pictures"
SIZE = 360
SIX = ("anger", "disgust", "fear", "happiness", "sadness", "surprise")
HEADS = ("amara", "mei", "kenji", "ines", "kwame", "olaf")
SMILE = {"AU6": 0.7, "AU12": 0.75, "AU25": 0.3, "masseter": 0.08}
QUALITY = 88
FILM_SIZE, FILM_RATE, FILM_QUALITY = (480, 480), Fraction(20), 74


def held(targets: dict[str, float], head: str = "standard", **look: object) -> Picture:
    """Return the picture of one face of a head, with a `Look` of the given choices."""
    settings = Settings(size=(SIZE, SIZE), head=head, look=replace(Look(quality="high"), **look))
    return next(pose(targets, settings=settings).pictures()).copy()


def shown(emotion: str, head: str) -> Picture:
    """Return the picture of a head that displays an emotion."""
    settings = Settings(size=(SIZE, SIZE), head=head, look=Look(quality="high"))
    return next(pose({}, emotion={emotion: 0.9}, settings=settings).pictures()).copy()


def sheet(pictures: Sequence[Picture], columns: int, path: Path) -> None:
    """Write pictures of one size side by side."""
    rows = [np.hstack(pictures[k : k + columns]) for k in range(0, len(pictures), columns)]
    Image.fromarray(np.vstack(rows)).save(path, quality=QUALITY, method=6)


def six_heads(path: Path) -> None:
    """The six heads, every other one smiling."""
    sheet([held(SMILE if k % 2 else {}, name) for k, name in enumerate(HEADS)], 3, path)


def six_emotions(path: Path) -> None:
    """The six emotions, one on each head."""
    sheet([shown(name, head) for name, head in zip(SIX, HEADS, strict=True)], 3, path)


def styles(path: Path) -> None:
    """The styles, in a smile with raised brows."""
    sheet([held({**SMILE, "AU1": 0.6, "AU2": 0.4}, style=name) for name in STYLES], 4, path)


def looks(path: Path) -> None:
    """The cuts of hair, then lights and framings."""
    cuts = [held({}, hair=name) for name in HAIR_STYLES if name != "bald"]
    lit = [held({}, "mei", light=name) for name in LIGHTS]
    framed = [held(SMILE, "amara", camera=name) for name in FRAMINGS if name != "portrait"]
    sheet([*cuts, *lit, *framed], 4, path)


def film(path: Path) -> None:
    """Write the demonstration as a moving picture with its overlays, without sound."""
    look = Look(overlay=("caption", "lanes"))
    settings = Settings(size=FILM_SIZE, fps=FILM_RATE, look=look)
    take = speak(str(ROOT / "examples" / "demo.xml"), settings=settings)
    first, *others = _images(take.pictures())
    wait = round(1000 / FILM_RATE)
    first.save(
        path, save_all=True, append_images=others, duration=wait, loop=0, quality=FILM_QUALITY, method=4
    )


def _images(pictures: Iterator[Picture]) -> list[Image.Image]:
    return [Image.fromarray(picture.copy()) for picture in pictures]


DRAWN: dict[str, Callable[[Path], None]] = {
    "six-heads.webp": six_heads,
    "six-emotions.webp": six_emotions,
    "styles.webp": styles,
    "looks.webp": looks,
    "demo.webp": film,
}


def main() -> None:
    """Draw what is named, or all."""
    for name in sys.argv[1:] or DRAWN:
        DRAWN[name](PICTURES / name)
        print(f"{name}: {(PICTURES / name).stat().st_size / 1000:.0f} kB", flush=True)


if __name__ == "__main__":
    main()
