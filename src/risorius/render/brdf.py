"""How light leaves a surface: microfacet gloss and Fresnel's law, in float32 for kernels."""

from __future__ import annotations

from .jit import device, f4
from .vec import Vec, add, dot, saturate, unit

_PI = f4(3.14159265)


@device
def schlick(cosine: float, facing: float) -> float:
    """Return the share of light mirrored at an angle (cosine), `facing` of it head on (Schlick 1994)."""
    m = f4(1) - saturate(cosine)
    m2 = m * m
    return facing + (f4(1) - facing) * m2 * m2 * m


@device
def ggx(nh: float, alpha: float) -> float:
    """Return the density of microfacets of width `alpha` that face the half vector (Walter et al. 2007)."""
    a2 = alpha * alpha
    d = nh * nh * (a2 - f4(1)) + f4(1)
    return a2 / (_PI * d * d)


@device
def gloss(normal: Vec, view: Vec, light: Vec, alpha: float, facing: float) -> float:
    """Return the mirrored light times the cosine at the surface: GGX with Kelemen's visibility term."""
    nl = dot(normal, light)
    if nl <= f4(0):
        return f4(0)
    half = unit(add(view, light))
    nh, lh = saturate(dot(normal, half)), max(dot(light, half), f4(0.1))
    return nl * ggx(nh, alpha) * schlick(lh, facing) / (f4(4) * lh * lh)
