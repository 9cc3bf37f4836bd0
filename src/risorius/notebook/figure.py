"""A performance as a figure of matplotlib: sound, words, curves, head, gaze and channels over one time."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..core.parameters import BASES, parameters_named
from ..core.performance import Performance
from ..core.speech.utterance import Utterance
from ..machine.optional import optional
from ..render.overlay.lanes import lane_blocks
from .shown_take import ShownTake, liveliest

_INCHES = 11.0
_MOST_POINTS = 4_000  # of the sound's outline
_DEGREES = ("head_pitch", "head_yaw", "head_roll", "gaze_pitch", "gaze_yaw")


def plotted(take: ShownTake, parameters: tuple[str, ...] = ()) -> Any:
    """Return a `matplotlib.figure.Figure`, which notebooks show and `savefig` writes.

    `parameters` are drawn by name, with or without their sides; without them those that move most. Raises
    RisoriusError if matplotlib is not installed, ParameterError for an unknown name.
    """
    named = {p.name: take.performance.curves[p.name] for name in parameters for p in parameters_named(name)}
    figure_module = optional("matplotlib.figure", "matplotlib")
    figure = figure_module.Figure(figsize=(_INCHES, 8.0), layout="constrained")
    sound, curves, head, lanes = figure.subplots(4, 1, sharex=True, height_ratios=(1, 3, 2, 2))
    _draw_sound(sound, take)
    times = take.performance.times
    for name, curve in (named or liveliest(take.performance)).items():
        curves.plot(times, curve, label=name, linewidth=1.2)
    curves.set_ylabel("activation")
    _draw_degrees(head, take.performance)
    _draw_lanes(lanes, take.performance)
    lanes.set_xlabel("time (s)")
    lanes.set_xlim(0.0, max(take.performance.duration, 1e-3))
    for axes in (curves, head):
        if axes.lines:
            axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small", frameon=False)
    return figure


def _draw_sound(axes: Any, take: ShownTake) -> None:
    axes.set_yticks([])
    axes.set_ylabel("sound")
    if take.audio is not None and take.audio.frames:
        step = max(1, take.audio.frames // _MOST_POINTS)
        peaks = [np.abs(block.astype(float)).max() for block in take.audio.blocks(step)]
        times = np.arange(len(peaks)) * step / take.audio.sample_rate
        axes.fill_between(times, np.negative(peaks), peaks, linewidth=0.0, alpha=0.6)
    if take.utterance is not None:
        _draw_words(axes, take.utterance)


def _draw_words(axes: Any, utterance: Utterance) -> None:
    place = axes.get_xaxis_transform()  # x in seconds, y in shares of the height
    for word in utterance.words:
        axes.axvline(word.start, linewidth=0.5, alpha=0.4)
        axes.text(
            0.5 * (word.start + word.end), 1.02, word.text, ha="center", va="bottom", rotation=30,
            fontsize="small", transform=place,
        )  # fmt: skip


def _draw_degrees(axes: Any, performance: Performance) -> None:
    for name in _DEGREES:
        axes.plot(performance.times, performance.curves[BASES[name][0].name], label=name, linewidth=1.2)
    axes.set_ylabel("degrees")


def _draw_lanes(axes: Any, performance: Performance) -> None:
    lanes = {name: blocks for name, blocks in lane_blocks(performance.score).items() if blocks}
    for row, blocks in enumerate(lanes.values()):
        spans = [(block.start, block.end - block.start) for block in blocks]
        axes.broken_barh(spans, (row - 0.4, 0.8), facecolors=f"C{row % 10}", edgecolor="white", linewidth=0.5)
    axes.set_yticks(range(len(lanes)), list(lanes))
    axes.invert_yaxis()
