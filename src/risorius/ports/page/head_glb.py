"""The head at rest as a `.glb` file, its vertices in the order of the frames."""

from __future__ import annotations

import tempfile
from pathlib import Path

from ..mesh.glb_scene import GlbScene
from ..mesh.gltf import Gltf
from .face_packer import FacePacker


def head_glb(stage: FacePacker) -> bytes:
    """Return the file."""
    gltf = Gltf(generator="Risorius", copyright="Head: CC0 1.0")
    GlbScene(stage.head, gltf, stage.head_parts, lit=True).build()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "head.glb"
        gltf.save(path)
        return path.read_bytes()
