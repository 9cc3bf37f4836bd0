"""Find heads: those that come with Risorius by their names, others by their folder or file."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from ...errors import HeadError, unknown
from ...machine.paths import is_file, is_folder

FILE = "head.npz"


def shipped_heads() -> tuple[str, ...]:
    """Return the names of the heads that come with Risorius."""
    return tuple(entry.name for entry in sorted(heads_folder().iterdir()) if (entry / FILE).is_file())


def head_file(name_or_path: str | Path) -> Path:
    """Return the file of a head by its name, folder or file; raise HeadError if there is no such head."""
    path = Path(name_or_path)
    if is_folder(path):
        path = path / FILE
    if is_file(path):
        return path.resolve()
    shipped = shipped_heads()
    if str(name_or_path) in shipped:
        return heads_folder() / str(name_or_path) / FILE
    raise HeadError(f"{unknown('head', str(name_or_path), shipped)}, or a folder that holds a {FILE}")


def heads_folder() -> Path:
    """Return the folder of the heads that come with Risorius."""
    return Path(str(resources.files("risorius") / "heads"))
