"""The software renderer: frames of the face in, pictures out."""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from ..core.arrays import Array, ByteArray, Float32Array, Int32Array
from ..core.look import QUALITIES, STYLES, Size
from ..errors import InputError, unknown
from ..face.frame import FaceFrame
from ..face.numerics.subdivide import triangulate
from ..looks.eyeball import iris_image
from ..looks.head_model import HeadModel, thin_hair
from ..looks.noise import noise_tile
from ..machine.kernels.jit import f4
from .backdrop import gradient
from .camera import Camera, project, project_pairs
from .cutout import covered, cut_out
from .diagram import shade_diagram
from .diagram_paint import DiagramPaint
from .framing import frame_head
from .hair_views import HairViews
from .inputs import (
    Paint,
    Pose,
    PosedMesh,
    SceneLight,
    Screen,
    Tables,
    empty_batch,
    empty_facets,
    empty_linear,
)
from .lights import STUDIO, LightRig
from .linear import SIDE
from .materials.hair import light_hairs
from .materials.shadows import cast_shadows
from .scene import HeadScene
from .shade import shade, shade_draft, shade_linear
from .shadow import DRAFT_SIZE, SIZE, ShadowMap
from .subsurface import diffuse_table
from .tone import film_table, to_bytes, tone_table
from .visibility import Visibility

SMALLEST, LARGEST = 16, 4096
_DRAFT_HAIRS = 3
"""A draft draws one in this number of hairs, and draws it wider by the same factor."""
_COARSE_SHADOW = QUALITIES["normal"]
"""Samples a pixel and side up to which the shadow is that of the coarse skin: nobody sees the difference."""
_DRAFT_DETAIL = f4(30)
"""Millimetres: skin and cloth of drafts have no pores, and are lit so far beyond the neckline."""


class SoftwareRenderer:
    """Draws one head model at one size on the CPU.

    Draws one picture at a time; several renderers may draw at once, each in a thread of its own.
    """

    def __init__(
        self,
        model: HeadModel,
        size: Size = (720, 720),
        quality: str = "normal",
        *,
        camera: Camera | None = None,
        lights: LightRig = STUDIO,
        background: Float32Array | None = None,
        alpha: bool = False,
        style: str = "realistic",
    ) -> None:
        """Prepare to draw `model` at `size` (width, height) in pixels.

        `quality` is draft, normal or high: 1, 4 or 16 samples a pixel. `background` is display light
        (height, width, 3) float32; with `alpha` it is left out and pictures have four channels. Raises
        InputError for a size that cannot be drawn, and for an unknown quality or style.
        """
        width, height = check_size(size)
        for kind, name, choices in (("quality", quality, QUALITIES), ("style", style, STYLES)):
            if name not in choices:
                raise InputError(unknown(kind, name, choices))
        self.size = (width, height)
        self._lights = lights.lighting()
        self._samples = QUALITIES[quality]
        self._draft = quality == "draft" and style == "realistic"
        self.is_linear = self._samples == SIDE and style == "realistic"
        if self._draft:
            model = thin_hair(model, _DRAFT_HAIRS)
        self.scene = HeadScene(model, self._lights.lamps, creased=not self._draft)
        self.camera = camera or frame_head(model.anatomy, width / height)
        if alpha:
            background = np.zeros((height, width, 3), np.float32)
        elif background is None:
            background = gradient(width, height, lights.centre, lights.edge)
        self._background = _check_background(background, width, height)
        self._alpha = alpha
        self._diagram_paint = (
            DiagramPaint(model.head, len(self.scene.triangles), style) if style != "realistic" else None
        )
        self._empty = to_bytes(self._background)
        tones = (film_table(), tone_table(), to_bytes(film_table()))
        cloth = model.cloth.astype(np.float32)
        iris = iris_image(*model.looks.iris)
        grain = np.zeros_like(noise_tile()) if self._draft else noise_tile()
        self._tables = Tables(diffuse_table(), grain, iris, cloth, *tones)
        self.hair_views: HairViews | None = None
        self.look_from(self.camera)
        self._allocate()

    def look_from(self, camera: Camera) -> None:
        """Draw from another place from now on."""
        width, height = (side * self._samples for side in self.size)
        self.camera = camera
        self._eye = np.asarray(camera.eye, np.float32)
        self._matrix = camera.matrix(width, height)
        self._least = 0.9 * camera.millimetres_per_sample(height)
        distance = math.dist(camera.eye, camera.target)
        if self.hair_views is None or not self.hair_views.fit(distance, self._least):
            views = HairViews(self.scene, distance, self._least)
            self.hair_views = views if views.reliable else None

    def _allocate(self) -> None:
        """Allocate the buffers that a picture is drawn with."""
        scene, (width, height), samples = self.scene, self.size, self._samples
        self._drawn: ByteArray | None = np.empty((height, width, 3), np.uint8) if self._alpha else None
        self._buffer = Visibility(width * samples, height * samples, len(scene.triangles))
        self._xy: Int32Array = np.zeros((len(scene.positions), 2), np.int32)
        self._key: Float32Array = np.zeros(len(scene.positions), np.float32)
        self._batch = empty_batch(
            max(width * samples * samples, 0 if samples > SIDE else scene.skin_vertices)
        )
        self._facets = empty_facets(len(scene.triangles) if self._draft else 0)
        count = len(scene.triangles) if self.is_linear else 0
        self._linear = empty_linear(count, len(scene.positions), scene.skin_vertices, width)
        centre, radius = scene.anatomy.sphere()
        direction, texels = self._lights.lamps[0, :3], DRAFT_SIZE if self._draft else SIZE
        if samples <= _COARSE_SHADOW:
            # The vertices of the skin's coarse quads are the first of the fine ones.
            vertices, self._casters = len(scene.head.rest), triangulate(scene.head.quads)
        else:
            vertices, self._casters = scene.mesh_vertices, scene.triangles[: scene.solid]
        self._shadow = ShadowMap(direction, centre, radius, vertices, len(self._casters), texels)

    def clone(self) -> SoftwareRenderer:
        """Return a renderer of the same pictures that another thread can use at the same time."""
        other = copy(self)
        other.scene = self.scene.clone()
        if self._diagram_paint is not None:
            other._diagram_paint = self._diagram_paint.clone()
        if self.hair_views is not None:
            other.hair_views = self.hair_views.clone(other.scene)
        other._allocate()
        return other

    @property
    def buffer_bytes(self) -> int:
        """The memory that a clone takes, about."""
        buffers = self._buffer.ids, self._buffer.depth, self._linear.planes
        return sum(array.nbytes for array in buffers) + 80 * len(self.scene.positions)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Height, width and channels of the pictures."""
        return (self.size[1], self.size[0], 3 if self._drawn is None else 4)

    @property
    def triangles_shown(self) -> Int32Array:
        """The triangle that each sample (rows, columns) of the last picture shows, -1 for the background."""
        return self._buffer.ids

    def render(
        self, frame: FaceFrame, out: ByteArray | None = None, suppression: Array | None = None
    ) -> ByteArray:
        """Return the picture (height, width, 3) uint8 sRGB of a frame, written into `out` unless it is None.

        With alpha the picture has a fourth channel, and its colours are not multiplied by it. `suppression`
        (46,) is how much of each parameter its rivals suppress, which the style "muscles" shows. Raises
        InputError for a frame of another head, and for an `out` that does not fit.
        """
        if out is None:
            out = np.empty(self.shape, np.uint8)
        elif out.shape != self.shape or out.dtype != np.uint8 or not out.flags.c_contiguous:
            raise InputError(
                f"picture buffer {out.shape} {out.dtype}; expected {self.shape} uint8, contiguous"
            )
        if self._diagram_paint is not None:
            self._diagram_paint.update(frame.parameters, suppression)
        if self._drawn is None:
            self._draw(frame, out)
        else:
            self._draw(frame, self._drawn)
            cut_out(self._drawn, covered(self._buffer.ids, self._samples), out)
        return out

    def _draw(self, frame: FaceFrame, out: ByteArray) -> None:
        scene = self.scene
        scene.check(frame)
        views, solid = self.hair_views, slice(0, scene.mesh_vertices)
        shown = views.seen(self._eye, frame.head_rotation) if views is not None else scene.all_hair
        pose = scene.pose(frame, self._eye, self._least, shown)
        project(scene.positions[solid], self._matrix, self._xy[solid], self._key[solid])
        project_pairs(scene.positions, self._matrix, shown.pairs, self._xy, self._key)
        self._buffer.order = shown.order
        self._buffer.prepare(self._xy, scene.triangles, scene.two_sided)
        self._shadow.update(
            scene.positions[: self._shadow.vertices], self._casters, scene.two_sided[: len(self._casters)]
        )
        self._shade(pose, shown.pairs, out)

    def _shade(self, pose: Pose, hair_pairs: Int32Array, out: ByteArray) -> None:
        scene, shadow, samples = self.scene, self._shadow, self._samples
        mesh = PosedMesh(
            self._xy,
            self._key,
            scene.positions,
            scene.normals,
            scene.attributes,
            scene.rest,
            scene.reach,
            scene.shadow,
            scene.vertex_light,
            scene.cloth_light,
            scene.triangles,
            scene.surfaces,
            *scene.creases[1:],
        )
        light = SceneLight(
            self._lights.lamps,
            self._lights.ambient,
            shadow.depth,
            shadow.low,
            shadow.high,
            shadow.matrix,
            f4(shadow.bias),
            f4(self._lights.pupil),
        )
        if not self._draft:
            cast_shadows(scene.positions, light, scene.shadow)
        light_hairs(mesh, light, self._eye, hair_pairs)
        pixel = f4(self.camera.millimetres_per_sample(self.size[1]))
        buffer = self._buffer
        screen = Screen(
            buffer.ids,
            buffer.depth,
            buffer.order,
            buffer.rows,
            buffer.chunks,
            samples,
            self._eye,
            pixel,
            _DRAFT_DETAIL if self._draft else pixel,
            self._background,
            self._empty,
        )
        if self._diagram_paint is None:
            if self._draft:
                shade_draft(screen, mesh, light, pose, self._tables, self._batch, self._facets, out)
            elif self.is_linear:
                out[:] = self._empty
                shade_linear(
                    screen, mesh, light, pose, self._tables, hair_pairs, self._batch, self._linear, out
                )
            else:
                shade(screen, mesh, light, pose, self._tables, self._batch, out)
        else:
            paint: Paint = self._diagram_paint.paint
            shade_diagram(screen, mesh, light, pose, self._tables, paint, self._batch, out)


def check_size(size: Size) -> Size:
    """Return a picture's size as whole numbers; raise InputError if it cannot be drawn."""
    if len(size) != 2 or any(int(n) != n for n in size):
        raise InputError(f"picture size {size}; expected width and height in whole pixels")
    width, height = (int(n) for n in size)
    if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
        raise InputError(f"picture size {width}x{height}; expected {SMALLEST} to {LARGEST} pixels each way")
    return width, height


def _check_background(background: Float32Array, width: int, height: int) -> Float32Array:
    if background.shape != (height, width, 3):
        raise InputError(f"background {background.shape}; expected {(height, width, 3)}")
    return np.array(background, np.float32)
