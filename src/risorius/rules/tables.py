"""Tables that a file of rules changes: lips, emotions, links between muscles (paper B, section 3.2).

An entry's id says what it changes: `lips.phone.AA`, `lips.class.vowel` and the other tables of `lips.toml`,
`emotions.happiness`, `links.zygomatic_major.zygomatic_minor`. Its values lie over those of the package; an id
that the package lacks is a new entry. A deleted phone moves no lips.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from ..core.muscle_coupling import Link
from ..core.parameters import MUSCLES
from ..errors import InputError, ParameterError, unknown
from ..reading.schema import build
from ..reading.source_text import SourceText
from ..reading.toml import read_tables
from .emotions import HAND_EMBLEM, Emotion, emotion_tables, emotions_in_force, shipped_emotions
from .fuzzy import fuzzy_table
from .lips import LIPS_FILE, NAMED_TABLES, LipTable, lip_table_of, lip_table_text
from .modulation import is_under

LIPS, EMOTIONS, LINKS = "lips", "emotions", "links"
SINGLE = ("opening", "pausing", "articulation", "tempo")
_MUSCLES = [[base] for base in dict.fromkeys(m.base for m in MUSCLES)]
_DELETABLE = ("phone", "diphthong", "onset")


@dataclass(frozen=True, slots=True)
class TableEntry:
    """Values of a table in place of the package's, or a new entry of it."""

    id: str
    values: Mapping[str, Any]
    source: str
    comment: str = ""

    def __post_init__(self) -> None:
        path(self.id)


@dataclass(frozen=True)
class TableChanges:
    """Changes of tables in files of rules: entries in order, and deleted ids."""

    changed: tuple[TableEntry, ...] = ()
    deleted: frozenset[str] = field(default_factory=frozenset)

    def lips(self) -> LipTable:
        """Return the lips' table with its changes; raise InputError if it does not fit together."""
        entries = self._of(LIPS)
        gone = frozenset(name for name in self.deleted if name.startswith(f"{LIPS}."))
        return lip_table_of({}) if not entries and not gone else _lips(self)

    def emotions(self) -> Mapping[str, Emotion]:
        """Return the emotions as changed; raise InputError if one does not fit."""
        fuzzy_table()  # its pairs name the package's emotions
        return _emotions(self) if self.touches(EMOTIONS) else shipped_emotions()

    def links(self, rows: Sequence[Link]) -> tuple[Link, ...]:
        """Return a head's rows of links with their changes; raise RisoriusError for one that cannot be."""
        new = [_link(entry) for entry in self._of(LINKS)]
        changed = {_link_id(row): row for row in (*rows, *new)}
        return tuple(row for name, row in changed.items() if not _is_deleted(name, self.deleted))

    def touches(self, table: str) -> bool:
        """Tell whether anything of a table is changed or deleted."""
        return bool(self._of(table)) or any(name.startswith(f"{table}.") for name in self.deleted)

    def _of(self, table: str) -> list[TableEntry]:
        return [entry for entry in self.changed if entry.id.startswith(f"{table}.")]

    def __hash__(self) -> int:
        return hash((tuple(map(repr, self.changed)), self.deleted))


def path(name: str) -> tuple[str, ...]:
    """Return the parts of an entry's id; raise ParameterError or InputError for one that names no entry."""
    table, *parts = name.split(".")
    if table == LIPS and parts and parts[0] in (*NAMED_TABLES, *SINGLE):
        if len(parts) == (2 if parts[0] in NAMED_TABLES else 1):
            return (table, *parts)
        raise InputError(f"there is no entry '{name}'; expected e.g. lips.phone.AA or lips.opening")
    if table == LIPS and parts:
        raise ParameterError(unknown("table of lips", parts[0], (*NAMED_TABLES, *SINGLE)))
    if (table == EMOTIONS and len(parts) == 1) or (table == LINKS and len(parts) in (2, 3)):
        return (table, *parts)
    known = "lips.phone.AA, emotions.pride or links.zygomatic_major.zygomatic_minor"
    raise InputError(f"there is no entry with the id '{name}'; expected e.g. {known}")


def is_link(name: str) -> bool:
    """Tell whether an entry's id, or the beginning of one, is that of links between muscles."""
    return name.partition(".")[0] == LINKS


def deleted_entries(prefixes: Iterable[str]) -> frozenset[str]:
    """Return the entries whose ids are one of the prefixes, or begin with one up to a dot."""
    lips = read_tables(lip_table_text(), LIPS_FILE)
    known = [f"{LIPS}.{table}.{name}" for table in _DELETABLE for name in lips[table]]
    known += [f"{EMOTIONS}.{name}" for name in emotion_tables()]
    asked = {p for p in prefixes if p.partition(".")[0] == LINKS and p.split(".")[1:2] in _MUSCLES}
    return frozenset(name for name in known if any(is_under(name, p) for p in prefixes)) | asked


def check(changes: TableChanges) -> None:
    """Raise RisoriusError if a table as it is changed does not fit."""
    changes.lips()
    with emotions_in_force(changes.emotions()):
        pass
    for entry in changes._of(LINKS):
        _link(entry)


@cache
def _lips(changes: TableChanges) -> LipTable:
    tables = read_tables(lip_table_text(), LIPS_FILE)
    for entry in changes._of(LIPS):
        _, *parts = path(entry.id)
        _lay(tables, parts, entry.values)
    gone: set[str] = set()
    for name in changes.deleted:
        table, *parts = name.split(".")
        if table == LIPS and len(parts) == 2 and tables.get(parts[0], {}).pop(parts[1], None) is not None:
            gone.add(parts[1])
    return replace(lip_table_of(tables), silent=frozenset(gone))


@cache
def _emotions(changes: TableChanges) -> Mapping[str, Emotion]:
    tables = emotion_tables()
    for entry in changes._of(EMOTIONS):
        name = path(entry.id)[1]
        if name not in tables:
            tables[name] = _new_emotion(name, entry)
        _lay(tables, [name], entry.values)
    shown = {name: table for name, table in tables.items() if f"{EMOTIONS}.{name}" not in changes.deleted}
    return {name: build(Emotion, shown[name], SourceText(f"{EMOTIONS}.{name}", "")) for name in sorted(shown)}


def _new_emotion(name: str, entry: TableEntry) -> dict[str, Any]:
    """Return the emotion's fields beside the values that its entry gives it."""
    emblem = {**HAND_EMBLEM, "targets": entry.values.get("targets", {})}
    return {"name": name, "description": entry.comment or name, "source": entry.source, "emblem": emblem}


def _lay(tables: dict[str, Any], parts: Sequence[str], values: Mapping[str, Any]) -> None:
    """Lay values over those of a table within tables; tables within it are laid over, too."""
    for part in parts:
        tables = tables.setdefault(part, {})
    for key, value in values.items():
        if isinstance(value, Mapping) and isinstance(tables.get(key), dict):
            _lay(tables, [key], value)
        else:
            tables[key] = value


def _link(entry: TableEntry) -> Link:
    _, muscle, linked, *sides = path(entry.id)
    if set(entry.values) != {"weight"}:
        raise InputError(f"{entry.id} has the values {', '.join(entry.values) or 'none'}; expected weight")
    weight = entry.values["weight"]
    if isinstance(weight, bool) or not isinstance(weight, int | float):
        raise InputError(f"{entry.id}: weight is {type(weight).__name__}; expected a number from 0 to 1")
    if sides not in ([], ["same"], ["other"]):
        raise ParameterError(unknown("side of a link", sides[0], ("same", "other")))
    return Link(muscle, linked, float(weight), entry.source, sides="other" if sides == ["other"] else "same")


def _link_id(row: Link) -> str:
    return f"{LINKS}.{row.muscle}.{row.linked}" + (".other" if row.sides == "other" else "")


def _is_deleted(name: str, deleted: Iterable[str]) -> bool:
    return any(is_under(name, prefix) for prefix in deleted)
