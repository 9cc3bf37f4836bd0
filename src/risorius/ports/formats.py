"""The table of output formats, found by the suffix of a file's name."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from pathlib import Path

from ..errors import OutputError, Place
from ..registry import Registry
from .writable import WritableTake, WriteOptions

Writer = Callable[[WritableTake, Path, WriteOptions], None]


class Need(StrEnum):
    """What a format is made from, and so which stages must run for it."""

    CURVES = "curves"
    VERTICES = "vertices"
    PIXELS = "pixels"
    SPEECH = "speech"
    HEAD = "head"


@dataclass(frozen=True, slots=True)
class Output:
    """A format: its suffix with the leading dot, what it holds, what it needs, and its writer.

    `opaque`: it shows pictures and has no place for an alpha channel.
    """

    suffix: str
    description: str
    needs: frozenset[Need]
    write: Writer
    opaque: bool = False


OUTPUTS: Registry[Output] = Registry("output suffix")


def register(
    suffix: str, description: str, needs: Iterable[str], write: Writer, *, opaque: bool = False
) -> None:
    """Add a format. `write(take, path, options)` fills `path`, an empty file beside the final one."""
    output = Output(suffix, description, frozenset(Need(need) for need in needs), write, opaque)
    OUTPUTS.register(suffix)(output)


def deferred(module: str, name: str) -> Writer:
    """Return a writer of this package that is imported when it is first used.

    What draws or fits faces takes a second to import, and most commands need none of it.
    """

    def write(take: WritableTake, path: Path, options: WriteOptions) -> None:
        getattr(import_module(f".{module}", __package__), name)(take, path, options)

    return write


def output_for(path: Path) -> Output:
    """Return the format that a file's name asks for; the longest suffix wins, in upper or lower case.

    Raises OutputError with the nearest known suffix and the list of all.
    """
    name = path.name.lower()
    found = [suffix for suffix in OUTPUTS if name.endswith(suffix.lower())]
    if not found:
        raise OutputError(_unknown_suffix(path), Place(str(path)))
    return OUTPUTS.get(max(found, key=len))


def _unknown_suffix(path: Path) -> str:
    known = ", ".join(OUTPUTS)
    if not path.suffix:
        return f"the name has no suffix; expected one of {known}"
    known_by_lower = {suffix.lower(): suffix for suffix in OUTPUTS}
    for asked in ("".join(path.suffixes[-2:]).lower(), path.suffix.lower()):
        near = [suffix for suffix in known_by_lower if suffix.endswith(asked)]
        near = near or difflib.get_close_matches(asked, known_by_lower, n=1, cutoff=0.6)
        if near:
            nearest = known_by_lower[near[0]]
            return f"unknown suffix '{path.suffix}'; did you mean '{nearest}'? Known: {known}"
    return f"unknown suffix '{path.suffix}'; expected one of {known}"


register(".mp4", "video with sound", {"pixels"}, deferred("video.mp4", "write_mp4"), opaque=True)
register(
    ".webm",
    "video with sound for the web, with alpha if asked",
    {"pixels"},
    deferred("video.webm", "write_webm"),
)
register(
    ".mov",
    "video with sound for editing, with alpha if asked",
    {"pixels"},
    deferred("video.mov", "write_mov"),
)
register(".png", "one frame, or a sheet of every n-th", {"pixels"}, deferred("png", "write_png"))
register(".wav", "the voice", {"speech"}, deferred("wav", "write_wav"))
register(
    ".muscles.csv",
    "curves of all muscles and parameters",
    {"curves"},
    deferred("muscles_csv", "write_muscles_csv"),
)
register(
    ".landmarks.csv",
    "distances and 68 points measured on the face",
    {"vertices"},
    deferred("landmarks_csv", "write_landmarks_csv"),
)
register(
    ".TextGrid", "words, phones and accents for Praat", {"speech"}, deferred("textgrid", "write_textgrid")
)
register(
    ".score.json", "all movements with their causes", {"curves"}, deferred("score_json", "write_score_json")
)
register(
    ".performance.json",
    "curves with their score",
    {"curves"},
    deferred("performance_json", "write_performance_json"),
)
register(
    ".arkit.csv",
    "52 ARKit weights as Live Link Face writes them",
    {"head"},
    deferred("arkit_csv", "write_arkit_csv"),
)
register(".glb", "the head in motion, by the clip's own shapes", {"head"}, deferred("glb", "write_glb"))
register(
    ".rig.glb",
    "the head with 52 ARKit shapes, driven by their weights",
    {"head"},
    deferred("glb", "write_rig_glb"),
)
register(".vrma", "VRM animation: head, gaze, expressions", {"head"}, deferred("vrma", "write_vrma"))
register(".usda", "the head with 52 blend shapes as USD", {"head"}, deferred("usda", "write_usda"))
register(".obj", "one frame as a mesh", {"head"}, deferred("obj", "write_obj"))
register(
    ".au.csv",
    "action units, gaze and pose in OpenFace's columns",
    {"head"},
    deferred("au_csv", "write_au_csv"),
)
register(".fap", "MPEG-4 facial animation parameters", {"head"}, deferred("fap", "write_fap"))
register(".bvh", "rotations of head and eyes", {"head"}, deferred("bvh", "write_bvh"))
register(
    ".visemes.json",
    "mouth shapes as Rhubarb Lip Sync writes them",
    {"speech"},
    deferred("rhubarb", "write_rhubarb_json"),
)
register(".visemes.tsv", "the same as a table", {"speech"}, deferred("rhubarb", "write_rhubarb_tsv"))
register(".visemes.xml", "the same as XML", {"speech"}, deferred("rhubarb", "write_rhubarb_xml"))
register(".visemes.dat", "the same as Moho switch data", {"speech"}, deferred("rhubarb", "write_moho_dat"))
register(
    ".azure.json",
    "viseme events as Azure Speech sends them",
    {"speech"},
    deferred("azure_json", "write_azure_json"),
)
register(
    ".oculus.csv",
    "weights of the 15 visemes of OVRLipSync",
    {"speech"},
    deferred("oculus_csv", "write_oculus_csv"),
)
register(
    ".channels.TextGrid",
    "every channel as a tier, for Praat",
    {"curves"},
    deferred("channels_textgrid", "write_channels_textgrid"),
)
register(
    ".feedback.xml", "the plan as BML feedback", {"curves"}, deferred("bml_feedback", "write_bml_feedback")
)
register(".npz", "the curves as numpy arrays", {"curves"}, deferred("npz", "write_npz"))
register(
    ".vertices.npz", "the curves and the skin of every frame", {"head"}, deferred("npz", "write_vertices_npz")
)
register(
    ".parquet", "curves and ARKit weights for data tools", {"head"}, deferred("parquet", "write_parquet")
)
