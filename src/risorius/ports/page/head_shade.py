"""The light in which the page draws a head: the library's own, and the shade of the resting head."""

from __future__ import annotations

import numpy as np

from ...face.head.head import Head
from ...looks.anatomy import find_anatomy
from ...looks.attributes import CURVATURE, INNER, MAX_CURVATURE, ROUGHNESS, SPECULAR
from ...looks.garment import neckline
from ...looks.head_model import head_model
from ...looks.perfusion import LEAST, LIPS_ABSORB, MOST, ROUNDS, SKIN_ABSORBS, skin_blood
from ...render.lights import STUDIO
from ...render.resting import light_at_rest
from .skin_formulas import STRONGEST
from .stage_table import StageBlood, StageLamp, StageLight

HEM_STEPS = 4.0
BLOOD_STEPS = 127.0


def light() -> StageLight:
    """Return the lamps (direction and linear colour each), and the ambient light from above and below."""
    lamps = tuple(StageLamp(lamp.direction(), lamp.colour, lamp.softness) for lamp in STUDIO.lamps)
    return StageLight(lamps, STUDIO.sky, STUDIO.ground)


def blood() -> StageBlood:
    """Return how skin changes its colour."""
    (red, green, blue), lips = SKIN_ABSORBS, LIPS_ABSORB
    skin = float(red), float(green), float(blue)
    absorbed = float(lips[0]), float(lips[1]), float(lips[2])
    return StageBlood(skin, absorbed, float(LEAST), float(MOST), ROUNDS)


def shade(head: Head) -> bytes:
    """Return for each vertex of the skin its light at rest, its cloth, its blood and its gloss.

    uint8 (vertices, 1 + lamps + 1 + 3 + 4): the share of the surroundings and of each lamp that it sees, 255
    for 1, of the first lamp for what hair leaves of it; then 128 at the neckline, one more for each
    1 / HEM_STEPS mm into the cloth that is worn; then how blood shows in skin, in lips, and where skin is
    bunched (`SkinBlood`), one for each 1 / BLOOD_STEPS, the last from 128 on; then roughness squared, the
    strength of the gloss of STRONGEST, the curvature of the greatest, the share of mouth interior, 255 for 1.
    """
    shares = light_at_rest(head, STUDIO)
    hem = 128.0 + HEM_STEPS * neckline(find_anatomy(head)).astype(np.float32)[:, None]
    shown = BLOOD_STEPS * np.stack(skin_blood(head, head.identity.looks), axis=1) + np.array([0, 0, 128])
    skin = head_model(head).solids["skin"].attributes[:, [ROUGHNESS, SPECULAR, CURVATURE, INNER]]
    surface = 255.0 * skin / np.array([1.0, STRONGEST, MAX_CURVATURE, 1.0])
    columns = np.concatenate([255.0 * shares.clip(0.0, 1.0), hem, shown, surface], axis=1)
    return np.round(columns.clip(0.0, 255.0)).astype(np.uint8).tobytes()
