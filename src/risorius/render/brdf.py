"""Reflection at a surface: microfacet gloss and Fresnel's law, in float32 for kernels."""

from __future__ import annotations

import math

from ..machine.kernels.jit import device, f4
from ..machine.kernels.vec import Vec, add, dot, saturate

_PI = f4(3.14159265)


@device("fast")
def schlick(cosine: float, facing: float) -> float:
    """Return the reflected share of light at an angle given by its cosine (Schlick 1994).

    `facing` is the share that is reflected at a right angle.
    """
    m = f4(1) - saturate(cosine)
    m2 = m * m
    return facing + (f4(1) - facing) * m2 * m2 * m


@device("fast")
def mirrored(facing_light: float, facing_half: float, apart: float, alpha: float, head_on: float) -> float:
    """Return the value of `gloss` from terms that several widths `alpha` share.

    `facing_light` is dot(normal, light), `facing_half` dot(normal, view + light), `apart` the square of the
    length of view + light. The fractions of GGX, of Kelemen's term and of the half vector make one here.
    """
    if facing_light <= f4(0):
        return f4(0)
    a2, apart, facing_half = alpha * alpha, max(apart, f4(0.04)), max(facing_half, f4(0))
    d = facing_half * facing_half * (a2 - f4(1)) + apart
    return facing_light * a2 * apart * schlick(f4(0.5) * math.sqrt(apart), head_on) / (_PI * d * d)


@device("fast")
def mirrored_change(
    facing_light: float, facing_half: float, apart: float, alpha: float, head_on: float
) -> tuple[float, float]:
    """Return how `mirrored` changes with `facing_light` and with `facing_half`."""
    if facing_light <= f4(0):
        return f4(0), f4(0)
    a2, apart, facing_half = alpha * alpha, max(apart, f4(0.04)), max(facing_half, f4(0))
    d = facing_half * facing_half * (a2 - f4(1)) + apart
    with_light = a2 * apart * schlick(f4(0.5) * math.sqrt(apart), head_on) / (_PI * d * d)
    return with_light, f4(4) * facing_light * with_light * facing_half * (f4(1) - a2) / d


@device("fast")
def gloss(normal: Vec, view: Vec, light: Vec, alpha: float, facing: float) -> float:
    """Return the mirrored light times the cosine at the surface: GGX with Kelemen's visibility term."""
    half = add(view, light)
    return mirrored(dot(normal, light), dot(normal, half), dot(half, half), alpha, facing)
