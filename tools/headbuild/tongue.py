"""The tongue: the source's shape, fitted into the dental arch, and its three movements in the frame of the
jaw.
"""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import AnyArray

from .bust import Bust
from .masks import smoothstep

_PART = "helper-tongue"
_FIT_SCALE = np.array([0.88, 1.0, 1.0])
_FIT_SHIFT = np.array([0.0, -2.5, -0.8])
_OUT = 13.5  # mm that the tip comes forward
_FLATTENED = 0.62  # of its thickness, lost by the blade
# z and y (mm) of its middle plane on its way out: above the lower incisors, under the upper ones, then down
_PASSAGE = ([8.0, 13.0, 16.0, 18.0, 20.0, 24.0], [-64.0, -63.4, -63.4, -64.4, -65.6, -66.6])


def tongue(bust: Bust) -> tuple[AnyArray, AnyArray]:
    """Vertices (n, 3) mm and quads (q, 4) at rest."""
    part = bust.source.parts[_PART]
    ids = part.vertices
    return bust.body[ids] * _FIT_SCALE + _FIT_SHIFT, np.searchsorted(ids, part.quads)


def tongue_fields(rest: AnyArray) -> dict[str, AnyArray]:
    """Displacement (n, 3) in mm at 1, for jaws that stand a little open (masseter about 0.12).

    Up: the tip touches the ridge behind the upper incisors (t d n l); its underside comes into view. Out: the
    blade passes between the teeth and the tip rests on the lower ones, before them (th). Back: the body draws
    back and rises towards the soft palate (k g and back vowels).
    """
    tip = float(rest[:, 2].max())
    return {"tongue_up": _up(rest, tip), "tongue_out": _out(rest, tip), "tongue_back": _back(rest, tip)}


def _up(rest: AnyArray, tip: float) -> AnyArray:
    body = smoothstep(tip - 34.0, tip, rest[:, 2])
    blade = smoothstep(tip - 12.0, tip, rest[:, 2])
    return _field(-0.12 * blade * rest[:, 0], 4.5 * body + 7.0 * blade, 1.0 * body + 2.5 * blade)


def _out(rest: AnyArray, tip: float) -> AnyArray:
    """The middle plane is laid on `_PASSAGE`, by where a vertex comes to stand, and the blade flattened."""
    body = smoothstep(tip - 48.0, tip, rest[:, 2])
    blade = smoothstep(tip - 18.0, tip, rest[:, 2])
    middle = _middle_height(rest)
    forward = _OUT * body
    passage = np.interp(rest[:, 2] + forward, *_PASSAGE)
    low = blade * (passage - middle) + (1.0 - blade) * 5.0 * body
    flat = -_FLATTENED * blade * (rest[:, 1] - middle)
    return _field(-0.12 * blade * rest[:, 0], low + flat, forward)


def _back(rest: AnyArray, tip: float) -> AnyArray:
    front = smoothstep(tip - 55.0, tip - 5.0, rest[:, 2])
    dorsum = np.exp(-(((rest[:, 2] - (tip - 30.0)) / 16.0) ** 2))
    upper = smoothstep(-6.0, 4.0, rest[:, 1] - _middle_height(rest))
    return _field(
        0.04 * dorsum * rest[:, 0], 8.0 * dorsum * (0.35 + 0.65 * upper) - 1.5 * front, -8.0 * front
    )


def _middle_height(rest: AnyArray) -> AnyArray:
    """(n,) height of the tongue's middle plane at each vertex's z."""
    order = np.argsort(rest[:, 2])
    z, y = rest[order, 2], rest[order, 1]
    centres = np.linspace(z[0], z[-1], 10)
    middle = [0.5 * (y[np.abs(z - c) < 8.0].min() + y[np.abs(z - c) < 8.0].max()) for c in centres]
    return np.asarray(np.interp(rest[:, 2], centres, middle))


def _field(x: AnyArray, y: AnyArray, z: AnyArray) -> AnyArray:
    return np.stack([x, y, z], axis=1)
