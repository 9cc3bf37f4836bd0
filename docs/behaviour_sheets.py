"""Draw one sentence by every profile and attitude, and a display beside an emblem.

Writes `profiles.png` and `emblem.png` into `docs/pictures`.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw

from risorius.api import speak
from risorius.rules.emotions import Display
from risorius.settings import Settings
from risorius.take import Take

PICTURES = Path(__file__).parent / "pictures"
SIZE, LABEL = 150, 100
SENTENCE = "She prefers popcorn. I don't know why, but she really likes it very much!"
# Seconds: looking away at the start, an accent, the pause, the shrug, a stressed word, the end.
MOMENTS = (0.35, 0.95, 1.55, 2.2, 3.4, 4.3, 5.0)
SPEAKERS = (
    ("neutral", ()), ("lively", ()), ("reserved", ()), ("authoritative", ()),
    *(("neutral", (name,)) for name in ("polite", "ironic", "persuasive", "submissive")),
)  # fmt: skip
REPORT = "She was very sad about it, but now she laughs."
REPORT_MOMENTS = (0.6, 1.35, 1.5, 1.65, 2.2, 2.9)


def row(take: Take, label: str, moments: Sequence[float]) -> npt.NDArray[np.uint8]:
    """Return a label and the take's pictures at some moments, side by side."""
    indices = [round(t * 30) for t in moments if t < take.duration]
    left = Image.new("RGB", (LABEL, SIZE), "white")
    ImageDraw.Draw(left).text((6, SIZE // 2 - 6), label, fill="black")
    shown = [np.array(p) for p in take.pictures((SIZE, SIZE), indices)]
    return np.hstack([np.array(left), *shown])


def save(rows: Sequence[npt.NDArray[np.uint8]], name: str) -> None:
    """Write rows of pictures, in few colours."""
    Image.fromarray(np.vstack(list(rows))).quantize(256).save(PICTURES / name, optimize=True)


def main() -> None:
    """Write both sheets."""
    rows = []
    for profile, attitudes in SPEAKERS:
        take = speak(SENTENCE, settings=Settings(profile=profile, attitudes=attitudes))
        rows.append(row(take, attitudes[0] if attitudes else profile, MOMENTS))
    save(rows, "profiles.png")
    felt = speak(REPORT, emotion=[Display("sadness", 0.8)], settings=Settings(seed=1))
    referred = speak(REPORT, settings=Settings(seed=1))
    save([row(felt, "display", REPORT_MOMENTS), row(referred, "emblem", REPORT_MOMENTS)], "emblem.png")


if __name__ == "__main__":
    main()
