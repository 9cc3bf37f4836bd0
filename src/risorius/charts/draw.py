"""The layout of a sheet of charts: titles, legends, axes with ticks and labels, lines, words, faces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..core.speech.utterance import Utterance
from .pen import Pen, Spot, width_of
from .sheet import INK, SOFT, ChartColour, ChartLine, ChartRow, ChartSheet, LabelledFace, Panel

if TYPE_CHECKING:
    from PIL.Image import Image

WIDTH = 1240
_MARGIN, _LEFT, _RIGHT = 22, 62, 20  # pixels around the sheet, and left and right of a panel
_HEADING, _LEGEND, _TITLE = 46, 22, 22
_SAID, _PHASES, _PLOT, _AXIS = 38, 18, 176, 46
_FACE, _LABEL = 224, 34
_SAMPLE, _GAP = 24, 12  # of a line in the legend
_GRID: ChartColour = (226, 231, 236)
_WORDS: tuple[ChartColour, ChartColour] = ((238, 241, 244), (222, 228, 234))
_WORD_SIZES = (12, 10, 9)
_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
_MOST_POINTS = 1600  # of a line: more than pixels


def drawn(sheet: ChartSheet) -> Image:
    """Return the picture of a sheet."""
    height = _HEADING + sum(_height(row) for row in sheet.rows) + _faces_height(sheet) + _MARGIN
    pen = Pen(WIDTH, height)
    pen.text((_MARGIN, _HEADING / 2 + 2), sheet.title, INK, 20)
    top = float(_HEADING)
    for row in sheet.rows:
        _draw_row(pen, row, top)
        top += _height(row)
    _draw_faces(pen, sheet.faces, top)
    return pen.picture()


def ticks(low: float, high: float, most: int = 8) -> list[float]:
    """Return at most `most` round numbers, evenly spaced, that lie between `low` and `high`."""
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(step * power for step in _STEPS if step * power >= rough * (1.0 - 1e-9))
    first = math.ceil(low / step - 1e-9)
    return [number * step for number in range(first, math.floor(high / step + 1e-9) + 1)]


def _height(row: ChartRow) -> int:
    return _heads(row) + _above(row) + _PLOT + _AXIS


def _heads(row: ChartRow) -> int:
    """Return the height of a row's title and legend and of its panels' titles."""
    return _TITLE + _LEGEND * len(_legend(row)) + _TITLE


def _above(row: ChartRow) -> int:
    said = _SAID if row.said is not None else 0
    return said + (_PHASES if any(panel.phases or panel.marks for panel in row.panels) else 0)


def _draw_row(pen: Pen, row: ChartRow, top: float) -> None:
    pen.text((_MARGIN, top + _TITLE / 2), row.title, INK, 16)
    for number, lines in enumerate(_legend(row)):
        _draw_legend(pen, lines, top + _TITLE + (number + 0.5) * _LEGEND)
    wide = (WIDTH - 2 * _MARGIN) / len(row.panels)
    for number, panel in enumerate(row.panels):
        left = _MARGIN + number * wide + _LEFT
        plot_top = top + _heads(row) + _above(row)
        frame = _Axes(row, left, left + wide - _LEFT - _RIGHT, plot_top, plot_top + _PLOT)
        pen.text((left, top + _heads(row) - _TITLE / 2), panel.title, SOFT, 13)
        frame.draw(pen, panel)


def _legend(row: ChartRow) -> list[list[ChartLine]]:
    """Return one line of each label, as many in a line of the legend as there is room for."""
    shown: dict[str, ChartLine] = {}
    for panel in row.panels:
        for line in panel.lines:
            shown.setdefault(line.label, line)
    legend: list[list[ChartLine]] = [[]]
    used = 0.0
    for line in shown.values():
        room = _SAMPLE + width_of(line.label) + 2 * _GAP
        if used + room > WIDTH - 2 * _MARGIN and legend[-1]:
            legend.append([])
            used = 0.0
        legend[-1].append(line)
        used += room
    return legend


def _draw_legend(pen: Pen, lines: list[ChartLine], middle: float) -> None:
    x = float(_MARGIN)
    for line in lines:
        if line.filled:
            pen.box((x, middle - 6), (x + _SAMPLE, middle + 6), line.colour, 0.22)
        pen.line([(x, middle), (x + _SAMPLE, middle)], line.colour, line.width, dashed=line.dashed)
        pen.text((x + _SAMPLE + _GAP / 2, middle), line.label, INK, 13)
        x += _SAMPLE + width_of(line.label) + 2 * _GAP


class _Axes:
    """The place of a panel on the sheet."""

    def __init__(self, row: ChartRow, left: float, right: float, top: float, bottom: float) -> None:
        self._row, self._left, self._right, self._top, self._bottom = row, left, right, top, bottom
        room = 0.04 * (row.high - row.low)
        self._low, self._high = row.low - room, row.high + room

    def draw(self, pen: Pen, panel: Panel) -> None:
        """Draw grid, ticks, labels, what is said, phases, marks and lines."""
        self._draw_grid(pen)
        above = self._top
        if self._row.said is not None:
            above -= _SAID
            self._draw_said(pen, self._row.said, above)
        for start, end, name in panel.phases:
            self._draw_phase(pen, start, end, name, above - _PHASES / 2)
        for time, name in panel.marks:
            x = self._x(time)
            pen.line([(x, self._top), (x, self._bottom)], SOFT, 1.0, dashed=True)
            pen.text((x, above - _PHASES / 2), name, SOFT, 12, anchor="mm")
        for line in sorted(panel.lines, key=lambda line: not line.filled):
            self._draw_line(pen, line)

    def _x(self, time: float) -> float:
        share = (time - self._row.start) / (self._row.end - self._row.start)
        return self._left + share * (self._right - self._left)

    def _y(self, value: float) -> float:
        return self._bottom - (value - self._low) / (self._high - self._low) * (self._bottom - self._top)

    def _draw_grid(self, pen: Pen) -> None:
        for value in ticks(self._row.low, self._row.high, 5):
            y = self._y(value)
            pen.line([(self._left, y), (self._right, y)], _GRID)
            pen.text((self._left - 8, y), f"{value + 0.0:g}", SOFT, 12, anchor="rm")
        for time in ticks(self._row.start, self._row.end, 8 if self._right - self._left < 700 else 14):
            x = self._x(time)
            pen.line([(x, self._top), (x, self._bottom)], _GRID)
            pen.text((x, self._bottom + 12), f"{time + 0.0:g}", SOFT, 12, anchor="mm")
        pen.line([(self._left, self._top), (self._left, self._bottom), (self._right, self._bottom)], SOFT)
        pen.text(((self._left + self._right) / 2, self._bottom + 30), "time (s)", INK, 12, anchor="mm")
        pen.text((self._left - _LEFT + 2, self._top - 9), self._row.axis, INK, 12)

    def _draw_said(self, pen: Pen, said: Utterance, top: float) -> None:
        words = [(word.start, word.end, word.text) for word in said.words]
        phones = [(phone.start, phone.end, phone.symbol) for phone in said.phones if phone.symbol]
        for number, (start, end, text) in enumerate(words):
            left, right = (min(max(self._x(time), self._left), self._right) for time in (start, end))
            pen.box((left, top), (right, top + _SAID - 2), _WORDS[number % 2])
            size = next((size for size in _WORD_SIZES if width_of(text, size) < right - left), None)
            if size is not None:
                pen.text(((left + right) / 2, top + 9), text, INK, size, anchor="mm")
        for start, end, text in phones:
            x = self._x((start + end) / 2)
            if self._left < x < self._right and width_of(text, 9) < self._x(end) - self._x(start) + 2:
                pen.text((x, top + 26), text, SOFT, 9, anchor="mm")

    def _draw_phase(self, pen: Pen, start: float, end: float, name: str, middle: float) -> None:
        left, right = self._x(start), self._x(end)
        half = width_of(name, 12) / 2 + 6
        centre = (left + right) / 2
        pen.line([(left, middle), (max(centre - half, left), middle)], SOFT)
        pen.line([(min(centre + half, right), middle), (right, middle)], SOFT)
        for x in (left, right):
            pen.line([(x, middle - 4), (x, middle + 4)], SOFT)
        pen.text((centre, middle), name, SOFT, 12, anchor="mm")

    def _draw_line(self, pen: Pen, line: ChartLine) -> None:
        inside = (line.times >= self._row.start) & (line.times <= self._row.end)
        times, values = line.times[inside], np.clip(line.values[inside], self._low, self._high)
        step = max(1, len(times) // _MOST_POINTS)
        points: list[Spot] = [
            (self._x(t), self._y(v))
            for t, v in zip(times[::step].tolist(), values[::step].tolist(), strict=True)
        ]
        if len(points) < 2:
            return
        if line.filled:
            ground = self._y(min(max(0.0, self._low), self._high))
            pen.area([(points[0][0], ground), *points, (points[-1][0], ground)], line.colour, 0.22)
        pen.line(points, line.colour, line.width, dashed=line.dashed)


def _faces_height(sheet: ChartSheet) -> int:
    return _FACE + _LABEL if sheet.faces else 0


def _draw_faces(pen: Pen, faces: tuple[LabelledFace, ...], top: float) -> None:
    from PIL import Image

    for left, face in zip(_places(len(faces)), faces, strict=True):
        picture = Image.fromarray(face.picture)
        pen.paste(picture.resize((_FACE, _FACE), Image.Resampling.LANCZOS), (left, top))
        pen.text((left + _FACE / 2, top + _FACE + _LABEL / 2), face.label, INK, 13, anchor="mm")


def _places(count: int) -> Iterator[float]:
    room = (WIDTH - 2 * _MARGIN) / max(count, 1)
    yield from (_MARGIN + (k + 0.5) * room - _FACE / 2 for k in range(count))
