"""Pictures as video stores them (BT.709, limited range): brightness per pixel, colour per four pixels."""

from __future__ import annotations

from ..core.arrays import ByteArray
from ..core.kernels.jit import i4, lean_device, lean_kernel

_BITS = 15
# ITU-R BT.709-6, sections 3.2 and 4: shares of red and blue in the brightness; the ranges of the numbers.
_RED, _BLUE = 0.2126, 0.0722
_BRIGHT, _COLOURED, _LOWEST, _GREY = 219 / 255, 224 / 255, 16, 128


def _row(red: float, green: float, blue: float, size: float) -> tuple[int, int, int]:
    """Return three weights as whole numbers of 2^-_BITS."""
    scale = size * (1 << _BITS)
    return round(red * scale), round(green * scale), round(blue * scale)


_GREEN = 1.0 - _RED - _BLUE
_Y = _row(_RED, _GREEN, _BLUE, _BRIGHT)
_CB = _row(-_RED, -_GREEN, 1.0 - _BLUE, _COLOURED / (2.0 * (1.0 - _BLUE)))
_CR = _row(1.0 - _RED, -_GREEN, -_BLUE, _COLOURED / (2.0 * (1.0 - _RED)))


def planes(rgb: ByteArray, out: ByteArray) -> None:
    """Write a picture (height, width, 3) of even sides as yuv420p: Y, Cb and Cr, each row by row.

    `out` (height · width · 3 / 2,) uint8. A colour is the mean of its four pixels'.
    """
    height, width, _ = rgb.shape
    pixels = height * width
    _brightness(rgb, out[:pixels].reshape(height, width))
    halves = out[pixels:].reshape(2, height // 2, width // 2)
    _colour(rgb, halves[0], halves[1])


@lean_kernel
def _brightness(rgb: ByteArray, out: ByteArray) -> None:
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            out[y, x] = _weighed(i4(rgb[y, x, 0]), i4(rgb[y, x, 1]), i4(rgb[y, x, 2]), _Y, _LOWEST, _BITS)


@lean_kernel
def _colour(rgb: ByteArray, blue: ByteArray, red: ByteArray) -> None:
    for y in range(blue.shape[0]):
        for x in range(blue.shape[1]):
            r, g, b = _four(rgb, y, x, 0), _four(rgb, y, x, 1), _four(rgb, y, x, 2)
            blue[y, x] = _weighed(r, g, b, _CB, _GREY, _BITS + 2)
            red[y, x] = _weighed(r, g, b, _CR, _GREY, _BITS + 2)


@lean_device
def _four(rgb: ByteArray, y: int, x: int, channel: int) -> int:
    """Return the sum of the four numbers of a channel at place (y, x) of a plane of half the size."""
    top, left = 2 * y, 2 * x
    upper = i4(rgb[top, left, channel]) + i4(rgb[top, left + 1, channel])
    return i4(upper + i4(rgb[top + 1, left, channel]) + i4(rgb[top + 1, left + 1, channel]))


@lean_device
def _weighed(r: int, g: int, b: int, weights: tuple[int, int, int], base: int, bits: int) -> int:
    """Return the weighted sum of three channels, rounded, plus `base`."""
    total = i4(r * i4(weights[0])) + i4(g * i4(weights[1])) + i4(b * i4(weights[2]))
    return i4(i4(total + i4((base << bits) + (1 << (bits - 1)))) >> bits)
