"""Find the times at which the curves of two plans can differ: the changes, and their reach."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from ..core.performance import Performance
from .channels import Channel
from .curve import Curve
from .intervals import Extent
from .knots import STEEPEST
from .plan import Plan

TimeSpan = tuple[float, float]


def recombine(
    plan: Plan, fps: Fraction, before: Plan | None = None, earlier: Performance | None = None
) -> Performance:
    """Return the plan's performance; reuse the parts of `earlier` (made from the plan `before`) that did not
    change.
    """
    if before is not None and earlier is not None and earlier.fps == fps:
        span = changed_span(before, plan)
        if span is not None:
            return plan.performance_like(earlier, span)
    return plan.performance(fps)


def changed_span(before: Plan, after: Plan) -> TimeSpan | None:
    """Return the times in seconds outside which both plans have the same curves, to the last bit.

    (0, 0) if nothing changed. None if the span is unknown: speech, settings, the clip's length or a channel's
    priority differ.
    """
    a, b = before.score, after.score
    if after.lips is not before.lips or a.settings != b.settings or a.duration != b.duration:
        return None
    channels = [{c.key: c for c in plan.channels} for plan in (before, after)]
    spans: list[TimeSpan] = []
    for name in channels[0].keys() | channels[1].keys():
        one, two = (by_name.get(name) for by_name in channels)
        if one is not None and two is not None and not one.levels.equal(two.levels):
            return None
        spans += _spans(one, two)
    if not spans:
        return 0.0, 0.0
    reach = _reach(before, after)
    return min(start for start, _ in spans) - reach, max(end for _, end in spans) + reach


def _spans(one: Channel | None, two: Channel | None) -> Iterator[TimeSpan]:
    """Yield the start and end of every part of a curve that only one of the two channels has."""
    for name in {name for channel in (one, two) if channel is not None for name in channel.curves}:
        if one is not None and two is not None and _shared(one.curves.get(name), two.curves.get(name)):
            continue
        before, after = (_extents(channel, name) for channel in (one, two))
        for start, end, _ in before ^ after:
            yield start, end


def _shared(one: Sequence[Curve] | None, two: Sequence[Curve] | None) -> bool:
    """Tell whether two plans have the very same curves."""
    if one is None or two is None or len(one) != len(two):
        return False
    return all(a is b for a, b in zip(one, two, strict=True))


def _extents(channel: Channel | None, name: str) -> frozenset[Extent]:
    curves = () if channel is None else channel.curves.get(name, ())
    return frozenset(extent for curve in curves for extent in curve.extents())


def _reach(before: Plan, after: Plan) -> float:
    """Return how many seconds a change of one channel has an effect on others, from level to level."""
    levels = {level for plan in (before, after) for c in plan.channels for level in c.levels.distinct}
    return STEEPEST * after.tuning.longest * (len(levels) + 2) + after.score.settings.rounding
