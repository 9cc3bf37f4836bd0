"""Files that a command writes; one of them may be standard output, `-.SUFFIX`."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import OutputError, Place
from .console import Console

_STANDARD = "-."
_LOOKED_AT = 8_192  # bytes by which text is told from other content


@contextmanager
def _files_for(outputs: Collection[Path]) -> Iterator[tuple[Path, ...]]:
    """Yield the files to write: for standard output one that is printed when the block ends well."""
    printed = [output for output in outputs if is_standard(output)]
    if not printed:
        yield tuple(outputs)
        return
    _check(printed)
    with tempfile.TemporaryDirectory(prefix="risorius-") as folder:
        file = Path(folder) / printed[0].name
        yield tuple(file if output == printed[0] else output for output in outputs)
        _print(file, Place(str(printed[0])))


@contextmanager
def written(console: Console, outputs: Collection[Path]) -> Iterator[tuple[Path, ...]]:
    """Yield the files to write, one that is printed later for standard output; when all are written, say so.

    Raises OutputError for more than one `-.SUFFIX`, an unknown suffix, or binary output to a terminal.
    """
    with _files_for(outputs) as files:
        yield files
    console.wrote(outputs)


def is_standard(output: Path) -> bool:
    """Whether an output is named `-.SUFFIX`."""
    return os.fspath(output).startswith(_STANDARD)


def _check(printed: list[Path]) -> None:
    from ..ports.formats import format_for

    format_for(printed[0])
    if len(printed) > 1:
        message = "standard output takes one output; expected files for the others"
        raise OutputError(message, Place(str(printed[1])))
    if sys.stdout is None:
        raise OutputError("standard output is closed; expected a file", Place(str(printed[0])))


def _print(file: Path, place: Place) -> None:
    with file.open("rb") as content:
        if sys.stdout.isatty() and b"\0" in content.read(_LOOKED_AT):
            raise OutputError("a terminal cannot show binary output; expected a pipe or a file", place)
        content.seek(0)
        sys.stdout.flush()
        shutil.copyfileobj(content, sys.stdout.buffer)
        sys.stdout.flush()
