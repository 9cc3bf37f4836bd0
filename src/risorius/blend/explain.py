"""Why a parameter has its value: the winner and its cause, each loser and the reason.

Nothing is stored per frame: an explanation is worked out on demand, from the same plan as the curves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core.lip_rig import LipRig
from ..core.movement import Cause, LipSegment, Movement
from ..core.parameters import INDEX
from ..core.score import Score
from ..errors import InputError, ParameterError, unknown
from .channels import Channel
from .concatenate import SIGNED
from .conflict import Suppressor
from .contact import CONTACTS, SEAL, TUCK
from .curve import Curve, Origin
from .directions import shares_of
from .limits import LIPS
from .lips import CompiledLips
from .manual import hidden
from .mouth import JAW
from .plan import Moment, Plan

_LEAST = 1e-9
# Seconds about a closure in which it is what brings the lips together.
_NEARBY = 0.2
_FIRST = np.zeros(1, dtype=np.intp)


@dataclass(frozen=True, slots=True)
class Contribution:
    """What one movement, segment or drawn curve asks of a parameter at a time, and what it gets.

    `label` names it, `cause` says why it exists. `requested` and `applied` are deviations from the
    parameter's neutral. `reason`: why it gets less than it asks, or does not show; "" if neither.
    """

    channel: str
    layer: str
    label: str
    cause: Cause
    requested: float
    applied: float
    reason: str = ""

    @property
    def what(self) -> str:
        """What it goes back to, for a sentence: the phone and word, or the mark, or its own name."""
        return self.cause.trigger or self.label


@dataclass(frozen=True, slots=True)
class Explanation:
    """A parameter's value at a time: the part that wins (None at rest), the others, and the last steps."""

    time: float
    parameter: str
    value: float
    winner: Contribution | None
    losers: tuple[Contribution, ...]
    notes: tuple[str, ...]


def explain(source: Score | Plan, time: float, parameter: str) -> Explanation:
    """Return why a parameter has its value at a time in seconds; the value is the curve's own.

    `parameter` is a name of the table, with its side. Pass a Plan to explain many moments of one score.
    Raises ParameterError for an unknown name and InputError for a time outside the score.
    """
    plan = source if isinstance(source, Plan) else Plan(source)
    if parameter not in INDEX:
        raise ParameterError(unknown("parameter", parameter, INDEX))
    if not 0.0 <= time <= plan.score.duration:
        raise InputError(f"time = {time} s is outside the score; expected 0 to {plan.score.duration:g} s")
    value = float(Moment(plan, np.array([time])).value(parameter)[0])
    contributions = _directed(plan, time, parameter) if parameter in SIGNED else _parts(plan, time, parameter)
    goal = _goal(plan, time, parameter)
    contributions = sorted([*goal, *contributions], key=lambda p: -abs(p.applied))
    winner = contributions[0] if contributions and abs(contributions[0].applied) > _LEAST else None
    losers = tuple(_lost(p, winner, plan.adds(parameter)) for p in contributions if p is not winner)
    notes = tuple(_notes(plan, time, parameter, value)) if contributions else ()
    return Explanation(time, parameter, value, winner, losers, notes)


def _lost(contribution: Contribution, winner: Contribution | None, adds: bool) -> Contribution:
    if contribution.reason or winner is None:
        return contribution
    return replace(contribution, reason="added" if adds else f"lower than {winner.what} ({winner.channel})")


def _parts(plan: Plan, time: float, name: str) -> list[Contribution]:
    """All that moves a muscle, contact or the tongue at a time."""
    moment = Moment(plan, np.array([time]))
    own = moment.own(name)
    found: list[Contribution] = []
    for channel in plan.channels:
        for curve in channel.curves.get(name, ()):
            requested = _value(curve, time)
            if abs(requested) <= _LEAST:
                found.extend(_replaced(channel, curve, time))
                continue
            kept = moment.resolve(channel, name, moment.times, np.array([requested]))
            shared = limited = kept
            if channel.name != LIPS:
                shared = moment.shared(channel, name, _FIRST, kept, own)
                limited = moment.limited(channel, name, _FIRST, shared, own)
            levels = (requested, float(kept[0]), float(shared[0]), float(limited[0]))
            contribution = _contribution(channel.name, curve.origin(time))
            reason = _reason(plan, channel, name, time, levels)
            found.append(replace(contribution, requested=requested, applied=levels[-1], reason=reason))
    return found


def _directed(plan: Plan, time: float, name: str) -> list[Contribution]:
    """All that turns the head or the eyes at a time."""
    terms = Moment(plan, np.array([time])).terms(name)
    shares = shares_of(name, [term for _, term in terms])
    found = []
    for ((channel, curve), term), share in zip(terms, shares, strict=True):
        requested, applied = float(term[0]), float(share[0])
        if abs(requested) > _LEAST:
            smaller = "added, made smaller by the others" if abs(applied) < abs(requested) - _LEAST else ""
            contribution = _contribution(channel.name, curve.origin(time))
            found.append(replace(contribution, requested=requested, applied=applied, reason=smaller))
        found.extend(_replaced(channel, curve, time))
    return found


def _replaced(channel: Channel, curve: Curve, time: float) -> Iterator[Contribution]:
    """What asks for something where a curve drawn by hand stands in its place."""
    requested = float(hidden(curve, np.array([time]))[0])
    if abs(requested) > _LEAST:
        contribution = _contribution(channel.name, curve.origin(time))
        yield replace(contribution, requested=requested, reason="replaced by the curve drawn by hand")


def _goal(plan: Plan, time: float, name: str) -> list[Contribution]:
    if name not in CONTACTS or plan.lips is None:
        return []
    rig = plan.lips.mouth.shapes.rig
    if name == SEAL and rig is not None:
        return _seal(plan, plan.lips, rig, time)
    found = []
    for goal in plan.lips.goals[name].goals:
        if goal.start - goal.ramp_in < time < goal.end + goal.ramp_out:
            contribution = _contribution(LIPS, plan.lips.mouth.segments[goal.segment])
            found.append(replace(contribution, requested=goal.value, applied=float(goal.at(time))))
    return found


def _seal(plan: Plan, lips: CompiledLips, rig: LipRig, time: float) -> list[Contribution]:
    """What the seal takes of the gap beyond what the segments ask for.

    That is the closure nearby, or else the segment that others would part further than it wants.
    """
    own, seal = (float(values[0]) for values in Moment(plan, np.array([time])).sealed(lips, rig))
    if seal <= own + _LEAST:
        return []
    segments = lips.mouth.segments
    near = {g.segment: max(g.start - time, time - g.end, 0.0) for g in lips.goals[SEAL].goals}
    number = min(near, key=lambda n: near[n], default=0)
    if near.get(number, np.inf) > _NEARBY:
        number = next((n for n, s in enumerate(segments) if s.start <= time < s.end), len(segments) - 1)
    return [replace(_contribution(LIPS, segments[number]), requested=seal, applied=seal)]


def _reason(plan: Plan, channel: Channel, name: str, time: float, levels: Sequence[float]) -> str:
    """Why less is left after the policy, the jaw's sharing and the lips' limits than was asked."""
    requested, kept, shared, limited = levels
    reasons = []
    if kept < requested - _LEAST:
        suppressor = plan.policy.suppressor(channel, name, time)
        if suppressor is not None:
            reasons.append(_because(plan, suppressor))
    if shared < kept - _LEAST:
        reasons.append("adds only a share to the jaw of speech")
    if limited < shared - _LEAST and plan.lips is not None:
        mouth = plan.lips.mouth
        segment = mouth.segments[mouth.block_at(time).limiting(name, time)]
        reasons.append(f"limited by {_contribution(LIPS, segment).what}")
    return "; ".join(reasons)


def _because(plan: Plan, suppressor: Suppressor) -> str:
    """Say what a rival does, and what caused the rival."""
    channel = next(c for c in plan.channels if c.name == suppressor.channel)
    requested = {
        _contribution(channel.name, curve.origin(suppressor.time)).what: _value(curve, suppressor.time)
        for curve in channel.curves[suppressor.parameter]
    }
    what = max(requested, key=lambda found: requested[found])
    return f"{suppressor.effect} {suppressor.parameter} of {what} ({suppressor.channel})"


def _value(curve: Curve, time: float) -> float:
    _, values = curve.sample(np.array([time]))
    return float(values[0]) if len(values) else 0.0


def _contribution(channel: str, origin: Origin) -> Contribution:
    """A movement, segment or drawn curve as a part, yet without values."""
    if isinstance(origin, Movement):
        return Contribution(channel, origin.layer, origin.label, origin.cause, 0.0, 0.0)
    if isinstance(origin, LipSegment):
        label = f"/{origin.phone}/" if origin.phone else "silence"
        return Contribution(channel, "", label, origin.cause, 0.0, 0.0)
    return Contribution(channel, "", "drawn by hand", origin.cause, 0.0, 0.0)


def _notes(plan: Plan, time: float, name: str, value: float) -> Iterator[str]:
    """What the last steps did to the joined value."""
    if plan.lips is None or name in SIGNED:
        return
    mouth, at = plan.lips.mouth, np.array([time])
    if name == JAW and value >= mouth.jaw_at_seal(at)[0] - _LEAST:
        yield "held by the seal of the lips"
    seal = float(plan.lips.goals[SEAL].at(at)[0])
    if name == TUCK and seal > _LEAST and value >= 1.0 - seal - _LEAST:
        yield "pushed aside by the seal of the lips"
    if name in mouth.limited and value > 0.0 and value <= mouth.low_at(name, at)[0] + _LEAST:
        yield "held up by the lips' lower limit"
