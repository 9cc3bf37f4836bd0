"""A head's colours in a file for programs whose lamps cast no fine shadows.

Our renderers find for each picture how much light comes past the lips, lids and hair, and where the cloth
begins. Engines light a glTF by its material alone. So the shade of an open mouth and of hair is in the
colours of vertices here, that of lids in the eye's picture, and the neckline in two small pictures that are
looked up by the distance from it. Our film makes light colours paler, too: the file has them as pictures show
them, or cheeks and nose would be redder in engines.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...core.arrays import Array, ByteArray, FloatArray
from ...face.head.head import Head
from ...looks.anatomy import Anatomy, find_anatomy, smoothstep
from ...looks.attributes import ALBEDO, INNER, SKIN, TEETH, TONGUE
from ...looks.eyeball import iris_picture
from ...looks.garment import neckline
from ...looks.parts import HEM, Part
from ...looks.srgb import linear, srgb_decode, srgb_encode
from ...render.lights import STUDIO
from ...render.materials.mouth import past_open_lips
from ...render.resting import light_at_rest
from ...render.tone import film

# The shares of light are those in lips that stand apart as in an open vowel: mm from where they meet.
_UPPER, _LOWER = 3.0, 9.0
_LEAST = 0.04  # of the light, where none comes straight from outside
_MATT, _SKIN = 0.92, 0.5  # roughness
_REACH, _STEP = 64.0, 0.25  # mm on both sides of the neckline that the pictures show, and of a pixel
_UNDER_HAIR = 0.75  # share of the lamps' shade under hair that is in the colours
_LID = (0.42, 0.86)  # radii of the eyeball between which lids shade it
_SHADED = 0.55  # share of light left there


@dataclass(frozen=True)
class GlbPaint:
    """Colours and pictures of one head."""

    head: Head

    def shade(self, part: Part) -> Array:
        """Return the share of light (n,), 0 to 1, that reaches a part's vertices past lips and hair."""
        if part.surface == TONGUE:
            return self._past_lips(part.points)
        if part.surface == TEETH:
            return self._past_lips(part.points, teeth=True)
        if part.surface != SKIN:
            return np.ones(len(part.points))
        past_lips = 1.0 - part.attributes[:, INNER] * (1.0 - self._past_lips(part.points))
        return np.asarray(past_lips * (1.0 - _UNDER_HAIR * (1.0 - self._light[:, 1])))

    def colours(self, part: Part) -> Array:
        """Return the linear colours (n, 3) of a part's vertices, 0 to 1, where the skin has its pictures."""
        colours = shown(part.colours)
        if part.surface == SKIN:
            colours = shown(part.attributes[:, ALBEDO : ALBEDO + 3])
            # The pictures cannot lighten: dark skin goes over into light cloth in the colours themselves.
            covered = np.clip(0.5 + self._depth / HEM, 0.0, 1.0)[:, None]
            colours += covered * (self._cloth / self._worn(part) - colours)
        return np.clip(colours * self.shade(part)[:, None], 0.0, 1.0)

    def skin_places(self) -> Array:
        """Return where each vertex of the skin (n, 2) is looked up in the skin's pictures."""
        across = np.clip(0.5 + self._depth / (2.0 * _REACH), 0.0, 1.0)
        return np.stack([across, 0.25 + 0.5 * self._light[:, 0]], axis=1)

    def skin_picture(self, part: Part) -> ByteArray:
        """Return the factors on the skin's colours, sRGB (2, n, 3): 1 but where cloth is."""
        row = np.where(_columns()[:, None] > 0.0, self._worn(part), 1.0)
        return np.round(255.0 * srgb_encode(np.stack([row, row]))).astype(np.uint8)

    def surface_picture(self) -> ByteArray:
        """Return the light that is free (red: 0, then 1), roughness (green), metal (blue), (2, n, 3)."""
        rough = np.where(_columns() > 0.0, _MATT, _SKIN)
        rows = [np.stack([np.full_like(rough, free), rough, np.zeros_like(rough)], axis=1) for free in (0, 1)]
        return np.round(255.0 * np.stack(rows)).astype(np.uint8)

    def eye_picture(self) -> ByteArray:
        """Return the front of an eye as `iris_picture` does, darkened where lids shade it."""
        picture = iris_picture(*self.head.identity.looks.iris)
        side = (np.arange(len(picture)) + 0.5) / len(picture) * 2.0 - 1.0
        shade = 1.0 - (1.0 - _SHADED) * smoothstep(*_LID, np.hypot(*np.meshgrid(side, side)))
        light = srgb_decode(picture / 255.0) * shade[..., None]
        return np.round(255.0 * srgb_encode(light)).astype(np.uint8)

    @cached_property
    def _light(self) -> FloatArray:
        return light_at_rest(self.head, STUDIO)

    @cached_property
    def _anatomy(self) -> Anatomy:
        return find_anatomy(self.head)

    @cached_property
    def _depth(self) -> Array:
        return np.asarray(neckline(self._anatomy))

    @property
    def _cloth(self) -> Array:
        return shown(linear(self.head.identity.looks.cloth))

    def _worn(self, part: Part) -> Array:
        """Return the factors (3,) of the cloth on the skin's colour at the neckline, at most 1."""
        bare = shown(part.attributes[np.abs(self._depth) < HEM, ALBEDO : ALBEDO + 3]).mean(axis=0)
        return np.asarray(np.clip(self._cloth / bare, 1e-3, 1.0))

    def _past_lips(self, points: Array, *, teeth: bool = False) -> Array:
        """Return the share of light (n,) that enters past open lips, reaches points (n, 3), and leaves."""
        (_, height, front), share = self._anatomy.mouth.astype(np.float32), np.empty(len(points), np.float32)
        slit = front, height + np.float32(_UPPER), height - np.float32(_LOWER)
        past_open_lips(points.astype(np.float32), *slit, teeth, share)
        return np.maximum(share.astype(np.float64), _LEAST)


def shown(albedo: FloatArray) -> Array:
    """Return the colours (…, 3), 0 to 1, that look in white light as albedos do in our studio's light."""
    lamps = sum(max(lamp.direction()[2], 0.0) * np.mean(lamp.colour) for lamp in STUDIO.lamps)
    light = lamps + 0.5 * np.mean(STUDIO.sky) + 0.5 * np.mean(STUDIO.ground)  # on what faces the camera
    return film(light * np.clip(albedo, 0.0, 1.0)) / float(film(np.asarray(light)))


def _columns() -> Array:
    """Return the distance in mm from the neckline of each column of the skin's pictures."""
    count = round(2.0 * _REACH / _STEP)
    return ((np.arange(count) + 0.5) / count * 2.0 - 1.0) * _REACH
