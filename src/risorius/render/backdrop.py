"""What stands behind the head: a soft gradient, a colour or a picture, in display light."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.arrays import ByteArray, Float32Array
from ..core.look import TRANSPARENT
from ..errors import InputError, Place
from ..looks.srgb import srgb_decode

Colour = tuple[int, int, int]
_SEED = 3


def backdrop(width: int, height: int, asked: str | None, centre: Colour, edge: Colour) -> Float32Array:
    """Return display light (height, width, 3) float32 of what is asked for as `Look.background`.

    `centre` and `edge` are those of the gradient that stands where nothing is asked for. Raises InputError
    for what is neither a colour nor a picture.
    """
    if asked is None:
        return gradient(width, height, centre, edge)
    if Path(asked).is_file():
        return _picture(Path(asked), width, height)
    return np.tile(srgb_decode(np.array(colour_named(asked)) / 255.0).astype(np.float32), (height, width, 1))


def gradient(width: int, height: int, centre: Colour, edge: Colour) -> Float32Array:
    """Return display light (height, width, 3) float32: `centre` behind the head, `edge` in the corners.

    Half a step of fixed noise hides the bands that eight bits would show.
    """
    y, x = np.mgrid[0:height, 0:width]
    reach = 0.5 * max(width, height)
    distance = np.hypot((x - 0.5 * width) / (1.25 * reach), (y - 0.46 * height) / (1.25 * reach))
    share = np.exp(-1.5 * distance**2)[..., None]
    inner, outer = np.array(centre) / 255.0, np.array(edge) / 255.0
    encoded = outer + share * (inner - outer)
    noise = np.random.default_rng(_SEED).uniform(-0.5, 0.5, (height, width, 1)) / 255.0
    return srgb_decode(np.clip(encoded + noise, 0.0, 1.0)).astype(np.float32)


def colour_named(asked: str) -> Colour:
    """Return a colour as CSS writes it, 0..255 each; raise InputError for what is none."""
    from PIL import ImageColor

    try:
        red, green, blue = ImageColor.getrgb(asked)[:3]
    except ValueError:
        raise InputError(
            f"background '{asked}' is neither a file nor a colour; expected e.g. '#203040', 'white', "
            f"'{TRANSPARENT}' or a picture"
        ) from None
    return red, green, blue


def _picture(path: Path, width: int, height: int) -> Float32Array:
    """Return a picture cut to the proportions asked for, about its middle, and brought to that size."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with Image.open(path) as image:
            fitted = ImageOps.fit(image.convert("RGB"), (width, height), Image.Resampling.LANCZOS)
    except (UnidentifiedImageError, OSError, Image.DecompressionBombError) as error:
        raise InputError(f"not a picture: {error}", Place(str(path))) from error
    encoded: ByteArray = np.asarray(fitted)
    return srgb_decode(encoded / 255.0).astype(np.float32)
