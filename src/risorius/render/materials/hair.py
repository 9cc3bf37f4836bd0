"""Hairs: a fibre mirrors light into a cone about its own direction (Kajiya and Kay 1989), twice.

Hairs are thinner than pixels, so their light is computed at the points of their curves and interpolated.
"""

from __future__ import annotations

import math

from ...core.arrays import Float32Array, Int32Array
from ...looks.attributes import HAIR, OCCLUSION, SPECULAR
from ...machine.kernels.jit import device, f4, kernel
from ...machine.kernels.vec import Vec, add, along, at, dot, saturate, scale, sub, times, unit, weigh
from ..inputs import Batch, PosedMesh, SceneLight
from .lit import ambient_light, key_share, lamp_colour, lamp_direction
from .shading_sample import corners_of, put, weights_of


@kernel("PosedMesh, SceneLight, f4[:], i4[:]", arithmetic="fast")
def light_hairs(mesh: PosedMesh, light: SceneLight, eye: Float32Array, pairs: Int32Array) -> None:
    """Write the light of hairs' vertices, `pairs` (k,) and the next of each, into `mesh.vertex_light`."""
    camera = (eye[0], eye[1], eye[2])
    for i in pairs:
        direction = at(mesh.normals, i)
        if dot(direction, direction) == f4(0):
            continue  # a hair behind the head
        p = scale(add(at(mesh.positions, i), at(mesh.positions, i + 1)), f4(0.5))
        colour = _fibre(mesh, light, i, p, direction, unit(sub(camera, p)))
        for row in range(i, i + 2):
            mesh.vertex_light[row, 0], mesh.vertex_light[row, 1], mesh.vertex_light[row, 2] = colour


@device("fast")
def shade_hairs(n: int, batch: Batch, mesh: PosedMesh) -> None:
    """Colour the patches of hair among the first n of a row."""
    for k in range(n):
        t = batch.triangle[k]
        if mesh.surfaces[t] >= HAIR:
            put(
                batch.colour,
                k,
                weigh(mesh.vertex_light, corners_of(mesh.triangles, t), weights_of(batch.weights, k), 0),
            )


@device("fast", inlined=True)
def _fibre(mesh: PosedMesh, light: SceneLight, i: int, p: Vec, direction: Vec, view: Vec) -> Vec:
    """Return the light from a hair at p, vertex i, that runs along `direction`."""
    albedo = at(mesh.attributes, i)
    free, strength = mesh.attributes[i, OCCLUSION], mesh.attributes[i, SPECULAR]
    across = facing_fibre(direction, view)
    shadow = key_share(light, p)
    total = times(albedo, ambient_light(light.ambient, across, free))
    for k in range(len(light.lamps)):
        lamp, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        share = (shadow if k == 0 else mesh.reach[i, k]) * between_fibres(free)
        total = add(total, lamp_on_fibre(albedo, colour, lamp, direction, across, view, share, strength))
    return total


@device("fast")
def facing_fibre(direction: Vec, view: Vec) -> Vec:
    """Return the normal of a fibre's side that is seen."""
    return unit(along(view, direction, -dot(view, direction)))


@device("fast")
def between_fibres(free: float) -> float:
    """Return the share of a lamp that comes between other hairs to one that sees the share `free`."""
    return f4(0.4) + f4(0.6) * free


@device("fast")
def lamp_on_fibre(
    albedo: Vec, colour: Vec, lamp: Vec, direction: Vec, across: Vec, view: Vec, share: float, strength: float
) -> Vec:
    """Return the light that a fibre along `direction` reflects of the share of a lamp."""
    cosine = dot(direction, lamp)
    sine = math.sqrt(saturate(f4(1) - cosine * cosine))
    facing = saturate(dot(across, lamp) * f4(0.6) + f4(0.4))
    shine = scale(fibre_shine(albedo, colour, direction, view, lamp), facing * share * strength)
    return along(shine, times(albedo, colour), f4(0.7) * sine * facing * share)


@device("fast")
def fibre_shine(albedo: Vec, colour: Vec, direction: Vec, view: Vec, lamp: Vec) -> Vec:
    """Return the white highlight, and the coloured one that has passed through the fibre, towards the tip."""
    half = unit(add(view, lamp))
    tilt = dot(direction, half)
    first, second = tilt + f4(0.09), tilt - f4(0.14)
    white = math.exp(-first * first * f4(60)) * f4(0.085)
    tinted = math.exp(-second * second * f4(14)) * f4(1.9)
    return along(scale(colour, white), times(albedo, colour), tinted)
