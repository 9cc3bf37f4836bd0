"""Tracks as animation in Blender: keyframes of shape keys, rotation of a head, sound."""

from __future__ import annotations

from math import radians
from pathlib import Path

import bpy
from mathutils import Euler

from .tracks import Track, plain

ACTION = "Risorius performance"


def insert_shape_keys(
    track: Track, objects: list, first: float, names: dict[str, tuple[str, ...]] | None = None
) -> int:
    """Key the shape keys of objects; return how many values of the track found a key.

    `first`: the scene's frame at which the track begins. `names`: the shape keys of a value whose own name is
    another. Keys that the track does not name stay as they are.
    """
    mapped = {plain(name): keys for name, keys in (names or {}).items()}
    wanted = {plain(key): name for name in track.values for key in mapped.get(plain(name), (name,))}
    found = set()
    for data in {item.data.shape_keys for item in objects if _has_keys(item)}:
        matching = {key.name: wanted[plain(key.name)] for key in data.key_blocks if plain(key.name) in wanted}
        if not matching:
            continue
        action = _new_action(data)
        for key, name in matching.items():
            _write(action, data, f'key_blocks["{bpy.utils.escape_identifier(key)}"].value', 0,
                   track.values[name], track, first)  # fmt: skip
        found.update(matching.values())
    return len(found)


def insert_rotation(track: Track, item, first: float) -> bool:
    """Turn an object, or a bone of an armature, as the head turns; return whether the track tells how.

    The character looks along -Y with Z up, as those do that are imported from glTF; how a bone lies at rest
    makes no difference.
    """
    if not track.head:
        return False
    still = [0.0] * len(track.times)
    angles = zip(*(track.head.get(part, still) for part in ("pitch", "roll", "yaw")), strict=True)
    turns = [Euler((-radians(p), radians(r), radians(y)), "YXZ").to_matrix() for p, r, y in angles]
    data = item.id_data
    path = "rotation_quaternion"
    if isinstance(item, bpy.types.PoseBone):
        rest = item.bone.matrix_local.to_3x3()
        turns = [rest.inverted() @ turn @ rest for turn in turns]
        path = item.path_from_id(path)
    item.rotation_mode = "QUATERNION"
    quaternions = [turn.to_quaternion() for turn in turns]
    animated = data.animation_data
    action = animated.action if animated and animated.action else _new_action(data)
    for axis in range(4):
        _write(action, data, path, axis, [quaternion[axis] for quaternion in quaternions], track, first)
    return True


def add_sound(path: Path, first: float):
    """Add a sound to the scene's sequencer; return its strip."""
    editor = bpy.context.scene.sequence_editor_create()
    channel = 1 + max((strip.channel for strip in editor.strips), default=0)
    return editor.strips.new_sound(path.stem, str(path), channel, round(first))


def get_rate() -> tuple[int, float]:
    """Return the frames of the scene, and the seconds that they last."""
    render = bpy.context.scene.render
    return render.fps, render.fps_base


def set_rate(rate: tuple[int, float]) -> None:
    """Set the frames of the scene, and the seconds that they last, as `get_rate` returns them."""
    render = bpy.context.scene.render
    render.fps, render.fps_base = rate


def fit_scene(track: Track, first: float) -> None:
    """Let the scene last as long as the track."""
    scene = bpy.context.scene
    scene.frame_end = max(scene.frame_end, int(first + track.times[-1] * _rate(scene)) + 1)


def _has_keys(item) -> bool:
    return item.type == "MESH" and item.data.shape_keys is not None


def _rate(scene) -> float:
    return scene.render.fps / scene.render.fps_base


def _new_action(data):
    action = bpy.data.actions.new(ACTION)
    data.animation_data_create().action = action
    return action


def _write(action, data, path: str, index: int, values: list[float], track: Track, first: float) -> None:
    """Write one curve, a key for each time of the track."""
    curve = action.fcurve_ensure_for_datablock(data, path, index=index)
    curve.keyframe_points.clear()
    curve.keyframe_points.add(len(values))
    rate = _rate(bpy.context.scene)
    points = [
        x for time, value in zip(track.times, values, strict=True) for x in (first + time * rate, value)
    ]
    curve.keyframe_points.foreach_set("co", points)
    linear = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items["LINEAR"].value
    curve.keyframe_points.foreach_set("interpolation", [linear] * len(values))
    curve.update()
