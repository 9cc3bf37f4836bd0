"""Draw the pictures of `lips.md`: "Julia prefers popcorn" (paper B, figure 1) by our three models, by plain
key poses and by mouth shapes as Rhubarb Lip Sync uses them, as curves and as strips of frames; and the poses
of phones, from the front and the side.

Run from the repository, with the extra `docs` installed: `python docs/lip_figures.py`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from drawing import INK, OURS, PRINTED, SECOND, SOFT, SPEECH, figure
from PIL import Image

from risorius import blend
from risorius.blend.mouth.coarticulation import (
    LIP_MODELS,
    SegmentValues,
    SegmentWeights,
    weighted_averages,
)
from risorius.core.functions import minimum_jerk
from risorius.core.movement import LipSegment
from risorius.core.parameters import NEUTRAL
from risorius.core.score import Score
from risorius.core.speech.utterance import SILENCE, Utterance
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.fit.measure import Gauge
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.pipeline import compose
from risorius.render.camera import Camera
from risorius.render.software_renderer import SoftwareRenderer
from risorius.rules.lips import lip_table
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

Array = npt.NDArray[np.float64]
PICTURES = Path(__file__).parent / "pictures"
SENTENCE, RATE, FPS = "Julia prefers popcorn.", 110, 100
PHONES = ("AA", "IY", "UW", "W", "M", "F", "TH", "S", "SH", "L")
WIDTH, HEIGHT, STRIP = 132, 108, 12
DIMMED = "#8a8f98"
COLOURS = {
    "effort": OURS,
    "dominance": DIMMED,
    "lookahead": SECOND,
    "key poses": SPEECH,
    "mouth shapes": PRINTED,
}
LABELS = {
    "effort": "least effort",
    "dominance": "dominance",
    "lookahead": "look-ahead",
    "key poses": "key poses",
    "mouth shapes": "mouth shapes",
}
# The phone whose pose stands for each of Rhubarb's shapes, and the phones that take it.
SHAPES = {
    "M": "P B M", "S": "T D N S Z TH DH CH JH SH ZH K G NG Y R HH IY IH", "EH": "EH AE AH", "AA": "AA",
    "AO": "AO ER", "UW": "UW UH W", "F": "F V", "L": "L",
}  # fmt: skip
SHAPE_OF = {phone: shape for shape, phones in SHAPES.items() for phone in phones.split()}
TWEEN = 0.06


class Steps:
    """Segments that follow one another by eased steps: no neighbour counts but the next one."""

    reach = 2.0

    def __init__(self, segments: Sequence[LipSegment], start: Array, end: Array) -> None:
        self._segments, self._start, self._end = segments, start, end

    def group(self, parameter: str) -> int:
        """All parameters step together."""
        return 0

    def targets(self, parameter: str) -> Array:
        """Return each segment's own target."""
        return np.array([s.targets.get(parameter, 0.0) for s in self._segments])

    def weights(self, group: int, times: Array) -> SegmentWeights:
        """Return how far each step has been made, less the next one."""
        share = (times - self._start[:, None]) / (self._end - self._start)[:, None]
        steps = np.vstack([np.ones(len(times)), minimum_jerk(np.clip(share, 0.0, 1.0)), np.zeros(len(times))])
        weight = steps[:-1] - steps[1:]
        segment, time = (i.ravel() for i in np.indices(weight.shape))
        return SegmentWeights(segment, time, weight.ravel(), len(times))

    def averages(self, group: int, values: Sequence[SegmentValues], times: Array) -> list[Array]:
        """Return the averages of some values by the weights."""
        return weighted_averages(self, group, values, times)


@LIP_MODELS.register("key poses")
def key_poses(segments: Sequence[LipSegment]) -> Steps:
    """A pose at the middle of each phone, eased from one to the next."""
    middles = np.array([(s.start + s.end) / 2.0 for s in segments])
    return Steps(segments, middles[:-1], middles[1:])


@LIP_MODELS.register("mouth shapes")
def mouth_shapes(segments: Sequence[LipSegment]) -> Steps:
    """A shape held for each phone, with a short tween at its start."""
    starts = np.array([s.start for s in segments[1:]])
    return Steps(segments, starts - TWEEN / 2.0, starts + TWEEN / 2.0)


def simplified(segment: LipSegment) -> LipSegment:
    """Return a segment with the pose of its mouth shape."""
    if segment.phone == SILENCE:
        return segment
    table = lip_table()
    return replace(segment, targets=table.shape(SHAPE_OF[_nearest(segment)]).targets)


def _nearest(segment: LipSegment) -> str:
    """Return a phone, for one half of a diphthong the phone whose part it is."""
    diphthong = lip_table().diphthongs.get(segment.phone)
    if diphthong is None:
        return segment.phone
    ordered = sorted(diphthong.parts, key=lambda part: lip_table().shape(part).targets["jaw_drop"])
    drop = segment.targets["jaw_drop"]
    return min(ordered, key=lambda part: abs(lip_table().shape(part).targets["jaw_drop"] - drop))


class Face:
    """The standard head, measured and photographed about the mouth."""

    def __init__(self) -> None:
        head = load_head()
        self._solver, self._gauge = FaceSolver(head), Gauge(head)
        points = head.landmarks(np.asarray(head.skin.matrix @ head.rest))
        x, y, z = points[[48, 54]].mean(axis=0).tolist()
        front = Camera((x, y, z + 500.0), (x, y - 4.0, z), 9.0)
        side = Camera((x + 430.0, y + 10.0, z + 200.0), (x, y - 4.0, z - 5.0), 9.0)
        size = (WIDTH, HEIGHT)
        model = head_model(head)
        self._front, self._side = (SoftwareRenderer(model, size, camera=camera) for camera in (front, side))

    def measures(self, values: Array) -> Array:
        """Return gap, width and protrusion in mm, shape (n, 3)."""
        found = [self._gauge.measure(self._solver.solve(row)) for row in values]
        return np.array([(m.lip_gap_mm, m.mouth_width_mm, m.lip_protrusion_mm) for m in found])

    def front(self, values: Array) -> Array:
        """Return a picture of the mouth."""
        return self._front.render(self._solver.solve(values)).copy()

    def both(self, values: Array) -> Array:
        """Return a picture from the front above one from the side."""
        frame = self._solver.solve(values)
        return np.vstack([self._front.render(frame), self._side.render(frame)])


def posed(targets: Mapping[str, float]) -> Array:
    """Return the values of all parameters for one segment that lasts, shape (46,)."""
    score = Score(4.0, lips=(LipSegment("x", 0.5, 3.5, dict(targets)),))
    values = NEUTRAL.copy()
    values[:] = blend.at(score, np.array([2.0]), load_lip_rig())[0]
    return values


def spoken() -> tuple[Utterance, Score]:
    """Return the sentence, slowly, and its score without anything random."""
    script = read_script(SENTENCE, text=True)
    utterance = synthesize_script(script, rate=RATE)
    return utterance, compose(script, utterance, (), Settings(lively=False))


def by(model: str, score: Score, times: Array) -> Array:
    """Return all parameters by a model, shape (n, 46)."""
    lips = tuple(simplified(s) for s in score.lips) if model == "mouth shapes" else score.lips
    return blend.at(
        replace(score, lips=lips, settings=replace(score.settings, lips=model)), times, load_lip_rig()
    )


def draw_curves(face: Face, utterance: Utterance, score: Score) -> None:
    """Draw gap, width and protrusion by the models and both others."""
    times = np.arange(0.0, score.duration, 1.0 / FPS)
    with figure(PICTURES / "lips-models.png", 9.0, 5.6) as drawn:
        axes = drawn.subplots(3, 1, sharex=True)
        for model, colour in COLOURS.items():
            found = face.measures(by(model, score, times))
            thick = 2.0 if model in ("effort", "dominance", "lookahead") else 1.1
            for column, axis in enumerate(axes):
                axis.plot(times, found[:, column], color=colour, linewidth=thick, label=LABELS[model])
        titles = ("gap between the lips, mm", "width of the mouth, mm", "protrusion, mm")
        for axis, title in zip(axes, titles, strict=True):
            axis.set_title(title)
            for phone in utterance.phones:
                axis.axvline(phone.start, color=SOFT, linewidth=0.4)
        for phone in utterance.phones:
            where = ((phone.start + phone.end) / 2.0, -0.06)
            axes[0].text(
                *where,
                phone.symbol,
                transform=axes[0].get_xaxis_transform(),
                ha="center",
                va="top",
                color=INK,
                fontsize=7.0,
            )
        axes[0].legend(ncols=3, loc="upper left")


def draw_strips(face: Face, utterance: Utterance, score: Score) -> None:
    """Write the mouth at the middles of the phones, one row for each model."""
    middles = np.array([(p.start + p.end) / 2.0 for p in utterance.phones if p.symbol])
    chosen = middles[np.linspace(0, len(middles) - 1, STRIP).round().astype(int)]
    rows = [np.hstack([face.front(v) for v in by(model, score, chosen)]) for model in COLOURS]
    Image.fromarray(np.vstack(rows)).quantize(256).save(PICTURES / "lips-strip.png", optimize=True)


def draw_phones(face: Face) -> None:
    """Write the poses of phones from the front and the side."""
    tiles = [face.both(posed(lip_table().shape(phone).targets)) for phone in PHONES]
    Image.fromarray(np.hstack(tiles)).quantize(256).save(PICTURES / "lips-phones.png", optimize=True)


def main() -> None:
    """Write all pictures."""
    face = Face()
    utterance, score = spoken()
    draw_curves(face, utterance, score)
    draw_strips(face, utterance, score)
    draw_phones(face)
    print(" ".join(p.symbol for p in utterance.phones if p.symbol))


if __name__ == "__main__":
    main()
