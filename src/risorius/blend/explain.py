"""Why a parameter has its value: the winner and its cause, each loser and the reason.

Nothing is stored per frame: an explanation is computed on demand, from the same ledger as the curves.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..core.arrays import Array
from ..core.lips.lip_rig import LipRig
from ..core.movement import LipSegment, Movement
from ..core.parameters import INDEX, NEUTRAL, PARAMETERS
from ..core.score import Score
from ..errors import InputError, ParameterError, unknown
from .channels import Channel
from .concatenate import SIGNED
from .conflict import Suppressor
from .curve import Curve, Origin
from .explanation import Contribution, Explanation
from .ledger import LedgerEntry
from .manual import replaced_values
from .mouth.contact import CONTACTS, SEAL, TUCK
from .mouth.limits import LIPS
from .mouth.lips import CompiledLips
from .mouth.speech_mouth import JAW
from .plan import Plan, PlanSample
from .rounding import SmoothingWindow

_LEAST = 1e-9
# The share of its range by which rounding must change a parameter to be worth a note.
_SEEN = 0.002
# Seconds around a closure in which it is the closure that brings the lips together.
_NEARBY = 0.2


def explain(source: Score | Plan, time: float, parameter: str) -> Explanation:
    """Return why a parameter has its value at a time in seconds; the value is the curve's own.

    `parameter` is a name of the table, with its side. Pass a Plan to explain many times of one score. Raises
    ParameterError for an unknown name and InputError for a time outside the score.
    """
    plan = source if isinstance(source, Plan) else Plan(source)
    if parameter not in INDEX:
        raise ParameterError(unknown("parameter", parameter, INDEX))
    if not 0.0 <= time <= plan.score.duration:
        raise InputError(f"time = {time} s is outside the score; expected 0 to {plan.score.duration:g} s")
    sample = PlanSample(plan, np.array([time]))
    value = float(sample.value(parameter)[0])
    contributions = _contributions(sample, parameter)
    if not contributions and value != NEUTRAL[INDEX[parameter]]:
        contributions = _contributions(_origin_of_rounded(sample, parameter), parameter)
    winner = contributions[0] if contributions and abs(contributions[0].applied) > _LEAST else None
    losers = tuple(_lost(c, winner, plan.adds(parameter)) for c in contributions if c is not winner)
    notes = tuple(_notes(sample, parameter, value)) if contributions else ()
    return Explanation(time, parameter, value, winner, losers, notes)


def _contributions(sample: PlanSample, name: str) -> list[Contribution]:
    """Return the contributions to a parameter, the largest applied one first."""
    moving = _turning(sample, name) if name in SIGNED else _moving(sample, name)
    return sorted([*_goals(sample, name), *moving], key=lambda c: -abs(c.applied))


def _origin_of_rounded(sample: PlanSample, name: str) -> PlanSample:
    """Return the moment near by that moves a parameter most: by rounding it shows in `sample`, too."""
    near = SmoothingWindow(sample.times, sample.plan.rounding.width(name), sample.plan.score.duration).times
    offsets = PlanSample(sample.plan, near).joined(name) - NEUTRAL[INDEX[name]]
    return PlanSample(sample.plan, near[[int(np.abs(offsets).argmax())]])


def _lost(loser: Contribution, winner: Contribution | None, adds: bool) -> Contribution:
    """Return a loser with its reason: the winner, unless it has one already."""
    if loser.reason or winner is None:
        return loser
    if adds or loser.on_top:
        reason = "added" if adds else f"on top of {winner.what} ({winner.channel})"
        return replace(loser, reason=reason, added=adds)
    below = "below" if winner.on_top else "lower than"
    return replace(loser, reason=f"{below} {winner.what} ({winner.channel})")


def _moving(sample: PlanSample, name: str) -> Iterator[Contribution]:
    """Yield all that moves a muscle, a contact or the tongue."""
    ledger = sample.ledger(name)
    for channel in ledger.channels:
        for curve in channel.curves[name]:
            entry = ledger.curve_entry(channel, curve)
            if abs(_only(entry.requested)) <= _LEAST:
                yield from _replaced(sample, channel, curve)
                continue
            origin, reason = _origin(sample, channel, curve), _reason(sample, name, entry)
            requested, applied = _only(entry.requested), _only(entry.applied)
            yield replace(origin, requested=requested, applied=applied, reason=reason)


def _turning(sample: PlanSample, name: str) -> Iterator[Contribution]:
    """Yield all that turns the head or the eyes."""
    for entry in sample.direction_entries(name):
        requested, applied = float(entry.requested[0]), float(entry.applied[0])
        if abs(requested) > _LEAST:
            smaller = "added, made smaller by the others" if abs(applied) < abs(requested) - _LEAST else ""
            origin = _origin(sample, entry.channel, entry.curve)
            yield replace(origin, requested=requested, applied=applied, reason=smaller, added=True)
        yield from _replaced(sample, entry.channel, entry.curve)


def _replaced(sample: PlanSample, channel: Channel, curve: Curve) -> Iterator[Contribution]:
    """Yield the requests of a curve while a curve drawn by hand replaces it."""
    requested = float(replaced_values(curve, sample.times)[0])
    if abs(requested) > _LEAST:
        origin = _origin(sample, channel, curve)
        yield replace(origin, requested=requested, reason="replaced by the curve drawn by hand")


def _goals(sample: PlanSample, name: str) -> list[Contribution]:
    """Return the effect of the contact goals on a contact."""
    lips, time = sample.plan.lips, float(sample.times[0])
    if name not in CONTACTS or lips is None:
        return []
    rig = lips.mouth.shapes.rig
    if name == SEAL and rig is not None:
        return _seal(sample, lips, rig)
    return [
        replace(
            _contribution(LIPS, lips.mouth.segments[goal.segment]),
            requested=goal.value,
            applied=float(goal.at(time)),
        )
        for goal in lips.goals[name].goals
        if goal.start - goal.ramp_in < time < goal.end + goal.ramp_out
    ]


def _seal(sample: PlanSample, lips: CompiledLips, rig: LipRig) -> list[Contribution]:
    """Return the cause that closes the gap beyond the seal that the segments target.

    That is a closure nearby, or else the segment whose lips other channels would part too far.
    """
    times, time = sample.times, float(sample.times[0])
    targeted = sample.rounded(SEAL, PlanSample.speech)
    seal = float(lips.mouth.approach.sealed(targeted, times, sample.mouth_gaps(rig))[0])
    if seal <= targeted[0] + _LEAST:
        return []
    segments = lips.mouth.segments
    distance = {g.segment: max(g.start - time, time - g.end, 0.0) for g in lips.goals[SEAL].goals}
    number = min(distance, key=lambda n: distance[n], default=0)
    if distance.get(number, np.inf) > _NEARBY:
        number = next((n for n, s in enumerate(segments) if s.start <= time < s.end), len(segments) - 1)
    return [replace(_contribution(LIPS, segments[number]), requested=seal, applied=seal)]


def _reason(sample: PlanSample, name: str, entry: LedgerEntry) -> str:
    """Say which stages of the ledger left less than the stage before, and why."""
    plan, time = sample.plan, float(sample.times[0])
    resolved, shared = _only(entry.resolved), _only(entry.shared)
    reasons = []
    if resolved < _only(entry.requested) - _LEAST:
        suppressor = plan.policy.suppressor(entry.channel, name, time)
        if suppressor is not None:
            reasons.append(_because(plan, suppressor))
    if shared < resolved - _LEAST:
        reasons.append("adds only a share to the jaw of speech")
    if _only(entry.applied) < shared - _LEAST and plan.lips is not None:
        mouth = plan.lips.mouth
        segment = mouth.segments[mouth.block_at(time).limiting(name, time)]
        reasons.append(f"limited by {_contribution(LIPS, segment).what}")
    return "; ".join(reasons)


def _because(plan: Plan, suppressor: Suppressor) -> str:
    """Return the effect of a rival in words, with the rival's cause."""
    channel = next(
        c for c in plan.channels if c.name == suppressor.channel and suppressor.parameter in c.curves
    )
    sample = PlanSample(plan, np.array([suppressor.time]))
    requested = {
        _origin(sample, channel, curve).what: _only(curve.sample(sample.times)[1])
        for curve in channel.curves[suppressor.parameter]
    }
    strongest = max(requested, key=lambda what: requested[what])
    return f"{suppressor.effect} {suppressor.parameter} of {strongest} ({suppressor.channel})"


def _only(values: Array) -> float:
    """Return the value at the only time; 0 without a value, because the curve is then at rest."""
    return float(values[0]) if len(values) else 0.0


def _origin(sample: PlanSample, channel: Channel, curve: Curve) -> Contribution:
    return _contribution(channel.name, curve.origin(float(sample.times[0])))


def _contribution(channel: str, origin: Origin) -> Contribution:
    """Return the contribution of a movement, a segment or a drawn curve, still without values."""
    if isinstance(origin, Movement):
        return Contribution(channel, origin.layer, origin.label, origin.cause, 0.0, 0.0, on_top=origin.on_top)
    if isinstance(origin, LipSegment):
        label = f"/{origin.phone}/" if origin.phone else "silence"
        return Contribution(channel, "", label, origin.cause, 0.0, 0.0)
    return Contribution(channel, "", "drawn by hand", origin.cause, 0.0, 0.0)


def _notes(sample: PlanSample, name: str, value: float) -> Iterator[str]:
    """Yield the effects of the last steps on the joined value."""
    lips, times = sample.plan.lips, sample.times
    parameter, rounded = PARAMETERS[INDEX[name]], sample.rounded(name)[0]
    if abs(rounded - sample.joined(name)[0]) > _SEEN * (parameter.high - parameter.low):
        yield f"rounded over {1000.0 * sample.plan.rounding.width(name):g} ms"
    if lips is None or name in SIGNED:
        return
    mouth = lips.mouth
    if name == JAW and sample.joined(name)[0] >= mouth.jaw_at_seal(times)[0] - _LEAST:
        yield "held by the seal of the lips"
    seal = float(lips.goals[SEAL].at(times)[0])
    if name == TUCK and seal > _LEAST and value >= 1.0 - seal - _LEAST:
        yield "pushed aside by the seal of the lips"
    if name in mouth.limited and value > 0.0 and value <= mouth.low_at(name, times)[0] + _LEAST:
        yield "held up by the lips' lower limit"
