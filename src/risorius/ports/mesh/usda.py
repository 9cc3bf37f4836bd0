"""`.usda`: the head with 52 blend shapes and its animation as Universal Scene Description (UsdSkel), text.

Metres, Y up. Needs usd-core (the extra `usd`). A skeleton of four joints, body, head and two eyes, turns the
skinned meshes as the nodes of `.rig.glb` turn; weights and rotations are time samples, one per frame. Lost:
hair, eyes' texture, materials but for colours; what 52 shapes cannot show; sound.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ...core.arkit import SHAPES
from ...core.arrays import Array, Float32Array
from ...errors import OutputError
from ...face.fit.arkit_track import ArkitTrack
from ...face.fit.shapes import arkit_shapes
from ...face.head.head import Head
from ...face.numerics.rotations import forward_rows, head_rotation, towards
from ...looks.head_model import head_model
from ...looks.parts import Part
from ...looks.srgb import srgb_encode
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .glb_paint import GlbPaint
from .gltf import quaternions

METRES = 0.001
JOINTS = ("body", "body/head", "body/head/eye_left", "body/head/eye_right")
_HEAD = 1
_SMALL = 1e-3  # mm: smaller displacements count as zero


def write_usda(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the stage; raise OutputError if usd-core is not installed."""
    try:
        from pxr import Usd
    except ImportError:
        raise OutputError("needs usd-core; run pip install usd-core") from None
    stage = Usd.Stage.CreateInMemory(".usda")
    _Stage(stage, take.shown_head).build(take, take.fit_arkit(options.progress))
    path.write_text(stage.GetRootLayer().ExportToString(), encoding="utf-8", newline="\n")


class _Stage:
    """Fills a stage."""

    def __init__(self, stage: Any, head: Head) -> None:
        self._stage, self._head = stage, head
        self._parts, self._paint = head_model(head).parts(), GlbPaint(head)
        # Where each joint stands from its parent, mm.
        self._places = [np.zeros(3), head.head_pivot, *(head.eye_centre - head.head_pivot)]

    def build(self, take: WritableTake, track: ArkitTrack) -> None:
        """Define the model, its skeleton, meshes and animation."""
        from pxr import UsdGeom, UsdSkel

        stage, performance = self._stage, take.performance
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        stage.SetTimeCodesPerSecond(float(performance.fps))
        stage.SetFramesPerSecond(float(performance.fps))
        stage.SetStartTimeCode(0)
        stage.SetEndTimeCode(len(performance.values) - 1)
        root = UsdSkel.Root.Define(stage, "/head")
        stage.SetDefaultPrim(root.GetPrim())
        self._skeleton()
        moved = arkit_shapes(self._head)
        self._mesh(self._parts["skin"], [moved.skin_at(k) for k in range(len(SHAPES))])
        self._mesh(self._parts["tongue"], list(moved.tongue))
        self._mesh(self._parts["teeth_lower"], list(moved.teeth_lower))
        self._mesh(self._parts["teeth_upper"], [])
        for name in ("eye_left", "eye_right"):
            self._mesh(self._parts[name], [])
        self._animate(track)

    def _skeleton(self) -> None:
        from pxr import Gf, UsdSkel

        skeleton = UsdSkel.Skeleton.Define(self._stage, "/head/skeleton")
        # In the pose of binding a joint stands in the model, at rest in its parent.
        in_model = [np.zeros(3), self._head.head_pivot, *self._head.eye_centre]
        bound, rest = (
            [Gf.Matrix4d().SetTranslate(Gf.Vec3d(*(place * METRES).tolist())) for place in places]
            for places in (in_model, self._places)
        )
        skeleton.CreateJointsAttr(JOINTS)
        skeleton.CreateBindTransformsAttr(bound)
        skeleton.CreateRestTransformsAttr(rest)
        binding = UsdSkel.BindingAPI.Apply(skeleton.GetPrim())
        binding.CreateAnimationSourceRel().SetTargets(["/head/animation"])

    def _mesh(self, part: Part, moves: list[Array]) -> None:
        from pxr import UsdGeom, UsdSkel, Vt

        mesh = UsdGeom.Mesh.Define(self._stage, f"/head/{part.name}")
        points = (part.points * METRES).astype(np.float32)
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
        mesh.CreateFaceVertexCountsAttr([3] * len(part.triangles))
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(part.triangles.astype(np.int32).ravel()))
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        colours = srgb_encode(part.colours * self._paint.shade(part)[:, None]).astype(np.float32)
        colour = mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.vertex)
        colour.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(colours)))
        binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
        binding.CreateSkeletonRel().SetTargets(["/head/skeleton"])
        joint, share = self._bound(part)
        binding.CreateJointIndicesPrimvar(False, 2).Set([0, joint] * len(points))
        weights = np.stack([1.0 - share, share], axis=1).astype(np.float32)
        binding.CreateJointWeightsPrimvar(False, 2).Set(Vt.FloatArray.FromNumpy(weights.ravel()))
        self._blend_shapes(binding, part, moves)

    def _blend_shapes(self, binding: Any, part: Part, moves: list[Array]) -> None:
        from pxr import Sdf, UsdSkel, Vt

        paths = {}
        for name, move in zip(SHAPES, moves, strict=False):
            rows = np.flatnonzero(np.abs(move).max(axis=1) > _SMALL)
            if not len(rows):
                continue
            paths[name] = Sdf.Path(f"/head/{part.name}/{name}")
            shape = UsdSkel.BlendShape.Define(self._stage, paths[name])
            offsets = np.ascontiguousarray(move[rows] * METRES, np.float32)
            shape.CreateOffsetsAttr(Vt.Vec3fArray.FromNumpy(offsets))
            shape.CreatePointIndicesAttr(Vt.IntArray.FromNumpy(rows.astype(np.int32)))
        if paths:
            binding.CreateBlendShapesAttr(list(paths))
            binding.CreateBlendShapeTargetsRel().SetTargets(list(paths.values()))

    def _bound(self, part: Part) -> tuple[int, Array]:
        """Return the joint that a part turns with, and each vertex's share (n,) in its turn."""
        if part.name == "skin":
            return _HEAD, np.clip(self._head.skin.matrix @ self._head.neck_weight, 0.0, 1.0)
        joint = f"body/head/{part.name}"
        return JOINTS.index(joint) if joint in JOINTS else _HEAD, np.ones(len(part.points))

    def _animate(self, track: ArkitTrack) -> None:
        from pxr import Gf, UsdSkel

        animation = UsdSkel.Animation.Define(self._stage, "/head/animation")
        animation.CreateJointsAttr(JOINTS)
        animation.CreateBlendShapesAttr(list(SHAPES))
        animation.CreateTranslationsAttr([Gf.Vec3f(*(place * METRES).tolist()) for place in self._places])
        animation.CreateScalesAttr([Gf.Vec3h(1.0, 1.0, 1.0)] * len(JOINTS))
        rotations, weights = animation.CreateRotationsAttr(), animation.CreateBlendShapeWeightsAttr()
        turns = [Gf.Quatf(w, x, y, z) for x, y, z, w in _turns(track).tolist()]
        for frame, row in enumerate(track.weights.tolist()):
            first = frame * (len(JOINTS) - 1)
            rotations.Set([Gf.Quatf(1.0), *turns[first : first + len(JOINTS) - 1]], frame)
            weights.Set(row, frame)


def _turns(track: ArkitTrack) -> Float32Array:
    """Return quaternions (3 frames, 4) x, y, z, w: frame by frame of the head, the left and the right eye."""
    turns = []
    for (yaw, pitch, roll), eyes in zip(track.head.tolist(), track.eyes.tolist(), strict=True):
        turns.append(head_rotation(pitch, yaw, roll))
        turns += [np.array(forward_rows(*towards(up, to_left))) for to_left, up, _ in eyes]
    return quaternions(turns)


register(".usda", "the head with 52 blend shapes as USD", {"head"}, write_usda, reads=("hair", "complexion"))
