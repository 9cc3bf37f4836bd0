"""The head as a glTF scene: nodes of body, head and eyes, meshes with their materials and morph targets."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.arrays import Array, ByteArray, IntArray
from ..face.head import Head
from ..looks.figure import Piece, iris_picture
from .gltf import INDICES, VERTICES, Gltf

METRES = 0.001
ON_SKIN = ("brows", "lashes")
_EYES = ("eye_left", "eye_right")


@dataclass
class GlbScene:
    """What has been built: the document, nodes by name, and which nodes have which morph targets by name.

    `pieces` as `render.figure_of` gives them; `posed` are points (n, 3) mm of pieces that are not at rest;
    `moving` are displacements (n, 3) mm of pieces by morph target: {"jawOpen": {"skin": …, "tongue": …}}.
    """

    head: Head
    gltf: Gltf
    pieces: Mapping[str, Piece]
    moving: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    posed: Mapping[str, Array] = field(default_factory=dict)
    nodes: dict[str, int] = field(default_factory=dict)
    targets: dict[str, tuple[str, ...]] = field(default_factory=dict)
    _normals: dict[str, Array] = field(default_factory=dict)

    def build(self) -> None:
        """Add all nodes and meshes; the skin turns with the head by its neck weights, the rest as a whole."""
        pieces, pivot, gltf = self.pieces, self.head.head_pivot, self.gltf
        self.nodes["head"] = gltf.add("nodes", {"name": "head", "translation": _metres(pivot)})
        self.nodes["body"] = gltf.add("nodes", {"name": "body", "children": [self.nodes["head"]]})
        children = []
        for name, piece in pieces.items():
            if name == "skin":
                continue
            about = self.head.eye_centre[_EYES.index(name)] if name in _EYES else pivot
            node = {"name": name, "mesh": self._mesh(piece, about)}
            if name in _EYES:
                node["translation"] = _metres(about - pivot)
            self.nodes[name] = gltf.add("nodes", node)
            children.append(self.nodes[name])
        gltf.document["nodes"][self.nodes["head"]]["children"] = children
        skin = {"name": "skin", "mesh": self._mesh(pieces["skin"], np.zeros(3)), "skin": self._joints()}
        self.nodes["skin"] = gltf.add("nodes", skin)
        scene = {"name": self.head.name, "nodes": [self.nodes["body"], self.nodes["skin"]]}
        gltf.document["scene"] = gltf.add("scenes", scene)

    def _joints(self) -> int:
        """Add the skin's two joints: it stays with the body by the share that the neck keeps."""
        matrices = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
        matrices[1, 3, :3] = -self.head.head_pivot * METRES
        joints = [self.nodes["body"], self.nodes["head"]]
        inverse = self.gltf.accessor(matrices.reshape(2, 16))
        return self.gltf.add("skins", {"name": "neck", "joints": joints, "inverseBindMatrices": inverse})

    def _mesh(self, piece: Piece, about: Array) -> int:
        points = self.posed.get(piece.name, piece.points)
        gltf = self.gltf
        self._normals[piece.name] = normals(points, piece.triangles)
        place = ((points - about) * METRES).astype(np.float32)
        attributes = {
            "POSITION": gltf.accessor(place, VERTICES),
            "NORMAL": gltf.accessor(self._normals[piece.name].astype(np.float32), VERTICES),
        }
        if piece.name in _EYES:
            across = (points - about) / self.head.eye_radius[_EYES.index(piece.name)]
            uv = np.stack([0.5 + 0.5 * across[:, 0], 0.5 - 0.5 * across[:, 1]], axis=1)
            attributes["TEXCOORD_0"] = gltf.accessor(uv.astype(np.float32), VERTICES)
        else:
            attributes["COLOR_0"] = gltf.accessor(piece.colours.astype(np.float32), VERTICES)
        if piece.name == "skin":
            attributes |= self._neck()
        primitive: dict[str, object] = {
            "attributes": attributes,
            "indices": gltf.accessor(piece.triangles.astype(np.uint32).ravel(), INDICES),
            "material": self._material(piece),
        }
        mesh: dict[str, object] = {"name": piece.name, "primitives": [primitive]}
        named = {target: moved[piece.name] for target, moved in self.moving.items() if piece.name in moved}
        if named:
            primitive["targets"] = [self._target(piece, move) for move in named.values()]
            mesh["extras"] = {"targetNames": list(named)}
            mesh["weights"] = [0.0] * len(named)
            self.targets[piece.name] = tuple(named)
        return gltf.add("meshes", mesh)

    def _target(self, piece: Piece, move: Array) -> dict[str, int]:
        target = {"POSITION": self.gltf.sparse((move * METRES).astype(np.float32))}
        if piece.roots is None:
            change = normals(piece.points + move, piece.triangles) - self._normals[piece.name]
            still = np.abs(change).max(axis=1) < 1e-3
            target["NORMAL"] = self.gltf.sparse(np.where(still[:, None], 0.0, change).astype(np.float32))
        return target

    def _neck(self) -> dict[str, int]:
        share = np.clip(self.head.skin.matrix @ self.head.neck_weight, 0.0, 1.0)
        # Quantized so that both weights add up to exactly 1.
        turned = np.round(255.0 * share).astype(np.uint8)
        weights = np.zeros((len(share), 4), np.uint8)
        weights[:, 0], weights[:, 1] = 255 - turned, turned
        joints = np.zeros((len(share), 4), np.uint8)
        joints[:, 1] = np.where(turned > 0, 1, 0)
        return {
            "JOINTS_0": self.gltf.accessor(joints, VERTICES),
            "WEIGHTS_0": self.gltf.accessor(weights, VERTICES, normalized=True),
        }

    def _material(self, piece: Piece) -> int:
        gltf = self.gltf
        surface: dict[str, object] = {"metallicFactor": 0.0, "roughnessFactor": piece.roughness}
        name = "eye" if piece.name in _EYES else "teeth" if piece.name.startswith("teeth") else piece.name
        for index, known in enumerate(gltf.document.get("materials", ())):
            if known["name"] == name:
                return index
        if name == "eye":
            image = {"bufferView": gltf.view(_png(iris_picture(self.head))), "mimeType": "image/png"}
            source = gltf.add("images", {"name": "iris", **image})
            sampler = gltf.add(
                "samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071}
            )
            surface["baseColorTexture"] = {
                "index": gltf.add("textures", {"source": source, "sampler": sampler})
            }
        material: dict[str, object] = {"name": name, "pbrMetallicRoughness": surface}
        return gltf.add("materials", {**material, "doubleSided": True} if piece.two_sided else material)


def riding(pieces: Mapping[str, Piece], skin: Array) -> dict[str, Array]:
    """Return how hairs rooted in the skin go along with its displacement (n, 3), by piece."""
    moves = {}
    for name in ON_SKIN:
        roots, weights = pieces[name].roots, pieces[name].weights
        assert roots is not None
        assert weights is not None
        moves[name] = np.einsum("vk,vkc->vc", weights, skin[roots])
    return moves


def normals(points: Array, triangles: IntArray) -> Array:
    """Return unit normals (n, 3) of a mesh's vertices; up where no triangle has an area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    total = np.stack(
        [np.bincount(triangles.ravel(), np.repeat(across[:, k], 3), len(points)) for k in range(3)], axis=1
    )
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.where(length > 1e-12, total / np.maximum(length, 1e-12), [0.0, 1.0, 0.0])


def _png(picture: ByteArray) -> bytes:
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, format="PNG")
    return buffer.getvalue()


def _metres(place: Sequence[float] | Array) -> list[float]:
    return [float(np.float32(value * METRES)) for value in place]
