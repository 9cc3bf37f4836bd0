"""The display light of vertices, within whose triangles pixels interpolate it."""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...machine.kernels.jit import device, f4
from ...machine.kernels.vec import Vec
from ..inputs import LinearTriangles
from ..tone import exposed
from .shading_sample import put

_STEP = f4(1.1)  # by which light is multiplied to see how the film answers


@device("fast")
def expose(v: int, light: Vec, film: Float32Array, linear: LinearTriangles) -> float:
    """Write the display light of scene light at vertex v.

    Return by what share the display light of green grows if its scene light grows by 1.
    """
    red, green, blue = exposed(film, light[0]), exposed(film, light[1]), exposed(film, light[2])
    put(linear.display, v, (red, green, blue))
    whole = max(light[1], f4(1e-3))
    return (exposed(film, whole * _STEP) / max(green, f4(1e-4)) - f4(1)) / ((_STEP - f4(1)) * whole)
