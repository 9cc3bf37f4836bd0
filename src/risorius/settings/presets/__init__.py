"""Settings kept in files: presets, which come with Risorius, and configurations of a user's own.

Each is a table of TOML: names of settings, or of their options without dashes, and their values as texts,
numbers or lists. `description` says what it is for. A preset is a file of this folder.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from os import PathLike
from pathlib import Path
from typing import Any

from ...errors import ParameterError, RisoriusError, unknown
from ...machine.paths import path_of
from ...reading.frozen import FrozenDict
from ...reading.hints import shown
from ...reading.source_text import SourceText
from ...reading.toml import read_tables, read_text
from ..declare import Row, rows
from ..table import Settings, settings_of

_DESCRIPTION = "description"
_SUFFIX = ".toml"


def load_settings(*names: str | PathLike[str], **chosen: Any) -> Settings:
    """Return the settings of presets and of configuration files (`.toml`), each over those before it, and
    over all of them the settings that are `chosen` by name.

    Raises RisoriusError for an unknown name, with its place, and for a value that a setting cannot have.
    """
    texts = tuple(name if isinstance(name, str) else str(path_of(name)) for name in names)
    return settings_of({**values_of(texts), **chosen})


def values_of(names: tuple[str, ...]) -> dict[str, Any]:
    """Return the values, by setting, of presets and files, each over those before it."""
    values: dict[str, Any] = {}
    for name in names:
        values |= _read(read_text(Path(name)), name) if name.endswith(_SUFFIX) else _preset(name)
    return values


@cache
def presets() -> Mapping[str, str]:
    """Return the purpose of each preset, by its name."""
    return FrozenDict({name: read_tables(text, name)[_DESCRIPTION] for name, text in _texts().items()})


@cache
def _texts() -> Mapping[str, str]:
    files = sorted(Path(__file__).parent.glob(f"*{_SUFFIX}"))
    return FrozenDict({file.stem: file.read_text(encoding="utf-8") for file in files})


def _preset(name: str) -> dict[str, Any]:
    if name not in _texts():
        raise ParameterError(unknown("preset", name, _texts()))
    return _read(_texts()[name], f"presets/{name}{_SUFFIX}")


def _read(text: str, name: str) -> dict[str, Any]:
    source, names = SourceText(name, text), _names()
    values: dict[str, Any] = {}
    for key, value in read_tables(text, name).items():
        if key == _DESCRIPTION:
            continue
        row = names.get(key.replace("-", "_"))
        if row is None:
            raise source.error((key,), unknown("setting", key, names))
        values[row.name] = tuple(value) if isinstance(value, list) else value
        try:
            settings_of({row.name: values[row.name]})
        except RisoriusError as error:
            raise source.error((key,), error.message, type(error)) from None
        except (AttributeError, TypeError, ValueError, OverflowError):
            message = f"{shown(value, source.syntax)} is not a {row.kind}"
            raise source.error((key,), message) from None
    return values


def _names() -> dict[str, Row]:
    """Return the settings by their names, and by their options' if these have a value."""
    return dict(_named(rows(Settings).values()))


def _named(table: Any) -> Iterator[tuple[str, Row]]:
    for row in table:
        yield row.name, row
        if row.flag is not None and not row.is_flag:
            yield row.flag.removeprefix("--").replace("-", "_"), row
