"""Do the lips close where ours do on the mesh that ARKit weights move? Heads, emotions and sentences.

The weights of `.arkit.csv` and the shapes of `.rig.glb`, at 30 fps. Run from the repository (2 s a sentence):
    PYTHONPATH=src OMP_NUM_THREADS=1 python benchmarks/seals.py [--sentences 60] [--heads ...] [--before]

Gaps are taken at 19 places from corner to corner, minus the gap there at rest; a frame is sealed where our
own face's gap is nowhere over 0.05 mm. Columns: sealed frames; the share of them with the whole mouth within
bounds (gap at most 0.2 mm, overlap 0.3); the widest gap and the deepest overlap in them; of all frames, the
share that is nowhere more than 0.2 mm wider than our face, and by how many mm the widest is; the
opening between the lips beside ours, correlation and depth; how far the lower lip's edge is from ours in
frames of /f v/, root mean square in mm; the widest gap of lids that are shut on our face; root mean squares
in mm between the skins over all, outside the lips, and at worst in a sealed frame; and the largest second
difference of a weight. `--before` puts beside each row what least squares over the sculpted shapes do.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from itertools import islice
from pathlib import Path

import numpy as np

import risorius
from risorius.core.arrays import Array
from risorius.core.parameters import INDEX
from risorius.face.fit import shapes
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.face.fit.contact_limits import ContactLimits
from risorius.face.fit.contact_shapes import contact_shapes
from risorius.face.fit.lid_limits import lid_vertices
from risorius.face.fit.mouth_gap import MouthGap
from risorius.face.frame import FaceFrame
from risorius.face.head.head import Head, load_head, shipped_heads
from risorius.machine.blas import one_thread

SENTENCES = Path(__file__).with_name("lips_sentences.txt").read_text().splitlines()
DISPLAYS = ("none", "happiness", "sadness", "anger", "fear", "disgust", "surprise")
STRENGTH = 0.8
SEALED, WIDEST, DEEPEST = 0.05, 0.2, 0.3  # mm
TUCKED, SHUT = 0.9, 0.1  # of `lip_tuck`; mm between lids
MIDDLE = 9  # of the 19 places
HEADER = (
    "head      emotion    sealed  within  gap  overlap | every  over |    r  depth | /f v/  lids |"
    "  rms outside sealed |   d2"
)


@dataclass(slots=True)
class Found:
    """Measures of the weights of some sentences, by sentence or by frame."""

    own: list[Array] = field(default_factory=list)
    gap: list[Array] = field(default_factory=list)
    tuck: list[float] = field(default_factory=list)
    lids: list[float] = field(default_factory=list)
    squares: list[tuple[float, float]] = field(default_factory=list)
    bend: float = 0.0

    def row(self) -> str:
        """Return the columns as the header names them."""
        own, gap = np.array(self.own), np.array(self.gap)
        sealed = own.max(axis=1) <= SEALED
        shut = gap[sealed]
        within = (shut.max(axis=1) <= WIDEST) & (shut.min(axis=1) >= -DEEPEST)
        over = (gap - np.maximum(own, 0.0)).max(axis=1)
        here, there = np.maximum(own[:, MIDDLE], 0.0), np.maximum(gap[:, MIDDLE], 0.0)
        skin, outside = np.sqrt(np.mean(self.squares, axis=0))
        worst = np.sqrt(np.array(self.squares)[sealed, 0].max(initial=0.0))
        return (
            f"{sealed.sum():6d} {100 * within.mean():6.1f}% {shut.max():5.2f} {-shut.min():6.2f}  |"
            f"{100 * np.mean(over <= WIDEST):5.1f}% {over.max():5.2f} |{np.corrcoef(here, there)[0, 1]:6.3f}"
            f"{here @ there / (here @ here):6.3f} |{np.sqrt(np.mean(np.square(self.tuck or [0.0]))):6.2f}"
            f"{max(self.lids, default=0.0):6.2f} |{skin:5.2f} {outside:6.2f} {worst:6.2f}  |{self.bend:5.2f}"
        )


class Measured:
    """One head's fit, measured on its mesh."""

    def __init__(self, head: Head, *, before: bool = False) -> None:
        self._before = before
        with _sculpted(before):
            self._fit = ArkitFit(head)
        self._gap = MouthGap.of(head)
        self._lids = np.concatenate(lid_vertices(head, self._fit.rest))
        self._outside = (head.skin.matrix @ head.masks["lips"])[self._fit.counted] < 0.5
        self._lower = np.where(self._gap.share < 0.0, -self._gap.share, 0.0)

    def add(self, frames: Sequence[FaceFrame], found: Found) -> None:
        """Add what the weights of some frames do."""
        with _sculpted(self._before):
            weights = self._fit.track(frames).weights
        if len(weights) > 2:
            found.bend = max(found.bend, float(np.abs(np.diff(weights, 2, axis=0)).max()))
        for frame, row in zip(frames, weights, strict=True):
            self._add_frame(frame, self._fit.skin(row), row, found)

    def _add_frame(self, frame: FaceFrame, skin: Array, weights: Array, found: Found) -> None:
        own = frame.skin.astype(np.float64)
        found.own.append(self._gap(own))
        found.gap.append(self._gap(skin))
        if frame.parameters[INDEX["lip_tuck"]] >= TUCKED:
            way = (self._lower[..., None] * (self._gap.corners(skin) - self._gap.corners(own))).sum(axis=1)
            found.tuck.append(float(np.sqrt((way[5:14, 1:] ** 2).sum(axis=1).mean())))
        apart = self._between_lids(own)
        if apart.max() < SHUT:
            found.lids.append(float(self._between_lids(skin).max()))
        left = self._fit.displacement(own) - self._fit.visible_displacement(weights)
        squares = (left.reshape(-1, 3) ** 2).sum(axis=1)
        found.squares.append((float(squares.mean()), float(squares[self._outside].mean())))

    def _between_lids(self, skin: Array) -> Array:
        return np.asarray(skin[self._lids[:, 0], 1] - skin[self._lids[:, 1], 1])


@contextmanager
def _sculpted(before: bool) -> Iterator[None]:
    """Fit by least squares over the sculpted shapes, closed lids apart, if `before`."""
    if not before:
        yield
        return
    keep = ContactLimits.keep
    try:
        shapes.contact_shapes = lambda head, fields: islice(contact_shapes(head, fields), 2)
        ContactLimits.keep = lambda *_: None  # type: ignore[method-assign]
        yield
    finally:
        shapes.contact_shapes, ContactLimits.keep = contact_shapes, keep  # type: ignore[method-assign]


@lru_cache(maxsize=2)
def measured(name: str, *, before: bool) -> Measured:
    """Return a head's fit."""
    return Measured(load_head(name), before=before)


@one_thread()
def main() -> None:
    """Print a row for each head and emotion, and one for all."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sentences", type=int, default=len(SENTENCES))
    parser.add_argument("--first", type=int, default=0, help="sentence")
    parser.add_argument("--heads", nargs="+", default=shipped_heads())
    parser.add_argument("--emotions", nargs="+", choices=DISPLAYS, default=DISPLAYS)
    parser.add_argument("--before", action="store_true")
    options = parser.parse_args()
    kinds = (False, True) if options.before else (False,)
    every = {before: Found() for before in kinds}
    print(HEADER)
    for name in options.heads:
        settings = risorius.Settings(dynamics="static", fps=Fraction(30), head=name)
        for emotion in options.emotions:
            here = {before: Found() for before in kinds}
            for text in SENTENCES[options.first :][: options.sentences]:
                display = () if emotion == "none" else {emotion: STRENGTH}
                frames = list(risorius.speak(text, text=True, settings=settings, emotion=display).faces())
                for before in kinds:
                    for found in (here[before], every[before]):
                        measured(name, before=before).add(frames, found)
            for before in kinds:
                label = "   before" if before else f"{name:9s} {emotion}"
                print(f"{label:20s}", here[before].row(), flush=True)
    for before in kinds:
        print(f"{'all, before' if before else 'all':20s}", every[before].row())


if __name__ == "__main__":
    main()
