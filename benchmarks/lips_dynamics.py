"""How fast the lips move, at any rate of speech: people's lip gap peaks at 120 to 320 mm a second.

Prints, by model and rate, of the lip gap on the mesh
- the 99.9th percentile of its speed, and the largest change of it within 5 ms while the lips are apart;
- the root mean square of its jerk while the lips are apart (asked: at most 250,000 mm/s³), and the share of
  its speed's power above 15 Hz (at most .05);
- how late the widest moment of vowels is beside their middles (of a diphthong, of its wider sound), and the
  middle of the shut lips beside that of the closure of /p b m/ (medians; asked: within 10 ms);
- with `--vowels` the median widest gap of each vowel.
Run from the repository (a few minutes):
    PYTHONPATH=src python benchmarks/lips_dynamics.py [--sentences 6] [--lips effort] [--rates 175] [--vowels]
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np
from lips_measures import machine

from risorius import blend
from risorius.core.arrays import Array
from risorius.core.lips.articulators import APERTURE
from risorius.core.movement import LipSegment
from risorius.core.speech.utterance import Phone
from risorius.face.fit.lip_file import load_lip_rig
from risorius.pipeline import compose
from risorius.script import read_script
from risorius.settings import BlendChoices, Settings
from risorius.speech import synthesize_script

SENTENCES = Path(__file__).with_name("lips_sentences.txt").read_text().splitlines()
RATES = (110, 175, 250, 350)
MODELS = ("effort", "dominance", "lookahead")
STEP = 0.005
FAST_HZ = 15.0
SHUT_MM = 0.05
SEAL = "lip_seal"


class Said(NamedTuple):
    """One sentence: the lip gap in mm every `STEP` seconds, its phones and the segments of the lips."""

    gap: Array
    phones: Sequence[Phone]
    lips: Sequence[LipSegment]

    @property
    def times(self) -> Array:
        return np.arange(len(self.gap)) * STEP

    def vowels(self) -> Iterator[tuple[Phone, Array, Array]]:
        """Yield each vowel with the times within it and the gap at them."""
        for phone in self.phones:
            within = (self.times >= phone.start) & (self.times <= phone.end)
            if phone.stress >= 0 and within.any():
                yield phone, self.times[within], self.gap[within]

    def vowels_late(self) -> Iterator[float]:
        """Yield how late the widest moment is beside the middle of each vowel, of a diphthong's wider sound.

        A vowel begins for the lips where the stop before it is released.
        """
        vowels = {phone.symbol for phone in self.phones if phone.stress >= 0}
        for sounds in groupby(self.lips, lambda segment: (segment.phone, segment.cause)):
            widest = max(sounds[1], key=lambda segment: segment.targets.get(APERTURE, 0.0))
            within = (self.times >= widest.start) & (self.times <= widest.end)
            if widest.phone in vowels and within.any():
                times, gap = self.times[within], self.gap[within]
                yield times[gap.argmax()] - (widest.start + widest.end) / 2.0

    def closures_late(self) -> Iterator[float]:
        """Yield how late the middle of the shut lips is beside that of each closure that stands alone."""
        closures = [s for s in self.lips if s.targets.get(SEAL, 0.0) >= 1.0]
        for closure in closures:
            shut = (self.gap <= SHUT_MM) & (self.times >= closure.start - 0.03)
            shut &= self.times <= closure.end + 0.03
            alone = all(s is closure or abs(s.start - closure.start) > 0.15 for s in closures)
            if alone and shut.any():
                yield float(self.times[shut].mean()) - (closure.start + closure.end) / 2.0


def spoken(sentence: str, rate: int, model: str) -> Said:
    """Return a sentence as our lips say it."""
    script = read_script(sentence, text=True)
    utterance = synthesize_script(script, rate=rate)
    settings = Settings(lively=False, blend=BlendChoices(lips=model))
    score = compose(script, utterance, (), settings)
    values = blend.at(score, np.arange(0.0, score.duration, STEP), load_lip_rig())
    return Said(machine().mouth(values)[:, 0], utterance.phones, score.lips)


def _jerk(curve: Array) -> Array:
    """Return the third derivative while the lips are apart, mm/s³."""
    apart = np.convolve(curve > SHUT_MM, np.ones(4), "valid") == 4.0
    return np.diff(curve, 3)[apart] / STEP**3


def _fast(curve: Array) -> tuple[float, float]:
    """Return the power of the speed above `FAST_HZ`, and all of it."""
    speed = np.diff(curve) / STEP
    power = np.abs(np.fft.rfft(speed - speed.mean())) ** 2
    return float(power[np.fft.rfftfreq(len(speed), STEP) > FAST_HZ].sum()), float(power.sum())


def _kink(curve: Array) -> float:
    """Return the largest change of speed from step to step, mm/s; lips that meet stop at once."""
    apart = (curve[:-2] > 0.0) & (curve[1:-1] > 0.0) & (curve[2:] > 0.0)
    return float(np.abs(np.diff(np.diff(curve)))[apart].max() / STEP)


def main() -> None:
    """Measure and print one line for each rate and model."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sentences", type=int, default=6)
    parser.add_argument("--lips", nargs="+", choices=MODELS, default=MODELS)
    parser.add_argument("--rates", nargs="+", type=int, default=RATES)
    parser.add_argument("--vowels", action="store_true")
    options = parser.parse_args()
    for model in options.lips:
        for rate in options.rates:
            said = [spoken(sentence, rate, model) for sentence in SENTENCES[: options.sentences]]
            print(f"{model:10s} {rate:4d} words/min: {_line(said)}", flush=True)
            if options.vowels:
                _print_vowels(said)


def _line(said: Sequence[Said]) -> str:
    curves = [one.gap for one in said]
    speed = np.concatenate([np.abs(np.diff(curve)) / STEP for curve in curves])
    jerk = np.sqrt(np.mean(np.concatenate([_jerk(curve) for curve in curves]) ** 2))
    fast, power = np.sum([_fast(curve) for curve in curves], axis=0)
    vowels = 1000.0 * np.median([late for one in said for late in one.vowels_late()])
    closures = 1000.0 * np.median([late for one in said for late in one.closures_late()])
    return (
        f"99.9th percentile {np.percentile(speed, 99.9):4.0f} mm/s, most {speed.max():4.0f}; "
        f"speed changes by at most {max(map(_kink, curves)):4.0f} mm/s in 5 ms; "
        f"jerk {jerk:7.0f} mm/s3; above {FAST_HZ:.0f} Hz {fast / power:.3f}; "
        f"vowels {vowels:+.0f} ms, closures {closures:+.0f} ms"
    )


def _print_vowels(said: Sequence[Said]) -> None:
    widest: dict[str, list[float]] = defaultdict(list)
    for one in said:
        for phone, _, gap in one.vowels():
            widest[phone.symbol].append(float(gap.max()))
    for symbol, found in sorted(widest.items()):
        print(f"  {symbol:3s} {len(found):3d} times, {np.median(found):4.1f} mm")


if __name__ == "__main__":
    main()
