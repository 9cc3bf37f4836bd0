"""The matcher: rules × units → events. Rules propose; `resolve` decides which of rival events happen."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from ..core.action_units import in_parameters, kept_units, unit_weights
from ..core.counter_rng import CounterRng
from ..core.parameters import INDEX, PARAMETERS, parameters_named
from ..core.time import TICK
from ..reading.frozen import FrozenDict
from .emotions import emotion, emotion_key
from .markup import markup_table
from .modulation import Modulation, rate_of, size_of
from .rule import ANY, NOTHING_FELT, Level, Rule, RuleAnchor, When
from .rule_span import RuleSpan
from .rule_spans import RuleSpans
from .stillness import StillTime, begun_in_speech, between_pauses
from .synchrony import MovementPhases, lasting, snapped, synchrony

LIDS = tuple(p.name for p in parameters_named("orbicularis_oculi_palpebralis"))
EYES = ("gaze_pitch", "gaze_yaw")
SIDED = ("head_yaw", "head_roll", "gaze_yaw")
# Seconds after the clip's end until gestures held to the end are released: later than any frame.
_BEYOND = 0.1
# No event is smaller than this share of its rule's size.
_SMALLEST = 0.3


@dataclass(frozen=True, slots=True)
class Event:
    """The event that a rule makes of a unit. `targets`: its own, scaled; `size`: how far its gesture goes."""

    rule: Rule
    unit: RuleSpan
    span: MovementPhases
    targets: Mapping[str, float]
    size: float

    @property
    def moves(self) -> frozenset[str]:
        """The parameters that it moves."""
        effect = self.rule.effect
        names = set(in_parameters(self.targets))
        if effect.gesture is not None:
            names.add(markup_table().head[effect.gesture].parameter)
        if effect.look is not None:
            names.update(EYES)
        if effect.blink is not None:
            names.update(LIDS)
        return frozenset(names)


Condition = Callable[[RuleSpan], object]
"""Returns of a unit what is true if it meets one condition."""


def events_of(
    rules: Iterable[Rule],
    units: RuleSpans,
    numbers: CounterRng,
    *,
    modulations: Sequence[Modulation] = (),
    side: float = 0.0,
) -> list[Event]:
    """Return all events that rules propose, in order of time and id.

    The numbers of an event are counted by its rule and unit: what another rule, an emotion, a profile or
    further text changes leaves the other events as they are. `side`: how much the speaker prefers the left,
    -1 to 1.
    """
    found = [e for rule in rules for e in _matched(rule, units, numbers.under(rule.id), modulations, side)]
    return sorted(found, key=lambda e: (e.span.start, e.rule.id))


def _matched(
    rule: Rule, units: RuleSpans, numbers: CounterRng, modulations: Sequence[Modulation], side: float
) -> Iterator[Event]:
    rate = rate_of(rule.id, modulations)
    fitting: Iterable[RuleSpan] = units.of(rule.level)
    for condition in conditions(rule.when):
        fitting = filter(condition, fitting)
    for unit in fitting:
        if _is_displayed(rule, unit):
            continue
        felt = felt_modulations(unit.emotions)
        ways = (*modulations, *felt)
        chance = rule.probability * (rate_of(rule.id, ways) if felt else rate)
        if chance < 1.0 and numbers.uniform(unit.phrase, unit.number, "chance") >= chance:
            continue
        own = numbers.under(unit.phrase, unit.number)
        alike = numbers.under("group", unit.group) if rule.effect.grouped else own
        size = size_of(rule.id, ways) * _varied(rule.effect.vary, alike)
        mirrored = rule.effect.mirror and alike.uniform("side") >= 0.5 * (1.0 + side)
        span = _span(rule, unit, own)
        yield _event(rule, unit, units, span, size, mirrored=mirrored)


def _is_displayed(rule: Rule, unit: RuleSpan) -> bool:
    """Tell whether a rule's emblem is of an emotion that the face displays already."""
    emblem = rule.effect.emblem
    return emblem is not None and unit.emotions.get(emotion_key(emblem), 0.0) > 0.0


def _varied(deviation: float, numbers: CounterRng) -> float:
    """Return a random factor on an event's size, 1 if it does not vary."""
    if deviation == 0.0:
        return 1.0
    return max(_SMALLEST, numbers.normal("size", mean=1.0, deviation=deviation, limit=2.0))


def felt_modulations(felt: Mapping[str, float]) -> tuple[Modulation, ...]:
    """Return how emotions with their intensities modulate the rules."""
    return tuple(emotion(name).modulation.at(intensity) for name, intensity in felt.items())


@lru_cache(maxsize=1024)
def conditions(when: When) -> tuple[Condition, ...]:
    """Return functions that tell whether a unit meets a rule, one for each condition of the rule."""
    words = frozenset(when.words)
    each: list[tuple[object, Condition]] = [
        (when.accent, lambda u: u.accents and _labelled(when.accent, [a.label for a in u.accents])),
        (when.nuclear is not None, lambda u: when.nuclear == any(a.nuclear for a in u.accents)),
        (when.boundary, lambda u: u.boundary and _labelled(when.boundary, [u.boundary])),
        (when.pause, lambda u: u.pause in when.pause),
        (when.question, lambda u: u.question in when.question),
        (when.stress, lambda u: u.stress in when.stress),
        (when.position, lambda u: u.position in when.position),
        (when.phones, lambda u: u.phone in when.phones),
        (words, lambda u: not u.words.isdisjoint(words)),
        (when.rate, lambda u: _within(when.rate, u.rate)),
        (when.lasting, lambda u: _within(when.lasting, u.end - u.start)),
        (when.turn, lambda u: u.turn in when.turn),
        (when.information, lambda u: u.information in when.information),
        (when.intensity or when.emotion, lambda u: _felt(when, u.emotions)),
    ]
    return tuple(condition for wanted, condition in each if wanted)


def _labelled(wanted: Sequence[str], found: Sequence[str]) -> bool:
    return ANY in wanted or any(label in wanted for label in found)


def _within(limits: tuple[float, float] | None, value: float) -> bool:
    return limits is None or limits[0] <= value <= limits[1]


def _felt(when: When, felt: Mapping[str, float]) -> bool:
    strongest = max(felt, key=lambda name: (felt[name], name), default=NOTHING_FELT)
    if when.intensity and felt.get(strongest, 0.0) < when.intensity:
        return False
    return not when.emotion or strongest in {_canonical(name) for name in when.emotion}


def _canonical(name: str) -> str:
    return name if name == NOTHING_FELT else emotion_key(name)


def _event(
    rule: Rule, unit: RuleSpan, units: RuleSpans, span: MovementPhases, size: float, *, mirrored: bool
) -> Event:
    if not rule.effect.grouped:
        size *= synchrony().size_at(unit.rate)
    targets = _targets(rule, size, mirrored)
    pauses: Sequence[StillTime] = units.pauses if rule.moves_head_in_speech else ()
    if rule.moves_head_in_speech:
        span = begun_in_speech(span, rule.timing.lead, pauses)
    if targets:
        span = between_pauses(span, pauses, unit.end if rule.timing.at is RuleAnchor.WHOLE else None)
    if rule.timing.snap:
        span = snapped(span, units.boundaries, [pause.start for pause in pauses])
    if rule.timing.at is RuleAnchor.WHOLE:
        span = lasting(span, rule.timing.shortest, units.boundaries)
    duration = units.situation.duration
    if rule.timing.at is RuleAnchor.WHOLE and rule.level is Level.PAUSE and unit.end > duration - TICK:
        return Event(rule, unit, _until_the_end(span, duration), targets, size)
    return Event(rule, unit, _inside(span, duration), targets, size)


def _until_the_end(span: MovementPhases, duration: float) -> MovementPhases:
    """Return a span that begins in the clip and is released after its end."""
    span = _inside(span, duration)
    return MovementPhases(span.start, min(span.apex, duration), duration + _BEYOND, duration + 2.0 * _BEYOND)


def _targets(rule: Rule, size: float, mirrored: bool) -> dict[str, float]:
    targets = {}
    effect = rule.effect
    given = dict(_kept(tuple(effect.targets.items())))
    if effect.emblem is not None:
        size = min(size * effect.size, 1.0)
        given |= emotion(effect.emblem).emblem_units(1.0)
    for name, value in given.items():
        sign = -1.0 if mirrored and name in SIDED else 1.0
        low, high = (0.0, 1.0) if unit_weights(name) else _range(name)
        targets[name] = min(max(sign * size * value, low), high)
    return targets


@lru_cache(maxsize=1024)
def _kept(targets: tuple[tuple[str, float], ...]) -> Mapping[str, float]:
    """Return `kept_units` of a rule's targets, which are the same for all its units."""
    return FrozenDict(kept_units(dict(targets)))


def _range(parameter: str) -> tuple[float, float]:
    return PARAMETERS[INDEX[parameter]].low, PARAMETERS[INDEX[parameter]].high


def _span(rule: Rule, unit: RuleSpan, numbers: CounterRng) -> MovementPhases:
    timing = rule.timing
    tempo = synchrony().duration_at(unit.rate)
    onset, offset = timing.onset * tempo, timing.offset * tempo
    start = _anchored(timing.at, unit, numbers) - timing.lead
    if timing.at is RuleAnchor.AROUND:
        return _around(unit, onset, offset)
    if timing.at is RuleAnchor.WHOLE:
        end = max(unit.end, start + timing.shortest)
        scale = min(1.0, (end - start) / max(onset + offset, 1e-9))
        return MovementPhases(start, start + scale * onset, end - scale * offset, end)
    hold_end = unit.end if timing.apex is None else start + onset + timing.apex * tempo
    release = max(hold_end, start + onset)
    return MovementPhases(start, start + onset, release, release + offset)


def _around(unit: RuleSpan, onset: float, offset: float) -> MovementPhases:
    """Return a span that is held through a pause; it takes the words around it, or longer, to come and go."""
    floor, word_start = unit.before or (0.0, unit.start)
    word_end, ceiling = unit.after or (unit.end, unit.end)
    start = min(word_start, max(unit.start - onset, floor))
    return MovementPhases(start, unit.start, unit.end, max(word_end, min(unit.end + offset, ceiling)))


def _anchored(at: RuleAnchor, unit: RuleSpan, numbers: CounterRng) -> float:
    """Return the time of an anchor; one within the unit is drawn from the event's `numbers`."""
    if at is RuleAnchor.ANYWHERE:
        return unit.start + numbers.uniform("place") * (unit.end - unit.start)
    if at is RuleAnchor.ACCENT and unit.accented is not None:
        return unit.accented
    return {RuleAnchor.MIDDLE: unit.middle, RuleAnchor.END: unit.end}.get(at, unit.start)


def _inside(span: MovementPhases, duration: float) -> MovementPhases:
    """Return a span that starts at 0 at the earliest and before the end of the clip."""
    moved = max(-span.start, 0.0)
    start, apex, release, end = (t + moved for t in (span.start, span.apex, span.release, span.end))
    return MovementPhases(start, apex, release, min(end, max(duration, start + 1e-3)))
