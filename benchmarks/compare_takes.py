"""A captured face beside a generated one of the same words: how alike their curves are, and which is late.

    python benchmarks/compare_takes.py CAPTURE.arkit.csv --audio VOICE.wav --transcript "…" --picture x.png
    python benchmarks/compare_takes.py CAPTURE.arkit.csv --against OTHER.arkit.csv --start 1.25

The capture is a take of Live Link Face, `--audio` the voice that was recorded with it, which is aligned and
performed; or `--against` names a take that is there already. `--start` is the time of the capture, in seconds
after its first frame, at which the sound begins. Every shape that moves in both by at least `MOVES` gets a
line: the correlation as it is and with the lag taken out, the lag (positive: the generated one is later), and
the generated one's amplitude by the captured one's (ratio of standard deviations).
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

import risorius
from risorius.core.arkit import ROTATIONS, SHAPES
from risorius.core.arrays import Array
from risorius.errors import InputError, RisoriusError
from risorius.ports.curves.arkit_csv import ArkitTake, read_arkit_csv

RATE = 60.0  # curves are compared at so many values a second
LAGS = 0.5  # s, the greatest lag that is looked for
MOVES = 0.03  # a curve whose range is less does not move: of a weight, or of radians
LEAST = 0.5  # s that both must cover beside the lags
NAMES = (*SHAPES, *ROTATIONS)


@dataclass(frozen=True, slots=True)
class Likeness:
    """One curve of two takes: correlations as they are and without the lag, lag in s, ratio of amplitudes."""

    name: str
    as_is: float
    correlation: float
    lag: float
    amplitude: float


def compare(captured: ArkitTake, generated: ArkitTake) -> list[Likeness]:
    """Compare all curves that move in both; raise InputError where the takes share too short a time."""
    times = common_times(captured, generated)
    pairs = zip(NAMES, curves(captured, times).T, curves(generated, times).T, strict=True)
    return [likeness(name, a, b) for name, a, b in pairs if min(np.ptp(a), np.ptp(b)) >= MOVES]


def still(captured: ArkitTake, generated: ArkitTake) -> tuple[list[str], list[str]]:
    """Return the curves that only the captured, and only the generated take moves."""
    times = common_times(captured, generated)
    moves = [np.ptp(curves(take, times), axis=0) >= MOVES for take in (captured, generated)]
    return tuple(  # type: ignore[return-value]
        [name for name, one, other in zip(NAMES, a, b, strict=True) if one and not other]
        for a, b in (moves, moves[::-1])
    )


def common_times(one: ArkitTake, other: ArkitTake) -> Array:
    """Return times (n,) in s at `RATE` that both takes cover."""
    start, end = max(one.times[0], other.times[0]), min(one.times[-1], other.times[-1])
    if end - start < LEAST + 2.0 * LAGS:
        message = f"the takes share {max(end - start, 0.0):.2f} s; expected {LEAST + 2.0 * LAGS:g} s or more"
        raise InputError(message)
    return np.arange(start, end, 1.0 / RATE)


def curves(take: ArkitTake, times: Array) -> Array:
    """Return the take's weights and rotations (n, 61) at times."""
    values = np.concatenate([take.weights, take.rotations], axis=1)
    return np.stack([np.interp(times, take.times, column) for column in values.T], axis=1)


def likeness(name: str, captured: Array, generated: Array) -> Likeness:
    """Return how alike two curves (n,) at `RATE` are."""
    reach = round(LAGS * RATE)
    steps = range(-reach, reach + 1)
    found = np.array([_correlation(*_shifted(captured, generated, step)) for step in steps])
    best = int(np.argmax(found))
    lag, correlation = (best - reach) / RATE, float(found[best])
    if 0 < best < len(found) - 1:  # the top of the parabola through three values
        before, top, after = found[best - 1 : best + 2]
        curved = before - 2.0 * top + after
        if curved < -1e-12:
            lag += 0.5 * (before - after) / curved / RATE
    amplitude = float(generated.std() / captured.std())
    return Likeness(name, float(found[reach]), correlation, float(lag), amplitude)


def _shifted(captured: Array, generated: Array, step: int) -> tuple[Array, Array]:
    """Return both where they overlap when the generated curve is `step` values late."""
    if step >= 0:
        return captured[: len(captured) - step], generated[step:]
    return captured[-step:], generated[:step]


def _correlation(a: Array, b: Array) -> float:
    a, b = a - a.mean(), b - b.mean()
    size = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / size if size > 1e-12 else 0.0


def generated_take(audio: Path, transcript: str) -> ArkitTake:
    """Return our performance of a recording."""
    settings = risorius.Settings(fps=Fraction(30))
    take = risorius.speak(transcript, audio=audio, settings=settings)
    return ArkitTake(take.times, take.arkit.weights, take.arkit.rotations)


def draw(captured: ArkitTake, generated: ArkitTake, rows: Sequence[Likeness], path: Path) -> None:
    """Draw the curves that move most, one above the other."""
    from matplotlib import pyplot as plt

    plt.switch_backend("Agg")

    times = common_times(captured, generated)
    one, other = curves(captured, times), curves(generated, times)
    column = {name: k for k, name in enumerate(NAMES)}
    chosen = sorted(rows, key=lambda row: -np.ptp(one[:, column[row.name]]))[:8]
    figure, axes = plt.subplots(
        len(chosen), 1, sharex=True, squeeze=False, figsize=(9, 1.1 * len(chosen) + 0.6)
    )
    for axis, row in zip(axes[:, 0], chosen, strict=True):
        axis.plot(times, one[:, column[row.name]], color="#303030", label="captured")
        axis.plot(times, other[:, column[row.name]], color="#c03028", label="generated")
        text = f"r {row.correlation:.2f}, {1000 * row.lag:+.0f} ms, × {row.amplitude:.2f}"
        axis.set_title(f"{row.name}: {text}", fontsize=8, loc="left", pad=2)
        axis.tick_params(labelsize=7)
        axis.spines[["top", "right"]].set_visible(False)
    axes[0, 0].legend(fontsize=7, loc="upper right", frameon=False)
    axes[-1, 0].set_xlabel("s", fontsize=8)
    figure.tight_layout(h_pad=0.3)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def tell(captured: ArkitTake, generated: ArkitTake, rows: Sequence[Likeness]) -> None:
    """Print a line for each curve, the medians, and what moves in one take only."""
    print(f"{'curve':22} {'as is':>6} {'at lag':>6} {'lag ms':>7} {'amplitude':>9}")
    for row in sorted(rows, key=lambda row: -row.correlation):
        numbers = f"{row.as_is:6.2f} {row.correlation:6.2f} {1000 * row.lag:+7.0f} {row.amplitude:9.2f}"
        print(f"{row.name:22} {numbers}")
    if rows:
        values = np.median([(r.as_is, r.correlation, r.lag, r.amplitude) for r in rows], axis=0)
        numbers = f"{values[0]:6.2f} {values[1]:6.2f} {1000 * values[2]:+7.0f} {values[3]:9.2f}"
        print(f"{'median':22} {numbers}")
    for who, names in zip(("captured", "generated"), still(captured, generated), strict=True):
        print(f"moves only in the {who} one: {', '.join(names) or 'nothing'}")


def main() -> None:
    """Compare, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("capture", type=Path)
    parser.add_argument("--audio", type=Path)
    parser.add_argument("--transcript")
    parser.add_argument("--against", type=Path)
    parser.add_argument("--start", type=float, default=0.0, metavar="S")
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args()
    spoken = asked.audio is not None and asked.transcript is not None
    if spoken == (asked.against is not None):
        parser.error("expected --against TAKE, or --audio WAV with --transcript TEXT")
    try:
        captured = started(read_arkit_csv(asked.capture), asked.start)
        if spoken:
            generated = generated_take(asked.audio, asked.transcript)
        else:
            generated = started(read_arkit_csv(asked.against), 0.0)
        rows = compare(captured, generated)
        tell(captured, generated, rows)
        if asked.picture is not None and rows:
            draw(captured, generated, rows, asked.picture)
    except RisoriusError as error:
        parser.exit(2, f"{parser.prog}: {error}\n")


def started(take: ArkitTake, start: float) -> ArkitTake:
    """Return a take whose time 0 is `start` s after its first frame."""
    return ArkitTake(take.times - take.times[0] - start, take.weights, take.rotations)


if __name__ == "__main__":
    main()
