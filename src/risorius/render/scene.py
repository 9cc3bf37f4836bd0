"""The scene of a head: one list of vertices and triangles, posed for each frame."""

from __future__ import annotations

from copy import copy
from typing import NamedTuple

import numpy as np

from ..core.arrays import AnyArray, ByteArray, Float32Array, Int8Array, Int32Array
from ..errors import InputError
from ..face.frame import FaceFrame
from ..looks.anatomy import smoothstep
from ..looks.attributes import ALBEDO, HAIR, OCCLUSION
from ..looks.eyeball import pupil_axes
from ..looks.garment import cloth_offset, neckline
from ..looks.head_model import FACIAL_HAIRS, HeadModel
from ..looks.normals import Normals
from ..looks.parts import Part, hair_attributes
from ..looks.perfusion import Perfusion
from ..looks.scalp import hair_shade
from ..looks.srgb import linear
from ..machine.kernels.jit import f4
from .aperture import lid_margins, lip_edges
from .inputs import Pose
from .occlusion import Occluder, bake
from .ribbons import WHOLE, ribbons
from .shading_block import LAMPS
from .turn import turn
from .wrinkle_table import lay_creases, raise_creases

_LIPS = 0.35  # of the light that comes through the flesh to where the lips touch
_SOFTENED = 0.8  # exponent: light reflected within folds brightens them a little


class ShownHair(NamedTuple):
    """The visible part of the hair.

    `points` (hairs, 2): the first and the last visible point of each hair; of a hidden hair the first comes
    after the last. `order` (k,): all solid triangles and the hairs' that are shown. `pairs` (p,): the first
    vertex of each pair across a hair that these have.
    """

    points: Int8Array
    order: Int32Array
    pairs: Int32Array


class HeadScene:
    """The vertices and triangles of a head model.

    These never change: `triangles` (m, 3), `surfaces` (m,), `two_sided` (m,), `rest` (n, 3) and, but for the
    albedo of the skin, `attributes` (n, ATTRIBUTES). The first `solid` triangles are those of the solid parts
    and cast shadows; the first `skin_vertices` vertices are the skin's. Hairs stand last: of `hairs` in all,
    the first `facial_hairs` are brows and lashes, and `hair_segments` (m − solid,) is the segment of its hair
    that each triangle belongs to. `pose` writes `positions` (n, 3) and `normals` (n, 3), float32 in the
    world, and the skin's albedo.
    """

    def __init__(self, model: HeadModel, lamps: Float32Array, *, creased: bool = True) -> None:
        """Make the scene of a head that `lamps` (n, 7) light; its skin has creases if `creased` is true."""
        self.model, self.head, self.anatomy = model, model.head, model.anatomy
        self._hairs = list(model.hairs.values())
        self._offset = cloth_offset(neckline(self.anatomy), model.skin.normals).astype(np.float32)
        self.skin_vertices = len(self._offset)
        parts = list(model.solids.values())
        self._starts = np.concatenate([[0], np.cumsum([len(part.points) for part in parts])])
        self._gather(parts)
        self.creases, self._creased = lay_creases(self.head, len(self.triangles)), creased
        self._bake(lamps)
        albedo = self.attributes[: self.skin_vertices, ALBEDO : ALBEDO + 3]
        self._perfusion = Perfusion(self.head, model.looks, albedo)

    def _gather(self, parts: list[Part]) -> None:
        """Join the parts, then the hairs, in common arrays."""
        starts = self._starts
        self.mesh_vertices = int(starts[-1])
        faces = np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)])
        self._normals = Normals(np.ascontiguousarray(faces, np.int32), self.mesh_vertices)
        triangles = [part.triangles + start for part, start in zip(parts, starts, strict=False)]
        surfaces = [np.full(len(part.triangles), part.surface) for part in parts]
        self.solid = sum(len(t) for t in triangles)
        attributes = [part.attributes for part in parts]
        self._hair_starts, first, number = [], self.mesh_vertices, HAIR
        for group in self._hairs:
            self._hair_starts.append(first)
            triangles.append(group.triangles() + first)
            per_hair = 2 * (group.widths.shape[1] - 1)
            surfaces.append(number + np.repeat(np.arange(len(group.widths)), per_hair))
            attributes.append(hair_attributes(group))
            first, number = first + group.vertices, number + len(group.widths)
        self.hairs = number - HAIR
        self.facial_hairs = sum(len(self.model.hairs[name].widths) for name in FACIAL_HAIRS)
        self.hair_segments = np.concatenate([group.segments() for group in self._hairs])
        self.triangles: Int32Array = np.concatenate(triangles).astype(np.int32)
        self.surfaces: Int32Array = np.concatenate(surfaces).astype(np.int32)
        self.two_sided: ByteArray = (self.surfaces >= HAIR).astype(np.uint8)
        self.attributes: Float32Array = np.concatenate(attributes)
        self._local: Float32Array = np.concatenate([part.points for part in parts]).astype(np.float32)
        self._local[: len(self._offset)] += self._offset
        self.all_hair = self.show_hair(np.tile(np.array([WHOLE], np.int8), (self.hairs, 1)))
        self.rest: Float32Array = np.zeros((first, 3), np.float32)
        self.rest[: self.mesh_vertices] = self._local
        self.positions: Float32Array = self.rest.copy()
        self.normals: Float32Array = np.zeros((first, 3), np.float32)
        self.vertex_light: Float32Array = np.zeros((first, 3), np.float32)
        self._weight: Float32Array = np.ones(self.mesh_vertices, np.float32)
        self._weight[: len(self._offset)] = self.head.skin.matrix @ self.head.neck_weight

    def _bake(self, lamps: Float32Array) -> None:
        """Compute the light at the resting skin from its surroundings and all lamps (n, 7) but the first."""
        count = self.skin_vertices
        self._normals.update(self._local, self.normals[: self.mesh_vertices])
        normals, solid = self.normals[: self.mesh_vertices], slice(0, self.solid)
        mesh = Occluder(self._local, normals, self.triangles[solid], self.two_sided[solid])
        free, reach = bake(mesh, *self.anatomy.sphere(), lamps)
        free = free[:count] ** _SOFTENED
        masks = self.anatomy.masks
        touching = smoothstep(0.25, 0.75, masks["lips"]) * (1.0 - masks["inner_mouth"])
        self.attributes[:count, OCCLUSION] = free + _LIPS * touching * (1.0 - free)
        columns = max(len(lamps), LAMPS)  # as many as kernels read
        self.reach: Float32Array = np.ones((len(self.rest), columns), np.float32)
        self.reach[:count, 1 : len(lamps)] = reach[:count]
        looks = self.model.looks
        albedo = float(linear(looks.hair).mean())
        taken, around = hair_shade(self.anatomy, looks.hair_style, lamps[:, :3], albedo)
        self.reach[:count, : len(lamps)] *= 1.0 - taken
        self.shadow: Float32Array = np.ones(count, np.float32)
        self.cloth_light: Float32Array = np.zeros((count, 3), np.float32)
        self.attributes[:count, OCCLUSION] *= 1.0 - around

    def clone(self) -> HeadScene:
        """Return a scene that can be posed on its own; both share the arrays that never change."""
        other = copy(self)
        other._normals = self._normals.clone()
        other._local, other.attributes = self._local.copy(), self.attributes.copy()
        other._perfusion = self._perfusion.clone()
        other.positions, other.normals = self.positions.copy(), self.normals.copy()
        other.vertex_light, other.shadow = self.vertex_light.copy(), self.shadow.copy()
        other.cloth_light = self.cloth_light.copy()
        other.creases = self.creases._replace(
            height=self.creases.height.copy(), raised=self.creases.raised.copy()
        )
        return other

    def check(self, frame: FaceFrame) -> None:
        """Raise InputError if a frame has not the number of vertices of this head."""
        sizes = np.diff(self._starts)
        for name, points, size in (
            ("skin", frame.skin, sizes[0]),
            ("lower teeth", frame.teeth_lower, sizes[4]),
            ("tongue", frame.tongue, sizes[5]),
        ):
            if points.shape != (size, 3):
                raise InputError(f"a frame whose {name} is {points.shape}; this head's is {(int(size), 3)}")

    def show_hair(self, points: Int8Array) -> ShownHair:
        """Return the visible hair if `points` are visible (see `ShownHair`)."""
        first, last = points[self.surfaces[self.solid :] - HAIR].T
        shown = self.solid + np.flatnonzero((first <= self.hair_segments) & (self.hair_segments < last))
        pairs = np.unique((self.triangles[shown] - self.mesh_vertices) // 2)
        order = np.concatenate([np.arange(self.solid), shown])
        return ShownHair(points, order.astype(np.int32), (self.mesh_vertices + 2 * pairs).astype(np.int32))

    def pose(self, frame: FaceFrame, eye: Float32Array, sample: float, shown: ShownHair) -> Pose:
        """Pose all vertices for a frame; of the hair, only the strands in `shown`.

        `eye` (3,) float32 is the place of the camera, `sample` the least width in mm that it can show.
        """
        rotation = frame.head_rotation.astype(np.float32)
        pivot = self.head.head_pivot.astype(np.float32)
        self._place(frame)
        turn(self._local, self._weight, rotation, pivot, self.positions[: self.mesh_vertices])
        self._update_surface(eye, sample, shown.points)
        return self._read_pose(frame, rotation, pivot)

    def at_rest(self) -> list[AnyArray]:
        """Return the arrays that determine the view of the head at rest from any place."""
        fields = ("roots", "weights", "curves", "widths", "behind")
        hairs = [np.asarray(getattr(group, name)) for group in self._hairs for name in fields]
        return [self.rest[: self.mesh_vertices], self.triangles, self.surfaces, self.two_sided, *hairs]

    def rest_at(self, eye: Float32Array, sample: float) -> None:
        """Move all vertices to rest, seen from `eye` (see `pose`)."""
        self.positions[: self.mesh_vertices] = self.rest[: self.mesh_vertices]
        self._update_surface(eye, sample, self.all_hair.points)

    def _update_surface(self, eye: Float32Array, sample: float, shown: Int8Array) -> None:
        """Recompute normals and hairs from the posed mesh."""
        mesh, first = slice(0, self.mesh_vertices), 0
        self._normals.update(self.positions[mesh], self.normals[mesh])
        for group, start in zip(self._hairs, self._hair_starts, strict=True):
            ribbons(
                self.positions,
                self.normals,
                group.roots,
                group.weights,
                group.curves,
                group.widths,
                shown[first : first + len(group.roots)],
                eye,
                start,
                f4(group.behind),
                f4(sample),
            )
            first += len(group.roots)

    def _place(self, frame: FaceFrame) -> None:
        """Copy the vertices that move within the head: skin, lower teeth, tongue."""
        starts = self._starts
        np.add(frame.skin, self._offset, out=self._local[: starts[1]])
        self._perfusion.colour(frame, self.attributes)
        if self._creased:
            raise_creases(self.creases, self.triangles[: self.solid], frame.wrinkles)
        self._local[starts[4] : starts[5]] = frame.teeth_lower
        self._local[starts[5] : starts[6]] = frame.tongue

    def _read_pose(self, frame: FaceFrame, rotation: Float32Array, pivot: Float32Array) -> Pose:
        """Return the positions that the shaders of eyes and mouth need."""
        head = self.head
        centres = (head.eye_centre - head.head_pivot) @ frame.head_rotation.T + head.head_pivot
        axes = frame.head_rotation @ frame.eye_rotation @ pupil_axes()
        lids = [
            lid_margins(
                frame.skin[head.lid_pairs[side]].astype(np.float64),
                head.eye_centre[side],
                float(head.eye_radius[side]),
            )
            for side in range(2)
        ]
        span, lips = lip_edges(frame.skin[head.lip_pairs].astype(np.float64))
        return Pose(
            rotation=rotation,
            pivot=pivot,
            eyes=centres.astype(np.float32),
            eye_axes=np.ascontiguousarray(axes, np.float32),
            eye_radius=head.eye_radius.astype(np.float32),
            lids=np.stack([heights for _, heights in lids]).astype(np.float32),
            lid_span=np.stack([s for s, _ in lids]).astype(np.float32),
            lips=np.ascontiguousarray(lips, np.float32),
            lip_span=span.astype(np.float32),
        )
