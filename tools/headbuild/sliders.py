"""Sliders that change a head when it is loaded: what the source's targets do to the skin.

The lips with what lies about them, and the lids with theirs, are moved without being bent: contact, seals and
blinks then hold as they do on the head itself.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from risorius.core.arrays import AnyArray
from risorius.face.head.head_file import FORMAT

from .build import Shape
from .mouth import lip_rings
from .pack import quantized, settled
from .source import Source

_TARGETS = "mpfb2/targets/"
# By the slider's name: the target at 1 and the one at −1.
PAIRS = {
    "face_length": ("head/head-scale-vert-incr", "head/head-scale-vert-decr"),
    "face_width": ("head/head-scale-horiz-incr", "head/head-scale-horiz-decr"),
    "fullness": ("head/head-fat-incr", "head/head-fat-decr"),
    "forehead_height": ("forehead/forehead-scale-vert-incr", "forehead/forehead-scale-vert-decr"),
    "forehead_slope": ("forehead/forehead-trans-backward", "forehead/forehead-trans-forward"),
    "temples": ("forehead/forehead-temple-incr", "forehead/forehead-temple-decr"),
    "nose_width": ("nose/nose-scale-horiz-incr", "nose/nose-scale-horiz-decr"),
    "nose_length": ("nose/nose-point-down", "nose/nose-point-up"),
    "nose_depth": ("nose/nose-scale-depth-incr", "nose/nose-scale-depth-decr"),
    "nose_hump": ("nose/nose-hump-incr", "nose/nose-hump-decr"),
    "cheekbones": ("cheek/{}-cheek-bones-incr", "cheek/{}-cheek-bones-decr"),
    "cheeks": ("cheek/{}-cheek-volume-incr", "cheek/{}-cheek-volume-decr"),
    "jaw_width": ("chin/chin-bones-incr", "chin/chin-bones-decr"),
    "chin_width": ("chin/chin-width-incr", "chin/chin-width-decr"),
    "chin_length": ("chin/chin-height-incr", "chin/chin-height-decr"),
    "chin_prominence": ("chin/chin-prominent-incr", "chin/chin-prominent-decr"),
    "ear_size": ("ears/{}-ear-scale-incr", "ears/{}-ear-scale-decr"),
    "ear_wing": ("ears/{}-ear-wing-incr", "ears/{}-ear-wing-decr"),
    "neck_width": ("neck/neck-scale-horiz-incr", "neck/neck-scale-horiz-decr"),
}
LIPS_WHOLE, LIPS_FREE = 9.0, 24.0  # mm from the lips within which skin goes with them, and where it is free
LIDS_WHOLE, LIDS_FREE = 9.0, 24.0  # mm from the eyeball, the same
MOST = 10.0  # mm that a slider moves the skin: the source's ends go further than people do
SMALLEST, STEP = 0.02, 0.01  # mm: less is not kept, and to what step


def build_sliders(source: Source, shape: Shape) -> dict[str, AnyArray]:
    """All arrays of the sliders' file, measured on the head `shape`."""
    ends = {
        f"{name}/{end}": path for name, pair in PAIRS.items() for end, path in zip("+-", pair, strict=True)
    }
    held = {key: _held(shape, _change(source, shape, path)) for key, path in ends.items()}
    return {
        "format": np.array(FORMAT, np.int32),
        "names": np.array(list(PAIRS)),
        **_packed({key: skin for key, (skin, _, _) in held.items()}),
        "mouth": settled(np.array([mouth for _, mouth, _ in held.values()]).reshape(-1, 2, 3)),
        "eyes": settled(np.array([eyes for _, _, eyes in held.values()]).reshape(-1, 2, 2, 3)),
    }


def _packed(fields: dict[str, AnyArray]) -> dict[str, AnyArray]:
    kept = {name: quantized(field, SMALLEST, STEP) for name, field in fields.items()}
    return {f"{name}/{key}": value for name, parts in kept.items() for key, value in parts.items()}


def _change(source: Source, shape: Shape, path: str) -> AnyArray:
    """(N0, 3) what a target does to the skin in mm, in the frame of the eyes, made exactly symmetric."""
    paths = sorted({f"{_TARGETS}{path.format(side)}.target.gz" for side in "lr"})
    whole = np.sum([source.target(p) for p in paths], axis=0)
    eyes = np.mean([whole[source.parts[f"helper-{side}-eye"].vertices].mean(axis=0) for side in "lr"], axis=0)
    change = (whole - eyes)[shape.bust.ids]
    change = 0.5 * (change + change[shape.bust.mirror] * np.array([-1.0, 1.0, 1.0]))
    return np.asarray(change * min(MOST / np.linalg.norm(change, axis=1).max(), 1.0))


def _held(shape: Shape, change: AnyArray) -> tuple[AnyArray, AnyArray, AnyArray]:
    """The change (N0, 3) with lips and lids unbent, and the ways of the mouth (3,) and the eyes (2, 3)."""
    rest, result = shape.rest, change.copy()
    lips = rest[lip_rings(shape.bust)]
    share = _share(cKDTree(lips).query(rest)[0], LIPS_WHOLE, LIPS_FREE)
    mouth = change[lip_rings(shape.bust)].mean(axis=0) * np.array([0.0, 1.0, 1.0])
    result += share[:, None] * (mouth - change)
    eyes = np.zeros((2, 3))
    for eye, (centre, radius) in enumerate(zip(shape.bust.eye_centre, shape.bust.eye_radius, strict=True)):
        far = np.linalg.norm(rest - centre, axis=1) - radius
        share = _share(far, LIDS_WHOLE, LIDS_FREE)
        eyes[eye] = change[far < LIDS_WHOLE].mean(axis=0)
        result += share[:, None] * (eyes[eye] - change)
    return result, mouth, eyes


def _share(distance: AnyArray, whole: float, free: float) -> AnyArray:
    """1 up to the distance `whole` and 0 from `free` on, smoothly between."""
    t = np.clip((free - distance) / (free - whole), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))
