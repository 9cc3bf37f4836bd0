"""How the figures of the documentation are drawn; what they show is in `figures.py`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import figures as f
import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from risorius.charts.figures import figures
from risorius.core.movement import Movement
from risorius.take import Take

INK, SOFT, GRID = "#22303c", "#8a97a5", "#e3e8ed"
OURS, PRINTED, SPEECH, SECOND = "#0b7a75", "#d1495b", "#e9a23b", "#5b6fb5"
DPI = 144
NEARLY_WHITE = 243
STYLE = {
    "font.family": "DejaVu Sans", "font.size": 9.0, "text.color": INK,
    "axes.titlesize": 10.0, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.titlepad": 7.0,
    "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": SOFT, "axes.linewidth": 0.8,
    "axes.labelcolor": INK, "axes.grid": True, "axes.axisbelow": True,
    "grid.color": GRID, "grid.linewidth": 0.8,
    "xtick.color": SOFT, "ytick.color": SOFT, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "lines.linewidth": 2.0, "lines.solid_capstyle": "round",
    "legend.frameon": False, "legend.fontsize": 8.5, "figure.facecolor": "white",
}  # fmt: skip


@contextmanager
def figure(path: Path, width: float, height: float, colours: int = 64) -> Iterator[Figure]:
    """Yield a figure of this size in inches, then write it: in our style, with a palette, to small PNG."""
    with mpl.rc_context(STYLE):
        drawn = Figure((width, height), dpi=DPI, layout="constrained")
        yield drawn
        drawn.savefig(path)
    shrink(path, colours)


def shrink(path: Path, colours: int) -> None:
    """Reduce a PNG to a palette; photographs need all 256 colours and dithering."""
    with Image.open(path) as opened:
        image = opened.convert("RGB")
    dither = Image.Dither.FLOYDSTEINBERG if colours == 256 else Image.Dither.NONE
    palette = image.quantize(colours, method=Image.Quantize.MEDIANCUT, kmeans=2)
    entries = palette.getpalette() or []
    for first in range(0, len(entries), 3):
        if min(entries[first : first + 3]) > NEARLY_WHITE:
            entries[first : first + 3] = [255, 255, 255]
    palette.putpalette(entries)
    image.quantize(palette=palette, dither=dither).save(path, optimize=True)


def grid(start: float, end: float, step: float = 0.005) -> f.Array:
    """Return evenly spaced times, both ends included, shape (n,)."""
    return np.linspace(start, end, round((end - start) / step) + 1)


def style_axes(axes: Axes, title: str, end: float, start: float = 0.0, x_label: str = "time (s)") -> None:
    """Give axes of an activity over time its title, range and labels."""
    axes.set(title=title, xlim=(start, end), ylim=(-0.03, 1.08), xlabel=x_label)
    axes.set_yticks([0.0, 0.5, 1.0])


def span(axes: Axes, start: float, end: float, text: str) -> None:
    """Mark a phase over the axes."""
    axes.annotate("", (start, 1.06), (end, 1.06), arrowprops={"arrowstyle": "<->", "color": SOFT, "lw": 0.9})
    axes.text((start + end) / 2, 1.085, text, ha="center", va="bottom", color=SOFT, fontsize=8.5)


def single_movement(path: Path) -> None:
    """Figure 4."""
    times, movement = grid(0.0, 7.0), f.FIGURE_4
    values = f.curve(movement, times)
    with figure(path, 6.4, 2.9) as drawn:
        axes = drawn.subplots()
        axes.fill_between(times, values, color=OURS, alpha=0.1, lw=0)
        axes.plot(times, values, color=OURS)
        style_axes(axes, "", 7.0)
        axes.set_ylim(0.0, 1.22)
        axes.set_ylabel("activity")
        release = movement.end - movement.offset
        span(axes, 0.0, movement.onset, "onset  2 s")
        span(axes, movement.onset, release, "apex")
        span(axes, release, movement.end, "offset  3 s")
        for time in (movement.onset, release):
            axes.axvline(time, color=SOFT, lw=0.8, ls=":")


def lower_target(path: Path) -> None:
    """Figure 5."""
    times = grid(0.0, 9.0)
    first, second = f.FIGURE_5
    with figure(path, 6.4, 3.2) as drawn:
        axes = drawn.subplots()
        axes.plot(times, f.curve(first, times), color=SOFT, lw=1.2, label="first movement alone")
        axes.plot(times, f.curve(second, times), color=SECOND, lw=1.2, label="second movement alone")
        printed = f.printed_overlap(first, second, times)
        axes.plot(times, printed, color=PRINTED, lw=1.6, ls=(0, (3, 2)), label="combined, as printed")
        axes.plot(times, f.curve((first, second), times), color=OURS, lw=2.6, label="combined, ours")
        axes.axvline(second.start, color=SOFT, lw=0.8, ls=":")
        style_axes(axes, "", 9.0)
        axes.set_ylabel("Zygomatic Major")
        axes.legend(loc="upper right")


def smile_and_speech(path: Path) -> None:
    """Figure 6."""
    times = grid(0.0, 7.0)
    found = f.figure_6(times)
    with figure(path, 8.6, 3.1) as drawn:
        panels = drawn.subplots(1, 2, sharey=True)
        for axes, (when, (smile, speech)) in zip(panels, found.items(), strict=True):
            axes.fill_between(times, speech, color=SPEECH, alpha=0.22, lw=0)
            axes.plot(times, speech, color=SPEECH, label="Orbicularis Oris (speech)")
            axes.plot(times, smile, color=OURS, lw=2.4, label="Zygomatic Major (smile)")
            style_axes(axes, f"{when} the combination", 7.0)
        panels[1].plot(times, found["before"][0], color=OURS, lw=1.0, ls=":", zorder=1)
        drawn.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)


def mended(path: Path) -> None:
    """Where the printed formulas jump, and what ours do there."""
    pairs = {
        "a release to nothing": (f.TO_NOTHING, 9.0),
        "a release longer than the next onset": (f.LONG_RELEASE, 8.0),
        "a movement within another": (f.NESTED, 8.0),
    }
    with figure(path, 9.0, 5.4) as drawn:
        panels = drawn.subplots(2, 2).ravel()
        for axes, (title, ((first, second), end)) in zip(panels, pairs.items(), strict=False):
            times = grid(0.0, end)
            compare(axes, times, f.printed_overlap(first, second, times), f.curve((first, second), times))
            axes.axvline(second.start, color=SOFT, lw=0.8, ls=":")
            style_axes(axes, title, end)
        times = grid(0.0, 4.0)
        compare(panels[3], times, f.printed_alone(f.TOO_SHORT, times), f.curve(f.TOO_SHORT, times))
        style_axes(panels[3], "onset and offset longer than the movement", 4.0)
        panels[3].set_xticks(range(5))
        panels[3].legend(loc="upper right")


def compare(axes: Axes, times: f.Array, printed: f.Array, ours: f.Array) -> None:
    """Draw a curve by the printed formulas beside ours."""
    axes.plot(times, printed, color=PRINTED, lw=1.6, ls=(0, (3, 2)), label="as printed")
    axes.plot(times, ours, color=OURS, lw=2.4, label="ours")


def onset_functions(path: Path) -> None:
    """The onset functions, of one movement and of overlapping ones."""
    with figure(path, 10.0, 4.2) as drawn:
        above, below = drawn.subplots(2, len(f.FUNCTIONS), sharey=True)
        for axes, name in zip(above, f.FUNCTIONS, strict=True):
            rise_and_fall(axes, (f.FUNCTION_ALONE,), name)
            style_axes(axes, name, 4.0, x_label="")
        for axes, name in zip(below, f.FUNCTIONS, strict=True):
            for movement in f.FUNCTION_OVERLAP:
                axes.plot(
                    grid(0.0, 6.0), f.curve(movement, grid(0.0, 6.0), onset_function=name), color=SOFT, lw=1.0
                )
            rise_and_fall(axes, f.FUNCTION_OVERLAP, name)
            style_axes(axes, "", 6.0)
        above[0].set_ylabel("one movement")
        below[0].set_ylabel("three that overlap")


def rise_and_fall(axes: Axes, movements: Sequence[Movement], function: str) -> None:
    """Draw movements combined with an onset function."""
    times = grid(0.0, max(m.end for m in movements))
    values = f.curve(movements, times, onset_function=function)
    axes.fill_between(times, values, color=OURS, alpha=0.1, lw=0)
    axes.plot(times, values, color=OURS)


def faces(path: Path) -> None:
    """Figure 3."""
    with figure(path, 10.0, 2.28, colours=256) as drawn:
        for axes, (title, settings) in zip(drawn.subplots(1, len(f.FACES)), f.FACES.items(), strict=True):
            show_face(axes, f.pressed_and_raised(*settings), 1)
            axes.set_title(title, loc="center", fontweight="normal")


def show_face(axes: Axes, take: Take, index: int) -> None:
    """Show the face of one frame, cut out of its picture."""
    side = 620
    picture = next(take.pictures((side, side), [index]))
    left, right, top, bottom = (round(side * share) for share in (0.235, 0.765, 0.29, 0.82))
    axes.imshow(picture[top:bottom, left:right], interpolation="antialiased")
    axes.set_axis_off()


def speech_lane(axes: Axes, take: Take, start: float, end: float) -> None:
    """Write the words and phones of a take over their times."""
    assert take.utterance is not None
    axes.set(xlim=(start, end), ylim=(0.0, 2.0))
    axes.set_axis_off()
    for number, word in enumerate(take.utterance.words):
        shade = GRID if number % 2 else "#f1f4f6"
        axes.add_patch(
            mpl.patches.Rectangle((word.start, 0.0), word.end - word.start, 2.0, color=shade, lw=0)
        )
        axes.text((word.start + word.end) / 2, 1.5, word.text, ha="center", va="center", fontsize=9.0)
    for phone in take.utterance.phones:
        if phone.symbol:
            middle = (phone.start + phone.end) / 2
            axes.text(middle, 0.5, phone.symbol, ha="center", va="center", fontsize=6.5, color=SOFT)


def policies(path: Path) -> None:
    """What each policy leaves of a smile in rounded speech."""
    takes = {name: f.smiling(name) for name in f.POLICIES}
    take = takes["inhibit"]
    times, rounding = take.times, take.performance[f.FUNNELER]
    shown, smile = int(np.argmax(rounding)), f.silent(take)[f.ZYGOMATIC]
    start, end = 0.42, take.duration
    with figure(path, 10.0, 7.2, colours=256) as drawn:
        layout = {"width_ratios": [4.4, 1.0], "height_ratios": [0.34, *[1.0] * len(takes)]}
        panels = drawn.subplots(1 + len(takes), 2, **layout)
        speech_lane(panels[0, 0], take, start, end)
        panels[0, 1].set_axis_off()
        for (axes, portrait), (name, performed) in zip(panels[1:], takes.items(), strict=True):
            axes.fill_between(
                times, rounding, color=SPEECH, alpha=0.28, lw=0, label="Orbicularis Oris (speech)"
            )
            axes.plot(times, smile, color=OURS, lw=1.1, ls=":", label="Zygomatic Major by itself")
            axes.plot(
                times,
                performed.performance[f.ZYGOMATIC],
                color=OURS,
                lw=2.4,
                label="Zygomatic Major as shown",
            )
            axes.axvline(times[shown], color=SOFT, lw=0.9, ls="--")
            style_axes(axes, name, end, start, x_label="")
            axes.tick_params(labelbottom=name == f.POLICIES[-1])
            show_face(portrait, performed, shown)
        panels[-1, 0].set_xlabel("time (s)")
        drawn.legend(*panels[1, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)


LANES = {
    "Frontalis Medialis": {"frontalis_medialis.left": SECOND},
    "Levator Palpebrae": {"levator_palpebrae.left": SECOND},
    "Zygomatic Major": {f.ZYGOMATIC: OURS},
    "Lip Funneler": {f.FUNNELER: SPEECH},
    "Masseter (jaw)": {"masseter": SPEECH},
    "Depressor Labii": {"depressor_labii.left": SPEECH},
    "lip on teeth (blue),\nlips closed (red)": {"lip_tuck": SECOND, "lip_seal": PRINTED},
}
"""The demonstration's curves to show, by the title of their lane, with their colours."""


def demo_curves(path: Path) -> None:
    """Figure 7 as curves: what the emotions ask for, and what is shown."""
    take = f.demonstration()
    wanted, shown = f.silent(take), f.finely(take)
    end = take.duration
    with figure(path, 10.0, 7.4) as drawn:
        panels = drawn.subplots(1 + len(LANES), 1, sharex=True, height_ratios=[0.6, *[1.0] * len(LANES)])
        speech_lane(panels[0], take, 0.0, end)
        for axes, (title, lanes) in zip(panels[1:], LANES.items(), strict=True):
            for name, colour in lanes.items():
                axes.fill_between(shown.times, shown[name], color=colour, alpha=0.18, lw=0)
                axes.plot(shown.times, shown[name], color=colour, lw=1.8, label="as shown")
                axes.plot(
                    wanted.times, wanted[name], color=INK, lw=0.9, ls=":", label="the emotions by themselves"
                )
            style_axes(axes, "", end, x_label="")
            axes.set_ylabel(title, rotation=0, ha="right", va="center", fontsize=8.5)
            axes.set_yticks([0.0, 1.0])
        panels[-1].set(xlabel="time (s)", xticks=np.arange(0.0, end + 0.01, 0.5))
        drawn.legend(*panels[3].get_legend_handles_labels(), loc="outside lower center", ncols=2)


def demo(path: Path) -> None:
    """Figure 7: every fifth frame."""
    take = f.demonstration()
    replace(take, settings=replace(take.settings, size=(240, 240), every=5)).write(path)
    shrink(path, 256)


def paper_a(path: Path) -> None:
    """Figures 4 to 7 as the command draws them."""
    figures("paper-a", path)
    shrink(path, 256)


FIGURES: dict[str, Callable[[Path], None]] = {
    "faces": faces,
    "single-movement": single_movement,
    "lower-target": lower_target,
    "smile-and-speech": smile_and_speech,
    "mended": mended,
    "onset-functions": onset_functions,
    "policies": policies,
    "demo-curves": demo_curves,
    "demo": demo,
    "paper-a": paper_a,
}
