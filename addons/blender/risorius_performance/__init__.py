"""Risorius Performance: imports `.arkit.csv` and `.performance.json` to shape keys.

In Blender: Edit > Preferences > Add-ons > Install from Disk, then File > Import > Risorius Performance. It
acts on the selected meshes with shape keys, or on all where none is selected.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import bpy
from bpy.props import BoolProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from . import keys
from .tracks import TrackError, read_map, read_track, scene_rate

bl_info = {
    "name": "Risorius Performance",
    "author": "The Risorius project",
    "version": (0, 1, 0),
    "blender": (4, 5, 0),
    "location": "File > Import > Risorius Performance",
    "description": "Imports facial performances to shape keys, with head and sound",
    "category": "Import-Export",
}


class ImportPerformance(bpy.types.Operator, ImportHelper):
    """Key the shape keys of the selected meshes by a performance of Risorius, or a take of Live Link Face"""

    bl_idname = "import_anim.risorius_performance"
    bl_label = "Import Risorius Performance"
    bl_options: ClassVar = {"REGISTER", "UNDO"}

    filter_glob: StringProperty(default="*.csv;*.json", options={"HIDDEN"})
    first: FloatProperty(
        name="First frame", default=1.0, description="Frame of the scene at which the performance begins"
    )
    names: StringProperty(
        name="Map",
        subtype="FILE_PATH",
        description="Names of shape keys, as risorius rig prints them (.toml)",
    )
    head: StringProperty(
        name="Head", description="Object, or armature:bone, that turns as the head does; empty for none"
    )
    with_sound: BoolProperty(
        name="Sound",
        default=True,
        description="Add the .wav of the same name, if it is there",
    )

    with_rate: BoolProperty(
        name="Frame rate",
        default=True,
        description="Set the scene's frame rate to that of the performance: a key on each frame",
    )

    def execute(self, context):
        """Import; say in one line what cannot be used."""
        path = Path(bpy.path.abspath(self.filepath))
        try:
            track = read_track(path)
            names = read_map(Path(bpy.path.abspath(self.names))) if self.names else None
            head = _head(self.head)
        except TrackError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        objects = [item for item in context.selected_objects if item.type == "MESH"] or list(bpy.data.objects)
        rate_before = keys.get_rate()
        if self.with_rate:
            keys.set_rate(scene_rate(track.rate))
        count = keys.insert_shape_keys(track, objects, self.first, names)
        if count == 0:
            keys.set_rate(rate_before)
            self.report(
                {"ERROR"}, f"{path.name}: fits no shape key; expected names such as jawOpen, or a map"
            )
            return {"CANCELLED"}
        if head is not None:
            keys.insert_rotation(track, head, self.first)
        sound = path.with_name(path.name.split(".")[0] + ".wav")
        if self.with_sound and sound.is_file():
            keys.add_sound(sound, self.first)
        keys.fit_scene(track, self.first)
        self.report({"INFO"}, f"{path.name}: {count} of {len(track.values)} curves to shape keys")
        return {"FINISHED"}


def _head(name: str):
    """Return the object or bone of that name; None where none is named."""
    if not name:
        return None
    armature, colon, bone = name.partition(":")
    item = bpy.data.objects.get(armature)
    if item is None:
        raise TrackError(f"there is no object '{armature}'; expected the head's, or armature:bone")
    if not colon:
        return item
    if item.type != "ARMATURE" or bone not in item.pose.bones:
        raise TrackError(f"'{armature}' has no bone '{bone}'")
    return item.pose.bones[bone]


def _menu(self, context):
    self.layout.operator(ImportPerformance.bl_idname, text="Risorius Performance (.csv, .json)")


def register() -> None:
    """Add the operator and its place in the menu."""
    bpy.utils.register_class(ImportPerformance)
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister() -> None:
    """Take both away again."""
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    bpy.utils.unregister_class(ImportPerformance)
