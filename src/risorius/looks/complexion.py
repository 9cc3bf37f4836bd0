"""The colours and gloss of the skin, painted on its vertices."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array, Float32Array
from ..face.head.identity import Looks
from .anatomy import Anatomy, smoothstep
from .attributes import ALBEDO, ATTRIBUTES, CURVATURE, EXTRA, INNER, MAX_CURVATURE, ROUGHNESS, SPECULAR
from .noise import noise_at
from .srgb import linear

# Factors on the albedo of regions.
_TINTS = {
    "cheek": (1.02, 0.82, 0.82),
    "nose": (1.01, 0.80, 0.78),
    "nostril": (0.96, 0.82, 0.80),
    "chin": (1.0, 0.91, 0.91),
    "under_eye": (0.97, 0.91, 0.93),
    "socket": (0.97, 0.91, 0.90),
    "forehead": (1.02, 1.02, 0.98),
    "ears": (1.0, 0.82, 0.80),
    "lids": (0.97, 0.91, 0.91),
}

_SHAVED = 0.34  # share of the hairs' colour in skin under the densest shaved beard


def paint_skin(anatomy: Anatomy, looks: Looks, neckline: Array, curvature: Array) -> Float32Array:
    """Return the attributes (N1, ATTRIBUTES) of the skin; renderers fill in the column OCCLUSION.

    `neckline` (N1,) is the distance into the cloth in mm, `curvature` (N1,) in 1/mm.
    """
    result = np.zeros((len(anatomy.skin), ATTRIBUTES), np.float32)
    result[:, ALBEDO : ALBEDO + 3] = _albedo(anatomy, looks)
    roughness, strength = _gloss(anatomy)
    result[:, ROUGHNESS] = roughness
    result[:, SPECULAR] = strength
    result[:, CURVATURE] = np.clip(curvature, 0.0, MAX_CURVATURE)
    result[:, INNER] = anatomy.masks["inner_mouth"]
    result[:, EXTRA] = neckline
    return result


def _blob(p: Array, centre: tuple[float, float], size: tuple[float, float]) -> Array:
    """Return the mask (N1,) of a soft spot on both sides of the face; its centre and size are in mm."""
    return np.exp(-(((np.abs(p[:, 0]) - centre[0]) / size[0]) ** 2) - ((p[:, 1] - centre[1]) / size[1]) ** 2)


def _regions(a: Anatomy) -> dict[str, Array]:
    """Return soft masks (N1,) of regions of the face."""
    p, u = a.skin, a.unit
    front = smoothstep(-45.0 * u, 5.0 * u, p[:, 2])
    cheek_height = 0.55 * a.eye_height + 0.45 * a.mouth[1]
    return {
        "cheek": front * _blob(p, (37 * u, cheek_height - 2 * u), (23 * u, 15 * u)),
        "nose": np.exp(-((np.linalg.norm(p - a.nose_tip, axis=1) / (13 * u)) ** 2)),
        "nostril": front * _blob(p, (14 * u, a.nose_tip[1] - 2 * u), (6 * u, 6 * u)),
        "chin": front * _blob(p, (0.0, 0.3 * a.mouth[1] + 0.7 * a.chin + 2 * u), (15 * u, 9 * u)),
        "under_eye": front * _blob(p, (27 * u, a.eye_height - 12 * u), (13 * u, 5 * u)),
        "socket": front * _blob(p, (22 * u, a.eye_height + 5 * u), (14 * u, 8 * u)),
        "forehead": front * _blob(p, (0.0, a.eye_height + 55 * u), (48 * u, 26 * u)),
        "ears": a.masks["ears"],
        "lids": a.masks["lids"] * (p[:, 2] > 0),
    }


def beard(a: Anatomy) -> Array:
    """Return how densely, 0..1, a beard grows at each skin vertex (N1,)."""
    p, u, mouth = a.skin, a.unit, float(a.mouth[1])
    aside = np.abs(p[:, 0]) / u
    top = mouth + u * (13.0 + 0.6 * np.maximum(aside - 28.0, 0.0))
    dense = (1.0 - smoothstep(-7.0 * u, 7.0 * u, p[:, 1] - top)) * smoothstep(-78.0 * u, -52.0 * u, p[:, 2])
    dense *= smoothstep(a.chin - 38.0 * u, a.chin + 2.0 * u, p[:, 1])
    # Few hairs grow below the lower lip beside its middle, and in the groove below the nose.
    dense *= 1.0 - 0.55 * _blob(p, (15.0 * u, mouth - 13.0 * u), (8.0 * u, 5.0 * u))
    dense *= 1.0 - 0.4 * np.exp(-((p[:, 0] / (3.0 * u)) ** 2)) * smoothstep(mouth, mouth + 8.0 * u, p[:, 1])
    return np.asarray(dense * (1.0 - a.masks["ears"]) * (0.95 + 0.09 * noise_at(p, 7.0)))


def _tint(colour: Array, amount: Array, factors: tuple[float, float, float]) -> Array:
    """Multiply colours (n, 3) by factors where `amount` (n,) is 1."""
    return colour * (1.0 + amount[:, None] * (np.asarray(factors) - 1.0))


def _albedo(a: Anatomy, looks: Looks) -> Array:
    p, flush = a.skin, looks.flush
    colour = np.tile(linear(looks.skin), (len(p), 1))
    for name, amount in _regions(a).items():
        if name in _TINTS:
            colour = _tint(colour, flush * amount, _TINTS[name])
    hairs = linear(looks.brows or looks.hair)
    colour = colour + (_SHAVED * looks.beard * beard(a))[:, None] * (hairs - colour)
    uneven = 0.5 * noise_at(p, 26.0) + 0.6 * noise_at(p, 11.0)
    colour = _tint(colour, flush * 0.026 * uneven, (0.4, 2.0, 1.8))
    lips = smoothstep(0.25, 0.75, a.masks["lips"])[:, None]
    colour = colour + lips * (linear(looks.lips) - colour)
    inner = smoothstep(0.3, 0.9, a.masks["inner_mouth"])[:, None]
    colour = colour + inner * (linear(looks.lining) - colour)
    return np.asarray(colour)


def _gloss(a: Anatomy) -> tuple[Array, Array]:
    """Return the gloss, roughness squared (N1,) and strength (N1,): oily forehead and nose, wet lips."""
    region = _regions(a)
    oily = np.maximum(region["forehead"], region["nose"])
    roughness = 0.21 - 0.07 * oily + 0.02 * region["cheek"]
    strength = 1.25 + 0.55 * oily - 0.15 * region["under_eye"]
    lips = smoothstep(0.25, 0.75, a.masks["lips"])
    inner = a.masks["inner_mouth"]
    roughness = roughness + lips * (0.085 - roughness)
    strength = strength + lips * (1.5 - strength)
    roughness = roughness + inner * (0.06 - roughness)
    return roughness, strength + inner * (1.5 - strength)
