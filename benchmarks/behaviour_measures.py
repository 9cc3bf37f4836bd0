"""What the benchmark of behaviour measures on a performance: blinks, gaze, head, brows, as studies do."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from risorius import blend
from risorius.core.arrays import Array, BoolArray
from risorius.core.score import Score
from risorius.core.speech.utterance import PauseKind, Utterance
from risorius.face.fit.lip_file import load_lip_rig

FPS = 500
# Looking so near straight ahead is looking at the listener's face; looks away that are shorter do not count.
FACE, SHORTEST = 6.0, 0.15
# A head that turns slower than this stands still, degrees a second.
STILL = 1.0
NEAR = 0.33


@dataclass(frozen=True)
class Clip:
    """A performance, sampled."""

    said: Utterance
    curves: dict[str, Array]

    @property
    def speaking(self) -> BoolArray:
        """Which frames lie in words or short pauses."""
        times = np.arange(len(self.curves["head_yaw"])) / FPS
        inside = np.zeros(len(times), dtype=bool)
        for word in self.said.words:
            inside |= (times >= word.start) & (times < word.end)
        return inside

    @property
    def pausing(self) -> BoolArray:
        """Which frames lie in pauses that end an utterance, a quarter of a second in."""
        times = np.arange(len(self.curves["head_yaw"])) / FPS
        inside = np.zeros(len(times), dtype=bool)
        for pause in self.said.pauses:
            if pause.kind in (
                PauseKind.FULL_STOP,
                PauseKind.QUESTION,
                PauseKind.EXCLAMATION,
                PauseKind.FINAL,
            ):
                inside |= (times >= pause.start + 0.25) & (times < pause.end)
        return inside


def sampled(score: Score, said: Utterance) -> Clip:
    """Return the clip of a score."""
    return Clip(said, blend.combine(score, Fraction(FPS), load_lip_rig()).curves)


def _runs(flags: BoolArray) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate(([0], flags.astype(int), [0]))))
    return [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def blinks(clip: Clip) -> list[tuple[float, float, float, float]]:
    """Return each blink's start, seconds of closing, seconds in all and depth 0..1."""
    lid = clip.curves["orbicularis_oculi_palpebralis.left"]
    found = []
    for a, b in _runs(lid > 0.02):
        part = lid[a:b]
        if part.max() >= 0.5:
            peak = int(np.argmax(part))
            found.append((a / FPS, peak / FPS, (b - a) / FPS, float(part.max())))
    return found


def gaze_angle(clip: Clip) -> Array:
    """Return degrees between gaze in the world and the listener."""
    c = clip.curves
    return np.hypot(c["gaze_pitch"] + c["head_pitch"], c["gaze_yaw"] + c["head_yaw"])


def visits(clip: Clip) -> tuple[list[float], list[float]]:
    """Return seconds of each look at the listener and of each look away."""
    at = gaze_angle(clip) < FACE
    for a, b in _runs(~at):
        if b - a < SHORTEST * FPS:
            at[a:b] = True
    return ([(b - a) / FPS for a, b in _runs(at)], [(b - a) / FPS for a, b in _runs(~at)])


def saccades(clip: Clip) -> Array:
    """Return amplitude in degrees, seconds, and peak speed in degrees a second of each, shape (n, 3)."""
    c = clip.curves
    pitch, yaw = c["gaze_pitch"] + c["head_pitch"], c["gaze_yaw"] + c["head_yaw"]
    speed = np.hypot(np.gradient(pitch), np.gradient(yaw)) * FPS
    rows = []
    for a, b in _runs(speed > 15.0):
        amplitude = float(np.hypot(pitch[b - 1] - pitch[a], yaw[b - 1] - yaw[a]))
        if amplitude > 2.0:
            rows.append((amplitude, (b - a) / FPS, float(speed[a:b].max())))
    return np.array(rows).reshape(-1, 3)


def main_sequence(degrees: Array) -> Array:
    """Return the published peak speed of saccades, degrees a second (facts: Freedman 2001)."""
    return np.asarray(473.0 * (1.0 - np.exp(-degrees / 7.8)))


def accent_speeds(clip: Clip) -> tuple[float, float]:
    """Return the head's mean speed within 0.15 s of accents and elsewhere in speech, degrees a second."""
    speed = head_speed(clip)
    times = np.arange(len(speed)) / FPS
    near = _distance(times, accented(clip.said)) <= 0.15
    return float(speed[clip.speaking & near].mean()), float(speed[clip.speaking & ~near].mean())


def head_speed(clip: Clip) -> Array:
    """Return the head's speed, degrees a second."""
    c = clip.curves
    return FPS * np.sqrt(sum(np.gradient(c[n]) ** 2 for n in ("head_pitch", "head_yaw", "head_roll")))


def inner_pause_speeds(clip: Clip) -> Array:
    """Return the head's mean and highest speed in each pause between words, commas included, shape (n, 2)."""
    speed, last = head_speed(clip), clip.said.words[-1].end
    rows = []
    for pause in clip.said.pauses:
        inside = speed[round(pause.start * FPS) : round(pause.end * FPS)]
        if pause.kind is not PauseKind.INITIAL and pause.start < last and len(inside):
            rows.append((inside.mean(), inside.max()))
    return np.array(rows).reshape(-1, 2)


def accent_peaks(clip: Clip) -> Array:
    """Return the head's highest speed within 0.15 s of each accent, in speech."""
    speed = np.where(clip.speaking, head_speed(clip), 0.0)
    reach = round(0.15 * FPS)
    return np.array([speed[max(round(t * FPS) - reach, 0) :][: 2 * reach].max() for t in accented(clip.said)])


def head_power(clip: Clip, low: float, high: float) -> float:
    """Return the share of the head's movement, as power of its velocity, within a band of Hz."""
    total = part = 0.0
    for name in ("head_pitch", "head_yaw", "head_roll"):
        spectrum = np.abs(np.fft.rfft(np.gradient(clip.curves[name]))) ** 2
        hertz = np.fft.rfftfreq(len(clip.curves[name]), 1 / FPS)
        total += float(spectrum[(hertz >= 0.2) & (hertz <= 7.0)].sum())
        part += float(spectrum[(hertz >= low) & (hertz < high)].sum())
    return part / total


def brow_raises(clip: Clip) -> list[float]:
    """Return when each rise of the brows begins, seconds."""
    brow = clip.curves["frontalis_medialis.left"]
    slope = np.gradient(brow) * FPS
    found: list[float] = []
    for a, b in _runs(slope > 0.2):
        if brow[b - 1] - brow[a] > 0.12:
            found.append(a / FPS)
    return found


def nods(clip: Clip) -> list[float]:
    """Return when each quick downward movement of the head begins, seconds."""
    pitch = clip.curves["head_pitch"]
    slope = np.gradient(pitch) * FPS
    return [a / FPS for a, b in _runs(slope < -6.0) if pitch[a] - pitch[b - 1] > 1.0]


def accented(said: Utterance) -> Array:
    """Return where accented syllables begin, seconds."""
    return np.array([said.syllables[a.syllable].start for a in said.accents])


def sentence_ranges(clip: Clip) -> list[float]:
    """Return the range of the head's pitch over each stretch between full pauses, degrees."""
    ranges, first = [], 0.0
    ends = [p.start for p in clip.said.pauses if p.kind not in (PauseKind.COMMA, PauseKind.INITIAL)]
    for end in ends:
        part = clip.curves["head_pitch"][round(first * FPS) : round(end * FPS)]
        if end - first > 1.0:
            ranges.append(float(part.max() - part.min()))
        first = end
    return ranges


def _distance(times: Array, events: Array) -> Array:
    """Return how far each time is from the event nearest to it, seconds."""
    after = np.clip(np.searchsorted(events, times), 1, len(events) - 1)
    return np.minimum(np.abs(times - events[after - 1]), np.abs(events[after] - times))


def aligned(events: list[float], targets: Array, window: float = 0.15) -> float:
    """Return the share of targets with an event within `window` seconds."""
    if not events or not len(targets):
        return 0.0
    distance = np.abs(np.subtract.outer(targets, np.array(events))).min(axis=1)
    return float(np.mean(distance <= window))
