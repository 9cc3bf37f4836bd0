"""Many roots at once, for threshold crossings on curves."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..core.arrays import Array

_TOLERANCE = 1e-13
_ITERATIONS = 80


def find_roots(function: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Return the x in [low, high] at which the function changes sign, shape (n,), to 1e-13.

    `function` maps shape (n,) to shape (n,), element by element, and has opposite signs (or a zero) at the
    two ends. The search takes inverse quadratic steps if they are safe, else it halves (Chandrupatla 1997).
    """
    a, b = high.copy(), low.copy()
    fa, fb = function(a), function(b)
    at_low, at_high = fb == 0.0, fa == 0.0
    share = np.full(len(a), 0.5)
    for _ in range(_ITERATIONS):
        x = a + share * (b - a)
        fx = function(x)
        same = (fx > 0.0) == (fa > 0.0)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        width = np.abs(b - a)
        best = np.where(np.abs(fa) < np.abs(fb), a, b)
        tolerance = _TOLERANCE + 4e-16 * np.abs(best)
        exact = (np.minimum(np.abs(fa), np.abs(fb)) == 0.0) | at_low | at_high
        if bool(np.all((width <= 2.0 * tolerance) | exact)):
            break
        least = np.minimum(tolerance / np.maximum(width, 1e-300), 0.5)
        share = np.clip(_quadratic_share(a, b, c, fa, fb, fc), least, 1.0 - least)
    inner = np.where(np.abs(fa) < np.abs(fb), a, b)
    return np.where(at_low, low, np.where(at_high, high, inner))


def _quadratic_share(a: Array, b: Array, c: Array, fa: Array, fb: Array, fc: Array) -> Array:
    """Return the next place to try, as a share of the way from a to b."""
    with np.errstate(divide="ignore", invalid="ignore"):
        position, value = (a - b) / (c - b), (fa - fb) / (fc - fb)
        safe = (value**2 < position) & ((1.0 - value) ** 2 < 1.0 - position)
        guess = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where(safe & np.isfinite(guess), guess, 0.5)
