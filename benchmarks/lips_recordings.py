"""Lips from recordings: closures where the sound says, words in time, and no transcript worse than loudness.

FOLDER is laid out as TIMIT (`timit.py`). The recordings are aligned with their words. Prints
- of the closures of /p b m/ (`pcl`, `bcl`, `m`, `em`, labelled by hand) the share whose middle, start and end
  lie within 30 ms of those of our shut lips, which are taken from the curves at 200 fps. Beside silence
  only the other edge counts: lips at rest are shut, before a first /m/ as after a last one;
- of the starts and ends of words the share within 50 ms of the hand's;
- r of the lip gap that recognized phones (no transcript) and loudness alone make, with the gap of labels by
  hand, at 50 fps.
Run from the repository (a few minutes):
    PYTHONPATH=src python benchmarks/lips_recordings.py FOLDER [--sentences 80] [--aligned-only]
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from lips_timing import gap as gap_of_labels
from timit import RATE, Sentence, sentences

from risorius import blend
from risorius.channels import ChannelInputs, compose
from risorius.core.arrays import Array
from risorius.core.channels import CHANNELS
from risorius.core.lips.lip_rig import gap_left
from risorius.core.parameters import INDEX, NAMES
from risorius.core.speech.audio import Audio
from risorius.core.speech.utterance import Utterance
from risorius.face.fit.lip_file import load_lip_rig
from risorius.speech import Recording, align_recording
from risorius.speech.alignment import align
from risorius.speech.recordings.recording import read_recording

FPS, COARSE = 200.0, 50.0
CLOSURES = ("pcl", "bcl", "m", "em")
SILENT = ("h#", "pau")
NEAR, WORD = 0.03, 0.05
SHUT_MM = 0.05
APART = 0.15
"""Seconds within which the nearest shut lips are looked for."""


class Span(NamedTuple):
    """A time from `start` to `end`, seconds."""

    start: float
    end: float


def labelled(sentence: Sentence, suffix: str, names: Sequence[str] = ()) -> list[Span]:
    """Return the spans in a file of labels by hand beside the recording, of some names or of all."""
    (path,) = (
        p for p in sentence.sound.parent.glob(f"{sentence.sound.stem}.*") if p.suffix.lower() == suffix
    )
    rows = [line.split() for line in path.read_text().splitlines()]
    return [Span(int(a) / RATE, int(b) / RATE) for a, b, name in rows if not names or name in names]


def lip_gap(utterance: Utterance, fps: float, seconds: float) -> Array:
    """Return the gap in mm that the lips of an utterance leave, by the head's rig."""
    others = [name for name in CHANNELS if name not in ("lips", "manual")]
    score = compose(ChannelInputs(utterance.duration, utterance, lively=False), without=others)
    rig = load_lip_rig()
    values = blend.at(score, np.arange(0.0, seconds, 1.0 / fps), rig)
    curves = {name: values[:, INDEX[name]] for name in NAMES}
    return gap_left(rig.gap(curves), curves["lip_seal"])


def shut(gap: Array) -> list[Span]:
    """Return when a gap at `FPS` is shut."""
    closed = np.concatenate([[False], gap <= SHUT_MM, [False]])
    edges = np.flatnonzero(closed[1:] != closed[:-1]) / FPS
    return [Span(float(a), float(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def merged(spans: Sequence[Span]) -> list[Span]:
    """Return sorted spans with those less than `NEAR` apart as one: "mb", a burst between two closures."""
    joined: list[Span] = []
    for span in spans:
        if joined and span.start - joined[-1].end <= NEAR:
            span = Span(joined.pop().start, span.end)
        joined.append(span)
    return joined


def errors(
    wanted: Sequence[Span], ours: Sequence[Span], silent: Sequence[Span]
) -> Iterator[tuple[float, float, float]]:
    """Yield how late the middle, start and end of our nearest span are; infinite if there is none.

    NaN is what a silence beside the span leaves open.
    """
    for span in wanted:
        middle = sum(span) / 2.0
        begins, ends = (any(edge in s for s in silent) for edge in span)
        away = min(ours, key=lambda s, span=span: _distance(s, span), default=Span(np.inf, np.inf))
        if not _distance(away, span) <= APART:
            yield (np.inf,) * 3
            continue
        yield (
            np.nan if begins or ends else sum(away) / 2.0 - middle,
            np.nan if begins else away.start - span.start,
            np.nan if ends else away.end - span.end,
        )


def _distance(one: Span, two: Span) -> float:
    """Return how far apart the nearer edges of two spans are."""
    return min(abs(one.start - two.start), abs(one.end - two.end))


def loudness(audio: Audio, seconds: float) -> Array:
    """Return the root of the sound's power, smoothed over 60 ms, at `COARSE` fps."""
    sound = audio.read().astype(np.float64)
    window = np.hanning(round(0.06 * audio.sample_rate) | 1)
    power = np.convolve(sound**2, window / window.sum(), "same")
    return np.sqrt(
        np.interp(np.arange(0.0, seconds, 1.0 / COARSE), np.arange(len(sound)) / audio.sample_rate, power)
    )


def share(late: Array, within: float) -> str:
    late = late[~np.isnan(late)]
    near = 100 * (np.abs(late) <= within).mean()
    return f"{near:5.1f} % of {len(late)} (median {1000 * np.median(late):+.0f} ms)"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sentences", type=int, default=80)
    parser.add_argument("--aligned-only", action="store_true", help="recognize nothing: half the time")
    options = parser.parse_args()
    closures: list[tuple[float, float, float]] = []
    edges: list[float] = []
    alike: list[tuple[float, float]] = []
    for sentence in list(sentences(options.folder))[: options.sentences]:
        audio = read_recording(sentence.sound)
        aligned = align(audio, sentence.text)
        gap = lip_gap(aligned, FPS, audio.duration)
        hand = merged(labelled(sentence, ".phn", CLOSURES))
        closures += errors(hand, shut(gap), labelled(sentence, ".phn", SILENT))
        words = labelled(sentence, ".wrd")
        if len(words) == len(aligned.words):
            pairs = zip(aligned.words, words, strict=True)
            edges += [x for ours, hand in pairs for x in (ours.start - hand.start, ours.end - hand.end)]
        if options.aligned_only:
            continue
        seconds = sentence.labels[-1].end - 1.0 / COARSE
        by_hand = gap_of_labels(sentence.labels, seconds)
        _, recognized = align_recording(Recording(str(sentence.sound)))
        ways = lip_gap(recognized, COARSE, seconds), loudness(audio, seconds)
        alike.append(tuple(float(np.corrcoef(by_hand, way)[0, 1]) for way in ways))
    middle, start, end = np.array(closures).T
    print(
        f"{len(middle)} closures of /p b m/ within {1000 * NEAR:.0f} ms: middle {share(middle, NEAR)}, "
        f"start {share(start, NEAR)}, end {share(end, NEAR)}; asked 90 %"
    )
    print(
        f"{len(edges)} edges of words within {1000 * WORD:.0f} ms: {share(np.array(edges), WORD)}; asked 95 %"
    )
    if options.aligned_only:
        return
    recognized_r, loudness_r = np.mean(alike, axis=0)
    print(
        f"no transcript, r of the gap with that of labels by hand: {recognized_r:.3f}; loudness alone "
        f"{loudness_r:.3f}; asked: no worse"
    )


if __name__ == "__main__":
    main()
