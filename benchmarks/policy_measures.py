"""What a conflict policy does to speech under an emotion: what `policies.py` counts and measures."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache, cached_property
from itertools import pairwise

import numpy as np

from risorius import blend
from risorius.channels import Display
from risorius.core.arrays import Array, BoolArray
from risorius.core.parameters import BASES, INDEX, NAMES, PARAMETERS, RIVALS, Kind
from risorius.core.performance import frame_times
from risorius.core.score import Score
from risorius.core.speech.utterance import Utterance
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.fit.measure import Gauge
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.pipeline import compose
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

FPS = Fraction(60)
HELD_MM = 0.05
SAMPLES = 4  # moments measured in a closure, its first and last included
DARK, LIT = 0.2, 0.8  # shares of its own level below which a muscle is off, above which it is on
DISPLAYED = 0.15  # weaker muscles of an emotion are no display of their own
STRONG = 0.3  # rivals that are both above it deform the mouth for all to see
ROUNDED = 0.5  # mm of protrusion: a phone with that much is rounded
HAIR = 1e-9
WHOLE = "all of the mouth"

MUSCLES = np.array([INDEX[p.name] for p in PARAMETERS if p.kind is Kind.MUSCLE])
# What speech owns by the design, under every policy: at closures these may not open, at vowels 08 not press.
OPENING = frozenset(
    p.name
    for base in (
        "depressor_labii",
        "orbicularis_oris_presser",
        "levator_labii_nasi",
        "levator_labii_superioris",
        "masseter",
    )
    for p in BASES[base]
)
MOUTH = frozenset(p.name for p in PARAMETERS if p.group in ("lips", "jaw", "cheeks", "nose"))
PAIRS = tuple((INDEX[a], INDEX[b]) for a in NAMES for b in RIVALS[a] if INDEX[a] < INDEX[b])


@dataclass
class Case:
    """One sentence under one emotion: its score, and each half of it by itself."""

    utterance: Utterance
    score: Score

    @cached_property
    def times(self) -> Array:
        """Frame times at 60 fps, shape (n,)."""
        return frame_times(self.score.duration, FPS)

    @cached_property
    def display(self) -> Array:
        """The emotion without the speech, shape (n, 46)."""
        return blend.at(replace(self.score, lips=()), self.times, load_lip_rig())

    @cached_property
    def speech(self) -> Array:
        """The speech without the emotion, shape (n, 46)."""
        return blend.at(replace(self.score, movements=()), self.times, load_lip_rig())

    @cached_property
    def speaking(self) -> BoolArray:
        """At which frames a phone is said, shape (n,)."""
        spoken = np.zeros(len(self.times), dtype=bool)
        for phone in self.utterance.phones:
            if phone.symbol:
                spoken |= (self.times >= phone.start) & (self.times < phone.end)
        return spoken

    @cached_property
    def apart(self) -> BoolArray:
        """Which conflicting pairs neither half shows by itself at a time, shape (n, pairs)."""
        return ~(_pairs_shown(self.display) | _pairs_shown(self.speech))

    @property
    def closures(self) -> list[tuple[float, float]]:
        """When the lips have to be closed."""
        return [(s.start, s.end) for s in self.score.lips if s.targets.get("lip_seal", 0.0) >= 1.0]

    @property
    def rounded(self) -> Array:
        """The middles of the rounded phones, shape (m,)."""
        lips = self.score.lips
        times = [(s.start + s.end) / 2 for s in lips if s.targets.get("lip_protrusion", 0.0) >= ROUNDED]
        return np.array(times)

    @cached_property
    def rounded_widths(self) -> list[float]:
        """How wide the mouth is at the rounded phones without the emotion, mm."""
        speech = blend.Plan(replace(self.score, movements=()), load_lip_rig())
        return [machine().width(values) for values in speech.at(self.rounded)]

    def combined(self, policy: str, guarded: bool = True) -> blend.Plan:
        """Return the score combined by a policy, with the lips' limits and contact goals or without."""
        settings = replace(self.score.settings, conflict=policy, contact=guarded)
        lips = self.score.lips if guarded else tuple(replace(s, limits={}) for s in self.score.lips)
        return blend.Plan(replace(self.score, lips=lips, settings=settings), load_lip_rig())


def cases(sentences: Iterable[str], emotion: str) -> list[Case]:
    """Return the sentences under an emotion at full strength."""
    settings = Settings(lively=False)
    found = []
    for sentence in sentences:
        script = read_script(sentence, text=True)
        utterance = synthesize_script(script)
        found.append(Case(utterance, compose(script, utterance, (Display(emotion, 1.0),), settings)))
    return found


@dataclass
class Result:
    """What one policy does, summed over performances; `*_s` in seconds, `*_mm` in millimetres."""

    closures: int = 0
    held: int = 0
    worst_gap_mm: float = 0.0
    frames: int = 0
    conflicting: int = 0
    strongly: int = 0
    widened_mm: float = 0.0
    rounded: int = 0
    largest_jump: float = 0.0
    speech_s: float = 0.0
    cycles: dict[str, int] = field(default_factory=lambda: defaultdict(int))
    seconds: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    kept: dict[str, list[float]] = field(default_factory=lambda: defaultdict(lambda: [0.0, 0.0]))

    def share(self, what: str) -> float:
        """Return a share of the display that is kept: `speaking`, `mouth speaking` or `silent`."""
        kept, whole = self.kept[what]
        return kept / whole

    def display_flutter(self) -> tuple[float, str]:
        """Return the full on/off cycles per second of speech of the busiest display's mouth, and its name."""
        return self._busiest(name for name in self.cycles if name.startswith(WHOLE))

    def flutter(self, everything: bool = False) -> tuple[float, str]:
        """Return the full on/off cycles per second of speech of the displays' busiest muscle, and its name.

        `everything`: with the muscles that speech owns, `OPENING`; else without them.
        """
        muscles = (name for name in self.cycles if not name.startswith(WHOLE))
        return self._busiest(name for name in muscles if everything or name.split()[0] not in OPENING)

    def _busiest(self, names: Iterable[str]) -> tuple[float, str]:
        return max(((self.cycles[name] / self.seconds[name], name) for name in names), default=(0.0, ""))

    def add(self, other: Result) -> None:
        """Add another result to this one."""
        self.closures += other.closures
        self.held += other.held
        self.worst_gap_mm = max(self.worst_gap_mm, other.worst_gap_mm)
        self.frames += other.frames
        self.conflicting += other.conflicting
        self.strongly += other.strongly
        self.widened_mm += other.widened_mm
        self.rounded += other.rounded
        self.largest_jump = max(self.largest_jump, other.largest_jump)
        self.speech_s += other.speech_s
        for name, seconds in other.seconds.items():
            self.seconds[name] += seconds
        for name, count in other.cycles.items():
            self.cycles[name] += count
        for what, (kept, whole) in other.kept.items():
            self.kept[what][0] += kept
            self.kept[what][1] += whole


class Machine:
    """The face, measured in millimetres."""

    def __init__(self) -> None:
        head = load_head("standard")
        self._solver, self._gauge = FaceSolver(head), Gauge(head)

    def gap(self, values: Array) -> float:
        """Return how far the lips are apart."""
        return self._gauge.measure(self._solver.solve(values)).lip_gap_mm

    def width(self, values: Array) -> float:
        """Return the mouth's width."""
        return self._gauge.measure(self._solver.solve(values)).mouth_width_mm


@cache
def machine() -> Machine:
    """Return the one machine."""
    return Machine()


def measure(case: Case, emotion: str, policy: str, guarded: bool) -> Result:
    """Return what a policy makes of a case."""
    made = case.combined(policy, guarded)
    values = made.at(case.times)
    result = Result(frames=len(case.times), speech_s=float(case.speaking.sum() / FPS))
    result.conflicting = int((_pairs_shown(values) & case.apart).any(axis=1).sum())
    result.strongly = int((_pairs_shown(values, STRONG) & case.apart).any(axis=1).sum())
    result.largest_jump = float(np.abs(np.diff(values[:, MUSCLES], axis=0)).max())
    _close(result, case, made)
    _round(result, case, made)
    _count_cycles(result, case, emotion, values)
    _weigh_display(result, case, values)
    return result


def _close(result: Result, case: Case, made: blend.Plan) -> None:
    for start, end in case.closures:
        gap = max(machine().gap(values) for values in made.at(np.linspace(start, end, SAMPLES)))
        result.closures += 1
        result.held += gap <= HELD_MM
        result.worst_gap_mm = max(result.worst_gap_mm, gap)


def _round(result: Result, case: Case, made: blend.Plan) -> None:
    for values, alone in zip(made.at(case.rounded), case.rounded_widths, strict=True):
        result.widened_mm += abs(machine().width(values) - alone)
        result.rounded += 1


def _pairs_shown(values: Array, level: float | None = None) -> BoolArray:
    """Return which conflicting pairs are both above a level, else their thresholds, (n, 46) -> (n, pairs)."""
    thresholds = np.array([p.threshold if level is None else level for p in PARAMETERS])
    above = values > thresholds + HAIR
    return np.stack([above[:, a] & above[:, b] for a, b in PAIRS], axis=1)


def _count_cycles(result: Result, case: Case, emotion: str, values: Array) -> None:
    shown = [i for i in MUSCLES if case.display[:, i].max() >= DISPLAYED]
    mouth = [i for i in shown if NAMES[i] in MOUTH]
    counted = {f"{NAMES[i]} ({emotion})": [i] for i in shown} | {f"{WHOLE} ({emotion})": mouth}
    for name, columns in counted.items():
        result.seconds[name] += float(case.speaking.sum() / FPS)
        level = case.display[:, columns].sum(axis=1)
        result.cycles[name] += cycles(values[:, columns].sum(axis=1), level)


def cycles(shown: Array, level: Array) -> int:
    """Return how often a muscle falls below DARK and rises again above LIT of its own level, both (n,).

    Only while the display holds: its own onset and offset do not count.
    """
    held = level >= LIT * level.max()
    low, high = held & (shown < DARK * level), held & (shown > LIT * level)
    lit = high[low | high]
    lit = lit[int(np.argmax(lit)) :] if lit.any() else lit[:0]
    return sum(not before and after for before, after in pairwise(lit.tolist()))


def _weigh_display(result: Result, case: Case, values: Array) -> None:
    for i in MUSCLES:
        level = case.display[:, i]
        kept = np.minimum(values[:, i], level)
        for what, chosen in (("speaking", case.speaking), ("silent", ~case.speaking)):
            for group in (what, f"mouth {what}") if NAMES[i] in MOUTH else (what,):
                result.kept[group][0] += float(kept[chosen].sum())
                result.kept[group][1] += float(level[chosen].sum())
