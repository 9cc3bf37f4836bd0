"""Requests that do not change the take: explanations, channels, saved poses and profiles."""

from __future__ import annotations

from collections.abc import Iterable

from ...blend import Contribution, Explanation, Trace
from ...blend.narrate import narrate
from ...core.action_units import resolve_targets
from ...core.parameters import INDEX, PARAMETERS
from ...core.progress import Progress
from ...rules.tuned import tuned_text
from ...take import Take
from ..wire import answers, requests
from .describe import packed
from .session import Session


def explain(session: Session, request: requests.Explain, progress: Progress) -> answers.Explanations:
    """Explain the values of parameters at a time."""
    take = session.live(request.take).take
    explanations = take.explain(request.time, request.parameter)
    ids = {m.id for m in take.score.movements}
    reasons = tuple(_reason(e, ids) for e in explanations)
    return answers.Explanations(request.time, reasons, tuple(narrate(explanations, request.time)))


def _reason(e: Explanation, ids: set[str]) -> answers.Reason:
    winner = None if e.winner is None else _part(e.winner, ids)
    losers = tuple(_part(part, ids) for part in e.losers)
    return answers.Reason(e.parameter, e.value, PARAMETERS[INDEX[e.parameter]].unit, winner, losers, e.notes)


def _part(part: Contribution, ids: set[str]) -> answers.ContributionView:
    cause = part.cause
    block = part.label if part.label in ids else ""
    return answers.ContributionView(
        part.channel, part.what, cause.rule, cause.place, part.requested, part.applied, part.reason, block
    )


def channel_curves(
    session: Session, request: requests.ChannelCurves, progress: Progress
) -> answers.ParameterDetail:
    """Return each channel's request for a parameter, and the part applied."""
    take = session.live(request.take).take
    return answers.ParameterDetail(
        request.parameter, tuple(_channel(trace, take) for trace in take.traces(request.parameter))
    )


def _channel(trace: Trace, take: Take) -> answers.ChannelCurve:
    times, step = take.times, float(1 / take.performance.fps)

    def spans(runs: Iterable[tuple[int, int]]) -> tuple[tuple[float, float], ...]:
        """Return the start and end of each run; a frame lasts until the next one."""
        return tuple((float(times[first]), float(times[last]) + step) for first, last in runs)

    requested, applied = packed(trace.requested), packed(trace.applied)
    return answers.ChannelCurve(
        trace.channel, requested, applied, spans(trace.inhibited), spans(trace.limited)
    )


def profile_text(session: Session, request: requests.ProfileText, progress: Progress) -> answers.ProfileFile:
    """Return a profile with changed numbers as a file; unchanged under its own name if none changed."""
    return answers.ProfileFile(request.name, tuned_text(request.base, request.name, request.numbers))


def save_pose(session: Session, request: requests.SavePose, progress: Progress) -> answers.PoseFile:
    """Save a face under a name, and return it as a file for the command line."""
    session.forget_prefetch()
    if request.kind == "emotion":
        text = session.files.save_emotion(request.name, request.values)
        return answers.PoseFile(request.name, f"{request.name}.toml", text)
    session.files.save_pose(request.name, request.values)
    words = [f"{name}={value:g}" for name, value in resolve_targets(request.values).items() if value]
    return answers.PoseFile(
        request.name, f"{request.name}.txt", f"risorius pose {' '.join(words)} -o face.png\n"
    )
