"""Binary glTF 2.0, piece by piece (Khronos Group, glTF 2.0 specification)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...core.arrays import AnyArray, Array, Float32Array, FloatArray
from ...reading.json_text import JsonObject
from ..export_source import WritableTake
from .glb_file import GlbFile, save_glb

_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
_COMPONENTS = {
    np.dtype(np.uint8): 5121,
    np.dtype(np.uint32): 5125,
    np.dtype(np.float32): 5126,
}
VERTICES, INDICES = 34962, 34963
_SPARSE_BELOW = 0.7  # share of moved vertices up to which the others are left out


class Gltf:
    """A document that grows: lists of objects by kind, and the bytes that they point into."""

    def __init__(self, **asset: Any) -> None:
        self.document: JsonObject = {"asset": {"version": "2.0", **asset}}
        self._bytes: list[bytes] = []
        self._size = 0

    def add(self, kind: str, entry: JsonObject) -> int:
        """Add an object to a list such as "nodes"; return its index."""
        entries = self.document.setdefault(kind, [])
        entries.append(entry)
        return len(entries) - 1

    def use(self, extension: str) -> None:
        """Say that the document uses an extension."""
        used = self.document.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def view(self, data: bytes, target: int | None = None) -> int:
        """Add bytes, aligned to four; return the index of their view."""
        padding = -self._size % 4
        self._bytes += [b"\0" * padding, data]
        start = self._size + padding
        self._size = start + len(data)
        view = {"buffer": 0, "byteOffset": start, "byteLength": len(data)}
        return self.add("bufferViews", view if target is None else {**view, "target": target})

    def accessor(self, values: AnyArray, target: int | None = None, *, normalized: bool = False) -> int:
        """Add an array (n,) or (n, components) of uint8, uint32 or float32; return its index."""
        entry = self._described(values)
        entry["bufferView"] = self.view(np.ascontiguousarray(values).tobytes(), target)
        if normalized:
            entry["normalized"] = True
        return self.add("accessors", entry)

    def sparse(self, values: AnyArray) -> int:
        """Add displacements (n, 3) float32, leaving out the vertices that do not move."""
        moved = np.flatnonzero(np.abs(values).max(axis=1) > 0.0).astype(np.uint32)
        if len(moved) > _SPARSE_BELOW * len(values):
            return self.accessor(values, VERTICES)
        entry = self._described(values)
        if len(moved):
            entry["sparse"] = {
                "count": len(moved),
                "indices": {"bufferView": self.view(moved.tobytes()), "componentType": 5125},
                "values": {"bufferView": self.view(np.ascontiguousarray(values[moved]).tobytes())},
            }
        return self.add("accessors", entry)

    def save(self, path: Path) -> None:
        """Write the document as `.glb`."""
        if self._size:
            self.document["buffers"] = [{"byteLength": self._size}]
        save_glb(GlbFile(path, self.document, b"".join(self._bytes)), path)

    @staticmethod
    def _described(values: AnyArray) -> JsonObject:
        components = 1 if values.ndim == 1 else values.shape[1]
        flat = values.reshape(len(values), components)
        return {
            "componentType": _COMPONENTS[values.dtype],
            "count": len(values),
            "type": _TYPES[components],
            "min": flat.min(axis=0).tolist(),
            "max": flat.max(axis=0).tolist(),
        }


class Animation:
    """The one animation of a document: channels on one clock, `times` (keys,) in seconds.

    Keys after the last frame hold its values.
    """

    def __init__(self, gltf: Gltf, times: Array) -> None:
        self._gltf, self._keys = gltf, len(times)
        self._clock = gltf.accessor(times.astype(np.float32))
        self._samplers: list[JsonObject] = []
        self._channels: list[JsonObject] = []

    def drive(self, node: int, path: str, values: FloatArray) -> None:
        """Let `path` ("weights", "rotation" …) of a node go straight through the values (frames, n)."""
        values = held(values, self._keys)
        if path == "weights":
            values = values.ravel()
        output = self._gltf.accessor(np.ascontiguousarray(values, np.float32))
        self._samplers.append({"input": self._clock, "output": output, "interpolation": "LINEAR"})
        self._channels.append({"sampler": len(self._samplers) - 1, "target": {"node": node, "path": path}})

    def finish(self) -> None:
        """Add it to the document."""
        entry = {"name": "performance", "channels": self._channels, "samplers": self._samplers}
        self._gltf.add("animations", entry)


def clip_times(take: WritableTake) -> Array:
    """Return the times (keys,) in seconds of a clip: those of all frames, and one more if its sound goes on.

    That is the first frame after the sound, until which the last pose holds: a player that loops the clip
    by the sound's clock would begin again before the sound ends.
    """
    times, fps = take.performance.times, take.performance.fps
    end = 0.0 if take.audio is None else take.audio.duration
    if np.float32(times[-1]) > end:
        return times
    number = int(end * fps) + 1
    if np.float32(number / fps) <= end:
        number += 1
    return np.append(times, float(number / fps))


def held(values: AnyArray, keys: int) -> AnyArray:
    """Return values (frames, …) with the last one repeated up to the number of keys."""
    return np.concatenate([values, np.repeat(values[-1:], keys - len(values), axis=0)])


def quaternion(rotation: Array) -> Array:
    """Return the unit quaternion (x, y, z, w), w not negative, of a rotation (3, 3)."""
    m = rotation
    # Bar-Itzhack 2000: the eigenvector of the largest eigenvalue is exact and never divides by zero.
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
            [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]],
        ]
    )
    vector = np.linalg.eigh(k)[1][:, -1]
    return np.asarray(vector if vector[3] >= 0.0 else -vector)


def quaternions(rotations: Sequence[Array]) -> Float32Array:
    """Return quaternions (n, 4) of rotations, each of unit length in float32."""
    rows = np.array([quaternion(rotation) for rotation in rotations], np.float32)
    return np.asarray(rows / np.linalg.norm(rows.astype(np.float64), axis=1, keepdims=True), np.float32)
