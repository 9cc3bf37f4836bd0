"""The head as a glTF scene: nodes of body, head and eyes, meshes with their materials and morph targets."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...core.arrays import Array, ByteArray, IntArray
from ...face.head.head import Head
from ...looks.attributes import HAIR, OCCLUSION, SPECULAR
from ...looks.eyeball import pupil_axes
from ...looks.parts import Part
from .glb_paint import GlbPaint
from .gltf import INDICES, VERTICES, Gltf

METRES = 0.001
_LINEAR, _MIPMAPS, _EDGE = 9729, 9987, 33071  # glTF's numbers of filters and of the clamped edge
_TYPICAL = 0.2  # weight of a clip's own shapes for which normals are exact
_EYES = ("eye_left", "eye_right")


@dataclass
class GlbScene:
    """A scene that has been built: the document, nodes by name, and the nodes of each morph target by name.

    `parts` as `HeadModel.parts` gives them; `posed` are points (n, 3) mm of parts that are not at rest;
    `moving` are displacements (n, 3) mm of parts by morph target: {"jawOpen": {"skin": …, "tongue": …}}.
    With `lit`, for our own page, colours are those of things without shade (`glb_paint` for others), and
    hairs say at each vertex (`_LIGHT`) which share of light reaches it, and how strong its highlights are,
    but have no normals. The morph target `back`, if there is one, is the last and moves all that others move
    by minus their sum: normals change so, too, although they are not linear.
    """

    head: Head
    gltf: Gltf
    parts: Mapping[str, Part]
    moving: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    posed: Mapping[str, Array] = field(default_factory=dict)
    lit: bool = False
    back: str = ""
    nodes: dict[str, int] = field(default_factory=dict)
    targets: dict[str, tuple[str, ...]] = field(default_factory=dict)
    _normals: dict[str, Array] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._paint = GlbPaint(self.head)

    def build(self) -> None:
        """Add all nodes and meshes; the skin turns with the head by its neck weights, the rest as a whole."""
        parts, pivot, gltf = self.parts, self.head.head_pivot, self.gltf
        self.nodes["head"] = gltf.add("nodes", {"name": "head", "translation": _metres(pivot)})
        self.nodes["body"] = gltf.add("nodes", {"name": "body", "children": [self.nodes["head"]]})
        children = []
        for name, part in parts.items():
            if name == "skin":
                continue
            about = self.head.eye_centre[_EYES.index(name)] if name in _EYES else pivot
            node = {"name": name, "mesh": self._mesh(part, about)}
            if name in _EYES:
                node["translation"] = _metres(about - pivot)
            self.nodes[name] = gltf.add("nodes", node)
            children.append(self.nodes[name])
        gltf.document["nodes"][self.nodes["head"]]["children"] = children
        skin = {"name": "skin", "mesh": self._mesh(parts["skin"], np.zeros(3)), "skin": self._joints()}
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

    def _mesh(self, part: Part, about: Array) -> int:
        points = self.posed.get(part.name, part.points)
        gltf = self.gltf
        self._normals[part.name] = normals(points, part.triangles)
        place = ((points - about) * METRES).astype(np.float32)
        attributes = {"POSITION": gltf.accessor(place, VERTICES)}
        if not (self.lit and part.surface >= HAIR):
            attributes["NORMAL"] = gltf.accessor(self._normals[part.name].astype(np.float32), VERTICES)
        if part.name in _EYES:
            side = _EYES.index(part.name)
            across = (points - about) / self.head.eye_radius[side] @ pupil_axes()[side]
            uv = np.stack([0.5 + 0.5 * across[:, 0], 0.5 - 0.5 * across[:, 1]], axis=1)
            attributes["TEXCOORD_0"] = gltf.accessor(uv.astype(np.float32), VERTICES)
        else:
            colours = part.colours if self.lit else self._paint.colours(part)
            attributes["COLOR_0"] = gltf.accessor(colours.astype(np.float32), VERTICES)
        if part.name == "skin":
            attributes |= self._neck()
            if not self.lit:
                places = self._paint.skin_places().astype(np.float32)
                attributes["TEXCOORD_0"] = gltf.accessor(places, VERTICES)
        if self.lit and part.surface >= HAIR:
            light = np.zeros((len(points), 4), np.uint8)  # a vertex takes a multiple of four bytes
            light[:, :2] = np.round(255.0 * part.attributes[:, [OCCLUSION, SPECULAR]].clip(0.0, 1.0))
            attributes["_LIGHT"] = gltf.accessor(light, VERTICES, normalized=True)
        primitive: dict[str, object] = {
            "attributes": attributes,
            "indices": gltf.accessor(part.triangles.astype(np.uint32).ravel(), INDICES),
            "material": self._material(part),
        }
        mesh: dict[str, object] = {"name": part.name, "primitives": [primitive]}
        named = {target: moved[part.name] for target, moved in self.moving.items() if part.name in moved}
        if named:
            primitive["targets"] = self._targets(part, named)
            mesh["extras"] = {"targetNames": list(named)}
            mesh["weights"] = [0.0] * len(named)
            self.targets[part.name] = tuple(named)
        return gltf.add("meshes", mesh)

    def _targets(self, part: Part, moves: Mapping[str, Array]) -> list[dict[str, int]]:
        targets, turned = [], np.zeros_like(part.points)
        for name, move in moves.items():
            target = {"POSITION": self.gltf.sparse((move * METRES).astype(np.float32))}
            if part.roots is None:
                change = -turned if name == self.back else self._normal_change(part, move)
                target["NORMAL"] = self.gltf.sparse(change.astype(np.float32))
                turned += change
            targets.append(target)
        return targets

    def _normal_change(self, part: Part, move: Array) -> Array:
        share = _TYPICAL if self.back else 1.0
        change = (normals(part.points + share * move, part.triangles) - self._normals[part.name]) / share
        return np.where(np.abs(change).max(axis=1, keepdims=True) < 1e-3, 0.0, change)

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

    def _material(self, part: Part) -> int:
        gltf = self.gltf
        surface: dict[str, object] = {"metallicFactor": 0.0, "roughnessFactor": part.roughness}
        name = "eye" if part.name in _EYES else "teeth" if part.name.startswith("teeth") else part.name
        for index, known in enumerate(gltf.document.get("materials", ())):
            if known["name"] == name:
                return index
        material: dict[str, object] = {"name": name, "pbrMetallicRoughness": surface}
        if name == "eye":
            surface["baseColorTexture"] = self._texture("eye", self._paint.eye_picture(), _MIPMAPS)
        elif name == "skin" and not self.lit:
            surface["baseColorTexture"] = self._texture("cloth", self._paint.skin_picture(part), _LINEAR)
            rough = self._texture("surface", self._paint.surface_picture(), _LINEAR)
            surface |= {"metallicRoughnessTexture": rough, "metallicFactor": 1.0, "roughnessFactor": 1.0}
            material["occlusionTexture"] = rough
        return gltf.add("materials", {**material, "doubleSided": True} if part.two_sided else material)

    def _texture(self, name: str, picture: ByteArray, smaller: int) -> dict[str, int]:
        gltf = self.gltf
        image = {"name": name, "bufferView": gltf.view(_png(picture)), "mimeType": "image/png"}
        sampler = {"magFilter": _LINEAR, "minFilter": smaller, "wrapS": _EDGE, "wrapT": _EDGE}
        source, sampling = gltf.add("images", image), gltf.add("samplers", sampler)
        return {"index": gltf.add("textures", {"source": source, "sampler": sampling})}


def normals(points: Array, triangles: IntArray) -> Array:
    """Return unit normals (n, 3) of a mesh's vertices; up if no triangle has an area."""
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
