"""The package's own tables of rules."""

from __future__ import annotations

from importlib import resources
from typing import TypeVar

from ..reading.toml import load_file, parse

T = TypeVar("T")
DATA = resources.files(__package__) / "data"

__all__ = ["DATA", "load", "load_file", "load_folder", "parse"]


def load(cls: type[T], name: str) -> T:
    """Return the package's table `name` (a path under `rules/data`, such as "synchrony.toml") as a `cls`."""
    return parse(cls, (DATA / name).read_text(encoding="utf-8"), name)


def load_folder(cls: type[T], folder: str) -> dict[str, T]:
    """Return all the package's tables in `folder`, by their path under `rules/data`, in order of name."""
    names = sorted(entry.name for entry in (DATA / folder).iterdir() if entry.name.endswith(".toml"))
    return {f"{folder}/{name}": load(cls, f"{folder}/{name}") for name in names}
