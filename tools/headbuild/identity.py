"""Who the standard head is: a blend of the source's identities, and a few sliders."""

from __future__ import annotations

import numpy as np

from .arrays import Array
from .source import Source

_MACRO = "mpfb2/targets/macrodetails/"
_GENDER = {"female": 0.62, "male": 0.38}
_AGE = "young"
_ANCESTRY = {"caucasian": 0.7, "asian": 0.15, "african": 0.15}
# Target file → amount; `{}` stands for both sides.
_SLIDERS = {
    "chin/chin-prominent-incr": 0.2,
    "cheek/{}-cheek-bones-incr": 0.3,
    "ears/{}-ear-scale-decr": 0.35,
    "ears/{}-ear-wing-decr": 0.5,
    "eyebrows/eyebrows-trans-up": 0.2,
    "eyes/{}-eye-corner2-up": 0.2,
    "eyes/{}-eye-scale-incr": 0.35,
    "forehead/forehead-scale-vert-decr": 0.3,
    "head/head-invertedtriangular": 0.45,
    "head/head-scale-horiz-decr": 0.2,
    "mouth/mouth-angles-up": 0.35,
    "mouth/mouth-scale-horiz-incr": 0.25,
    "mouth/mouth-upperlip-volume-incr": 0.2,
    "nose/nose-hump-decr": 0.3,
    "nose/nose-point-up": 0.25,
    "nose/nose-scale-horiz-decr": 0.2,
    "nose/nose-volume-decr": 0.25,
    "nose/nose-width3-decr": 0.35,
}


def identity(source: Source) -> Array:
    """The body (19158, 3) in mm, in the source's frame, made exactly symmetric."""
    body = source.base.copy()
    for gender, share in _GENDER.items():
        for ancestry, part in _ANCESTRY.items():
            body += share * part * source.target(f"{_MACRO}{ancestry}-{gender}-{_AGE}.target.gz")
        body += share * source.target(
            f"{_MACRO}universal-{gender}-{_AGE}-averagemuscle-averageweight.target.gz"
        )
    for pattern, amount in _SLIDERS.items():
        for path in sorted({pattern.format("l"), pattern.format("r")}):
            body += amount * source.target(f"mpfb2/targets/{path}.target.gz")
    return np.asarray(0.5 * (body + body[source.mirror()] * np.array([-1.0, 1.0, 1.0])))
