"""Files that a user asks for: checked before any work starts, then all written or none."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Collection, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import OutputError, Place
from ..machine.atomic import os_failure, replacing
from ..machine.blas import one_thread
from ..machine.paths import is_folder, path_of
from .export_source import WritableTake, WriteOptions
from .formats import FORMATS, FileFormat, Need, format_for

PathLike = str | os.PathLike[str]
_WORDS = {Need.PIXELS: "pictures", Need.SPEECH: "spoken words"}
_USUAL = 6  # of the formats that are named in an error


@dataclass(frozen=True, slots=True)
class OutputFile:
    """A file to be written and its format."""

    path: Path
    format: FileFormat


def check_target(path: PathLike, available: Collection[str] = tuple(Need)) -> OutputFile:
    """Return the target for `path` if it can be written.

    `available`: which of the needs ("curves", "vertices", "pixels", "speech") there will be.
    Raises OutputError for an unknown suffix, a need that is not available, a folder that is missing or
    not writable, and a path that is a folder or a read-only file.
    """
    file = path_of(path)
    if is_folder(file):
        raise OutputError("is a folder; expected a file name", Place(str(file)))
    if "\0" in str(file):
        raise OutputError(f"the name {str(file)!r} contains a null character; expected a file name")
    target = OutputFile(file, format_for(file))
    missing = sorted(need for need in target.format.needs if need not in available)
    if missing:
        raise OutputError(_not_here(target.format, missing[0], available), Place(str(file)))
    try:
        _check_place(file)
    except OSError as error:
        raise os_failure(file, error) from error
    return target


def _not_here(format: FileFormat, missing: Need, available: Collection[str]) -> str:
    rest = [s for s in FORMATS if all(need in available for need in FORMATS.get(s).needs)]
    shown = ", ".join(rest[:_USUAL]) + (", …" if len(rest) > _USUAL else "")
    return (
        f"{format.suffix} needs {_WORDS.get(missing, missing)}, and there are none; expected one of {shown}"
    )


def check_targets(
    paths: Iterable[PathLike], available: Collection[str] = tuple(Need), *, alpha: bool = False
) -> tuple[OutputFile, ...]:
    """Return the targets for all `paths`.

    Raises OutputError as `check_target`, if one is given twice, and with `alpha` as `check_alpha`.
    """
    targets = tuple(check_target(path, available) for path in paths)
    if alpha:
        check_alpha(targets)
    seen: set[str] = set()
    for target in targets:
        real = os.path.realpath(target.path)
        if real in seen:
            raise OutputError("the output is given twice; expected different files", Place(str(target.path)))
        seen.add(real)
    return targets


def check_alpha(targets: Iterable[OutputFile]) -> None:
    """Raise OutputError for a target that cannot hold pictures with a transparent background."""
    for target in targets:
        if target.format.opaque:
            suffixes = ", ".join(s for s in FORMATS if not FORMATS.get(s).opaque and _shows(FORMATS.get(s)))
            message = (
                f"{target.format.suffix} cannot have a transparent background; expected one of {suffixes}"
            )
            raise OutputError(message, Place(str(target.path)))


def _shows(entry: FileFormat) -> bool:
    return Need.PIXELS in entry.needs


def write_targets(
    take: WritableTake, targets: Sequence[OutputFile], options: WriteOptions | None = None
) -> None:
    """Write all targets; they appear together, when the last is complete, or not at all.

    A score refers to the `.wav` among the targets, if there is one. The bytes do not depend on the number of
    threads that linear algebra has. Raises OutputError.
    """
    options = options or WriteOptions()
    if options.alpha:
        check_alpha(targets)
    if options.voice is None:
        voices = [target.path for target in targets if target.format.suffix == ".wav"]
        options = replace(options, voice=voices[0] if voices else None)
    with one_thread(), ExitStack() as stack:
        beside = [stack.enter_context(replacing(target.path)) for target in targets]
        for target, temporary in zip(targets, beside, strict=True):
            _write_one(take, target, temporary, options)


def _write_one(take: WritableTake, target: OutputFile, temporary: Path, options: WriteOptions) -> None:
    try:
        target.format.write(take, temporary, options)
    except OSError as error:
        raise os_failure(target.path, error) from error
    except OutputError as error:
        raise error.at(Place(str(target.path))) from error


def _check_place(file: Path) -> None:
    place = Place(str(file))
    folder = file.parent
    if not folder.exists():
        raise OutputError(f"the folder '{folder}' does not exist; expected an existing folder", place)
    if not folder.is_dir():
        raise OutputError(f"'{folder}' is not a folder", place)
    if file.exists() and not os.access(file, os.W_OK):
        raise OutputError("exists and is read-only", place)
    try:
        # Only trying tells: permission bits say nothing about a read-only disk, or to an administrator.
        tempfile.TemporaryFile(dir=Path(os.path.realpath(file)).parent).close()
    except OSError as error:
        raise OutputError(f"the folder '{folder}' is not writable ({error.strerror})", place) from error
