"""Published figures of how lips and jaw move, beside ours: a table of value, source, ours.

Ours are measured on the standard head's mesh: vowels held, the rest in sentences said by the default voice.
How much of a labial stop is closure is compared with hand labels, where FOLDER has them (`timit.py`). Run
from the repository:
    PYTHONPATH=src python benchmarks/lips_published.py [FOLDER] [--sentences 6]
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
from lips_dynamics import SENTENCES, STEP, spoken
from lips_measures import COLUMNS, machine
from timit import RATE

from risorius import blend
from risorius.channels.tempo import fullness_of_phones
from risorius.core.movement import LipSegment
from risorius.core.score import Score
from risorius.core.speech.utterance import Accent, Syllable, Utterance
from risorius.face.fit.lip_file import load_lip_rig
from risorius.pipeline import compose
from risorius.rules.lips import lip_table
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

STOPS = (("p", "pcl"), ("b", "bcl"))
SAID = "Put it on the map."
Row = tuple[str, str, str, float]
VTL = "VocalTractLab JD3, MRI of a German speaker"
GRETA = "Greta's lip model, means over contexts"
FACTS = "measured on speakers (facts: lips, {})"


@cache
def held(phone: str) -> dict[str, float]:
    """Return what the mouth measures in a phone that lasts, against rest, mm."""
    score = Score(4.0, lips=(LipSegment(phone, 0.5, 3.5, lip_table().shape(phone).targets),))
    now, rest = machine().mouth(blend.at(score, np.array([2.0, 0.0]), load_lip_rig()))
    return dict(zip(COLUMNS, (now - rest).tolist(), strict=True))


def between(measure: str, phone: str, low: str, high: str) -> float:
    """Return where a phone stands from one (0) to another (1) in a measure."""
    value, least, most = (held(p)[measure] for p in (phone, low, high))
    return (value - least) / (most - least)


def vowels() -> Iterator[Row]:
    """Yield the rows of vowels, relative to one another: speakers differ in size."""
    for phone, published in (("IY", 0.27), ("EH", 0.76), ("AO", 0.62)):
        yield f"jaw, {phone} from UW to AA", f"{published:.2f}", GRETA, between("jaw", phone, "UW", "AA")
    for phone, published in (("AO", 0.26), ("UW", 0.34)):
        ratio = held(phone)["gap"] / held("AA")["gap"]
        yield f"lip gap, {phone} to AA", f"{published:.2f}", VTL, ratio
    for phone, published in (("AO", 0.56), ("AA", 0.07), ("IY", 0.08)):
        ratio = held(phone)["protrusion"] / held("UW")["protrusion"]
        yield f"protrusion, {phone} to UW", f"{published:.2f}", VTL, ratio
    yield "width, AO from UW to IY", "0.41", GRETA, between("width", "AO", "UW", "IY")


def prosody() -> Iterator[Row]:
    """Yield how far the jaw drops in "map" stressed, under focus and at the end of a phrase, to neither."""
    utterance = synthesize_script(read_script(SAID, text=True))
    number = next(k for k, s in enumerate(utterance.syllables) if s.stress > 0 and _has(utterance, s, "AE"))
    plain = tuple(replace(s, prominence=0.0) for s in utterance.syllables)
    bare = replace(utterance, accents=(), pauses=(), syllables=plain)
    accent = Accent(utterance.syllables[number].start, utterance.syllables[number].word, number)
    # The rate of the sentence opens its phones, too; beside that.
    tempo = fullness_of_phones(bare, lip_table())[utterance.syllables[number].first_phone]
    plain_jaw = lip_table().shape("AE").targets["jaw_drop"] * tempo
    for what, published, fact, said in (
        ("of a stressed vowel", "1.15", 6, bare),
        ("under focus", "1.33", 11, replace(bare, accents=(accent,))),
    ):
        yield f"jaw {what}, to neither", published, FACTS.format(fact), jaw_asked(said) / plain_jaw
    final = replace(bare, pauses=utterance.pauses)
    yield (
        "jaw at a phrase's end, to its middle", "1.20", FACTS.format(11), jaw_asked(final) / jaw_asked(bare)
    )  # fmt: skip


def _has(utterance: Utterance, syllable: Syllable, symbol: str) -> bool:
    held = utterance.phones[syllable.first_phone : syllable.last_phone]
    return any(p.symbol == symbol for p in held)


def jaw_asked(utterance: Utterance) -> float:
    """Return the jaw drop that the vowel of "map" asks for, mm."""
    score = compose(read_script(SAID, text=True), utterance, (), Settings(lively=False))
    return next(s.targets["jaw_drop"] for s in score.lips if s.phone == "AE")


def movement(count: int) -> Iterator[Row]:
    """Yield how fast the gap opens and closes, and how fast still where the lips meet."""
    curves = [spoken(sentence, 175, "effort").gap for sentence in SENTENCES[:count]]
    speed = np.concatenate([np.abs(np.diff(curve)) / STEP for curve in curves])
    source = FACTS.format(8)
    yield "lip gap's speed, 99.9th percentile, mm/s", "150-310", source, float(np.percentile(speed, 99.9))
    met = [share for curve in curves for share in _speed_at_contact(curve)]
    source = "Lofqvist and Gracco 1996: close to the peak"
    yield "speed 10 ms before the lips meet, to the peak", "near 1", source, float(np.mean(met))


def _speed_at_contact(curve: np.ndarray) -> Iterator[float]:
    """Yield for each closure the closing speed two steps before contact, relative to its peak before it."""
    for k in np.flatnonzero((curve[:-1] > 0.2) & (curve[1:] <= 0.2)):
        closing = -np.diff(curve[max(k - 24, 0) : k + 1])
        if len(closing) > 4 and closing.max() > 0.2:
            yield float(closing[-2] / closing.max())


def closures(folder: Path, stops: Sequence[tuple[str, str]] = STOPS) -> Iterator[Row]:
    """Yield what share of a labial stop is closure, by the names of its burst and its closure."""
    for stop, closed in stops:
        files = sorted(folder.rglob("*.[Pp][Hh][Nn]"))
        shut, burst = np.array([lengths for path in files for lengths in _stops(path, stop, closed)]).T
        source = f"TIMIT, {len(shut)} stops labelled by hand, closure {1e3 * shut.mean():.0f} ms"
        table = lip_table()
        at_onset = table.at_onset(stop.upper(), table.shape(stop.upper()))
        # About as many of them begin a word as do not.
        ours = 0.5 * (table.shape(stop.upper()).closure + at_onset.closure)
        yield f"closure's share of /{stop}/", f"{shut.sum() / (shut + burst).sum():.2f}", source, ours


def _stops(path: Path, stop: str, closed: str) -> Iterator[tuple[float, float]]:
    """Yield the seconds of closure and burst of each stop of a label file."""
    rows = [(int(a), int(b), name) for a, b, name in map(str.split, path.read_text().splitlines())]
    for (a, b, first), (_, c, second) in pairwise(rows):
        if (first, second) == (closed, stop):
            yield (b - a) / RATE, (c - b) / RATE


def table(folder: Path | None, count: int) -> Sequence[Row]:
    """Return all rows."""
    return [*vowels(), *prosody(), *movement(count), *(closures(folder) if folder else ())]


def main() -> None:
    """Print the table as it stands in `docs/lips.md`."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--sentences", type=int, default=6)
    options = parser.parse_args()
    print("| what | published | source | ours |\n| --- | --- | --- | --- |")
    for what, published, source, ours in table(options.folder, options.sentences):
        print(f"| {what} | {published} | {source} | {ours:.{0 if ours > 10.0 else 2}f} |", flush=True)


if __name__ == "__main__":
    main()
