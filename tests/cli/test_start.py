"""What a command loads before it writes: each output only what it needs, so that short ones begin soon."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

SIGNALS = {"scipy.signal", "scipy.stats", "scipy.interpolate", "scipy.optimize"}
"""What scipy imports slowly, and nothing of ours needs for a performance."""
FACE = {
    "numba",
    "llvmlite",
    "scipy.ndimage",
    "scipy.spatial",
    "scipy.sparse",
    "risorius.face.solve",
    "risorius.render",
    "PIL",
}

RECORDINGS = {"risorius.speech.from_recording", "risorius.speech.alignment", "risorius.speech.recordings"}
"""Readers and aligners of recordings, which a text has no use for."""


@pytest.mark.parametrize(
    ("outputs", "unneeded"),
    [
        (["x.TextGrid", "x.muscles.csv"], SIGNALS | FACE | RECORDINGS),
        pytest.param(["x.png"], SIGNALS | {"numba"}, marks=pytest.mark.full),
    ],
    ids=["speech and curves", "picture"],
)
def test_outputs_load_only_what_they_need(outputs: list[str], unneeded: set[str], tmp_path: Path) -> None:
    picture = ["--size", "32x32", "--at", "0"] if "x.png" in outputs else []
    arguments = ["speak", "Hi.", *picture, *(part for output in outputs for part in ("-o", output))]
    code = f"import sys; from risorius.cli import run; assert run({arguments}) == 0; print(*sys.modules)"
    ended = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert all((tmp_path / output).exists() for output in outputs)
    assert not unneeded & set(ended.stdout.split())


def test_a_command_looks_for_garbage_seldom_and_not_at_its_end() -> None:
    code = (
        "import atexit, gc, sys; from risorius.cli import main; sys.argv[1:] = ['--version'];"
        "atexit.register(lambda: print(gc.get_threshold()[0], gc.get_freeze_count())); main()"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    objects, frozen = map(int, ended.stdout.split()[-2:])
    assert objects > 2_000
    assert frozen > 10_000


def test_a_film_is_begun_without_what_speaks() -> None:
    code = (
        "import sys; from risorius import speaking; from risorius.cli import run;"
        "speaking.speak_and_prepare = lambda *_: print(*sys.modules) or sys.exit();"
        "run(['speak', 'Hi.', '-o', 'x.mp4'])"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(ended.stdout.split())
    assert "risorius.speaking" in loaded
    assert not loaded & {"risorius.speech", "risorius.script", "risorius.blend", "risorius.face", "numpy"}
