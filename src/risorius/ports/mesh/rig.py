"""A character of one's own: a GLB whose morph targets are mapped to ARKit's names becomes an output rig."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...core.arkit import INDEX, SHAPES
from ...core.arrays import Array, Float32Array
from ...core.parameters import INDEX as PARAMETER
from ...core.parameters import NEUTRAL
from ...errors import InputError, Place, unknown
from ...face.fit.arkit_fit import ArkitFit
from ...face.fit.arkit_track import ArkitTrack
from ...face.fit.mouth_gap import MouthGap
from ...face.fit.muscle_fit import FITTED
from ...face.head.head import Head
from ...face.solve import FaceSolver
from ...machine.blas import one_thread
from ...reading.source_text import SourceText
from ...reading.toml import parse, read_text
from .glb_file import GlbFile, read_glb
from .gltf import held
from .shape_names import ShapeTargets, guess_map

WELL, PARTLY = 0.25, 0.6  # shares of a movement left over up to which it is shown well, and partly


@dataclass(frozen=True, slots=True)
class ShapeMap:
    """A map's file: the names of a character's morph targets by ARKit's names, one or a list for each."""

    shapes: Mapping[str, str | tuple[str, ...]] = field(default_factory=dict)


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
    """A character's file, the targets of each mesh, and its map: the targets of each ARKit shape by name."""

    file: GlbFile
    targets: Mapping[int, tuple[str, ...]]
    shapes: ShapeTargets

    def __repr__(self) -> str:
        """Return one line: the file, and how many of ARKit's shapes it has."""
        meshes = f"{len(self.targets)} mesh{'es' if len(self.targets) != 1 else ''}"
        return f"<Rig {self.file.path.name}: {len(self.shapes)} of {len(SHAPES)} ARKit shapes on {meshes}>"

    @property
    def missing(self) -> tuple[str, ...]:
        """ARKit shapes that it does not have."""
        return tuple(name for name in SHAPES if name not in self.shapes)

    @property
    def unused(self) -> tuple[str, ...]:
        """Morph targets that stand for no ARKit shape."""
        names = (name for names in self.targets.values() for name in names)
        return tuple(dict.fromkeys(name for name in names if name not in self.shape_of))

    @property
    def shape_of(self) -> Mapping[str, str]:
        """The ARKit shape of each morph target that stands for one."""
        return {name: shape for shape, names in self.shapes.items() for name in names}


def read_rig(path: Path, map_file: Path | None = None) -> Rig:
    """Read a character; the map is guessed from names if no file gives it.

    Raises InputError if the file has no morph targets, or the map is wrong.
    """
    file = read_glb(path)
    targets = file.morph_targets()
    if not targets:
        raise InputError("has no morph targets; expected a mesh with blend shapes", Place(str(path)))
    if map_file is None:
        return Rig(file, targets, guess_map(*targets.values()))
    names = tuple(dict.fromkeys(name for group in targets.values() for name in group))
    return Rig(file, targets, _read_map(map_file, names))


def _read_map(path: Path, names: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Return a map; InputError if it is empty, or a name is unknown or a target given twice."""
    source = SourceText(str(path), read_text(path))
    shapes = parse(ShapeMap, source.text, source.name).shapes
    if not shapes:
        example = 'jawOpen = "Mouth_Open"'
        raise InputError(f"[shapes] is empty; expected lines such as {example}", Place(str(path)))
    read: dict[str, tuple[str, ...]] = {}
    shape_of: dict[str, str] = {}
    for shape, given in shapes.items():
        if shape not in INDEX:
            raise source.error(("shapes", shape), unknown("ARKit shape", shape, INDEX))
        read[shape] = (given,) if isinstance(given, str) else given
        if not read[shape]:
            raise source.error(("shapes", shape), "the list is empty; expected names of morph targets")
        for target in read[shape]:
            if target not in names:
                raise source.error(("shapes", shape), unknown("morph target", target, names))
            if (other := shape_of.setdefault(target, shape)) != shape:
                message = f"morph target '{target}' is given for {other} and for {shape}"
                raise source.error(("shapes", shape), message)
    return read


def check_performable(rig: Rig) -> None:
    """Raise InputError if nothing of a performance would show on a character."""
    place = Place(str(rig.file.path))
    if not rig.shapes:
        raise InputError("no morph target has the name of an ARKit shape; expected --map FILE", place)
    if not any(rig.file.nodes_of(mesh) for mesh in rig.targets):
        raise InputError("no node shows a mesh with morph targets", place)
    rig.file.extended()


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

    `times` (keys,): keys after the last frame hold its weights. A target that is not a shape keeps the
    weight that the file gives it at rest. Raises InputError as `check_performable`.
    """
    check_performable(rig)
    weights = held(track.weights, len(times))
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

    shape_of, keys = rig.shape_of, np.ones(len(times))
    clock = accessor(times.astype(np.float32))
    samplers, channels, outputs = [], [], {}
    for mesh, names in rig.targets.items():
        for node in rig.file.nodes_of(mesh):
            resting = rig.file.resting_weights(mesh, node, len(names))
            if (mesh, resting) not in outputs:
                columns = [
                    weights[:, INDEX[shape_of[name]]] if name in shape_of else rest * keys
                    for name, rest in zip(names, resting, strict=True)
                ]
                values = np.ascontiguousarray(np.stack(columns, axis=1), np.float32)
                outputs[mesh, resting] = accessor(values.ravel())
            output = outputs[mesh, resting]
            samplers.append({"input": clock, "output": output, "interpolation": "LINEAR"})
            target = {"node": node, "path": "weights"}
            channels.append({"sampler": len(samplers) - 1, "target": target})
    document["animations"].append({"name": "risorius", "channels": channels, "samplers": samplers})
    buffers = document["buffers"] or [{}]
    document["buffers"] = [{**buffers[0], "byteLength": len(binary)}, *buffers[1:]]
    return GlbFile(rig.file.path, document, bytes(binary))
