"""`.glb` and `.rig.glb`: the head with eyes, teeth, tongue and hair in motion, as binary glTF 2.0.

`.glb` moves the skin by the clip's own basis: few shapes, exact to the residual that the file states.
`.rig.glb` moves it by the 52 ARKit shapes under their names, so that the clip drives other characters that
have them, and these characters' clips drive the head. Head and eyes turn as nodes in both. A pose of one
frame is a still: the posed points themselves. Lost: the muscles and causes; fine wrinkles that the renderer
draws between vertices; the sound, whose file's name stands in the asset's extras when a `.wav` is written
along.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...core.arkit import SHAPES
from ...core.arrays import Array, Float32Array
from ...face.contact.mouth import Mouth
from ...face.fit.shapes import ArkitShapes, arkit_shapes
from ...face.frame import FaceFrame
from ...face.head.head import Head
from ...looks.head_model import head_model
from ...looks.parts import Part
from ...looks.root_attachment import RootedHairs
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .basis import ClipBasis, nonnegative
from .glb_scene import GlbScene
from .gltf import Animation, Gltf, clip_times, quaternions

GENERATOR = "Risorius"
_SMALL = 1e-3  # mm: smaller displacements count as zero
_LIPS = 4.0  # how much more exactly than other skin a clip's own shapes show lips: a gap of .2 mm is seen
_SHOWN = ("skin", "tongue", "teeth_lower", "lashes")
"""Parts whose points in each frame make a clip's shapes. Brows turn little: they follow the skin's shapes."""


def write_glb(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the clip by its own basis, or one frame as a still."""
    head = take.shown_head
    model = head_model(head)
    parts = model.parts()
    if len(take.performance.values) <= 2 and take.audio is None:
        still(head, parts, next(take.faces(progress=options.progress)), _asset(options)).save(path)
        return
    lashes, brows = (RootedHairs(model, (name,)) for name in ("lashes", "brows"))
    rest = np.concatenate([parts[name].points for name in _SHOWN])
    basis, turns = ClipBasis(rest, importance=_importance(head, len(rest))), Turns()
    for frame in take.faces(progress=options.progress):
        grown = lashes.points(frame.skin.astype(np.float64)).values()
        basis.show(np.concatenate([frame.skin, frame.tongue, frame.teeth_lower, *grown]))
        turns.append(frame)
    shapes, weights = nonnegative(*basis.finish())
    rms, worst = basis.residual
    gltf = Gltf(**_asset(options, residual_rms_mm=round(rms, 4), residual_worst_mm=round(worst, 4)))
    cuts = np.cumsum([len(parts[name].points) for name in _SHOWN])[:-1]
    moving = {
        f"clip_{number:02d}": _moves(brows, dict(zip(_SHOWN, np.split(shape, cuts), strict=True)))
        for number, shape in enumerate(shapes[:-1])
    }
    back = f"clip_{len(moving):02d}"
    if moving:
        moving[back] = _minus_sum(list(moving.values()))
    scene = GlbScene(head, gltf, parts, moving, back=back)
    scene.build()
    animate(scene, clip_times(take), dict(zip(moving, weights.T, strict=True)), turns)
    gltf.save(path)


def write_rig_glb(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the clip as weights of the 52 ARKit shapes; raise HeadError if the head has none."""
    head, track = take.shown_head, take.fit_arkit(options.progress)
    rms, worst = track.residual
    gltf = Gltf(**_asset(options, residual_rms_mm=round(rms, 4), residual_worst_mm=round(worst, 4)))
    scene = rig_scene(head, gltf)
    turns = Turns()
    for frame in take.faces(progress=options.progress):
        turns.append(frame)
    animate(scene, clip_times(take), dict(zip(SHAPES, track.weights.T, strict=True)), turns)
    gltf.save(path)


def rig_scene(head: Head, gltf: Gltf) -> GlbScene:
    """Build the head at rest with its 52 shapes as morph targets; raise HeadError if it has none."""
    model, shapes = head_model(head), arkit_shapes(head)
    parts, hairs = model.parts(), RootedHairs(model)
    moving = {name: _moves(hairs, _shape(shapes, index)) for index, name in enumerate(SHAPES)}
    for moves in moving.values():
        moves.setdefault("skin", np.zeros_like(parts["skin"].points))
    scene = GlbScene(head, gltf, parts, moving)
    scene.build()
    return scene


def still(head: Head, parts: Mapping[str, Part], frame: FaceFrame, asset: Mapping[str, object]) -> Gltf:
    """Return one frame as a document without animation."""
    skin = frame.skin.astype(np.float64)
    posed = {"skin": skin, "tongue": frame.tongue.astype(np.float64)}
    posed["teeth_lower"] = frame.teeth_lower.astype(np.float64)
    posed |= RootedHairs(head_model(head)).points(skin)
    gltf = Gltf(**asset)
    scene = GlbScene(head, gltf, parts, posed=posed)
    scene.build()
    turns = Turns()
    turns.append(frame)
    for name, rotations in turns.all().items():
        gltf.document["nodes"][scene.nodes[name]]["rotation"] = rotations[0].tolist()
    return gltf


class Turns:
    """Rotations of head and eyes, frame by frame."""

    def __init__(self) -> None:
        self._rotations: dict[str, list[Array]] = {"head": [], "eye_left": [], "eye_right": []}

    def append(self, frame: FaceFrame) -> None:
        """Take in the next frame."""
        for rotations, turn in zip(
            self._rotations.values(), (frame.head_rotation, *frame.eye_rotation), strict=True
        ):
            rotations.append(turn)

    def all(self) -> dict[str, Float32Array]:
        """Return quaternions (frames, 4) by node, without jumps of sign."""
        return {name: _continuous(quaternions(rotations)) for name, rotations in self._rotations.items()}


def animate(scene: GlbScene, times: Array, weights: Mapping[str, Array], turns: Turns) -> None:
    """Add the animation: `weights` (frames,) by morph target, and the rotations; `times` are `clip_times`."""
    animation = Animation(scene.gltf, times)
    for node, names in scene.targets.items():
        animation.drive(scene.nodes[node], "weights", np.stack([weights[name] for name in names], axis=1))
    for node, rotations in turns.all().items():
        animation.drive(scene.nodes[node], "rotation", rotations)
    animation.finish()


def _importance(head: Head, count: int) -> Array:
    """Return how much more exactly than others each of `count` points, the skin's first, is shown."""
    importance = np.ones(count)
    importance[Mouth.of(head).vertices] = _LIPS
    return importance


def _minus_sum(moves: list[dict[str, Array]]) -> dict[str, Array]:
    """Return minus the sum of displacements by part."""
    names = dict.fromkeys(name for move in moves for name in move)
    return {name: -np.sum([move[name] for move in moves if name in move], axis=0) for name in names}


def _moves(hairs: RootedHairs, moved: Mapping[str, Array]) -> dict[str, Array]:
    """Return displacements by part: those given, and of the hairs on the skin; none for resting parts."""
    everything = {**moved, **hairs.moves(moved["skin"])}
    return {name: move for name, move in everything.items() if np.abs(move).max() > _SMALL}


def _shape(shapes: ArkitShapes, index: int) -> dict[str, Array]:
    return {
        "skin": shapes.skin_at(index),
        "tongue": shapes.tongue[index],
        "teeth_lower": shapes.teeth_lower[index],
    }


def _continuous(rotations: Float32Array) -> Float32Array:
    against = (rotations[1:] * rotations[:-1]).sum(axis=1) < 0.0
    signs = np.concatenate([[1.0], np.cumprod(np.where(against, -1.0, 1.0))])
    return np.asarray(rotations * signs[:, None], np.float32)


def _asset(options: WriteOptions, **extras: object) -> dict[str, object]:
    if options.voice is not None:
        extras["audio"] = options.voice.name
    return {"generator": GENERATOR, "copyright": "Head: CC0 1.0", **({"extras": extras} if extras else {})}


register(
    ".glb", "the head in motion, by the clip's own shapes", {"head"}, write_glb, reads=("hair", "complexion")
)
register(
    ".rig.glb",
    "the head with 52 ARKit shapes, driven by their weights",
    {"head"},
    write_rig_glb,
    reads=("hair", "complexion"),
)
