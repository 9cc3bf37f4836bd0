"""The table of file formats, found by the suffix of a file's name.

Each format is one file of this package that ends with a line `register(…)`. The table is made from these
lines, read as text: the files themselves draw and fit faces and take seconds to import, which most commands
do not need. A format's file is imported when it is first written or read.
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.registry import Registry, registrations
from ..errors import InputError, OutputError, Place, unknown

if TYPE_CHECKING:
    from .export_source import WritableTake, WriteOptions
    from .import_result import PlayedFile, ReadOptions

Writer = Callable[["WritableTake", Path, "WriteOptions"], None]
"""Fills a file, which is empty and stands beside the final one."""
Reader = Callable[[Path, "ReadOptions"], "PlayedFile"]
"""Reads a file; raises InputError for one that is wrong."""
_LAST = 100
_USUAL = 10  # formats that a message names: all of them would be too many
_COLUMNS = ("suffix", "description", "needs")  # what `register` has before its functions


class Need(StrEnum):
    """The data that a format is made from; it determines which stages must run."""

    MOVEMENTS = "movements"
    CURVES = "curves"
    VERTICES = "vertices"
    PIXELS = "pixels"
    SPEECH = "speech"
    HEAD = "head"


@dataclass(frozen=True, slots=True)
class FileFormat:
    """A format: its suffix with the leading dot, its contents, and the data from which it is written.

    `module`: the name of the module that writes and reads it. `opaque`: it shows pictures and has no place
    for an alpha channel. `read_suffixes`: the suffixes of files that are read as this format; none if it is
    only written. `uses`: data that change it, too, but without which it can be made. `reads`: the settings
    that it reads beside those of the stages that it needs or uses. `order`: its place in lists; those of the
    same place go by their suffix.
    """

    suffix: str
    description: str
    needs: frozenset[Need]
    module: str
    opaque: bool = False
    read_suffixes: tuple[str, ...] = ()
    uses: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()
    order: int = _LAST

    def write(self, take: WritableTake, path: Path, options: WriteOptions) -> None:
        """Fill `path` with a take; the format's module is imported if it is not yet."""
        self._functions()[0](take, path, options)

    def read(self, path: Path, options: ReadOptions) -> PlayedFile:
        """Return the contents of a file; the format's module is imported if it is not yet."""
        reader = self._functions()[1]
        if reader is None:
            raise ValueError(f"{self.suffix} files can be written, but not read")
        return reader(path, options)

    def _functions(self) -> tuple[Writer, Reader | None]:
        if self.suffix not in _FUNCTIONS:
            import_module(self.module)
        return _FUNCTIONS[self.suffix]


FORMATS: Registry[FileFormat] = Registry("output suffix")
_FUNCTIONS: dict[str, tuple[Writer, Reader | None]] = {}  # filled as the formats' modules are imported


def register(
    suffix: str,
    description: str,
    needs: Iterable[str],
    write: Writer,
    read: Reader | None = None,
    *,
    also_read: tuple[str, ...] = (),
    opaque: bool = False,
    uses: tuple[str, ...] = (),
    reads: tuple[str, ...] = (),
    order: int = _LAST,
) -> None:
    """Register a format, at the end of its file; all but the functions are written as literals.

    `also_read`: other suffixes of files that `read` understands. The rest as in `FileFormat`. A format of
    another package is in the table once its module is imported.
    """
    _FUNCTIONS[suffix] = (write, read)
    if suffix not in FORMATS:
        options = {"also_read": also_read, "opaque": opaque, "uses": uses, "reads": reads, "order": order}
        columns = (suffix, description, needs)
        FORMATS.register(suffix)(_format(write.__module__, columns, options, readable=read is not None))


def _format(module: str, columns: tuple[Any, ...], options: dict[str, Any], *, readable: bool) -> FileFormat:
    suffix, description, needs = columns
    also_read = options.pop("also_read", ())
    suffixes = (suffix, *also_read) if readable else ()
    return FileFormat(
        suffix, description, frozenset(map(Need, needs)), module, read_suffixes=suffixes, **options
    )


def declared(package: Path) -> Iterator[FileFormat]:
    """Yield the formats that the files of the package register, without importing them."""
    for line in registrations(package, __package__, len(_COLUMNS)):
        readable = len(line.arguments) > len(_COLUMNS) + 1
        yield _format(line.module, line.arguments[: len(_COLUMNS)], dict(line.keywords), readable=readable)


for _row in sorted(declared(Path(__file__).parent), key=lambda row: (row.order, row.suffix.lower())):
    FORMATS.register(_row.suffix)(_row)


def format_for(path: Path) -> FileFormat:
    """Return the format that a file is written in; the longest suffix wins, in upper or lower case.

    Raises OutputError with the nearest known suffix and the list of all.
    """
    suffix = _suffix_of(path, FORMATS.names())
    if suffix is None:
        raise OutputError(_unknown_suffix(path), Place(str(path)))
    return FORMATS.get(suffix)


def format_read(path: Path) -> FileFormat:
    """Return the format that a file is read as; raise InputError, naming those that are read."""
    readers = {suffix: row for row in map(FORMATS.get, FORMATS) for suffix in row.read_suffixes}
    suffix = _suffix_of(path, readers)
    if suffix is None:
        from ..script.kinds import kind_of_suffix

        kind = kind_of_suffix(path.name)
        if kind is not None:
            raise InputError(kind, Place(str(path)))
        raise InputError(
            unknown("kind of capture", "".join(path.suffixes[-2:]), sorted(readers)), Place(str(path))
        )
    return readers[suffix]


def _suffix_of(path: Path, known: Collection[str]) -> str | None:
    name = path.name.lower()
    return max((suffix for suffix in known if name.endswith(suffix.lower())), key=len, default=None)


def _unknown_suffix(path: Path) -> str:
    usual = f"one of {', '.join(list(FORMATS)[:_USUAL])}; 'risorius list outputs' shows all"
    if not path.suffix:
        return f"the name has no suffix; expected {usual}"
    known_by_lower = {suffix.lower(): suffix for suffix in FORMATS}
    for ending in ("".join(path.suffixes[-2:]).lower(), path.suffix.lower()):
        near = [suffix for suffix in known_by_lower if suffix.endswith(ending)]
        near = near or difflib.get_close_matches(ending, known_by_lower, n=1, cutoff=0.6)
        if near:
            nearest = known_by_lower[near[0]]
            return (
                f"unknown suffix '{path.suffix}'; did you mean '{nearest}'? 'risorius list outputs' shows all"
            )
    return f"unknown suffix '{path.suffix}'; expected {usual}"
