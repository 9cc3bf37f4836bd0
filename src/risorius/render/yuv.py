"""Pictures as video stores them (BT.709, limited range): brightness per pixel, colour per four pixels."""

from __future__ import annotations

from ..core.arrays import ByteArray
from ..machine.kernels.jit import device, i4, kernel

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
    _brightness(rgb.reshape(-1), out[:pixels])
    halves = out[pixels:].reshape(2, height // 2, width // 2)
    _colour(rgb.reshape(height, -1), halves[0], halves[1])


# Arrays of few dimensions: only so does the compiler turn these loops into vector code.
@kernel("u1[:], u1[:]")
def _brightness(rgb: ByteArray, out: ByteArray) -> None:
    """Write the brightness (n,) of pixels (3 n,)."""
    for i in range(len(out)):
        out[i] = _weighed(i4(rgb[3 * i]), i4(rgb[3 * i + 1]), i4(rgb[3 * i + 2]), _Y, _LOWEST, _BITS)


@kernel("u1[:, :], u1[:, :], u1[:, :]")
def _colour(rgb: ByteArray, blue: ByteArray, red: ByteArray) -> None:
    """Write the colours (h, w) of pixels (2 h, 6 w)."""
    for y in range(blue.shape[0]):
        for x in range(blue.shape[1]):
            r, g, b = _four(rgb, y, 6 * x), _four(rgb, y, 6 * x + 1), _four(rgb, y, 6 * x + 2)
            blue[y, x] = _weighed(r, g, b, _CB, _GREY, _BITS + 2)
            red[y, x] = _weighed(r, g, b, _CR, _GREY, _BITS + 2)


@device()
def _four(rgb: ByteArray, y: int, column: int) -> int:
    """Return the sum of a channel over four pixels, the first of which stands in row 2 y."""
    upper = i4(rgb[2 * y, column]) + i4(rgb[2 * y, column + 3])
    return i4(upper + i4(rgb[2 * y + 1, column]) + i4(rgb[2 * y + 1, column + 3]))


@device()
def _weighed(r: int, g: int, b: int, weights: tuple[int, int, int], base: int, bits: int) -> int:
    """Return the weighted sum of three channels, rounded, plus `base`."""
    total = i4(r * i4(weights[0])) + i4(g * i4(weights[1])) + i4(b * i4(weights[2]))
    return i4(i4(total + i4((base << bits) + (1 << (bits - 1)))) >> bits)
