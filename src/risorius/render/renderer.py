"""The renderer: frames of the face in, pictures out."""

from __future__ import annotations

import numpy as np

from ..errors import InputError, unknown
from ..face.frame import FaceFrame
from ..face.head import Head
from .anatomy import Anatomy
from .backdrop import studio_backdrop
from .camera import Camera, portrait, project
from .complexion import Complexion
from .eyeball import iris_image
from .inputs import Light, Mesh, Pose, Sight, Tables, empty_batch
from .jit import f4
from .lights import STUDIO, LightRig
from .materials.hair import light_hairs
from .noise import noise_tile
from .raster import ByteArray, FloatArray, IntArray, Visibility
from .scene import HeadScene
from .shade import shade
from .shadow import ShadowMap
from .subsurface import diffuse_table
from .tone import film_table, tone_table

QUALITIES = {"draft": 1, "normal": 2, "high": 4}  # samples per pixel and side
SMALLEST, LARGEST = 16, 4096


class Renderer:
    """Draws one head at one size.

    Not safe for several threads at once: its kernels share buffers, and numba allows one caller at a time.
    """

    def __init__(
        self,
        head: Head,
        size: tuple[int, int] = (720, 720),
        quality: str = "normal",
        *,
        camera: Camera | None = None,
        lights: LightRig = STUDIO,
        complexion: Complexion | None = None,
        background: FloatArray | None = None,
    ) -> None:
        """Prepare to draw `head` at `size` (width, height) in pixels.

        `quality` is draft, normal or high: 1, 4 or 16 samples a pixel. `background` is display light
        (height, width, 3) float32. Raises InputError for a size or quality that cannot be drawn.
        """
        width, height = check_size(size)
        if quality not in QUALITIES:
            raise InputError(unknown("quality", quality, QUALITIES))
        self.size = (width, height)
        self._lights = lights.lighting()
        self.scene = HeadScene(head, self._lights.lamps, complexion)
        self.camera = camera or frame_head(self.scene.anatomy, width / height)
        self._samples = QUALITIES[quality]
        self._background = _check_background(background, width, height)
        self._eye = np.asarray(self.camera.eye, np.float32)
        self._prepare(width * self._samples, height * self._samples)

    def _prepare(self, width: int, height: int) -> None:
        scene = self.scene
        self._matrix = self.camera.matrix(width, height)
        self._buffer = Visibility(width, height, len(scene.triangles))
        self._xy: IntArray = np.zeros((len(scene.positions), 2), np.int32)
        self._key: FloatArray = np.zeros(len(scene.positions), np.float32)
        self._batch = empty_batch(width * self._samples)
        centre, radius = scene.anatomy.sphere()
        self._shadow = ShadowMap(self._lights.lamps[0, :3], centre, radius, len(scene.positions), scene.solid)
        iris = iris_image(*scene.head.identity.looks.iris)
        self._tables = Tables(diffuse_table(), noise_tile(), iris, scene.cloth, film_table(), tone_table())

    def render(self, frame: FaceFrame, out: ByteArray | None = None) -> ByteArray:
        """Return the picture (height, width, 3) uint8 sRGB of a frame, written into `out` if given.

        Raises InputError for a frame of another head, and for an `out` that does not fit.
        """
        width, height = self.size
        if out is None:
            out = np.empty((height, width, 3), np.uint8)
        elif out.shape != (height, width, 3) or out.dtype != np.uint8 or not out.flags.c_contiguous:
            raise InputError(
                f"picture buffer {out.shape} {out.dtype}; expected {(height, width, 3)} uint8, contiguous"
            )
        scene = self.scene
        scene.check(frame)
        pose = scene.pose(frame, self._eye)
        project(scene.positions, self._matrix, self._xy, self._key)
        self._buffer.draw(self._xy, self._key, scene.triangles, scene.two_sided)
        self._shadow.update(
            scene.positions[: scene.mesh_vertices],
            scene.triangles[: scene.solid],
            scene.two_sided[: scene.solid],
        )
        self._shade(pose, out)
        return out

    def _shade(self, pose: Pose, out: ByteArray) -> None:
        scene, shadow, samples = self.scene, self._shadow, self._samples
        mesh = Mesh(
            self._xy,
            self._key,
            scene.positions,
            scene.normals,
            scene.attributes,
            scene.rest,
            scene.reach,
            scene.hair_light,
            scene.triangles,
            scene.surfaces,
            *scene.creases,
        )
        light = Light(
            self._lights.lamps,
            self._lights.room,
            shadow.depth,
            shadow.tiles,
            shadow.matrix,
            f4(shadow.bias),
        )
        light_hairs(mesh, light, self._eye, scene.mesh_vertices)
        pixel = f4(self.camera.millimetres_per_sample(self.size[1]))
        sight = Sight(self._buffer.ids, self._buffer.depth, samples, self._eye, pixel, self._background)
        shade(sight, mesh, light, pose, self._tables, self._batch, out)


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """Return a picture's size as whole numbers; raise InputError where it is none that can be drawn."""
    if len(size) != 2 or any(int(n) != n for n in size):
        raise InputError(f"picture size {size}; expected width and height in whole pixels")
    width, height = (int(n) for n in size)
    if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
        raise InputError(f"picture size {width}x{height}; expected {SMALLEST} to {LARGEST} pixels each way")
    return width, height


def frame_head(anatomy: Anatomy, aspect: float) -> Camera:
    """Return the portrait camera: from above the hair to the collar, wider where the picture is narrow."""
    u = anatomy.unit
    top, bottom = anatomy.top + 22.0 * u, anatomy.chin - 44.0 * u
    if aspect < 0.9:
        middle, half = 0.5 * (top + bottom), 0.5 * (top - bottom) * 0.9 / aspect
        top, bottom = middle + half, middle - half
    return portrait(top, bottom, (0.0, anatomy.eye_height, 0.0))


def _check_background(background: FloatArray | None, width: int, height: int) -> FloatArray:
    if background is None:
        return studio_backdrop(width, height)
    if background.shape != (height, width, 3):
        raise InputError(f"background {background.shape}; expected {(height, width, 3)}")
    return np.array(background, np.float32)
