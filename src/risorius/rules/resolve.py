"""Choose among the events that rules propose: some pause others, and the script comes before all."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ..core.action_units import in_parameters
from .markup import markup_table
from .match import Event
from .modulation import is_under

# Seconds: an event that begins later than another by more is not foreseen, and does not pause it.
_FORESIGHT = 0.6
# Events of one part of the face closer than this would be one movement, seconds.
APART = 0.05


def resolve(
    events: Iterable[Event], taken: Iterable[tuple[float, float, frozenset[str]]] = ()
) -> list[Event]:
    """Return the events that happen, in order.

    Those that another's rule pauses do not; nor, regulators apart, those that move what the script moves at
    the time: `taken` are its spans and parameters. If two start together in one part, the larger stays.
    """
    spans = list(taken)
    found = [e for e in events if not _is_taken(e, spans)]
    pausing = [e for e in found if e.rule.pauses]
    return _apart([e for e in found if not any(_pauses(other, e) for other in pausing)])


def _is_taken(event: Event, taken: Iterable[tuple[float, float, frozenset[str]]]) -> bool:
    return event.rule.channel != "regulators" and any(
        start < event.span.end and event.span.start < end and not event.moves.isdisjoint(names)
        for start, end, names in taken
    )


def _pauses(other: Event, event: Event) -> bool:
    end = min(event.span.end, event.span.start + _FORESIGHT)
    meet = other.span.start < end and event.span.start < other.span.end
    return meet and any(is_under(event.rule.id, prefix) for prefix in other.rule.pauses)


def _apart(events: Sequence[Event]) -> list[Event]:
    kept: dict[tuple[str, str], list[Event]] = {}
    for event in sorted(events, key=lambda e: (e.span.start, e.rule.id)):
        row = kept.setdefault((event.rule.channel, event.rule.part), [])
        if row and event.span.start - row[-1].span.start < APART:
            if _weight(event) > _weight(row[-1]):
                row[-1] = event
        else:
            row.append(event)
    return sorted((e for row in kept.values() for e in row), key=lambda e: (e.span.start, e.rule.id))


def _weight(event: Event) -> float:
    effect = event.rule.effect
    gesture = markup_table().head[effect.gesture].amplitude * effect.size if effect.gesture else 0.0
    return math.fsum(abs(v) for v in in_parameters(event.targets).values()) + event.size * (
        gesture + (effect.blink or 0.0)
    )
