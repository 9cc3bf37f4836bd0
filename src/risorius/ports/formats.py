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
from .source import Material, WriteOptions

Writer = Callable[[Material, Path, WriteOptions], None]


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
    """Add a format. `write(material, path, options)` fills `path`, an empty file beside the final one."""
    output = Output(suffix, description, frozenset(Need(need) for need in needs), write, opaque)
    OUTPUTS.register(suffix)(output)


def deferred(module: str, name: str) -> Writer:
    """Return a writer of this package that is imported when it is first used.

    What draws or fits faces takes a second to import, and most commands need none of it.
    """

    def write(material: Material, path: Path, options: WriteOptions) -> None:
        getattr(import_module(f".{module}", __package__), name)(material, path, options)

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
