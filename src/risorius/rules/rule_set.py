"""Sets of rules: ours, and those that a user's file adds, replaces and deletes (paper B, section 3.2)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from ..errors import InputError, ParameterError, Place, RisoriusError, unknown
from ..reading.frozen import FrozenDict
from ..reading.source_text import SourceText
from ..reading.toml import parse, read_tables, read_text
from .emotions import emotions_in_force
from .expressions import FELT, expressed, overwhelming
from .habits import HABITS, Habit, HabitChanges, deleted_by, with_habits
from .load import DATA
from .modulation import is_under
from .profiles import NEUTRAL, attitudes, profile, profiles
from .rule import Rule
from .tables import TableChanges, TableEntry, check, deleted_entries, is_link

FOLDER = "rules"
_RULE = re.compile(r"^\[\[\s*rule\s*\]\][^\n]*\n", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class RuleFile:
    """A file of rules. `habit`: numbers of habits. `entry`: entries of tables. `delete`: ids, or their
    beginnings up to a dot, of rules, habits and entries that do not hold.
    """

    rule: tuple[Rule, ...] = ()
    habit: tuple[Habit, ...] = ()
    entry: tuple[TableEntry, ...] = ()
    delete: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class RuleEntry:
    """A rule, its place, and its text in the file."""

    rule: Rule
    place: Place
    text: str


@dataclass(frozen=True)
class RuleSet:
    """The rules that hold, by id, in the order of their files, and the files' changes of habits.

    `habit_places`: where each of the changed habits stands; `tables`, `table_places`: likewise of tables.
    `gone`: ids, or their beginnings up to a dot, that files replace or delete.
    """

    entries: Mapping[str, RuleEntry] = field(default_factory=FrozenDict)
    habits: HabitChanges = field(default_factory=HabitChanges)
    habit_places: tuple[Place, ...] = ()
    gone: tuple[str, ...] = ()
    tables: TableChanges = field(default_factory=TableChanges)
    table_places: tuple[Place, ...] = ()

    def __iter__(self) -> Iterator[Rule]:
        return (entry.rule for entry in self.entries.values())

    def get(self, name: str) -> RuleEntry:
        """Return the rule `name`; raise ParameterError, with the nearest one, if it is unknown."""
        if name not in self.entries:
            raise ParameterError(unknown("rule", name, self.entries))
        return self.entries[name]


@cache
def shipped() -> RuleSet:
    """Return the package's rules."""
    rule_set = RuleSet()
    names = sorted(entry.name for entry in (DATA / FOLDER).iterdir() if entry.name.endswith(".toml"))
    for name in names:
        rule_set = extended(rule_set, (DATA / FOLDER / name).read_text(encoding="utf-8"), f"{FOLDER}/{name}")
    return rule_set


def rule_names() -> dict[str, str]:
    """Return the ids of the rules that come with Risorius, with the purpose of each."""
    return {rule.id: rule.comment for rule in shipped()}


def rule_set_of(path: Path | None) -> RuleSet:
    """Return the package's rules as a user's file changes them; raise InputError if it cannot be used."""
    return shipped() if path is None else extended(shipped(), read_text(path), str(path))


def check_links_alone(path: Path | None, reader: str) -> None:
    """Raise InputError, with its place, if a user's file changes more than the links between muscles.

    `reader`: what reads the file, for the message. Also raises as `rule_set_of`.
    """
    if path is None:
        return
    text = read_text(path)
    extended(shipped(), text, str(path))
    file, source = parse(RuleFile, text, str(path)), SourceText(str(path), text)
    others = [(("rule", i), f"rule {rule.id}") for i, rule in enumerate(file.rule)]
    others += [(("habit", i), f"habit {habit.id}") for i, habit in enumerate(file.habit)]
    others += [(("entry", i), entry.id) for i, entry in enumerate(file.entry) if not is_link(entry.id)]
    others += [(("delete", i), f"delete {name}") for i, name in enumerate(file.delete) if not is_link(name)]
    for where, what in others:
        raise source.error(where, f"{what} has no effect: {reader} reads only [[entry]] links.*")


@contextmanager
def emotions_of(path: Path | None, expression: str = FELT, overwhelmed: bool = False) -> Iterator[None]:
    """Let the emotions be as a user's file changes them, felt or posed; raises as `rule_set_of`.

    `overwhelmed`: at full intensity they outdo speech.
    """
    changed = rule_set_of(path).tables.emotions()
    if overwhelmed:
        changed = overwhelming(changed)
    with emotions_in_force(expressed(changed, expression)):
        yield


def extended(rule_set: RuleSet, text: str, name: str) -> RuleSet:
    """Return a set with the rules of TOML `text`, from the file `name`, added.

    A rule with the id of one in the set replaces it, and so does one that names it in `replaces`. Raises
    InputError, with its place, for rules that do not fit the schema, an id given twice, an unknown rule to
    replace or delete, and replacements that go round in a circle.
    """
    source = SourceText(name, text)
    with _emotions_of(text, name):
        file = parse(RuleFile, text, name)
    entries = dict(rule_set.entries)
    for index, prefix in enumerate(file.delete):
        found = [known for known in entries if is_under(known, prefix)]
        found += [known for known in _rules_of_speakers() if is_under(known, prefix)]
        if not found and not deleted_by([prefix]) and not deleted_entries([prefix]):
            raise source.error(("delete", index), unknown("rule", prefix, (*entries, *HABITS)))
        for known in found:
            entries.pop(known, None)
    texts = _rule_texts(text)
    own = {rule.id: RuleEntry(rule, source.place(("rule", i)), texts[i]) for i, rule in enumerate(file.rule)}
    _check_own(file, own, rule_set, source)
    gone = {old for rule in file.rule for old in rule.replaces}
    kept = {key: entry for key, entry in entries.items() if key not in gone}
    entries = FrozenDict({**kept, **{key: entry for key, entry in own.items() if key not in gone}})
    before = rule_set.habits
    habits = HabitChanges((*before.changed, *file.habit), before.deleted | deleted_by(file.delete))
    _check_habits(file, source)
    places = tuple(source.place(("habit", index)) for index in range(len(file.habit)))
    tables = _tables(file, rule_set.tables, source)
    table_places = tuple(source.place(("entry", index)) for index in range(len(file.entry)))
    return RuleSet(
        entries,
        habits,
        (*rule_set.habit_places, *places),
        (*rule_set.gone, *file.delete, *sorted(gone)),
        tables,
        (*rule_set.table_places, *table_places),
    )


def _emotions_of(text: str, name: str) -> AbstractContextManager[None]:
    """Return a context in which a file's own emotions are known to its rules, if its entries are right."""
    known = {"id", "values", "source", "comment"}
    rows = [row for row in read_tables(text, name).get("entry", ()) if isinstance(row, dict)]
    try:
        named = tuple(TableEntry(**row) for row in rows if known >= row.keys() >= {"id", "values", "source"})
        changes = TableChanges(named)
        check(changes)
        return emotions_in_force(changes.emotions())
    except (RisoriusError, AttributeError):
        return nullcontext()  # the strict reader tells what is wrong


def _tables(file: RuleFile, before: TableChanges, source: SourceText) -> TableChanges:
    """Return the changes of tables; raise InputError, with its place, for an entry that does not fit."""
    deleted = before.deleted | deleted_entries(file.delete)
    tables = before
    for index, entry in enumerate(file.entry):
        tables = TableChanges((*tables.changed, entry), deleted)
        try:
            check(tables)
        except RisoriusError as error:
            raise source.error(("entry", index, "values"), f"{entry.id}: {error.message}") from None
    return TableChanges(tables.changed, deleted)


def _check_habits(file: RuleFile, source: SourceText) -> None:
    """Raise InputError, with its place, for a habit whose numbers do not fit."""
    for index, habit in enumerate(file.habit):
        try:
            with_habits(profile(NEUTRAL), HabitChanges((habit,)))
        except RisoriusError as error:
            raise source.error(("habit", index, "numbers"), error.message) from None


def _rule_texts(text: str) -> list[str]:
    """Return each rule's lines, the comments before the next one left out."""
    parts = _RULE.split(text)[1:]
    return ["[[rule]]\n" + _without_comments_after(part) for part in parts]


def _without_comments_after(text: str) -> str:
    """Return text without the comments and blank lines at its end."""
    lines = text.split("\n")
    while len(lines) > 1 and lines[-1].lstrip()[:1] in ("", "#"):
        lines.pop()
    return "\n".join(lines)


def _check_own(file: RuleFile, own: Mapping[str, RuleEntry], rule_set: RuleSet, source: SourceText) -> None:
    seen: set[str] = set()
    for index, rule in enumerate(file.rule):
        path = ("rule", index, "replaces")
        if rule.id in seen:
            raise source.error(("rule", index, "id"), f"rule '{rule.id}' is given twice; expected it once")
        seen.add(rule.id)
        for old in rule.replaces:
            if old not in own and old not in rule_set.entries and old not in _rules_of_speakers():
                raise source.error(path, unknown("rule", old, (*own, *rule_set.entries)))
        _check_speakers(rule, source.place(("rule", index, "when")))
        if circle := _circle(rule.id, own):
            raise source.error(path, f"replacements go round in a circle: {' → '.join(circle)}")


def _check_speakers(rule: Rule, place: Place) -> None:
    """Raise InputError for a condition on an unknown attitude or profile; files of profiles end in .toml."""
    for name in rule.when.attitude:
        if name not in attitudes():
            raise InputError(unknown("attitude", name, attitudes()), place)
    for name in rule.when.profile:
        if name not in profiles():
            raise InputError(unknown("profile", name, profiles()), place)


@cache
def _rules_of_speakers() -> frozenset[str]:
    """Return the ids of the rules in our profiles and attitudes."""
    of_profiles = (rule.id for p in profiles().values() for rule in p.rule)
    return frozenset((*of_profiles, *(rule.id for a in attitudes().values() for rule in a.rule)))


def _circle(start: str, own: Mapping[str, RuleEntry]) -> tuple[str, ...]:
    """Return the replacements that lead from a rule back to itself, nothing if none do."""
    waiting: list[tuple[str, ...]] = [(start,)]
    seen: set[str] = set()
    while waiting:
        trail = waiting.pop()
        for old in own[trail[-1]].rule.replaces if trail[-1] in own else ():
            if old == start:
                return (*trail, start)
            if old not in seen:
                seen.add(old)
                waiting.append((*trail, old))
    return ()
