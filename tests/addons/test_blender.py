"""The add-on in Blender itself, in a process of its own: shape keys, head and sound of a take."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import risorius

ROOT = Path(__file__).parents[2]
ADDONS = ROOT / "addons/blender"
PACKAGES = "RISORIUS_BLENDER"
"""The environment's variable with the folder of Blender's module: `scripts/check --full` sets it."""


@pytest.mark.full
@pytest.mark.skipif(PACKAGES not in os.environ, reason="Blender's module is not there")
def test_a_take_moves_an_imported_head_as_its_own_animation_does(tmp_path: Path) -> None:
    settings = risorius.Settings(dynamics="static")
    take = risorius.speak("No, my mother!", emotion={"happiness": 0.6}, settings=settings)
    take.write(*(tmp_path / f"x.{suffix}" for suffix in ("rig.glb", "arkit.csv", "wav")))
    command = [sys.executable, str(Path(__file__).with_name("in_blender.py")), str(ADDONS), str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": os.environ[PACKAGES]}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["done"] == ["FINISHED"]
    assert result["keys"] == 52
    assert result["off"] < 1e-6
    assert result["own"] > 2.0  # the head turns, and ours turns alike
    assert result["turned"] < 0.1
    assert result["sounds"] == ["x", "x.001"]
    assert result["rate"] == [30, 1.0]  # of the take; the scene had 24
    assert result["left alone"] == [24, 25]  # if the user wants so, or nothing was imported
    assert "x.arkit.csv: fits no shape key" in result["refused"]
    assert "x.wav: is not a performance; expected .arkit.csv or .performance.json" in result["refused"]


def test_the_manifest_has_the_version_of_the_library() -> None:
    manifest = tomllib.loads((ADDONS / "risorius_performance/blender_manifest.toml").read_text())
    assert manifest["version"] == risorius.__version__
    assert manifest["id"] == "risorius_performance"
