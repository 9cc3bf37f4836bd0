"""Emotion in speech: is every phone still read from the lips, and is the display still seen?

Sixty sentences are said under six emotions at full strength and a full smile, measured on the mesh at
100 fps. Run from the repository (about twenty minutes; fewer sentences take less):
    PYTHONPATH=src OMP_NUM_THREADS=1 python benchmarks/lips.py [--sentences 60] [--lips MODEL]
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from lips_measures import DISPLAYS, Result, Spoken, measure

from risorius.settings import BlendChoices, Settings

SENTENCES = Path(__file__).with_name("lips_sentences.txt").read_text().splitlines()


def rows(result: Result) -> Iterator[tuple[str, str, bool]]:
    """Yield what is asked for, what was measured, and whether it holds."""
    closed, touching = result.closed / result.closures, result.touching / result.tucks
    yield "closures of /p b m/: 100 %", f"{100 * closed:.1f} % of {result.closures}", closed == 1.0
    yield "contact of /f v/: 99 %", f"{100 * touching:.1f} % of {result.tucks}", touching >= 0.99
    for name, found, least in (
        ("lip gap keeps SD: 0.85", result.deviation, 0.85),
        ("lip gap, r with neutral: 0.90", result.correlation, 0.9),
    ):
        yield name, f"mean {np.mean(found):.2f}, least {min(found):.2f}", float(np.mean(found)) >= least
    for name, found, least in (
        ("/w u o/ narrower than silent: 3 mm", result.narrower_mm, 3.0),
        ("/w u o/ further out than silent: 1 mm", result.further_mm, 1.0),
    ):
        share = np.mean(np.array(found) >= least)
        yield name, f"{100 * share:.1f} %, mean {np.mean(found):.1f}, least {min(found):.1f}", share == 1.0
    jaw = result.sibilant_jaw_mm
    yield (
        "jaw drop at sibilants: at most 4 mm",
        f"mean {np.mean(jaw):.1f}, most {max(jaw):.1f}",
        max(jaw) <= 4.0,
    )
    if result.widened_mm:
        kept = np.sum(result.widened_mm) / np.sum(result.widened_silent_mm)
        yield "mouth width keeps: 40 %", f"{100 * kept:.0f} %", bool(kept >= 0.4)
    upper = np.sum(result.upper_kept) / np.sum(result.upper_whole) if np.sum(result.upper_whole) else 1.0
    yield "brows and lids keep: 90 %", f"{100 * upper:.0f} %", bool(upper >= 0.9)


def main() -> None:
    """Measure and print, by display and over all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sentences", type=int, default=len(SENTENCES))
    parser.add_argument("--lips", default="effort")
    parser.add_argument("--conflict", default=BlendChoices().planned().conflict)
    parser.add_argument("--displays", nargs="+", choices=DISPLAYS, default=DISPLAYS)
    options = parser.parse_args()
    blend = BlendChoices(conflict=options.conflict, lips=options.lips)
    found = {display: Result() for display in options.displays}
    for sentence in SENTENCES[: options.sentences]:
        spoken = Spoken.of(sentence, Settings(lively=False, blend=blend))
        for display in options.displays:
            found[display].add(measure(spoken, display))
    total = Result()
    for display, result in found.items():
        total.add(result)
        print_rows(display, result)
    print_rows("all", total)


def print_rows(title: str, result: Result) -> None:
    """Print one table."""
    print(f"\n{title}")
    for name, value, holds in rows(result):
        print(f"  {'ok  ' if holds else 'FAIL'} {name:40s} {value}", flush=True)


if __name__ == "__main__":
    main()
