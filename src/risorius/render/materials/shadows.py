"""The key lamp's shadow on the skin: computed at vertices, and between them only where these differ."""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...machine.kernels.jit import device, f4, kernel
from ...machine.kernels.vec import Vec, at
from ..inputs import PosedMesh, SceneLight
from .lit import key_share
from .shading_sample import Corners

EVEN = f4(0.1)
"""Vertices whose shares differ by less need no shadow computed between them."""


@kernel("f4[:, :], SceneLight, f4[:]", arithmetic="fast", wide=True)
def cast_shadows(positions: Float32Array, light: SceneLight, shadow: Float32Array) -> None:
    """Write the share of the key lamp that reaches each of the first vertices into `shadow` (n,)."""
    for i in range(len(shadow)):
        shadow[i] = key_share(light, at(positions, i))


@device("fast", inlined=True)
def shadow_at(mesh: PosedMesh, light: SceneLight, corners: Corners, weights: Vec, p: Vec) -> float:
    """Return the share of the key lamp that reaches p, a place in a triangle of skin."""
    a, b, c = mesh.shadow[corners[0]], mesh.shadow[corners[1]], mesh.shadow[corners[2]]
    if max(a, b, c) - min(a, b, c) > EVEN:
        return key_share(light, p)
    share: float = weights[0] * a + weights[1] * b + weights[2] * c
    return share
