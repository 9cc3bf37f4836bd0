"""The key lamp's shadow on a block of patches: looked up where it bends, and a straight line between."""

from __future__ import annotations

from ..inputs import Light
from ..jit import device, f4, inlined
from ..lanes import POSITION, SHADOW, get
from ..raster import FloatArray
from ..vec import dot, sub
from .lit import key_share

_NEAR = f4(1.5)  # mm within which a shadow's soft edge, some 6 mm wide, is as good as straight
_EVEN = f4(0.06)  # shares of the key lamp that differ by less have nothing between them


@inlined
def find_shadows(count: int, block: FloatArray, light: Light) -> None:
    """Write the share of the key lamp that arrives at each of `count` patches, neighbours in a row."""
    for k in range(0, count, 4):
        block[SHADOW + k] = key_share(light, get(block, POSITION, k))
    for step in (2, 1):
        for k in range(step, count, 2 * step):
            if k + step < count and _smooth(block, k, step):
                block[SHADOW + k] = f4(0.5) * (block[SHADOW + k - step] + block[SHADOW + k + step])
            else:
                block[SHADOW + k] = key_share(light, get(block, POSITION, k))


@device
def _smooth(block: FloatArray, k: int, step: int) -> bool:
    """Return whether patch k lies near those `step` before and after, and the shadow's edge is straight."""
    p, before, after = get(block, POSITION, k), block[SHADOW + k - step], block[SHADOW + k + step]
    back, on = sub(p, get(block, POSITION, k - step)), sub(get(block, POSITION, k + step), p)
    near = _NEAR * f4(step)
    close = dot(back, back) < near * near and dot(on, on) < near * near
    return close and (step == 1 or abs(after - before) < _EVEN)
