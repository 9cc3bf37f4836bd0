"""The library's own formulas, constants and tables of skin for a page that shades it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ...looks.anatomy import Anatomy
from ...looks.attributes import MAX_CURVATURE
from ...looks.eyeball import IRIS
from ...looks.garment import COLLAR
from ...looks.noise import SIZE as CELLS
from ...looks.noise import noise_tile
from ...looks.parts import HEM, TEETH_GLOSS, TONGUE_GLOSS
from ...render import shadow, subsurface, wrinkle_table
from ...render.brdf import gloss, mirrored, schlick
from ...render.lights import STUDIO
from ...render.materials import cloth, eye, hair, lit, mouth, skin, skin_lamps, wrinkle_normals
from .glsl import glsl_of
from .stage_table import StageShading, StageShadow

STRONGEST = 2.0
"""The strength of gloss for which a page has the highest number."""
_FUNCTIONS = (
    schlick,
    mirrored,
    gloss,
    lit.ambient_on,
    lit.warm_edge,
    subsurface.angle_place,
    subsurface.curvature_place,
    skin.pore_depth,
    skin.collar_free,
    skin.fold_colour,
    skin_lamps.edge_share,
    wrinkle_normals.covered_skin,
    wrinkle_normals.darkened,
    wrinkle_normals.bent,
    wrinkle_normals.ridge,
    wrinkle_normals.overhang,
    wrinkle_normals.pit,
    cloth.collar_shade,
    cloth.cloth_share,
    cloth.sheen,
    cloth.knitted,
    cloth.rolled,
    eye.iris_share,
    eye.pupil_edge,
    eye.lid_shade,
    eye.white_of_eye,
    eye.white_share,
    eye.refracted,
    eye.on_iris,
    eye.gathered,
    eye.mirror_share,
    eye.tear_glint,
    eye.caruncle_glint,
    eye.window,
    hair.facing_fibre,
    hair.between_fibres,
    hair.fibre_shine,
    hair.lamp_on_fibre,
    mouth.strip_share,
    mouth.past_strips,
    mouth.lamps_behind,
    mouth.spread_in_flesh,
    mouth.spread_in_teeth,
    mouth.reddened,
    mouth.tooth_share,
    mouth.towards_lips,
)
_CONSTANTS = {
    "ANGLES": subsurface.ANGLES,
    "CURVATURES": subsurface.CURVATURES,
    "MAX_CURVATURE": MAX_CURVATURE,
    "FACING": skin_lamps.FACING,
    "SHARP": skin_lamps.SHARP,
    "BROAD": skin_lamps.BROAD,
    "FRONT": skin_lamps.FRONT,
    "GRAZED": skin_lamps.GRAZED,
    "PORES": skin.PORES,
    "PORES_DARKEN": skin.PORES_DARKEN,
    "PORES_DULL": skin.PORES_DULL,
    "PORES_SOFT": skin_lamps.PORES_SOFT,
    "FLESH": skin.FLESH,
    "FOLD_SHADES": skin.FOLD_SHADES,
    "FOLD_DULLS": skin.FOLD_DULLS,
    "FAINT": wrinkle_table.FAINT,
    "FOLD": wrinkle_table.FOLD,
    "DIMPLES": wrinkle_table.DIMPLES,
    "PIT_CELLS": wrinkle_normals.PIT_CELLS,
    "TAPS": shadow.REACH,
    "RAMP": shadow.RAMP,
    "COLLAR": COLLAR,
    "THREAD": cloth.THREAD,
    "STITCHES": cloth.STITCHES,
    "IRIS": IRIS,
    "PUPIL": STUDIO.pupil,
    "CORNEA": eye.CORNEA,
    "VEINS": eye.VEINS,
    "WHITE_AROUND": eye.WHITE_AROUND,
    "IRIS_AROUND": eye.IRIS_AROUND,
    "WET": eye.WET,
    "KEY_WINDOW": eye.KEY_WINDOW,
    "FILL_WINDOW": eye.FILL_WINDOW,
    "KEY_BRIGHT": eye.KEY_BRIGHT,
    "FILL_BRIGHT": eye.FILL_BRIGHT,
    "STRONGEST": STRONGEST,
    "HEM": HEM,
    "INNER_MOUTH": skin.INNER_MOUTH,
    "FAUCES": mouth.FAUCES,
    "WARM": mouth.WARM,
    "AROUND": mouth.AROUND,
    "WET_GLOSS": mouth.GLOSS,
    "TOOTH_ROUGHNESS": TEETH_GLOSS[0],
    "TOOTH_STRENGTH": TEETH_GLOSS[1],
    "TONGUE_ROUGHNESS": TONGUE_GLOSS[0],
    "TONGUE_STRENGTH": TONGUE_GLOSS[1],
}
_HIGHEST = 5.0  # of the grain's heights, whose variance is 1: 127 steps


def shading() -> StageShading:
    """Return the data by which a page shades skin."""
    sizes = CELLS, subsurface.ANGLES, subsurface.CURVATURES
    return StageShading(glsl_of(_FUNCTIONS, _CONSTANTS), *sizes, _HIGHEST, eye.LID_STEPS, mouth.LIP_STEPS)


def key_shadow(anatomy: Anatomy) -> StageShadow:
    """Return how a page draws the key lamp's shadow map of a head."""
    centre, radius = anatomy.sphere()
    matrix = shadow.light_matrix(np.array(STUDIO.lamps[0].direction()), centre, radius, shadow.SIZE)
    return StageShadow(
        matrix=tuple(matrix.astype(float).ravel().tolist()),
        size=shadow.SIZE,
        depth=2.0 * radius + 2.0,
        bias=shadow.bias_of(radius, shadow.SIZE),
    )


@lru_cache(maxsize=1)
def skin_tables() -> bytes:
    """Return the heights of the grain and the light that leaves skin.

    First uint8 (CELLS, CELLS, CELLS): 128 for 0, 127 more for the highest. Then float16
    (ANGLES, CURVATURES, 4), little-endian, whose fourth column is 1.
    """
    grain = np.round(128.0 + noise_tile() * (127.0 / _HIGHEST)).clip(1, 255).astype(np.uint8)
    table = subsurface.diffuse_table()
    leaving = np.concatenate([table, np.ones_like(table[..., :1])], axis=2)
    return grain.tobytes() + leaving.astype("<f2").tobytes()
