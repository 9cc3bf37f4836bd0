"""Draw the sheets of what the face can do: `python docs/face_sheets.py [NAME …]` (all where none is named).

Run from the repository's root; the sheets are written to docs/pictures.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw

from risorius import blend
from risorius.core.action_units import ACTION_UNITS, resolve_targets
from risorius.core.movement import LipSegment
from risorius.core.parameters import INDEX, MUSCLES, NEUTRAL
from risorius.core.score import Score
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.head.head import Head, load_head
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.render.software_renderer import SoftwareRenderer
from risorius.rules.emotions import emotion, emotions
from risorius.rules.lips import lip_table

Targets = Mapping[str, float]
Picture = npt.NDArray[np.uint8]

PICTURES = Path(__file__).parent / "pictures"
SIDE = 400  # pixels of a picture, of which the face is kept: left, top, right, bottom
FACE = (118, 80, 282, 322)
HEAD = (64, 0, 335, 400)  # the whole head in the same proportions
MOUTH_SIDE = 900  # pixels of a picture of which the mouth is kept, from the front and from the side
MOUTH = {"front": (350, 500, 550, 720), "side": (240, 500, 440, 720)}
CAPTION = 13
COLOURS = 192
STRENGTHS = (0.5, 1.0)
HEAD_UNITS = range(51, 57)
INTENSITIES = (0.35, 0.7, 1.0)
SIX = ("anger", "disgust", "fear", "happiness", "sadness", "surprise")
AGES = (25.0, 45.0, 70.0)
# One phone for each of the twelve mouth shapes that speech shows.
VISEMES = ("M", "F", "TH", "T", "L", "S", "SH", "K", "R", "UW", "IY", "AA")
PROFILE = 75.0  # degrees by which the camera goes round for the side view
MURMUR = {"masseter": 0.1, "lip_seal": 1.0}


class Studio:
    """Takes pictures of one head."""

    def __init__(self, head: Head, *, age: float = 25.0, turned: float = 0.0, side: int = SIDE) -> None:
        self._solver = FaceSolver(head, age=age)
        self._renderer = SoftwareRenderer(head_model(head), (side, side))
        if turned:
            camera = self._renderer.camera
            angle, far = np.radians(turned), camera.eye[2] - camera.target[2]
            x, _, z = camera.target
            eye = (x + far * float(np.sin(angle)), camera.eye[1], z + far * float(np.cos(angle)))
            self._renderer = SoftwareRenderer(head_model(head), (side, side), camera=replace(camera, eye=eye))

    def take(self, targets: Targets, frame: tuple[int, int, int, int] = FACE) -> Image.Image:
        """Return the face with parameters or action units at `targets`."""
        values = np.array(NEUTRAL)
        for name, value in resolve_targets(targets).items():
            values[INDEX[name]] = value
        size = FACE[2] - FACE[0], FACE[3] - FACE[1]
        return self.picture(values).crop(frame).resize(size, Image.Resampling.LANCZOS)

    def picture(self, values: npt.NDArray[np.float64]) -> Image.Image:
        """Return the whole picture of the face at `values` (46,)."""
        picture: Picture = self._renderer.render(self._solver.solve(values))
        return Image.fromarray(np.asarray(picture))


def sheet(pictures: Mapping[str, Image.Image], columns: int) -> Image.Image:
    """Return pictures in rows of `columns`, each under its name."""
    width, height = next(iter(pictures.values())).size
    rows = -(-len(pictures) // columns)
    whole = Image.new("RGB", (columns * width, rows * (height + CAPTION)), "white")
    pen = ImageDraw.Draw(whole)
    for number, (name, picture) in enumerate(pictures.items()):
        left, top = number % columns * width, number // columns * (height + CAPTION)
        pen.text((left + 3, top + 1), name, fill="black")
        whole.paste(picture, (left, top + CAPTION))
    return whole


def muscles() -> Image.Image:
    """Every muscle at half and at full contraction."""
    studio = Studio(load_head())
    names = dict.fromkeys(m.base for m in MUSCLES)
    short = {name: name.replace("orbicularis", "orb.").replace("depressor", "depr.") for name in names}
    short = {name: text.replace("levator", "lev.").replace("_", " ") for name, text in short.items()}
    return sheet(
        {
            f"{short[name]} {strength:g}": studio.take({name: strength})
            for name in names
            for strength in STRENGTHS
        },
        8,
    )


def action_units() -> Image.Image:
    """Every action unit in full; the wink on one side, the tongue with the mouth open."""
    studio = Studio(load_head())
    poses = {n: {f"AU{n}": 1.0} for n in ACTION_UNITS}
    poses |= {46: {"AU46.left": 1.0}, 19: {"AU19": 1.0, "AU25": 0.5, "masseter": 0.2}}
    return sheet(
        {
            f"{n} {ACTION_UNITS[n].name}": studio.take(targets, HEAD if n in HEAD_UNITS else FACE)
            for n, targets in poses.items()
        },
        8,
    )


def emotion_intensities() -> Image.Image:
    """Six emotions at three intensities and three ages."""
    head = load_head()
    studios = {age: Studio(head, age=age) for age in AGES}
    return sheet(
        {
            f"{name} {strength:g}, {age:g}": studio.take(emotion(name).targets(strength))
            for name in SIX
            for age, studio in studios.items()
            for strength in INTENSITIES
        },
        9,
    )


def visemes() -> Image.Image:
    """Twelve mouth shapes of speech, from the front and from the side."""
    head = load_head()
    views = {
        "front": Studio(head, side=MOUTH_SIDE),
        "side": Studio(head, turned=PROFILE, side=MOUTH_SIDE),
    }
    return sheet(
        {
            f"{phone} {view}": studio.picture(held(phone)).crop(MOUTH[view])
            for half in (VISEMES[:6], VISEMES[6:])
            for view, studio in views.items()
            for phone in half
        },
        6,
    )


def held(phone: str) -> npt.NDArray[np.float64]:
    """Return the values (46,) of a phone that lasts."""
    score = Score(4.0, lips=(LipSegment(phone, 0.5, 3.5, lip_table().shape(phone).targets),))
    return np.asarray(blend.at(score, np.array([2.0]), load_lip_rig())[0])


def closures() -> Image.Image:
    """The closed lips of /m/ under each emotion in full."""
    studio = Studio(load_head())
    poses = {"none": {}} | {name: emotion(name).targets(1.0) for name in emotions()}
    return sheet({name: studio.take({**targets, **MURMUR}) for name, targets in poses.items()}, 7)


SHEETS: dict[str, Callable[[], Image.Image]] = {
    "muscles": muscles,
    "action-units": action_units,
    "emotion-intensities": emotion_intensities,
    "visemes": visemes,
    "closures": closures,
}


def main() -> None:
    """Draw the sheets named on the command line."""
    PICTURES.mkdir(exist_ok=True)
    for name in sys.argv[1:] or SHEETS:
        SHEETS[name]().quantize(COLOURS).save(PICTURES / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
