"""A character of one's own: a GLB whose morph targets are mapped to ARKit's names becomes an output rig."""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...core.arkit import INDEX, SHAPES
from ...core.arrays import Array, Float32Array
from ...core.parameters import INDEX as PARAMETER
from ...core.parameters import NEUTRAL
from ...errors import InputError, Place, unknown
from ...face.fit.arkit_fit import ArkitFit, ArkitTrack
from ...face.fit.mouth_gap import MouthGap
from ...face.fit.muscle_fit import FITTED
from ...face.head.head import Head
from ...face.solve import FaceSolver
from ...machine.blas import one_thread
from ...reading.source_text import SourceText
from ...reading.toml import parse, read_text
from .glb_file import GlbFile, read_glb

WELL, PARTLY = 0.25, 0.6  # shares of a movement left over up to which it is shown well, and partly
_LIKE = 0.88  # how alike names must be for a guess
_SIDES = {"l": "left", "r": "right", "lft": "left", "rgt": "right"}


@dataclass(frozen=True, slots=True)
class ShapeMap:
    """A map's file: names of a character's morph targets by ARKit's names."""

    shapes: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class MuscleCoverage:
    """The quality with which the character shows one of our parameters.

    `left_over`: the share 0..1 of its movement that the available shapes do not make, and `rms` that in mm,
    both measured on our head; `best` is the share that all 52 shapes would leave over.
    """

    parameter: str
    left_over: float
    best: float
    rms: float

    @property
    def verdict(self) -> str:
        """The quality in a word: well, partly or not."""
        return "well" if self.left_over <= WELL else "partly" if self.left_over <= PARTLY else "not"


@dataclass(frozen=True, slots=True)
class Rig:
    """A character's file, its map, and the targets of each mesh."""

    file: GlbFile
    targets: Mapping[int, tuple[str, ...]]
    shapes: Mapping[str, str]

    @property
    def missing(self) -> tuple[str, ...]:
        """ARKit shapes that it does not have."""
        return tuple(name for name in SHAPES if name not in self.shapes)

    @property
    def unused(self) -> tuple[str, ...]:
        """Morph targets that stand for no ARKit shape."""
        used = set(self.shapes.values())
        return tuple(dict.fromkeys(n for names in self.targets.values() for n in names if n not in used))


def read_rig(path: Path, map_file: Path | None = None) -> Rig:
    """Read a character; the map is guessed from names if no file gives it.

    Raises InputError if the file has no morph targets, or the map is wrong.
    """
    file = read_glb(path)
    targets = file.morph_targets()
    if not targets:
        raise InputError("has no morph targets; expected a mesh with blend shapes", Place(str(path)))
    names = tuple(dict.fromkeys(name for group in targets.values() for name in group))
    if map_file is None:
        return Rig(file, targets, guess_map(names))
    return Rig(file, targets, _read_map(map_file, names))


def _read_map(path: Path, names: Sequence[str]) -> dict[str, str]:
    """Return a map; InputError if it is empty, or a name is unknown or a target given twice."""
    source = SourceText(str(path), read_text(path))
    shapes = parse(ShapeMap, source.text, source.name).shapes
    if not shapes:
        example = 'jawOpen = "Mouth_Open"'
        raise InputError(f"[shapes] is empty; expected lines such as {example}", Place(str(path)))
    shape_of: dict[str, str] = {}
    for shape, target in shapes.items():
        if shape not in INDEX:
            raise source.error(("shapes", shape), unknown("ARKit shape", shape, INDEX))
        if target not in names:
            raise source.error(("shapes", shape), unknown("morph target", target, names))
        if (other := shape_of.setdefault(target, shape)) != shape:
            message = f"morph target '{target}' is given for {other} and for {shape}"
            raise source.error(("shapes", shape), message)
    return dict(shapes)


def check_performable(rig: Rig) -> None:
    """Raise InputError if nothing of a performance would show on a character."""
    place = Place(str(rig.file.path))
    if not rig.shapes:
        raise InputError("no morph target has the name of an ARKit shape; expected --map FILE", place)
    if not any(rig.file.nodes_of(mesh) for mesh in rig.targets):
        raise InputError("no node shows a mesh with morph targets", place)
    rig.file.extended()


def guess_map(names: Sequence[str]) -> dict[str, str]:
    """Return the morph targets that most likely are ARKit's shapes, each used once.

    Case, punctuation, a prefix that all share, and the way sides are written do not count.
    """
    plain: dict[str, str] = {}
    for name in names:
        plain.setdefault(_plain(name), name)
    matched = {shape: plain[_plain(shape)] for shape in SHAPES if _plain(shape) in plain}
    free = {key: name for key, name in plain.items() if name not in matched.values()}
    for shape in SHAPES:
        if shape not in matched:
            near = difflib.get_close_matches(_plain(shape), list(free), n=1, cutoff=_LIKE)
            if near and _side(near[0]) == _side(_plain(shape)):
                matched[shape] = free.pop(near[0])
    return {shape: matched[shape] for shape in SHAPES if shape in matched}


@one_thread()
def report(rig: Rig, head: Head) -> list[MuscleCoverage]:
    """Return how well the character shows each of our muscles, measured by `head`'s own sculpted shapes."""
    every, some = ArkitFit.of(head), ArkitFit(head, rig.shapes)
    solver = FaceSolver(head)
    rows = []
    for name in FITTED:
        values = np.array(NEUTRAL)
        values[PARAMETER[name]] = 1.0
        frame = solver.solve(values)
        moved = float(np.sqrt((some.displacement(frame.skin).reshape(-1, 3) ** 2).sum(axis=1).mean()))
        left = [fit.residual(frame, fit.weights(frame))[0] for fit in (some, every)]
        share = [min(rms / max(moved, 1e-9), 1.0) for rms in left]
        rows.append(MuscleCoverage(name, share[0], share[1], left[0]))
    return rows


@one_thread()
def lips_apart(rig: Rig, head: Head) -> float:
    """Return by how many mm the character's lips stay apart, at most, where ours are sealed.

    It is measured at 19 places from corner to corner on `head`, whose jaw opens up to 0.2 under the seal.
    """
    fit, solver, gap = ArkitFit(head, rig.shapes), FaceSolver(head), MouthGap.of(head)
    widest = []
    for jaw in (0.0, 0.1, 0.2):
        values = np.array(NEUTRAL)
        values[[PARAMETER["masseter"], PARAMETER["lip_seal"]]] = jaw, 1.0
        widest.append(gap(fit.skin(fit.weights(solver.solve(values)))).max())
    return max(float(max(widest)), 0.0)


def animated(rig: Rig, track: ArkitTrack, times: Array) -> GlbFile:
    """Return the character's file with one animation more: the track's weights on its morph targets.

    Raises InputError as `check_performable`.
    """
    check_performable(rig)
    document, binary = rig.file.extended(), bytearray(rig.file.binary)

    def accessor(values: Float32Array) -> int:
        binary.extend(b"\0" * (-len(binary) % 4))
        view = {"buffer": 0, "byteOffset": len(binary), "byteLength": values.nbytes}
        binary.extend(values.tobytes())
        document["bufferViews"].append(view)
        described = {"componentType": 5126, "count": values.size, "type": "SCALAR"}
        limits = {"min": [float(values.min())], "max": [float(values.max())]}
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, **described, **limits})
        return len(document["accessors"]) - 1

    shape_of = {target: shape for shape, target in rig.shapes.items()}
    clock = accessor(times.astype(np.float32))
    samplers, channels = [], []
    for mesh, names in rig.targets.items():
        columns = [track.weights[:, INDEX[shape_of[n]]] if n in shape_of else 0.0 * times for n in names]
        output = accessor(np.ascontiguousarray(np.stack(columns, axis=1), np.float32).ravel())
        for node in rig.file.nodes_of(mesh):
            samplers.append({"input": clock, "output": output, "interpolation": "LINEAR"})
            target = {"node": node, "path": "weights"}
            channels.append({"sampler": len(samplers) - 1, "target": target})
    document["animations"].append({"name": "risorius", "channels": channels, "samplers": samplers})
    buffers = document["buffers"] or [{}]
    document["buffers"] = [{**buffers[0], "byteLength": len(binary)}, *buffers[1:]]
    return GlbFile(rig.file.path, document, bytes(binary))


def _plain(name: str) -> str:
    """Return a name without case, punctuation and prefixes, its side spelled out at the end."""
    stem = re.split(r"[.:|]", name)[-1]
    words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+", stem)
    sides = [_SIDES.get(word.lower(), word.lower()) for word in words]
    side = next((word for word in reversed(sides) if word in ("left", "right")), "")
    rest = "".join(word for word in sides if word not in ("left", "right"))
    return rest + side


def _side(plain: str) -> str:
    return next((side for side in ("left", "right") if plain.endswith(side)), "")
