"""The rules of a speaker: individuality and attitude choose the type and the timing of what is shown.

Paper B, section 3.2.1: type and time of occurrence define an action, and a speaker is a set of both. A
profile and an attitude may hold rules and delete some; a rule may also name, in its conditions, who it is
for. A user's file of rules has the last word.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..errors import InputError, Place, unknown
from ..reading.frozen import FrozenDict
from .modulation import is_under
from .profiles import Attitude, Profile
from .rule_set import RuleEntry, RuleSet, shipped


def rules_of_speaker(rule_set: RuleSet, profile: Profile, attitudes: Sequence[Attitude]) -> RuleSet:
    """Return the rules that hold for a speaker, those of profile and attitudes among them.

    Of rules with the same id that of the user's file holds, then that of the last attitude, of the profile,
    and ours. Raises InputError for a rule of theirs that replaces or deletes an unknown one.
    """
    everyone: tuple[Profile | Attitude, ...] = (profile, *attitudes)
    speakers = [s for s in everyone if s.rule or s.delete]
    entries = dict(rule_set.entries)
    for speaker in speakers:
        _add(entries, speaker, rule_set)
    names = [attitude.name for attitude in attitudes]
    kept = {key: e for key, e in entries.items() if e.rule.when.suits(profile.name, names)}
    return (
        rule_set
        if not speakers and len(kept) == len(entries)
        else replace(rule_set, entries=FrozenDict(kept))
    )


def _add(entries: dict[str, RuleEntry], speaker: Profile | Attitude, rule_set: RuleSet) -> None:
    """Add the rules of a profile or an attitude, and take away what they replace and delete."""
    place = Place(speaker.name)
    gone = [*speaker.delete, *(old for rule in speaker.rule for old in rule.replaces)]
    for name in gone:
        if not any(is_under(known, name) for known in (*rule_set.entries, *shipped().entries, *entries)):
            raise InputError(unknown("rule", name, rule_set.entries), place)
        for known in [k for k in entries if is_under(k, name) and not _is_users(k, rule_set)]:
            del entries[known]
    for rule in speaker.rule:
        if not _is_users(rule.id, rule_set):
            text = f"# a rule of '{speaker.name}'"
            entries[rule.id] = RuleEntry(rule, place, text)


def _is_users(name: str, rule_set: RuleSet) -> bool:
    """Tell whether the user's file has a word on a rule: it changes, replaces or deletes it."""
    if any(is_under(name, prefix) for prefix in rule_set.gone):
        return True
    entry = rule_set.entries.get(name)
    return entry is not None and entry is not shipped().entries.get(name)
