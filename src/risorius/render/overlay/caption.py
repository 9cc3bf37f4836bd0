"""The spoken words, with the current one bright."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from ...core.look import Size
from ...core.speech.utterance import Word
from ...core.speech.written_words import written_words
from .ink import BRIGHT, INK, PANEL, Subject, font

if TYPE_CHECKING:
    from PIL.Image import Image

_PAUSE = 0.35  # seconds of silence that end a line
_LINGER = 0.6  # seconds for which a line stays after its last word


class Caption:
    """One line of words at the foot of the picture."""

    below = 0

    def __init__(self, subject: Subject, size: Size) -> None:
        self._times = subject.performance.times
        self._text = font(round(0.045 * min(size)))
        utterance = subject.utterance
        shown = written_words(utterance) if utterance else ()
        words = [
            replace(w, text=text) for w, text in zip(utterance.words if utterance else (), shown, strict=True)
        ]
        self._space = self._text.getlength(" ")
        self._lines = lines_of(words, 0.86 * size[0], self._width, self._space)

    def _width(self, word: Word) -> float:
        return self._text.getlength(word.text)

    def draw(self, image: Image, height: int, frame: int) -> None:
        """Draw the line that is being said, or was a moment ago."""
        from PIL import ImageDraw

        time = float(self._times[frame])
        line = next((li for li in self._lines if li[0].start - 0.15 <= time <= li[-1].end + _LINGER), None)
        if line is None:
            return
        pen, high = ImageDraw.Draw(image, "RGBA"), self._text.size
        total = sum(map(self._width, line)) + self._space * (len(line) - 1)
        x, y = 0.5 * (image.width - total), height - 2.1 * high
        box = (x - 0.6 * high, y - 0.3 * high, x + total + 0.6 * high, y + 1.45 * high)
        pen.rounded_rectangle(box, radius=0.4 * high, fill=PANEL)
        for word in line:
            is_spoken = word.start <= time < word.end
            pen.text((x, y), word.text, font=self._text, fill=BRIGHT if is_spoken else INK)
            x += self._width(word) + self._space


def lines_of(
    words: Sequence[Word], wide: float, width: Callable[[Word], float], space: float
) -> list[list[Word]]:
    """Return words by line: a line ends at a pause, or if the next word would not fit in `wide`."""
    lines: list[list[Word]] = []
    used = 0.0
    for word in words:
        length = width(word)
        if not lines or word.start - lines[-1][-1].end > _PAUSE or used + space + length > wide:
            lines.append([])
            used = -space
        lines[-1].append(word)
        used += space + length
    return lines
