"""The same input gives the same bytes: with any number of threads, any hash seed, in any folder."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from risorius.ports.formats import FORMATS

from .profiles import everyday

SCRIPT = """<PHONEME text="Oh, really?"/><EMOTIONDISPLAY time="0" duration="1" Surprise="0.7"/>"""
RUN = "import sys; from risorius.cli import run; sys.exit(run(sys.argv[1:]))"
PLACES = [
    {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "PYTHONHASHSEED": "0"},
    {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2", "PYTHONHASHSEED": "1"},
    {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2", "PYTHONHASHSEED": "2"},
]
QUICK = [".muscles.csv", ".score.json", ".TextGrid"]
SHAPES = [suffix for suffix in FORMATS if suffix not in QUICK]


def digests(folder: Path, environment: dict[str, str], suffixes: list[str]) -> dict[str, str]:
    """Return the digests of a script's outputs, made in a folder of that name by a process of its own."""
    folder.mkdir()
    (folder / "scene.xml").write_text(SCRIPT)
    outputs = [part for suffix in suffixes for part in ("-o", f"out{suffix}")]
    options = ["--fps", "5"] + (["--size", "64x64"] if suffixes != QUICK else [])
    command = [sys.executable, "-c", RUN, "speak", "scene.xml", *options, *outputs]
    done = subprocess.run(command, cwd=folder, env=os.environ | environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return {suffix: hashlib.sha256((folder / f"out{suffix}").read_bytes()).hexdigest() for suffix in suffixes}


@pytest.mark.parametrize("suffixes", everyday([QUICK, SHAPES], [QUICK]), ids=["quick", "every"])
def test_bytes_do_not_depend_on_threads_hash_seeds_and_folders(suffixes: list[str], tmp_path: Path) -> None:
    places = PLACES if suffixes != QUICK else PLACES[:2]
    made = [digests(tmp_path / f"folder {k}", place, suffixes) for k, place in enumerate(places)]
    assert all(other == made[0] for other in made[1:])
