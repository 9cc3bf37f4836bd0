"""The columns of manifests: the input, and every setting that has an option, by either name."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache

from ..errors import InputError, Place, unknown
from ..reading.frozen import FrozenDict
from ..settings import Settings
from ..settings.declare import SWITCHED, Row, rows

INPUT = ("id", "text", "script", "audio", "transcript", "emotion")


@dataclass(frozen=True, slots=True)
class SettingColumn:
    """A column of a setting. `negated`: it is named as an option without a value, which says the opposite of
    the default: on in `still` is off in `lively`.
    """

    row: Row
    negated: bool = False

    def text(self, cell: str) -> str:
        """Return a cell as the setting reads it; raises InputError unless a switch is on or off."""
        if not self.negated:
            return cell
        if cell not in SWITCHED:
            raise InputError(unknown("value", cell, SWITCHED))
        on = SWITCHED[cell]
        return self.row.text(on is not self.row.usual)


@cache
def setting_columns() -> Mapping[str, SettingColumn]:
    """Return the columns of settings by name: those of the settings, and of their options without dashes."""
    columns = {}
    for name, row in rows(Settings).items():
        if row.flag is not None:
            columns[normal(row.flag)] = SettingColumn(row, negated=row.is_flag)
            columns[name] = SettingColumn(row)
    return FrozenDict(columns)


def normal(name: str) -> str:
    """Return a column's name as it is looked up: `--onset-function` is `onset_function`."""
    return name.strip().lstrip("-").lower().replace("-", "_")


def check_columns(names: Collection[str], read_elsewhere: Collection[str], place: Place) -> None:
    """Raise InputError for a column that nothing reads: neither a setting, nor in a pattern, nor ignored."""
    columns = (*INPUT, *setting_columns())
    for name in names:
        if normal(name) not in columns and name not in read_elsewhere:
            raise InputError(f"{unknown('column', name, columns)}; --ignore leaves it out", place)
