"""The choices with which the video worker begins a film."""

from __future__ import annotations

from dataclasses import dataclass

SLOTS = 4
"""Pictures waiting for the encoder; more only cost memory."""


@dataclass(frozen=True, slots=True)
class FilmSetup:
    """`fps` as "24000/1001"; `sample_rate` None for a silent film; `codec` is a name of `codecs.CODECS`.

    `pixels` says how the numbers of a picture come: rgb24, rgba or yuv420p; `memory` is the path of the
    slots; `draft` is true for a film that should rather be made soon than be small. Width and height are
    even, as most formats want them.
    """

    path: str
    width: int
    height: int
    fps: str
    sample_rate: int | None
    codec: str = "mp4"
    pixels: str = "rgb24"
    memory: str = ""
    draft: bool = False
