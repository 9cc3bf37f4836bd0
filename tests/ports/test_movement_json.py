import json
from typing import Any

import pytest

from risorius.core.movement import Dominance, LipSegment, ManualCurve, Movement
from risorius.errors import InputError
from risorius.ports.movement_json import entry_from_json, entry_to_json
from risorius.ports.node import Node

SMILE: dict[str, Any] = {
    "channel": "emotion",
    "start": 0.0,
    "end": 1.0,
    "onset": 0.2,
    "offset": 0.3,
    "targets": {"zygomatic_major.left": 1.0},
}
CLOSURE: dict[str, Any] = {
    "channel": "lips",
    "phone": "M",
    "start": 0.0,
    "end": 0.1,
    "targets": {"lip_seal": 1.0},
}
HAND: dict[str, Any] = {"channel": "manual", "keys": {"masseter": [[0, 0], [1, 0.5]]}}


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ({}, "m: 'channel' is missing"),
        (SMILE | {"channel": "emotoin"}, "m.channel: unknown channel 'emotoin'; did you mean 'emotion'?"),
        (SMILE | {"onset": -1}, "m.onset: -1 is out of range; expected 0 or more"),
        (SMILE | {"start": -1}, "m.start: -1 is out of range; expected 0 or more"),
        (SMILE | {"end": 0}, "m: 'emotion@0': end = 0.0 must come after start = 0.0"),
        (SMILE | {"ofset": 1}, "m.ofset: unknown key 'ofset'; did you mean 'offset'?"),
        (SMILE | {"phone": "M"}, "m.phone: unknown key 'phone'"),
        (
            SMILE | {"function": "lineer"},
            "m.function: unknown onset function 'lineer'; did you mean 'linear'?",
        ),
        (SMILE | {"targets": {"AU12.left": 2}}, "m.targets: AU12.left = 2.0 is out of range"),
        (SMILE | {"targets": {"AU34": 1}}, "m.targets: AU34 (cheek puff) cannot be shown by the 35 muscles"),
        (SMILE | {"targets": {"masseter": [1]}}, "m.targets.masseter: expected a number, found a list of 1"),
        (SMILE | {"cause": {"rul": "x"}}, "m.cause.rul: unknown key 'rul'; did you mean 'rule'?"),
        (SMILE | {"priority": "high"}, 'm.priority: expected a number, found "high"'),
        (CLOSURE | {"end": -1}, "m: 'phone M': end = -1.0 must come after start = 0.0"),
        (CLOSURE | {"onset": 1}, "m.onset: unknown key 'onset'"),
        ({"channel": "lips"}, "m: 'phone' is missing"),
        (CLOSURE | {"limits": {"masseter": [1, 0]}}, "m.limits.masseter: the limits are reversed: 1 > 0"),
        (
            CLOSURE | {"limits": {"masseter": [0]}},
            "m.limits.masseter: expected a list of 2, found a list of 1",
        ),
        (CLOSURE | {"limits": {"masseter": [0, 2]}}, "m.limits.masseter: masseter = 2.0 is out of range"),
        (
            CLOSURE | {"limits": {"jaw": [0, 1], "masseter": [0, 1]}},
            "m.limits.masseter: masseter is given twice",
        ),
        (CLOSURE | {"dominance": {"*": {"after": "x"}}}, 'm.dominance.*.after: expected a number, found "x"'),
        ({"channel": "manual"}, "m: 'keys' is missing"),
        (
            HAND | {"keys": {"masseter": []}},
            "m.keys.masseter: there are no keys; expected [[time, value], …]",
        ),
        (HAND | {"keys": {"masseter": [[1, 0], [1, 1]]}}, "m.keys.masseter[1]: time 1 does not come after 1"),
        (HAND | {"keys": {"masseter": [[0, 3]]}}, "m.keys.masseter[0]: masseter = 3.0 is out of range"),
        (
            HAND | {"keys": {"masset": [[0, 0]]}},
            "m.keys.masset: unknown muscle or parameter 'masset'; did you",
        ),
    ],
)
def test_a_faulty_entry_is_refused_with_its_path(entry: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as caught:
        entry_from_json(Node(entry, "m"))
    assert str(caught.value).startswith(message)


def test_a_name_without_side_means_both_and_units_become_muscles() -> None:
    targets = {"AU12": 0.5, "jaw_open": 0.25}
    movement = entry_from_json(Node(SMILE | {"targets": targets}))
    assert isinstance(movement, Movement)
    assert movement.targets == {"zygomatic_major.left": 0.5, "zygomatic_major.right": 0.5, "masseter": 0.25}


def test_lips_take_aliases_in_limits_and_dominance() -> None:
    more = {
        "limits": {"risorius": [0, 0.5]},
        "dominance": {"jaw_open": {"magnitude": 2}, "*": {"after": 0.1}},
    }
    segment = entry_from_json(Node(CLOSURE | more))
    assert isinstance(segment, LipSegment)
    assert segment.limits == {"risorius.left": (0.0, 0.5), "risorius.right": (0.0, 0.5)}
    assert segment.dominance == {"*": Dominance(after=0.1), "masseter": Dominance(magnitude=2.0)}


def test_hand_drawn_curves_may_name_both_sides() -> None:
    curve = entry_from_json(Node({"channel": "manual", "keys": {"mentalis": [[0, 0.5], [1, 1]]}}))
    keys = ((0.0, 0.5), (1.0, 1.0))
    assert curve == ManualCurve({"mentalis.left": keys, "mentalis.right": keys})


def test_a_drawn_curve_that_replaces_comes_back() -> None:
    curve = ManualCurve({"masseter": ((0.0, 0.5), (1.0, 0.2))}, replaces=True)
    assert entry_from_json(Node(entry_to_json(curve))) == curve


def test_what_is_written_is_small() -> None:
    """Defaults stay away, so that a person can read a score."""
    movement = entry_from_json(Node(SMILE))
    assert entry_to_json(movement) == SMILE
    assert json.loads(json.dumps(entry_to_json(entry_from_json(Node(CLOSURE))))) == CLOSURE


@pytest.mark.parametrize("channel", ["lips", "manual"])
def test_an_ordinary_movement_may_stand_in_the_lips_or_the_manual_channel(channel: str) -> None:
    movement = entry_from_json(Node(SMILE | {"channel": channel}))
    assert isinstance(movement, Movement)
    assert entry_to_json(movement) == SMILE | {"channel": channel}
