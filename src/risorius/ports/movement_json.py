"""One entry of a score's `movements`: an ordinary movement, a lip segment or hand-drawn curves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..core.action_units import resolve_targets
from ..core.articulators import ARTICULATORS, check_lip_target
from ..core.channels import CHANNELS
from ..core.functions import DEFAULT_FUNCTION, ONSET_FUNCTIONS
from ..core.movement import (
    Cause,
    Dominance,
    LipSegment,
    ManualCurve,
    Movement,
    check_movement,
    check_span,
    check_target,
)
from ..core.parameters import parameters_named
from ..errors import ParameterError, unknown
from .node import Node
from .records import from_record, to_record

Entry = Movement | LipSegment | ManualCurve
Json = dict[str, Any]

_MOVEMENT_REQUIRED = ("channel", "start", "end", "onset", "offset", "targets")
_MOVEMENT_KEYS = (
    "id", "channel", "layer", "start", "end", "onset", "offset",
    "priority", "release_priority", "function", "targets", "cause",
)  # fmt: skip
_LIPS_REQUIRED = ("channel", "phone", "start", "end", "targets")
_LIPS_KEYS = (*_LIPS_REQUIRED, "limits", "dominance", "yields", "cause")
_LIP_NAMES = {"*", *ARTICULATORS}
_MANUAL_REQUIRED = ("channel", "keys")
_MANUAL_KEYS = (*_MANUAL_REQUIRED, "replaces", "cause")


def entry_to_json(entry: Entry) -> Json:
    """Return a movement, lip segment or manual curve as an object; what has its default is left out."""
    if isinstance(entry, Movement):
        return _movement_to_json(entry)
    if isinstance(entry, LipSegment):
        return _lips_to_json(entry)
    keys = {name: [list(key) for key in keys] for name, keys in entry.keys.items()}
    replaces = {"replaces": True} if entry.replaces else {}
    return {"channel": "manual", "keys": keys} | replaces | _cause_to_json(entry.cause)


def entry_from_json(node: Node) -> Entry:
    """Return what an object describes: with `phone` a lip segment, with `keys` a manual curve.

    Targets may be action units, aliases and names without side. Raises InputError with the place.
    """
    members = node.members()
    channel = members.get("channel")
    if channel is not None and channel.text() not in CHANNELS:
        raise ParameterError(f"{channel.path}: {unknown('channel', channel.text(), CHANNELS)}")
    name = None if channel is None else channel.value
    if name == "lips" and ("phone" in members or "onset" not in members):
        return _lips_from_json(node)
    if name == "manual" and ("keys" in members or "onset" not in members):
        return _manual_from_json(node)
    return _movement_from_json(node)


def _movement_to_json(m: Movement) -> Json:
    optional: Json = {
        "priority": m.priority,
        "release_priority": m.release_priority,
        "function": None if m.function == DEFAULT_FUNCTION else m.function,
    }
    return {
        **({"id": m.id} if m.id else {}),
        "channel": m.channel,
        **({"layer": m.layer} if m.layer else {}),
        "start": m.start,
        "end": m.end,
        "onset": m.onset,
        "offset": m.offset,
        **{name: value for name, value in optional.items() if value is not None},
        "targets": dict(m.targets),
        **_cause_to_json(m.cause),
    }


def _movement_from_json(node: Node) -> Movement:
    entries = node.entries(_MOVEMENT_KEYS, _MOVEMENT_REQUIRED)
    known: Json = {
        "channel": entries["channel"].text(),
        "targets": _targets(entries["targets"]),
        "cause": _cause(entries),
    }
    for name in ("start", "end", "onset", "offset"):
        known[name] = entries[name].number(low=0.0)
    for name in ("priority", "release_priority"):
        if name in entries and entries[name].value is not None:
            known[name] = entries[name].number()
    for name in ("id", "layer", "function"):
        if name in entries:
            known[name] = entries[name].text()
    if "function" in entries:
        with entries["function"].located():
            ONSET_FUNCTIONS.get(known["function"])
    movement = Movement(**known)
    with node.located():
        check_movement(movement)
    return movement


def _lips_to_json(segment: LipSegment) -> Json:
    limits = {name: list(pair) for name, pair in segment.limits.items()}
    dominance = {name: to_record(value) for name, value in segment.dominance.items()}
    return {
        "channel": "lips",
        "phone": segment.phone,
        "start": segment.start,
        "end": segment.end,
        "targets": dict(segment.targets),
        **({"limits": limits} if limits else {}),
        **({"dominance": dominance} if dominance else {}),
        **({"yields": dict(segment.yields)} if segment.yields else {}),
        **_cause_to_json(segment.cause),
    }


def _lips_from_json(node: Node) -> LipSegment:
    entries = node.entries(_LIPS_KEYS, _LIPS_REQUIRED)
    phone, start, end = entries["phone"].text(), entries["start"].number(low=0.0), entries["end"].number()
    with node.located():
        check_span(f"phone {phone or 'silence'}", start, end)
    limits = entries.get("limits", Node({})).members()
    dominance = entries.get("dominance", Node({})).members()
    held = {name: from_record(Dominance, dominance.pop(name)) for name in _LIP_NAMES & dominance.keys()}
    return LipSegment(
        phone,
        start,
        end,
        _lip_targets(entries["targets"]),
        {name: _limit(name, pair) for name, pair in _by_parameter(limits).items()},
        held | {name: from_record(Dominance, value) for name, value in _by_parameter(dominance).items()},
        _cause(entries),
        _yields(entries),
    )


def _yields(entries: Mapping[str, Node]) -> dict[str, float]:
    members = entries.get("yields", Node({})).members()
    found = {name: members.pop(name).number(low=0.0) for name in sorted(_LIP_NAMES & members.keys())}
    return found | {name: node.number(low=0.0) for name, node in _by_parameter(members).items()}


def _lip_targets(node: Node) -> dict[str, float]:
    """Return targets that are articulators, in mm, as they stand; others as those of a movement."""
    members = node.members()
    found = {name: members.pop(name).number() for name in ARTICULATORS if name in members}
    with node.located():
        for name, value in found.items():
            check_lip_target(name, value)
    others = Node({name: value.value for name, value in members.items()}, node.path)
    return found | _targets(others)


def _limit(parameter: str, node: Node) -> tuple[float, float]:
    low, high = (item.number() for item in node.items(2))
    with node.located():
        check_target(parameter, low)
        check_target(parameter, high)
    if low > high:
        raise node.fault(f"the limits are reversed: {low:g} > {high:g}")
    return low, high


def _manual_from_json(node: Node) -> ManualCurve:
    entries = node.entries(_MANUAL_KEYS, _MANUAL_REQUIRED)
    curves = _by_parameter(entries["keys"].members())
    keys = {name: _keys(name, curve) for name, curve in curves.items()}
    return ManualCurve(keys, _cause(entries), "replaces" in entries and entries["replaces"].flag())


def _keys(parameter: str, node: Node) -> tuple[tuple[float, float], ...]:
    keys: list[tuple[float, float]] = []
    for item in node.items():
        time, value = (part.number() for part in item.items(2))
        if keys and time <= keys[-1][0]:
            raise item.fault(f"time {time:g} does not come after {keys[-1][0]:g}")
        with item.located():
            check_target(parameter, value)
        keys.append((time, value))
    if not keys:
        raise node.fault("there are no keys; expected [[time, value], …]")
    return tuple(keys)


def _targets(node: Node) -> dict[str, float]:
    values = {name: value.number() for name, value in node.members().items()}
    with node.located():
        return resolve_targets(values)


def _by_parameter(members: Mapping[str, Node]) -> dict[str, Node]:
    """Replace aliases and names without side by the parameters that they mean."""
    found: dict[str, Node] = {}
    for name, node in members.items():
        with node.located():
            parameters = parameters_named(name)
        for parameter in parameters:
            if parameter.name in found:
                raise node.fault(f"{parameter.name} is given twice")
            found[parameter.name] = node
    return found


def _cause(entries: Mapping[str, Node]) -> Cause:
    return from_record(Cause, entries["cause"]) if "cause" in entries else Cause()


def _cause_to_json(cause: Cause) -> Json:
    record = to_record(cause)
    return {"cause": record} if record else {}
