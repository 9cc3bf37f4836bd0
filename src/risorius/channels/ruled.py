"""Movements of rules: events become movements, beside the marks of the script."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from ..core.channels import channel_timing
from ..core.movement import Cause, Movement
from ..rules.gestures import timed_parts
from ..rules.markup import markup_table
from ..rules.match import Event
from ..rules.resolve import APART
from ..rules.stillness import StillTime, next_pause
from .blinks import blink, blink_depth
from .inputs import ChannelInputs, Context

# While the head moves the eyes stay on what they look at: the vestibulo-ocular reflex, of gain 1.
_COUNTER = {"head_pitch": "gaze_pitch", "head_yaw": "gaze_yaw"}


def with_eyes(targets: Mapping[str, float]) -> dict[str, float]:
    """Return targets of the head with the eyes turned against them, so that gaze stays where it is."""
    # A difference, because scores do not keep the sign of -0.0.
    counter = {_COUNTER[name]: 0.0 - value for name, value in targets.items() if name in _COUNTER}
    return {**targets, **counter}


def marked_and_ruled(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the movements that the script marks on a channel, then those of its rules: all that many do."""
    yield from inputs.marked(context.name)
    yield from movements_of_rules(inputs, context)


def movements_of_rules(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the movements of a channel's events; looks are left to the gaze."""
    boundaries = inputs.units.boundaries
    prefix = context.name + "."
    events = [event for event in context.events if event.rule.id.startswith(prefix)]
    blinks: set[tuple[str, float]] = set()
    for event, following in zip(events, _following_gestures(events), strict=True):
        if event.targets:
            yield _held(event)
        if event.rule.effect.gesture is not None:
            yield from _gesture(event, following, inputs.units.pauses)
        if event.rule.effect.blink is not None:
            own = context.numbers.under(event.rule.id, event.unit.phrase, event.unit.number)
            depth = event.rule.effect.blink * blink_depth(inputs.profile.blinks, own)
            closing = blink(
                context.name,
                event.span.start,
                depth,
                inputs.profile.blinks,
                boundaries,
                _cause(event),
                _layer(event),
            )
            # Two that begin with the same phoneme are one.
            if (closing.layer, closing.start) not in blinks:
                blinks.add((closing.layer, closing.start))
                yield closing


def _cause(event: Event) -> Cause:
    return Cause(event.rule.id, event.unit.text)


def _layer(event: Event) -> str:
    """A blink beside other targets has a layer of its own."""
    return f"{event.rule.part}.lids" if event.targets else event.rule.part


def _held(event: Event) -> Movement:
    span, rule = event.span, event.rule
    return Movement(
        rule.channel,
        span.start,
        span.end,
        span.apex - span.start,
        max(span.end - span.release, 0.0),
        with_eyes(event.targets),
        id=f"{rule.id}@{span.start:.3f}",
        layer=rule.part,
        function=rule.timing.function or channel_timing(rule.channel).function,
        cause=_cause(event),
        on_top=rule.effect.on_top,
    )


def _following_gestures(events: Sequence[Event]) -> list[float]:
    """Return for each event when the next gesture of the same part begins, infinity after the last."""
    starts: dict[str, float] = {}
    following = []
    for event in reversed(events):
        following.append(starts.get(event.rule.part, math.inf))
        if event.rule.effect.gesture is not None:
            starts[event.rule.part] = event.span.start
    return following[::-1]


def _gesture(event: Event, until: float, pauses: Sequence[StillTime]) -> Iterator[Movement]:
    """Yield a gesture's parts up to the time at which another gesture takes over."""
    rule = event.rule
    gesture = markup_table().head[str(rule.effect.gesture)]
    amplitude = gesture.amplitude * rule.effect.size * event.size
    begun = event.span.start
    parts = timed_parts(gesture, rule.effect.times, *next_pause(begun, pauses))
    for number, part in enumerate(parts, 1):
        if begun + part.start > until - APART:
            return
        yield Movement(
            rule.channel,
            begun + part.start,
            begun + part.end,
            part.onset,
            part.offset,
            with_eyes({gesture.parameter: part.scale * amplitude}),
            id=f"{rule.id}@{begun:.3f}.{number}",
            layer=f"{rule.part}.gesture",
            function=rule.timing.function or "minimum_jerk",
            cause=_cause(event),
        )
