"""The background of a picture: a soft gradient, a colour or a picture, in display light."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import ByteArray, Float32Array
from ..core.look import ByteColour, parse_colour
from ..errors import InputError, Place
from ..looks.srgb import srgb_decode
from ..machine.array_cache import cached_arrays
from ..machine.paths import is_file

if TYPE_CHECKING:
    from PIL.Image import Image

_SEED = 3
_FORMATS = ("PNG", "JPEG", "WEBP", "GIF", "BMP", "TIFF")
_MOST_PIXELS = 50_000_000


def backdrop(
    width: int, height: int, background: str | None, centre: ByteColour, edge: ByteColour
) -> Float32Array:
    """Return display light (height, width, 3) float32 for `Look.background`: a colour or a picture's path.

    If it is None, a gradient from `centre` to `edge` is drawn. Raises InputError for a text that is neither a
    colour nor a picture.
    """
    if background is None:
        return gradient(width, height, centre, edge)
    if is_file(Path(background)):
        return _picture(Path(background), width, height)
    colour = srgb_decode(np.array(parse_colour(background)) / 255.0)
    return np.tile(colour.astype(np.float32), (height, width, 1))


def gradient(width: int, height: int, centre: ByteColour, edge: ByteColour) -> Float32Array:
    """Return display light (height, width, 3) float32: `centre` behind the head, `edge` in the corners.

    Half a step of fixed noise hides the bands that eight bits would show.
    """
    (light,) = cached_arrays(
        "gradient", [width, height, centre, edge], lambda: (_shaded(width, height, centre, edge),)
    )
    return light


def _shaded(width: int, height: int, centre: ByteColour, edge: ByteColour) -> Float32Array:
    y, x = np.mgrid[0:height, 0:width]
    reach = 0.5 * max(width, height)
    distance = np.hypot((x - 0.5 * width) / (1.25 * reach), (y - 0.46 * height) / (1.25 * reach))
    share = np.exp(-1.5 * distance**2)[..., None]
    inner, outer = np.array(centre) / 255.0, np.array(edge) / 255.0
    encoded = outer + share * (inner - outer)
    noise = np.random.default_rng(_SEED).uniform(-0.5, 0.5, (height, width, 1)) / 255.0
    return srgb_decode(np.clip(encoded + noise, 0.0, 1.0)).astype(np.float32)


def check_background(background: str) -> None:
    """Raise InputError for a text that is neither a colour nor a picture that can be decoded."""
    if is_file(Path(background)):
        with _opened(Path(background)) as image:
            image.load()
    else:
        parse_colour(background)


def _picture(path: Path, width: int, height: int) -> Float32Array:
    """Return a picture cut about its middle to the proportions of width and height, then scaled to them."""
    from PIL import Image, ImageOps

    with _opened(path) as image:
        fitted = ImageOps.fit(image.convert("RGB"), (width, height), Image.Resampling.LANCZOS)
    encoded: ByteArray = np.asarray(fitted)
    return srgb_decode(encoded / 255.0).astype(np.float32)


@contextmanager
def _opened(path: Path) -> Iterator[Image]:
    """Open a picture; raise InputError if it is too large, or the block finds a fault in it."""
    from PIL import Image

    place = Place(str(path))
    try:
        with Image.open(path, formats=_FORMATS) as image:
            if image.width * image.height > _MOST_PIXELS:
                size = f"{image.width} x {image.height} pixels"
                raise InputError(f"has {size}; expected at most {_MOST_PIXELS:,}", place)
            yield image
    except InputError:
        raise
    except Exception as error:
        # PIL's decoders raise a dozen kinds, SyntaxError among them, for what is damaged.
        message = f"not a picture: {error}; expected one of {', '.join(_FORMATS)}"
        raise InputError(message, place) from error
