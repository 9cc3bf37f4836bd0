"""The golden results, by file name: each case computes its arrays by public calls alone.

`python tools/renew_goldens.py` writes the files anew, after a change that is meant to move them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import risorius
from risorius.core.arrays import AnyArray, Array, ByteArray, FloatArray

FOLDER = Path(__file__).parent
EXAMPLES = FOLDER.parents[1] / "examples"
STEP = 12
"""The golden files hold every twelfth vertex of the skin."""


def curves_of(script: str, emotion: tuple[str, ...] = (), **settings: Any) -> Array:
    """Return all curves of a performance, shape (frames, parameters)."""
    take = risorius.speak(script, emotion=emotion, settings=risorius.load_settings(**settings))
    return np.stack(list(take.curves.values()), axis=1)


def skin_of(pose: Mapping[str, float], emotion: str | tuple[()] = (), **settings: Any) -> FloatArray:
    """Return every twelfth vertex of the skin in a pose in mm, shape (vertices, 3)."""
    take = risorius.pose(pose, emotion=emotion, settings=risorius.load_settings(**settings))
    (face,) = take.faces()
    return np.array(face.skin[::STEP])


def picture_of(pose: Mapping[str, float], emotion: str, **look: Any) -> ByteArray:
    """Return the picture of a pose, shape (144, 144, 3 or 4)."""
    settings = risorius.load_settings(size=(144, 144), dynamics="static", **look)
    (picture,) = risorius.pose(pose, emotion=emotion, settings=settings).pictures()
    return picture


CLOSED = {"lip_seal": 1.0, "masseter": 0.25, "orbicularis_oris_presser": 0.3}
OPEN = {"masseter": 0.6, "tongue_up": 0.4, "gaze_yaw": 12.0, "orbicularis_oculi_palpebralis": 0.4}
CURVES: dict[str, Callable[[], Array]] = {
    "paper-a": partial(
        curves_of, str(EXAMPLES / "demo.xml"), conflict="inhibit", onset_function="exponential", seed=1
    ),
    "julia": partial(
        curves_of, str(EXAMPLES / "01-julia.utt"), lips="lookahead", conflict="attenuate", seed=2
    ),
    "anger": partial(
        curves_of,
        "My baby brother put the map by the beam.",
        ("anger:0.8@0.4-3",),
        head="mei",
        fps=24,
        seed=3,
    ),
    "german": partial(
        curves_of,
        "Guten Morgen! Wie geht es dir?",
        ("happiness:0.6",),
        lips="dominance",
        language="de",
        seed=4,
    ),
}
SKINS: dict[str, Callable[[], FloatArray]] = {
    "closed": partial(skin_of, CLOSED, head="standard"),
    "fear": partial(skin_of, OPEN, "fear:0.9", head="olaf", dynamics="biphasic"),
    "old-smile": partial(skin_of, {"AU12.left": 0.9, "AU6": 0.7, "head_pitch": 10.0}, head="amara", age=72.0),
    "lines": partial(skin_of, {"AU4": 0.8, "AU15": 0.7, "lip_tuck": 1.0}, head="kenji", muscles="lines"),
}
PICTURES: dict[str, Callable[[], ByteArray]] = {
    "happiness": partial(picture_of, {"gaze_yaw": 5.0}, "happiness:0.8"),
    "surprise-high": partial(
        picture_of,
        {"head_yaw": 25.0},
        "surprise:1",
        head="kwame",
        quality="high",
        light="daylight",
        background="transparent",
    ),
    "disgust-draft": partial(
        picture_of, {"head_pitch": 8.0}, "disgust:0.9", head="ines", quality="draft", camera="close-up"
    ),
    "sadness-muscles": partial(picture_of, {"AU1": 0.5}, "sadness:0.7", head="mei", style="muscles"),
}


def stored_arrays(name: str) -> AnyArray:
    """Return a golden array of curves or vertices."""
    with np.load(FOLDER / f"{name}.npz") as file:
        return np.array(file["values"])
