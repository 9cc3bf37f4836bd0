"""Compare exported files, as outside programs read them, with our own face.

    python benchmarks/abroad.py [--heads standard amara …] [--sentences 4] [--full] [--keep FOLDER]

Each file of some sentences, neutral and with emotions, is evaluated by outside readers and compared with our
own face, frame by frame. A line for each pair of format and reader states the worst over all sentences
(`abroad_measures.Loss` says what each column is); lips are measured at 19 places from corner to corner, over
what they are apart at rest.

Readers: pygltflib with numpy and usd-core (pip install ".[bench]"), three.js and three-vrm under node (npm
install --prefix build/node three@0.187.0 @pixiv/three-vrm@3.5.5 @pixiv/three-vrm-animation@3.5.5, or where
RISORIUS_NODE_MODULES says), and with --full Blender (its module where RISORIUS_BLENDER says). A reader that
is not there is named and left out. FAP and action units have no outside reader: our own reads them.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import astuple, fields, replace
from functools import partial
from pathlib import Path

import numpy as np
from abroad_cues import closures_in_visemes
from abroad_cues import show as show_closures
from abroad_measures import Gauges, Loss, Own, Seen
from abroad_readers import (
    MissingReaderError,
    Reader,
    by_blender,
    by_csv,
    by_pygltflib,
    by_three,
    by_three_vrm,
    by_usd_core,
)

import risorius
from risorius.take import Take

SENTENCES: tuple[tuple[str, dict[str, float]], ...] = (
    ("My baby brother put the map by the beam.", {}),
    ("Five brave men found a very fine view above the ferry.", {"happiness": 0.8}),
    ("Oh no, where did my maps and my papers go?", {"surprise": 0.8}),
    ("Stop it, Bob. Nobody ever pays for the boat.", {"anger": 0.8}),
    ("I miss my mother. May we phone home before we move?", {"sadness": 0.8}),
    ("A bumpy bus brought the whole family up the mountain.", {}),
)
SHAPES = "shapes.vrma"
"""The suffix of the animation with `--names arkit`; that without has VRM's presets."""
FILES = (
    "rig.glb",
    "glb",
    "arkit.csv",
    "usda",
    "vrma",
    "fap",
    "au.csv",
    "oculus.csv",
    "visemes.json",
    "azure.json",
)
"""Suffixes; the rig comes first, for others are shown on it."""


def by_risorius(path: Path, gauges: Gauges) -> Seen:
    """Play a file on our own head: for formats that have no outside reader here."""
    take = risorius.play(path, settings=risorius.Settings(head=gauges.head.name, dynamics="static"))
    return gauges.own(take.faces()).seen


READERS: tuple[tuple[str, str, Reader], ...] = (
    ("rig.glb", "pygltflib", by_pygltflib),
    ("rig.glb", "three.js", by_three),
    ("glb", "pygltflib", by_pygltflib),
    ("glb", "three.js", by_three),
    ("arkit.csv", "csv, on the rig's shapes", by_csv),
    ("usda", "usd-core", by_usd_core),
    ("vrma", "three-vrm, presets", partial(by_three_vrm, expressions="presets")),
    ("shapes.vrma", "three-vrm, 52 shapes", partial(by_three_vrm, expressions="shapes")),
    ("fap", "Risorius", by_risorius),
    ("au.csv", "Risorius", by_risorius),
)
IN_BLENDER: tuple[tuple[str, str, Reader], ...] = tuple(
    (suffix, "Blender", by_blender) for suffix in ("rig.glb", "glb", "usda")
)


def write(take: Take, folder: Path) -> None:
    """Write all files of a take."""
    take.write(*(folder / f"x.{suffix}" for suffix in FILES))
    replace(take, settings=replace(take.settings, names="arkit")).write(folder / f"x.{SHAPES}")


def losses(
    own: Own, gauges: Gauges, folder: Path, readers: Sequence[tuple[str, str, Reader]]
) -> Iterator[tuple[str, Loss]]:
    """Yield what each file in `folder` loses, as each reader shows it."""
    yield "our own face", gauges.loss(own.seen, own)
    for suffix, name, read in readers:
        seen = read(folder / f"x.{suffix}", gauges)
        yield f".{suffix:10} {name}", gauges.loss(_as_long(seen, own), own)


def _as_long(seen: Seen, own: Own) -> Seen:
    """Leave out what a reader shows after our last frame; raise ValueError if it shows less."""
    count = len(own.sealed)
    if len(seen.skin) < count:
        raise ValueError(f"shows {len(seen.skin)} frames of {count}")
    return Seen(seen.skin[:count], seen.head[:count], None if seen.looks is None else seen.looks[:count])


def usable(readers: Sequence[tuple[str, str, Reader]], folder: Path) -> Iterator[tuple[str, str, Reader]]:
    """Yield the readers that are installed; name the others."""
    take = risorius.speak("Hm.", settings=risorius.Settings(dynamics="static"))
    write(take, folder)
    gauges = Gauges(take.head)
    for suffix, name, read in readers:
        try:
            read(folder / f"x.{suffix}", gauges)
        except MissingReaderError as error:
            print(f"left out: .{suffix} by {name}: {error}")
        else:
            yield suffix, name, read


def show(worst: dict[str, list[Loss]]) -> None:
    """Print the worst of each column, and the root mean square of `rms`."""
    names = [field.name for field in fields(Loss)]
    print(f"{'':38}" + "".join(f"{name:>9}" for name in names))
    for label, rows in worst.items():
        table = np.array([astuple(row) for row in rows])
        least = np.where(np.isnan(table), -np.inf, table).max(axis=0)
        least[-1] = np.sqrt((table[:, -1] ** 2).mean())
        print(f"{label:38}" + "".join(f"{x:9.2f}" if np.isfinite(x) else f"{'-':>9}" for x in least))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--heads", nargs="+", default=["standard"])
    parser.add_argument("--sentences", type=int, default=len(SENTENCES), help="how many of the sentences")
    parser.add_argument("--full", action="store_true", help="in Blender, too")
    parser.add_argument("--keep", type=Path, help="a folder for the files, which else are removed")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        readers = tuple(usable((*READERS, *(IN_BLENDER if asked.full else ())), Path(scratch)))
        worst: dict[str, list[Loss]] = {}
        closures = []
        for head in asked.heads:
            for number, (text, emotion) in enumerate(SENTENCES[: asked.sentences]):
                folder = (asked.keep or Path(scratch)) / f"{head}-{number}"
                folder.mkdir(parents=True, exist_ok=True)
                take = risorius.speak(text, emotion=emotion, settings=risorius.Settings(head=head))
                write(take, folder)
                gauges = Gauges(take.head)
                own = gauges.own(take.faces())
                for label, loss in losses(own, gauges, folder, readers):
                    worst.setdefault(label, []).append(loss)
                closures.append(closures_in_visemes(folder, take.times, own.sealed))
    show(worst)
    show_closures(closures)


if __name__ == "__main__":
    main()
