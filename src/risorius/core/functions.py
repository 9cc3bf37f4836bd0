"""Onset functions: how a movement rises. Each is a pure, monotone function of x = t/D in [0, 1].

f(0) = 0 and f(1) = 1. The offset is the mirror image, f(1 - x): paper A's phi_- is the mirror of its phi_+
(facts: science/errata, A0). Arrays have any shape; the caller clips x to [0, 1].
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import numpy as np

from ..reading.hints import Then
from .arrays import Array
from .registry import Registry

OnsetFunction = Callable[[Array], Array]

ONSET_FUNCTIONS: Registry[OnsetFunction] = Registry("onset function")
DEFAULT_FUNCTION = "exponential"
CORNERED = frozenset({"exponential", "linear"})
"""Functions that change the slope at once, as paper A's do; curves with others have no corners."""


def known_function(name: str) -> str:
    """Return the name of an onset function; raise ParameterError, with the nearest, for an unknown one."""
    ONSET_FUNCTIONS.get(name)
    return name


FunctionName = Annotated[str, Then(known_function)]
"""The name of an onset function, as files hold it."""


@ONSET_FUNCTIONS.register("exponential")
def exponential(x: Array) -> Array:
    """2^x - 1: paper A, section 4 (after Essa)."""
    return np.exp2(x) - 1.0


@ONSET_FUNCTIONS.register("linear")
def linear(x: Array) -> Array:
    """Constant speed."""
    return np.asarray(x, dtype=np.float64)


@ONSET_FUNCTIONS.register("minimum_jerk")
def minimum_jerk(x: Array) -> Array:
    """10x³ - 15x⁴ + 6x⁵: no speed or acceleration at either end."""
    return x * x * x * (10.0 + x * (6.0 * x - 15.0))


# How the speed of a saccade falls off on both sides of its middle: the peak is 2.5 / 1.5 of the mean.
_FALL = 1.5


@ONSET_FUNCTIONS.register("saccade")
def saccade(x: Array) -> Array:
    """Speed in proportion to 1 - |2x - 1|^1.5, whose peak is 1.67 times its mean.

    With this profile the duration of 25 ms + 2.4 ms a degree gives the measured peak speed,
    473(1 - e^(-A/7.8)) degrees a second, within 7 % from 1 to 20 degrees, and within 5 % in the mean where
    curves are rounded (facts: science/03, sections 3.2 and 3.3); a triangle of speed, 2 times its mean, would
    be a fifth too fast.
    """
    u = 2.0 * np.asarray(x, dtype=np.float64) - 1.0
    return np.asarray(0.5 + 0.5 * u * ((_FALL + 1.0) - np.abs(u) ** _FALL) / _FALL)


def positive_part(x: Array, width: float) -> Array:
    """Return max(x, 0) without a corner: x from `width` on, 0 below 0, and smaller than x between.

    The curve between, x²·(2w − x)/w², has the slope 0 at 0 and 1 at `width`; below a thousandth of the
    width it is 0, so that what dies away comes to rest.
    """
    between = x * x * (2.0 * width - x) / (width * width)
    return np.asarray(np.where(x >= width, x, np.where(x > _REST * width, between, 0.0)))


_REST = 1e-3
