"""Gaze: where the eyes go, and how eyes and head share the way.

Looks come from the script, from rules (regulators, pointing) and from the habit of looking away now and then;
between them the eyes scan the listener's face (paper B, section 5.2). Every shift is a saccade on the main
sequence; the head follows a large one by Freedman's law while the eyes counter-rotate.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core.movement import Cause, Movement
from ..rules.conduct import rate_of
from ..rules.markup import markup_table
from ..rules.match import Event
from ..rules.profiles import Aversion
from ..rules.rule import AWAY, TurnState
from .eye_head import Angles, GazeShift, head_help, shifts_of
from .registry import CHANNEL_BUILDERS, Brief
from .ruled import movements_of_rules

AVERSION, SCAN, REST = "gaze.aversion.habit", "gaze.scan.face", "gaze.rest.listener"
LISTENER: Angles = (0.0, 0.0)
# A look shorter than this is not begun, seconds.
_SHORTEST = 0.3
# Seconds from one fixation to the next at least (Lee, Badler and Badler 2002: 50 to 100 ms between saccades).
_REFRACTORY = 0.15
# How far a look up or down strays sideways, and one aside up or down: degrees.
_STRAY = 2.5


@dataclass(frozen=True, slots=True)
class Look:
    """A direction held over [start, end) seconds; `fixed`: the script's, which the eyes do not scan."""

    start: float
    end: float
    direction: Angles
    cause: Cause
    fixed: bool = False


@CHANNEL_BUILDERS.register("gaze")
def gaze(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
    """Yield the marked gaze with the head's share of it, and the fixations of the clip, one after another."""
    marked = brief.marked("gaze")
    yield from marked
    yield from (helped for m in marked if (helped := head_help(m)) is not None)
    yield from movements_of_rules(brief, "gaze")
    if not brief.lively:
        return
    # While listening the eyes are as free as else: only who is looked at is marked.
    asked = [m for m in marked if (m.start, m.end) not in brief.listening]
    looks = [Look(m.start, m.end, LISTENER, m.cause, fixed=True) for m in asked]
    looks = _averted(brief, _commanded(brief, _apart(looks), rng), rng)
    shifts = list(_fixations(brief, looks, rng))
    yield from shifts_of(shifts, brief.duration, brief.profile.blinks, brief.units.boundaries, rng)


def _apart(looks: Sequence[Look]) -> list[Look]:
    """Return looks in order, each ended where the next begins."""
    ordered = sorted(looks, key=lambda k: k.start)
    ends = [*(k.start for k in ordered[1:]), math.inf][: len(ordered)]
    return [replace(k, end=min(k.end, end)) for k, end in zip(ordered, ends, strict=True) if k.start < end]


def _commanded(brief: Brief, marked: Sequence[Look], rng: np.random.Generator) -> list[Look]:
    """Return the marked looks, and those of rules where they do not stand against them, one after another."""
    looks = list(marked)
    asked = [e for e in brief.events if e.rule.effect.look is not None]
    for event in sorted(asked, key=lambda e: (e.rule.channel != "gaze", -e.span.start, e.rule.id)):
        direction = _aimed(event, brief, rng)
        end = min([event.span.end, *(k.start for k in looks if k.end > event.span.start)])
        if end - event.span.start >= _SHORTEST:
            looks.append(Look(event.span.start, end, direction, Cause(event.rule.id, event.unit.text)))
    return sorted(looks, key=lambda k: k.start)


def _aimed(event: Event, brief: Brief, rng: np.random.Generator) -> Angles:
    name = str(event.rule.effect.look)
    if name == AWAY:
        return _away(brief, rng)
    found = markup_table().gaze[name]
    scale = event.rule.effect.size
    return scale * found.pitch, scale * found.yaw


def _away(brief: Brief, rng: np.random.Generator) -> Angles:
    """Draw a direction away from the listener."""
    habits = brief.profile.gaze
    names = sorted(habits.directions)
    weights = np.array([habits.directions[n] for n in names])
    way = names[int(rng.choice(len(names), p=weights / weights.sum()))]
    stray = float(rng.normal(0.0, _STRAY))
    if way == "side":
        sign = 1.0 if rng.random() < 0.5 * (1.0 + brief.profile.side) else -1.0
        return stray, sign * _size(habits.yaw, rng)
    return (1.0 if way == "up" else -1.0) * _size(habits.pitch, rng), 2.0 * stray


def _size(normal: tuple[float, float], rng: np.random.Generator) -> float:
    mean, sd = normal
    return float(np.clip(rng.normal(mean, sd), mean - 2.0 * sd, mean + 2.0 * sd))


def _averted(brief: Brief, looks: Sequence[Look], rng: np.random.Generator) -> list[Look]:
    """Return the looks, and among them those away that regulate intimacy (Andrist et al. 2013)."""
    found = list(looks)
    time = float(rng.uniform(0.0, 1.0)) * _aversion(brief, 0.0).gap[0]
    while time < brief.duration:
        habit = _aversion(brief, time)
        end = time + _size(habit.length, rng)
        direction = _away(brief, rng)
        rival = next((k for k in looks if k.start < end + _SHORTEST and time < k.end + _SHORTEST), None)
        if rival is None and end < brief.duration:
            found.append(Look(time, end, direction, Cause(AVERSION, "habit")))
        last = end if rival is None else rival.end
        if rival is not None and rival.direction == LISTENER:
            time = last + _SHORTEST
            continue
        often = max(rate_of(AVERSION, brief.conduct_at(last)), 1e-3)
        time = last + max(_size(habit.gap, rng), _SHORTEST) / often
    return sorted(found, key=lambda k: k.start)


def _aversion(brief: Brief, time: float) -> Aversion:
    speaking = brief.situation.turn_at(time) is TurnState.SPEAKING and brief.utterance is not None
    return brief.profile.gaze.speaking if speaking else brief.profile.gaze.listening


def _fixations(brief: Brief, looks: Sequence[Look], rng: np.random.Generator) -> Iterator[GazeShift]:
    """Yield the shifts of gaze in order: to each look, back, and about what is looked at meanwhile."""
    time = 0.0
    for look in looks:
        yield from _scan(brief, time, look.start, LISTENER, rng)
        yield GazeShift(look.start, look.direction, look.cause)
        if not look.fixed:
            yield from _scan(brief, look.start, look.end, look.direction, rng)
        time = look.end
        if time < brief.duration:
            yield GazeShift(time, LISTENER, Cause(REST, "the listener"))
    yield from _scan(brief, time, brief.duration, LISTENER, rng)


def _scan(
    brief: Brief, start: float, end: float, centre: Angles, rng: np.random.Generator
) -> Iterator[GazeShift]:
    """Yield saccades about a direction, at random times in (start, end)."""
    habits = brief.profile.gaze
    time = start + _fixation(habits.scan, rng)
    while time + _REFRACTORY < end:
        point = (
            centre[0] + float(np.clip(rng.standard_normal(), -2.0, 2.0)) * habits.scan_pitch,
            centre[1] + float(np.clip(rng.standard_normal(), -2.0, 2.0)) * habits.scan_yaw,
        )
        yield GazeShift(time, point, Cause(SCAN, "the listener's face" if centre == LISTENER else "looking"))
        time += _fixation(habits.scan, rng)


def _fixation(mean: float, rng: np.random.Generator) -> float:
    """Return seconds of a fixation: none shorter than the eyes' refractory time, few much longer."""
    return _REFRACTORY + float(rng.gamma(2.0, 0.5 * max(mean - _REFRACTORY, 0.05)))
