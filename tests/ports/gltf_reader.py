"""A second implementation of what the tests need of glTF: where vertices stand at a key of the animation."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

TYPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
KINDS = {5121: "<u1", 5125: "<u4", 5126: "<f4"}


class Document:
    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        self.json: dict[str, Any] = json.loads(data[20 : 20 + size])
        self._data = data[28 + size :]

    def node(self, name: str) -> int:
        return next(k for k, node in enumerate(self.json["nodes"]) if node["name"] == name)

    def _view(self, index: int, kind: str, count: int, width: int) -> np.ndarray:
        view = self.json["bufferViews"][index]
        values = np.frombuffer(self._data, kind, count * width, view["byteOffset"])
        return values.reshape(count, width).copy()

    def array(self, index: int) -> np.ndarray:
        accessor = self.json["accessors"][index]
        width, kind = TYPES[accessor["type"]], KINDS[accessor["componentType"]]
        if "bufferView" in accessor:
            values = self._view(accessor["bufferView"], kind, accessor["count"], width)
        else:
            values = np.zeros((accessor["count"], width), kind)
        if sparse := accessor.get("sparse"):
            rows = self._view(sparse["indices"]["bufferView"], "<u4", sparse["count"], 1)[:, 0]
            values[rows] = self._view(sparse["values"]["bufferView"], kind, sparse["count"], width)
        return values

    def output(self, node: str, path: str) -> np.ndarray:
        """Return a channel's values by key (keys, n)."""
        animation = self.json["animations"][0]
        target = {"node": self.node(node), "path": path}
        channel = next(c for c in animation["channels"] if c["target"] == target)
        sampler = animation["samplers"][channel["sampler"]]
        keys = self.json["accessors"][sampler["input"]]["count"]
        return self.array(sampler["output"]).reshape(keys, -1)

    def morphed(self, name: str, key: int) -> np.ndarray:
        """Return the vertices (n, 3) in mm of a mesh at a key, before its node's own place."""
        mesh = self.json["meshes"][self.json["nodes"][self.node(name)]["mesh"]]
        (primitive,) = mesh["primitives"]
        points = self.array(primitive["attributes"]["POSITION"]).astype(float)
        if "targets" in primitive:
            weights = self.output(name, "weights")[key]
            assert len(weights) == len(mesh["extras"]["targetNames"])
            for weight, target in zip(weights, primitive["targets"], strict=True):
                points += weight * self.array(target["POSITION"])
        return 1000.0 * points
