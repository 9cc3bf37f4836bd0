"""The inside of the mouth: teeth, gums, tongue, and how little light comes past the lips."""

from __future__ import annotations

import math

from ..brdf import gloss
from ..inputs import ALBEDO, OCCLUSION, TEETH, TONGUE, Batch, Light, Mesh, Pose, Sight
from ..jit import device, f4
from ..vec import Vec, along, dot, saturate, scale, sub, times, unrotate, weigh
from .lit import key_share, lamp_colour, lamp_direction, room_light
from .patch import Corners, corners_of, place_of, put, weights_of

LIP_STEPS = 32
_GLOSS = f4(0.03)


@device
def past_lips(pose: Pose, p: Vec) -> float:
    """Return how much light 0..1 comes to a point within the mouth past the lips, and out again.

    The slit of the lips is taken as an endless strip, at the point's own x and, since light also falls in
    slantwise, halfway to the middle. What enters must leave the same way, so depth darkens twice.
    """
    x, y, z = unrotate(pose.rotation, sub(p, (pose.pivot[0], pose.pivot[1], pose.pivot[2])))
    x, y, z = x + pose.pivot[0], y + pose.pivot[1], z + pose.pivot[2]
    seen = max(_strip(pose, x, y, z), f4(0.75) * _strip(pose, x * f4(0.5), y, z))
    return min(f4(1.6) * seen, f4(1)) * (f4(0.3) + f4(0.7) * seen)


@device
def _strip(pose: Pose, x: float, y: float, z: float) -> float:
    """Return the form factor of the slit over x: half the difference of the sines towards its two edges."""
    left, right = pose.lip_span[0], pose.lip_span[1]
    place = saturate((x - left) / (right - left)) * f4(LIP_STEPS - 1.001)
    i = int(place)
    s = place - f4(i)
    top, top_z = _edge(pose, i, s, 0)
    low, low_z = _edge(pose, i, s, 2)
    up, down = top - y, low - y
    ahead = max(f4(0.5) * (top_z + low_z) - z, f4(0.3))
    up_sine = up / math.sqrt(up * up + ahead * ahead)
    down_sine = down / math.sqrt(down * down + ahead * ahead)
    beside = max(max(left - x, x - right), f4(0))
    return saturate(f4(0.5) * (up_sine - down_sine)) * ahead / (ahead + f4(2) * beside)


@device
def _edge(pose: Pose, i: int, s: float, column: int) -> tuple[float, float]:
    y, z = pose.lips[i, column], pose.lips[i, column + 1]
    return y + (pose.lips[i + 1, column] - y) * s, z + (pose.lips[i + 1, column + 1] - z) * s


@device
def shade_mouth(turn: int, n: int, batch: Batch, mesh: Mesh, sight: Sight, light: Light, pose: Pose) -> None:
    """Colour the patches of teeth, gums and tongue among the first n of a row."""
    for k in range(n):
        t = batch.triangle[turn, k]
        if mesh.surfaces[t] == TEETH or mesh.surfaces[t] == TONGUE:
            corners, weights = corners_of(mesh, t), weights_of(batch, turn, k)
            p, normal, view = place_of(mesh, sight, corners, weights)
            put(batch, turn, k, _wet(mesh, light, pose, corners, weights, p, normal, view))


@device
def _wet(mesh: Mesh, light: Light, pose: Pose, corners: Corners, weights: Vec, p: Vec, normal: Vec, view: Vec) -> Vec:
    """Return the light from teeth, gums and tongue: wet, and dark with their depth behind the lips."""
    albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
    free, roughness, strength = weigh(mesh.attributes, corners, weights, OCCLUSION)
    deep = past_lips(pose, p) * free
    shadow = key_share(light, p)
    total = times(albedo, scale(room_light(light, normal, f4(1)), deep * f4(1.5)))
    for k in range(2):
        direction, colour = lamp_direction(light, k), lamp_colour(light, k)
        arriving = deep * (shadow if k == 0 else f4(1))
        wrapped = saturate((dot(normal, direction) + f4(0.4)) * f4(1 / 1.4))
        total = along(total, times(albedo, colour), wrapped * arriving)
        total = along(total, colour, gloss(normal, view, direction, roughness, _GLOSS) * strength * arriving)
    return total
