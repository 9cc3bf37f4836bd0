"""The names of ARKit's 52 face shapes, and of the rotations that the Live Link Face app adds.

Names and order: Apple, ARFaceAnchor.BlendShapeLocation; column order: Epic Games, Live Link Face (recorded
takes), which puts right before left for the jaw and the mouth. Always map by name.
"""

from __future__ import annotations


def _name(column: str) -> str:
    return column[0].lower() + column[1:]


_EYE = ("EyeBlink", "EyeLookDown", "EyeLookIn", "EyeLookOut", "EyeLookUp", "EyeSquint", "EyeWide")

CSV_SHAPES: tuple[str, ...] = (
    *(f"{eye}{side}" for side in ("Left", "Right") for eye in _EYE),
    *("JawForward", "JawRight", "JawLeft", "JawOpen"),
    *("MouthClose", "MouthFunnel", "MouthPucker", "MouthRight", "MouthLeft"),
    *(f"Mouth{part}{side}" for part in ("Smile", "Frown", "Dimple", "Stretch") for side in ("Left", "Right")),
    *("MouthRollLower", "MouthRollUpper", "MouthShrugLower", "MouthShrugUpper"),
    *(f"Mouth{part}{side}" for part in ("Press", "LowerDown", "UpperUp") for side in ("Left", "Right")),
    *("BrowDownLeft", "BrowDownRight", "BrowInnerUp", "BrowOuterUpLeft", "BrowOuterUpRight"),
    *("CheekPuff", "CheekSquintLeft", "CheekSquintRight", "NoseSneerLeft", "NoseSneerRight", "TongueOut"),
)
"""The shapes' columns of the app's CSV, in its order."""

ROTATIONS: tuple[str, ...] = tuple(
    f"{part}{angle}" for part in ("Head", "LeftEye", "RightEye") for angle in ("Yaw", "Pitch", "Roll")
)
"""The nine rotations after the shapes, in the CSV and in packets."""

_SWAPPED = {
    "JawRight": "JawLeft",
    "JawLeft": "JawRight",
    "MouthRight": "MouthLeft",
    "MouthLeft": "MouthRight",
}
PACKET_SHAPES: tuple[str, ...] = tuple(_SWAPPED.get(name, name) for name in CSV_SHAPES)
"""The shapes in the order of packets (and of ARKit): left before right throughout."""

SHAPES: tuple[str, ...] = tuple(_name(name) for name in PACKET_SHAPES)
"""Apple's names, in ARKit's order: the columns of every array of weights (…, 52)."""
INDEX: dict[str, int] = {name: index for index, name in enumerate(SHAPES)}

EXCLUSIVE: tuple[tuple[str, str], ...] = (
    ("jawLeft", "jawRight"),
    ("mouthLeft", "mouthRight"),
    ("eyeBlinkLeft", "eyeWideLeft"),
    ("eyeBlinkRight", "eyeWideRight"),
)
"""Pairs of shapes of which only one can act at a time: a movement in opposite directions."""

OPPOSED: tuple[tuple[str, str], ...] = (
    *EXCLUSIVE,
    ("browInnerUp", "browDownLeft"),
    ("browInnerUp", "browDownRight"),
    *(
        (f"{one}{side}", f"{other}{side}")
        for one, other in (
            ("mouthSmile", "mouthFrown"),
            ("browOuterUp", "browDown"),
            ("eyeLookIn", "eyeLookOut"),
            ("eyeLookUp", "eyeLookDown"),
        )
        for side in ("Left", "Right")
    ),
)
"""Pairs of shapes that act against each other."""


def column_of(shape: str) -> str:
    """Return the CSV's column of a shape: its name with a capital."""
    return shape[0].upper() + shape[1:]
