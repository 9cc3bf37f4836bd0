"""Figures 4 to 7 of paper A by our combination: its movements, its sentence, its frames."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from .. import blend
from ..core.arrays import Array
from ..core.movement import Movement
from ..core.parameters import INDEX
from ..core.performance import Performance
from ..core.progress import Progress, quiet
from ..core.score import BlendSettings, Score
from ..pipeline import combine, perform
from ..script import parse_script
from ..settings import BlendChoices
from ..settings.declare import rows
from ..settings.presets import load_settings
from ..take import Take
from .sheet import RIVAL, SECOND, SOFT, ChartLine, ChartRow, ChartSheet, LabelledFace, Panel

ZYGOMATIC, FUNNELER = "zygomatic_major.left", "orbicularis_oris_funneler"
PRESET = "paper-a"
RATE = Fraction(15)
"""Frames a second of Figure 7: the paper prints none, but by it frame 16 follows the happiness that starts at
1 s, and frame 47 the end of the sentence."""
FRAMES = (16, 23, 30, 34, 47)
DEMONSTRATION = """<PHONEME time="0" text="Oh, really? I like it very much." />
<EMOTIONDISPLAY time="0" duration="2.0" Surprise="1.0" />
<EMOTIONDISPLAY time="1.0" duration="3.0" Happiness="1.0" />
"""
_FINE = Fraction(200)
_FACE = (320, 320)


def _display(start: float, end: float, onset: float, offset: float, value: float = 1.0) -> Movement:
    """Return a smile's Zygomatic Major as an emotion displays it; seconds."""
    return Movement("emotion", start, end, onset, offset, {ZYGOMATIC: value})


FIGURE_4 = _display(0.0, 7.0, 2.0, 3.0)
"""7 s, of which the onset takes 2 s and the offset 3 s."""
FIGURE_5 = (_display(0.0, 5.0, 1.5, 2.0), _display(3.0, 9.0, 2.0, 2.0, 0.5))
"""At 3 s the Zygomatic Major is released to the target of the second movement, 0.5."""
FIGURE_6 = (_display(0.0, 7.0, 1.2, 1.6, 0.9), Movement("lips", 3.0, 4.2, 0.35, 0.35, {FUNNELER: 0.8}))
"""At 3 s the Orbicularis Oris speaks, and inhibits the Zygomatic Major."""


def curve(movements: Iterable[Movement], times: Array, parameter: str, settings: BlendSettings) -> Array:
    """Return one parameter of a score of movements at times in seconds, shape (n,)."""
    chosen = tuple(movements)
    score = Score(max(m.end for m in chosen), chosen, settings=settings)
    return blend.at(score, times)[:, INDEX[parameter]]


def demonstration(choices: BlendChoices, progress: Progress = quiet) -> Take:
    """Return the sentence of Figure 7 by the paper's settings, at its frames."""
    given = {name: getattr(choices, name) for name in rows(BlendChoices)}
    chosen = {name: value for name, value in given.items() if value is not None}
    settings = load_settings(PRESET, fps=RATE, **chosen)
    return perform(parse_script(DEMONSTRATION, ".xml", PRESET), (), settings, progress)


def paper_sheet(choices: BlendChoices, progress: Progress = quiet) -> ChartSheet:
    """Return Figures 4 to 7; the faces of Figure 7 are drawn."""
    settings = choices.over(BlendSettings())
    take = demonstration(choices, progress)
    pictures = take.pictures(_FACE, FRAMES, progress)
    faces = [
        LabelledFace(picture, f"frame {frame} ({float(frame / RATE):.2f} s)")
        for frame, picture in zip(FRAMES, pictures, strict=True)
    ]
    charts = (_row_4(settings), _row_5(settings), _row_6(settings), *_rows_7(take))
    return ChartSheet("Paper A, Figures 4 to 7, by Risorius", charts, tuple(faces))


def _times(end: float) -> Array:
    return np.linspace(0.0, end, round(end * float(_FINE)) + 1)


def _row_4(settings: BlendSettings) -> ChartRow:
    movement, times = FIGURE_4, _times(FIGURE_4.end)
    line = ChartLine("Zygomatic Major", times, curve([movement], times, ZYGOMATIC, settings), filled=True)
    release = movement.end - movement.offset
    phases = (
        (movement.start, movement.onset, "onset"),
        (movement.onset, release, "apex"),
        (release, movement.end, "offset"),
    )
    title = "Figure 4: one movement of 7 s, with an onset of 2 s and an offset of 3 s"
    return ChartRow(title, (Panel("", (line,), phases),), 0.0, movement.end)


def _row_5(settings: BlendSettings) -> ChartRow:
    first, second = FIGURE_5
    times = _times(second.end)
    alone = [
        ChartLine(f"{name} movement", times, curve([m], times, ZYGOMATIC, settings), colour)
        for name, m, colour in (("first", first, SOFT), ("second", second, SECOND))
    ]
    both = ChartLine("combined", times, curve(FIGURE_5, times, ZYGOMATIC, settings))
    before = Panel("before", tuple(alone))
    after = Panel("after", (*(replace(line, dashed=True, width=1.4) for line in alone), both))
    title = "Figure 5: Zygomatic Major of two movements in one channel; from 3 s on it falls to 0.5"
    return ChartRow(title, (before, after), 0.0, second.end)


def _row_6(settings: BlendSettings) -> ChartRow:
    smile, speech = FIGURE_6
    times = _times(smile.end)
    panels = [
        Panel(
            when,
            (
                _smile(times, curve(smiling, times, ZYGOMATIC, settings)),
                _rounding(times, curve(speaking, times, FUNNELER, settings)),
            ),
        )
        for when, smiling, speaking in (("before", [smile], [speech]), ("after", FIGURE_6, FIGURE_6))
    ]
    title = "Figure 6: rivals in two channels; from 3 s on speech rounds the lips"
    return ChartRow(title, tuple(panels), 0.0, smile.end)


def _smile(times: Array, values: Array) -> ChartLine:
    return ChartLine("Zygomatic Major (emotion)", times, values)


def _rounding(times: Array, values: Array) -> ChartLine:
    return ChartLine("Orbicularis Oris, funneler (speech)", times, values, RIVAL, filled=True)


def _rows_7(take: Take) -> tuple[ChartRow, ChartRow]:
    felt, said, shown = (_finely(take, kept) for kept in (("emotion",), ("lips",), ()))
    marks = tuple((float(frame / RATE), str(frame)) for frame in FRAMES)
    mouth = (
        Panel(
            "each channel by itself",
            (_smile(felt.times, felt[ZYGOMATIC]), _rounding(said.times, said[FUNNELER])),
        ),
        Panel(
            "combined",
            (_smile(shown.times, shown[ZYGOMATIC]), _rounding(shown.times, shown[FUNNELER])),
            (),
            marks,
        ),
    )
    brow, jaw = "frontalis_medialis.left", "masseter"
    face = (
        Panel("each channel by itself", (*_brow_and_jaw(felt, felt[brow], said[jaw]),)),
        Panel("combined", (*_brow_and_jaw(shown, shown[brow], shown[jaw]),), (), marks),
    )
    first = "Figure 7: “Oh, really? I like it very much.”, surprise until 2 s, happiness from 1 s to 4 s"
    second = "Figure 7, brows and jaw"
    return (
        ChartRow(first, mouth, 0.0, take.duration, said=take.utterance),
        ChartRow(second, face, 0.0, take.duration),
    )


def _brow_and_jaw(curves: Performance, brow: Array, jaw: Array) -> Sequence[ChartLine]:
    return (
        ChartLine("Frontalis Medialis, brows", curves.times, brow, SECOND),
        ChartLine("Masseter, jaw rotation", curves.times, jaw, RIVAL, filled=True),
    )


def _finely(take: Take, kept: tuple[str, ...]) -> Performance:
    """Return the curves of a take at `_FINE` frames a second, of the `kept` channels alone if any are."""
    score = take.score
    if kept:
        movements = tuple(m for m in score.movements if m.channel in kept)
        score = replace(score, movements=movements, lips=score.lips if "lips" in kept else ())
    return combine(score, replace(take.settings, fps=_FINE)).performance
