"""The doctor: find valid rules, habits and entries that have no effect, or not the one they state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..core.action_units import resolve_targets
from ..core.antagonists import antagonist_pairs
from ..core.speech.utterance import PauseKind, Question
from ..errors import Place
from .habits import Habit
from .modulation import is_under
from .rule import NOTHING_FELT, Level, Rule
from .rule_set import RuleEntry, RuleSet, shipped
from .tables import TableEntry

DELETED_TOO = "is changed and deleted; expected one of both"


@dataclass(frozen=True, slots=True)
class Finding:
    """A problem of a rule, and where the rule stands."""

    place: Place
    message: str

    def __str__(self) -> str:
        return f"{self.place}: {self.message}"


def examine(rule_set: RuleSet) -> tuple[Finding, ...]:
    """Return the problems of a set of rules and of its changes of habits, in its order."""
    of_rules = (
        Finding(entry.place, f"rule '{entry.rule.id}' {message}")
        for entry in rule_set.entries.values()
        for message in _problems(entry, rule_set)
    )
    changed = rule_set.habits.changed
    of_habits = (
        Finding(place, f"habit '{habit.id}' {message}")
        for index, (habit, place) in enumerate(zip(changed, rule_set.habit_places, strict=True))
        for message in _problems_of_habit(habit, changed[index + 1 :], rule_set)
    )
    entries = rule_set.tables.changed
    of_tables = (
        Finding(place, f"entry '{entry.id}' {message}")
        for index, (entry, place) in enumerate(zip(entries, rule_set.table_places, strict=True))
        for message in _problems_of_entry(entry, entries[index + 1 :], rule_set)
    )
    return (*of_rules, *of_habits, *of_tables)


def _problems_of_entry(entry: TableEntry, later: Sequence[TableEntry], rule_set: RuleSet) -> Iterator[str]:
    """Yield the problems of an entry of a table that others may follow."""
    if any(is_under(entry.id, prefix) for prefix in rule_set.tables.deleted):
        yield DELETED_TOO
    if not entry.values:
        yield "changes nothing: it has no values"
    yield from _problems_of_keys(entry.values, [o.values for o in later if o.id == entry.id], entry.source)


def _problems_of_habit(habit: Habit, later: Sequence[Habit], rule_set: RuleSet) -> Iterator[str]:
    """Yield the problems of new numbers of a habit that others may follow."""
    if habit.id in rule_set.habits.deleted:
        yield DELETED_TOO
    if not habit.numbers:
        yield "changes nothing: it has no numbers"
    yield from _problems_of_keys(habit.numbers, [o.numbers for o in later if o.id == habit.id], habit.source)


def _problems_of_keys(
    values: Mapping[str, object], later: Sequence[Mapping[str, object]], source: str
) -> Iterator[str]:
    """Yield the problems of values by key that `later` ones of the same id may replace."""
    for key in values:
        if any(key in other for other in later):
            yield f"gives '{key}' twice; the last one holds"
    if not source.strip():
        yield "lacks a source"


def _problems(entry: RuleEntry, rule_set: RuleSet) -> Iterator[str]:
    rule = entry.rule
    if rule.probability == 0.0:
        yield "can never fire: its probability is 0"
    yield from _contradictions(rule)
    for prefix in rule.pauses:
        if not any(is_under(name, prefix) for name in (*rule_set.entries, *shipped().entries)):
            yield f"pauses '{prefix}', which is not a rule"
        if is_under(rule.id, prefix):
            yield "pauses itself"
    if rule.effect.look is not None and rule.effect.targets:
        yield "has a look and targets; the look alone goes to the eyes, the targets to its own channel"
    for larger, smaller in antagonist_pairs(resolve_targets(rule.effect.targets)):
        yield f"contracts {smaller} beside its rival {larger}; expected at most 1 of both together"
    if not rule.source.strip() or not rule.comment.strip():
        yield "lacks a source or a comment"
    twins = [r.id for r in rule_set if r.id < rule.id and _same(r, rule)]
    if twins:
        yield f"does what '{twins[0]}' does at the same time"


def _contradictions(rule: Rule) -> Iterator[str]:
    """Yield why no unit can meet all conditions of a rule."""
    when = rule.when
    kinds, questions = set(when.pause), set(when.question)
    if when.nuclear and not when.accent:
        yield 'asks for a nuclear accent without naming accents; expected accent = ["any"] as well'
    if rule.level is Level.PAUSE and kinds and PauseKind.QUESTION not in kinds and _asks(questions):
        yield "can never fire: a question is followed by a pause of the kind question"
    if when.intensity > 0.0 and set(when.emotion) == {NOTHING_FELT}:
        yield "can never fire: when nothing is felt there is no intensity"
    if when.words and all(word != word.lower() for word in when.words):
        yield "can never fire: words are compared in lower case"
    if rule.level is not Level.PAUSE and kinds == {PauseKind.INITIAL}:
        yield "can never fire: nothing is said before the initial pause"
    if set(when.stress) == {-1} and rule.level is not Level.PHONEME:
        yield "can never fire: only consonants have a stress of -1"


def _asks(questions: set[Question]) -> bool:
    return bool(questions) and Question.NONE not in questions


def _same(one: Rule, other: Rule) -> bool:
    """Tell whether two rules move the same part on the same units at the same time."""
    keys = [(r.channel, r.part, r.level, r.when, r.timing.at, r.timing.lead) for r in (one, other)]
    return keys[0] == keys[1] and set(one.effect.targets) == set(other.effect.targets) != set()
