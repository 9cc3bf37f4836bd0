"""The body of an identity: a blend of the source's sexes, origins and ages, and a few sliders."""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import AnyArray
from risorius.errors import HeadError, unknown
from risorius.face.head.identity import OLD, YOUNG, Identity

from .source import Source

_MACRO = "mpfb2/targets/macrodetails/"
_UNIVERSAL = _MACRO + "universal-{sex}-{age}-{muscle}muscle-{weight}weight.target.gz"
_ORIGIN = _MACRO + "{origin}-{sex}-{age}.target.gz"
_SLIDERS = "mpfb2/targets/"


def body(source: Source, identity: Identity) -> AnyArray:
    """The body (19158, 3) in mm, in the source's frame, made exactly symmetric; raise HeadError where the
    source has no such slider.
    """
    result = source.base.copy()
    for age, time in _ages(identity.age).items():
        for sex, share in identity.sex.items():
            for origin, part in identity.origin.items():
                path = _ORIGIN.format(origin=origin, sex=sex, age=age)
                result += share * time * part * source.target(path)
            for muscle, strength in _levels(identity.build.get("muscle", 0.0)).items():
                for weight, amount in _levels(identity.build.get("weight", 0.0)).items():
                    path = _UNIVERSAL.format(sex=sex, age=age, muscle=muscle, weight=weight)
                    result += share * time * strength * amount * source.target(path)
    for slider, amount in identity.sliders.items():
        for path in _slider_paths(source, slider):
            result += amount * source.target(path)
    return np.asarray(0.5 * (result + result[source.mirror()] * np.array([-1.0, 1.0, 1.0])))


def _ages(years: float) -> dict[str, float]:
    old = float(np.clip((years - YOUNG) / (OLD - YOUNG), 0.0, 1.0))
    return {name: share for name, share in (("young", 1.0 - old), ("old", old)) if share > 0.0}


def _levels(value: float) -> dict[str, float]:
    end = "max" if value > 0.0 else "min"
    shares = {"average": 1.0 - abs(value), end: abs(value)}
    return {name: share for name, share in shares.items() if share > 0.0}


def _slider_paths(source: Source, slider: str) -> list[str]:
    paths = sorted({f"{_SLIDERS}{slider.format(side)}.target.gz" for side in "lr"})
    if not all(source.has(path) for path in paths):
        known = [name.removesuffix(".target.gz").replace("/l-", "/{}-") for name in source.names(_SLIDERS)]
        raise HeadError(unknown("slider", slider, known))
    return paths
