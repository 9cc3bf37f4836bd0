"""The request `rules_fired`: which rules fired in a take, and when."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

from ..core.movement import Movement
from ..core.progress import Progress
from ..core.score import Score
from ..rules.profiles import attitude, profile_of
from ..rules.rule_set import rule_set_of
from ..rules.speakers import rules_of_speaker
from .session.session import Session
from .wire.shared import Whole


@dataclass(frozen=True, slots=True)
class RulesFired:
    """Ask which rules fired and when; answered by FiredRules."""

    take: Whole


@dataclass(frozen=True, slots=True)
class FiredRule:
    """A rule, its comment, the ids of its blocks and the start of each."""

    rule: str
    comment: str
    blocks: tuple[str, ...]
    times: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class FiredRules:
    """The rules that fired in a take, in order of their ids."""

    rules: tuple[FiredRule, ...]


def rules_fired(session: Session, request: RulesFired, progress: Progress) -> FiredRules:
    """Return the rules that fired in a take."""
    live = session.live(request.take)
    settings = live.take.settings
    attitudes = [attitude(name) for name in settings.attitudes]
    rule_set = rules_of_speaker(rule_set_of(settings.rules), profile_of(settings.profile), attitudes)
    rules = []
    for rule, movements in sorted(_by_rule(live.take.score).items()):
        comment = rule_set.entries[rule].rule.comment if rule in rule_set.entries else ""
        times = tuple(m.start for m in movements)
        rules.append(FiredRule(rule, comment, tuple(m.id for m in movements), times))
    return FiredRules(tuple(rules))


def _by_rule(score: Score) -> dict[str, list[Movement]]:
    by_rule = defaultdict(list)
    for movement in score.movements:
        by_rule[movement.cause.rule].append(movement)
    return by_rule
