"""The channels below the picture, with their movements over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from ...core.channels import CHANNELS
from ...core.look import Size
from ...core.movement import Movement
from ...core.score import Score
from .ink import BRIGHT, GROUND, INK, SOFT, InkColour, Subject, font

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

_SPAN = 3.0  # seconds shown of a longer performance
_SHARE = 0.24  # of the picture's height, at most
_COLOURS: tuple[InkColour, ...] = (
    (11, 140, 130, 255),
    (209, 73, 91, 255),
    (91, 111, 181, 255),
    (201, 138, 44, 255),
    (122, 92, 160, 255),
    (70, 150, 84, 255),
    (160, 96, 76, 255),
    (96, 128, 148, 255),
)


Box = tuple[float, float, float, float]
"""Left, top, right, bottom, in pixels."""


class LaneBlock(NamedTuple):
    """A movement from `start` to `end` seconds, and its name."""

    start: float
    end: float
    label: str


class Lanes:
    """One lane for each channel that moves, with the movements as blocks and a line for now."""

    def __init__(self, subject: Subject, size: Size) -> None:
        self._times = subject.performance.times
        self._duration = max(subject.performance.duration, 1e-3)
        lanes = lane_blocks(subject.performance.score)
        self._lanes = {name: blocks for name, blocks in lanes.items() if blocks}
        high = round(0.026 * min(size))
        row = min(1.55 * high, _SHARE * size[1] / max(len(self._lanes), 1))
        self._text, self._row = font(max(min(high, int(row / 1.3)), 6)), row
        names = max(map(self._text.getlength, self._lanes), default=0.0)
        self._left = names + 1.1 * self._text.size
        self.below = round(row * len(self._lanes) + 0.6 * row) if self._lanes else 0

    def draw(self, image: Image, height: int, frame: int) -> None:
        """Draw all lanes and where a frame stands in them."""
        from PIL.ImageDraw import Draw

        pen, time = Draw(image, "RGBA"), float(self._times[frame])
        shown = min(self._duration, _SPAN)
        first = min(max(time - 0.5 * shown, 0.0), self._duration - shown)
        left, right = self._left, image.width - 0.6 * self._text.size
        scale = (right - left) / shown
        pen.rectangle((0, height, image.width, image.height), fill=GROUND)
        for k, (name, blocks) in enumerate(self._lanes.items()):
            y = height + (k + 0.3) * self._row
            pen.text((0.5 * self._text.size, y), name, font=self._text, fill=SOFT)
            colour = _COLOURS[CHANNELS.names().index(name) % len(_COLOURS)]
            spans = [(left + (b.start - first) * scale, left + (b.end - first) * scale) for b in blocks]
            boxes = [(max(x, left), y, min(end, right), y + 0.82 * self._row) for x, end in spans]
            for box in boxes:
                self._block(pen, box, colour)
            for box, free, block in zip(boxes, _uncovered(boxes), blocks, strict=True):
                if self._text.getlength(block.label) + 6.0 < free:
                    middle = 0.5 * (box[1] + box[3])
                    pen.text((box[0] + 4.0, middle), block.label, font=self._text, fill=INK, anchor="lm")
        now = left + (time - first) * scale
        pen.line((now, height, now, image.height), fill=BRIGHT, width=2)

    def _block(self, pen: ImageDraw, box: Box, colour: InkColour) -> None:
        if box[2] - box[0] < 1.0:
            return
        radius = 0.2 * self._row
        # PIL raises ValueError for some boxes that are hardly wider than their corners.
        room = min(box[2] - box[0], box[3] - box[1]) >= 2.0 * radius + 4.0
        pen.rounded_rectangle(box, radius=radius if room else 0.0, fill=colour, outline=GROUND)


def _uncovered(boxes: Sequence[Box]) -> list[float]:
    """Return how far each box can be seen from its left edge: those after it are drawn over it."""
    return [
        min([box[2], *(later[0] for later in boxes[k + 1 :] if later[0] < box[2] and box[0] < later[2])])
        - box[0]
        for k, box in enumerate(boxes)
    ]


def _name(movement: Movement) -> str:
    return movement.cause.trigger or movement.cause.rule or movement.label


def lane_blocks(score: Score) -> dict[str, list[LaneBlock]]:
    """Return the blocks of each channel, in the channels' order; segments of the lips are named by phone."""
    blocks: dict[str, list[LaneBlock]] = {name: [] for name in CHANNELS}
    for movement in score.movements:
        blocks[movement.channel].append(LaneBlock(movement.start, movement.end, _name(movement)))
    for segment in score.lips:
        if segment.phone:
            blocks["lips"].append(LaneBlock(segment.start, segment.end, segment.phone))
    for curve in score.manual:
        times = [time for keys in curve.keys.values() for time, _ in keys]
        if times:
            blocks["manual"].append(
                LaneBlock(min(times), max(max(times), min(times) + 0.01), "drawn by hand")
            )
    return blocks
