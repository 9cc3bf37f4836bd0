"""A `.glb` file read: its JSON and its bytes, checked as far as they are used."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from ...errors import InputError, Place
from ...reading.json_text import parse_json

LARGEST = 1_000_000_000  # bytes
_NOT_BINARY = "is not binary glTF 2.0; expected a .glb file"
_HEADER, _CHUNK = struct.Struct("<4sII"), struct.Struct("<I4s")


@dataclass(frozen=True, slots=True)
class GlbFile:
    """The document and its binary chunk, which is empty if the file has none."""

    path: Path
    document: dict[str, Any]
    binary: bytes

    def __repr__(self) -> str:
        """Return one line: the file's name, and how long its binary chunk is."""
        return f"<GlbFile {self.path.name}, {len(self.binary)} bytes beside its document>"

    def morph_targets(self) -> dict[int, tuple[str, ...]]:
        """Return the names of morph targets by mesh; raise InputError if names and targets differ."""
        targets_by_name = {}
        for index, mesh in enumerate(self._list("meshes")):
            targets = [len(self._part(p, "targets", index)) for p in self._part(mesh, "primitives", index)]
            if not any(targets):
                continue
            names = self._target_names(mesh, index)
            if len(set(targets)) != 1 or (names and len(names) != targets[0]):
                raise self._fault(f"mesh {index} has {targets[0]} morph targets and {len(names)} names")
            targets_by_name[index] = tuple(map(str, names)) or tuple(f"target_{k}" for k in range(targets[0]))
        return targets_by_name

    def nodes_of(self, mesh: int) -> list[int]:
        """Return the nodes that show a mesh."""
        return [k for k, node in enumerate(self._list("nodes")) if node.get("mesh") == mesh]

    def resting_weights(self, mesh: int, node: int, targets: int) -> tuple[float, ...]:
        """Return the weights of a mesh's targets at rest: those of the node that shows it, else its own.

        Without either they are 0. Raises InputError if they are not as many numbers as there are targets.
        """
        holders = self._list("nodes")[node], self._list("meshes")[mesh]
        weights = next((holder["weights"] for holder in holders if "weights" in holder), [0.0] * targets)
        if not isinstance(weights, list) or not all(isinstance(weight, int | float) for weight in weights):
            raise self._fault(f"the weights of mesh {mesh} are not a list of numbers; expected one")
        if len(weights) != targets:
            raise self._fault(f"mesh {mesh} has {targets} morph targets and {len(weights)} weights")
        return tuple(map(float, weights))

    def extended(self) -> dict[str, Any]:
        """Return a copy of the document to which accessors, their views and animations can be added.

        Raises InputError if one of these is not a list, or the first buffer is not the file's own.
        """
        lists = {kind: [*self._list(kind)] for kind in ("accessors", "bufferViews", "animations", "buffers")}
        if any("uri" in buffer for buffer in lists["buffers"][:1]) or (lists["buffers"] and not self.binary):
            raise self._fault("keeps its data in another file; expected all of it in the .glb")
        return {**self.document, **lists}

    def _target_names(self, mesh: dict[str, Any], index: int) -> list[Any]:
        """Return the names of a mesh's targets, its own or, as UniVRM writes them, those of a primitive."""
        for holder in (mesh, *self._part(mesh, "primitives", index)):
            extras = holder.get("extras")
            if isinstance(extras, dict) and (names := self._part(extras, "targetNames", index)):
                return names
        return []

    def _list(self, kind: str) -> list[dict[str, Any]]:
        entries = self.document.get(kind, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self._fault(f"'{kind}' is not a list of objects; expected one")
        return entries

    def _part(self, holder: object, kind: str, mesh: int) -> list[Any]:
        """Return a list within a mesh, empty if it is not there."""
        part = holder.get(kind, []) if isinstance(holder, dict) else None
        if not isinstance(part, list):
            raise self._fault(f"'{kind}' of mesh {mesh} is not a list; expected one")
        return part

    def _fault(self, message: str) -> InputError:
        return InputError(message, Place(str(self.path)))


def save_glb(file: GlbFile, path: Path) -> None:
    """Write a document with its bytes as `.glb`."""
    text = json.dumps(file.document, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = file.binary + b"\0" * (-len(file.binary) % 4)
    parts = [_CHUNK.pack(len(text), b"JSON"), text]
    if data:
        parts += [_CHUNK.pack(len(data), b"BIN\0"), data]
    length = _HEADER.size + sum(map(len, parts))
    path.write_bytes(b"".join([_HEADER.pack(b"glTF", 2, length), *parts]))


def read_glb(path: Path) -> GlbFile:
    """Read a binary glTF 2.0 file; raise InputError if it is not one, is cut off or over 1 GB."""
    place = Place(str(path))
    try:
        with path.open("rb") as file:
            data = _read(file, place)
    except (OSError, ValueError) as error:
        raise InputError(f"cannot be read: {getattr(error, 'strerror', None) or error}", place) from None
    try:
        chunks = _chunks(data)
        text = chunks[b"JSON"].decode()
    except (struct.error, KeyError, ValueError):
        raise InputError(_NOT_BINARY, place) from None
    document = parse_json(text, str(path)).data
    if not isinstance(document, dict):
        raise InputError("has no glTF document", place)
    return GlbFile(path, document, chunks.get(b"BIN\0", b""))


def _read(file: IO[bytes], place: Place) -> bytes:
    """Return all of a file, read no further than its header says; raise InputError if that is wrong."""
    header = file.read(_HEADER.size)
    if len(header) < _HEADER.size:
        raise InputError(_NOT_BINARY, place)
    magic, version, length = _HEADER.unpack(header)
    if magic != b"glTF" or version != 2:
        raise InputError(_NOT_BINARY, place)
    if length > LARGEST:
        raise InputError(f"is larger than {LARGEST // 1_000_000} MB; expected less", place)
    data = header + file.read(length - len(header) + 1) if length > len(header) else header
    if length != len(data):
        count = f"more than {length}" if len(data) > length else len(data)
        raise InputError(f"has {count} bytes, but its header says {length}: it is cut off", place)
    return data


def _chunks(data: bytes) -> dict[bytes, bytes]:
    chunks: dict[bytes, bytes] = {}
    at = _HEADER.size
    while at < len(data):
        size, kind = _CHUNK.unpack_from(data, at)
        at += _CHUNK.size
        chunks.setdefault(kind, data[at : at + size])
        at += size
    return chunks
