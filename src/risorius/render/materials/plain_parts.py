"""Eyes, teeth and tongue of the plain material."""

from __future__ import annotations

import math

from ...looks import attributes
from ...looks.attributes import EYE_LEFT, TEETH
from ...looks.eyeball import IRIS
from ...machine.kernels.jit import device, f4
from ...machine.kernels.vec import (
    Vec,
    along,
    dot,
    mix,
    saturate,
    scale,
    smooth,
    sub,
    times,
    unit,
    unrotate,
    weigh,
)
from ..brdf import gloss
from ..inputs import Batch, Pose, PosedMesh, SceneLight, Screen
from .eye import lid_distances, lid_shade
from .lit import ambient_light, key_share, lamp_colour, lamp_direction, lamp_share
from .mouth import past_lips
from .shading_sample import Corners, corners_of, towards, weights_of

MIRRORED = f4(0.04)  # reflected share of clay at a right angle
ROUGH = f4(0.34)
_BALL = (f4(0.66), f4(0.66), f4(0.66))
_RING = (f4(0.16), f4(0.16), f4(0.17))
_PUPIL = f4(0.42)  # radii of the iris
_FAR = f4(20)  # mm: plain eyes have no corners


@device("fast")
def facing(normal: Vec, direction: Vec) -> float:
    """Return the cosine of matt light, wrapped a little around the edge."""
    return saturate((dot(normal, direction) + f4(0.12)) * f4(1 / 1.12))


@device("fast", inlined=True)
def shade_part(
    k: int, surface: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, pose: Pose
) -> Vec:
    """Return the light from patch k of an eye, tooth or tongue."""
    corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
    p = weigh(mesh.positions, corners, weights, 0)
    key, view = key_share(light, p), towards(screen.eye, p)
    if surface < TEETH:
        return _ball(mesh, light, pose, surface - EYE_LEFT, corners, weights, p, view, key)
    albedo = weigh(mesh.attributes, corners, weights, attributes.ALBEDO)
    deep = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
    normal = unit(weigh(mesh.normals, corners, weights, 0))
    return _matt(mesh, light, corners, weights, normal, view, albedo, deep, key)


@device("fast", inlined=True)
def _matt(
    mesh: PosedMesh,
    light: SceneLight,
    corners: Corners,
    weights: Vec,
    normal: Vec,
    view: Vec,
    albedo: Vec,
    free: float,
    key: float,
) -> Vec:
    """Return matt light with the gloss of clay, where the share `free` of all light arrives."""
    total = times(albedo, ambient_light(light.ambient, normal, free))
    for k in range(len(light.lamps)):
        direction, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        share = lamp_share(mesh.reach, corners, weights, k) * free * (key if k == 0 else f4(1))
        total = along(total, times(albedo, colour), facing(normal, direction) * share)
    shine = gloss(normal, view, lamp_direction(light.lamps, 0), ROUGH, MIRRORED) * key * free
    return along(total, lamp_colour(light.lamps, 0), shine)


@device("fast", inlined=True)
def _ball(
    mesh: PosedMesh,
    light: SceneLight,
    pose: Pose,
    side: int,
    corners: Corners,
    weights: Vec,
    p: Vec,
    view: Vec,
    key: float,
) -> Vec:
    """Return the light from an eye: a matt ball with a ring for the iris, in the shade of its lids."""
    centre = (pose.eyes[side, 0], pose.eyes[side, 1], pose.eyes[side, 2])
    outward = unit(sub(p, centre))
    local = unrotate(pose.eye_axes[side], outward)
    in_head = unrotate(pose.rotation, outward)
    below, above = lid_distances(pose.lids, pose.lid_span, side, in_head, pose.eye_radius[side])
    shade = lid_shade(below, above, _FAR, _FAR)
    ring = math.sqrt(local[0] * local[0] + local[1] * local[1]) / IRIS
    iris = f4(1) - smooth(f4(0.94), f4(1.06), ring)
    pupil = f4(1) - smooth(_PUPIL - f4(0.05), _PUPIL + f4(0.05), ring)
    albedo = mix(_BALL, _RING, iris if local[2] > f4(0) else f4(0))
    albedo = scale(albedo, f4(1) - f4(0.85) * pupil * iris)
    lit = _matt(mesh, light, corners, weights, outward, view, albedo, shade, key)
    spark = gloss(outward, view, lamp_direction(light.lamps, 0), f4(0.03), MIRRORED) * shade
    return along(lit, lamp_colour(light.lamps, 0), min(spark, f4(1.2)))
