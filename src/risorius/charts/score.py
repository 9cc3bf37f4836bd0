"""Any score as paper A's Figures 5 and 6 show one: each parameter before and after the two stages."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from .. import blend
from ..core.arrays import Array, BoolArray
from ..core.channels import CHANNELS
from ..core.movement import Movement
from ..core.parameters import INDEX, NAMES, PARAMETERS, RIVALS, parameters_named
from ..core.score import Score
from ..errors import InputError
from ..pipeline import combine
from ..take import Take
from .sheet import SHOWN, SOFT, ChartColour, ChartLine, ChartRow, ChartSheet, Panel

MOST_ROWS = 6
_FINEST, _MOST_FRAMES = 200, 4000
_MOST_ALONE = 8
"""Movements of a parameter up to which each is drawn by itself, too."""
_LONGEST_BESIDE = 8.0
"""Seconds up to which what was before and after stand side by side."""
_LEAST = 1e-3
_COLOURS: tuple[ChartColour, ...] = (
    (226, 150, 40), (91, 111, 181), (209, 73, 91), (122, 92, 160),
    (70, 150, 84), (160, 96, 76), (96, 128, 148), (190, 110, 160),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Activity:
    """A parameter at `times` (n,): each channel's request, and what is shown; deviations from its neutral.

    `both_sides`: whether the other side moves alike and has no row of its own.
    """

    name: str
    times: Array
    requested: Mapping[str, Array]
    shown: Array
    both_sides: bool = False

    @property
    def changed(self) -> float:
        """By how much what is shown differs from what most is requested, on average."""
        return float(np.abs(self.shown - self.most).mean()) / self.span

    @property
    def most(self) -> Array:
        """The largest of the requests at each time; of directions, which add up, their sum."""
        requests = np.stack(list(self.requested.values()))
        return np.asarray(requests.sum(axis=0) if self.span > 1.0 else requests.max(axis=0))

    @property
    def span(self) -> float:
        """The size of a usual full movement, in the parameter's unit."""
        parameter = PARAMETERS[INDEX[self.name]]
        return 1.0 if not parameter.unit else min(parameter.high, 10.0)

    @property
    def moved(self) -> float:
        """How far it moves, on average."""
        return float(np.abs(self.most).mean()) / self.span


def score_sheet(
    take: Take, title: str, names: Sequence[str], start: float | None, end: float | None
) -> ChartSheet:
    """Return a row for each parameter of `names`, or for those that the combination changes most.

    `start`, `end`: the seconds that are shown. Raises ParameterError for an unknown name, InputError if the
    span is empty or nothing moves in it.
    """
    first, last = start or 0.0, take.duration if end is None else min(end, take.duration)
    if not first < last:
        raise InputError(
            f"from {first:g} to {last:g} s is not a span; expected one within {take.duration:g} s"
        )
    fine = combine(take.score, replace(take.settings, fps=_rate(take.duration)), take.utterance)
    within = (fine.times >= first) & (fine.times <= last)
    wanted = [p.name for name in names for p in parameters_named(name)] or NAMES
    _check_moving(fine, names, within, f"from {first:g} to {last:g} s")
    found = [_activity(fine, name, within) for name in dict.fromkeys(wanted)]
    chosen = _one_of_two([activity for activity in found if activity is not None])
    if not chosen:
        raise InputError(f"nothing moves from {first:g} to {last:g} s; expected movements to draw")
    if not names:
        chosen = sorted(chosen, key=lambda a: (-round(a.changed, 3), -a.moved))[:MOST_ROWS]
    rows = [_row(fine, activity, first, last) for activity in chosen]
    return ChartSheet(title, tuple(row for whole in rows for row in _with_room(whole)))


def _check_moving(take: Take, names: Sequence[str], within: BoolArray, when: str) -> None:
    """Raise InputError for a named parameter that does not move, on either side."""
    for name in names:
        if all(_activity(take, p.name, within) is None for p in parameters_named(name)):
            raise InputError(f"{name} does not move {when}; expected a parameter that does")


def _rate(duration: float) -> Fraction:
    return Fraction(max(min(_FINEST, int(_MOST_FRAMES / max(duration, 1e-3))), 15))


def _activity(take: Take, name: str, within: BoolArray) -> Activity | None:
    """Return a parameter within a span of a take's times; None if nothing moves it there."""
    traced = {t.channel: t.requested[within] for t in take.traces(name)}
    moving = {channel: requested for channel, requested in traced.items() if _moves(requested)}
    shown = take.curves[name][within] - PARAMETERS[INDEX[name]].neutral
    return Activity(name, take.times[within], moving, shown) if moving else None


def _moves(values: Array) -> bool:
    return bool(np.abs(values).max(initial=0.0) > _LEAST)


def _one_of_two(activities: Sequence[Activity]) -> list[Activity]:
    """Return activities without right sides that move as the left ones do, which stand for both."""
    by_name = {activity.name: activity for activity in activities}
    kept = []
    for activity in activities:
        base, _, side = activity.name.partition(".")
        left, right = by_name.get(f"{base}.left"), by_name.get(f"{base}.right")
        alike = left is not None and right is not None and not _moves(left.shown - right.shown)
        if not alike or side != "right":
            kept.append(replace(activity, both_sides=alike))
    return kept


def _row(take: Take, activity: Activity, first: float, last: float) -> ChartRow:
    channels = [_channel_line(c, activity.times, v) for c, v in activity.requested.items()]
    rivals = _rival_lines(take, activity)
    shown = ChartLine("as shown", activity.times, activity.shown, SHOWN, 2.8)
    alone = _alone(take.score, activity)
    before = Panel("before: the movements of each channel, combined", (*rivals, *alone, *channels))
    faint = tuple(replace(line, width=1.2, dashed=True) for line in channels)
    after = Panel("after: the channels, combined", (*rivals, *faint, shown))
    values = np.concatenate([line.values for line in (*before.lines, *after.lines)])
    unit = PARAMETERS[INDEX[activity.name]].unit
    low, high = min(float(values.min()), 0.0), max(float(values.max()), _LEAST if unit else 1.0)
    base = activity.name.partition(".")[0]
    title = f"{base} (both sides)" if activity.both_sides else activity.name
    return ChartRow(title, (before, after), first, last, low, high, unit or "activity", take.utterance)


def _with_room(row: ChartRow) -> list[ChartRow]:
    """Return a row, or one for each of its panels if they are too narrow for their span side by side."""
    if row.end - row.start <= _LONGEST_BESIDE:
        return [row]
    return [replace(row, panels=(panel,)) for panel in row.panels]


def _channel_line(channel: str, times: Array, values: Array) -> ChartLine:
    colour = _COLOURS[CHANNELS.names().index(channel) % len(_COLOURS)]
    return ChartLine(channel, times, values, colour, 2.4)


def _alone(score: Score, activity: Activity) -> list[ChartLine]:
    """Return a line of each movement by itself in channels that have a few."""
    name, times = activity.name, activity.times
    moving = [m for m in score.movements if name in m.parameters and m.channel in activity.requested]
    count = Counter(m.channel for m in moving)
    moving = [m for m in moving if count[m.channel] > 1]
    if len(moving) > _MOST_ALONE:
        return []
    neutral = PARAMETERS[INDEX[name]].neutral
    curves = [_values_of(score, m, times, name) - neutral for m in moving]
    return [
        ChartLine("each movement by itself", times, curve, SOFT, 1.3, dashed=True)
        for curve in curves
        if _moves(curve)
    ]


def _values_of(score: Score, movement: Movement, times: Array, name: str) -> Array:
    alone = replace(score, movements=(movement,), lips=(), manual=())
    return blend.at(alone, times)[:, INDEX[name]]


def _rival_lines(take: Take, activity: Activity) -> list[ChartLine]:
    """Return the rival that takes most from a parameter, if one takes anything."""
    within = np.searchsorted(take.times, activity.times)
    lost = np.maximum(np.abs(activity.most) - np.abs(activity.shown), 0.0)
    rivals = [(float(take.curves[rival][within] @ lost), rival) for rival in sorted(RIVALS[activity.name])]
    taken, rival = max(rivals, default=(0.0, ""))
    if taken <= _LEAST:
        return []
    values = take.curves[rival][within]
    return [ChartLine(f"its rival {rival}", activity.times, values, SOFT, 1.0, filled=True)]
