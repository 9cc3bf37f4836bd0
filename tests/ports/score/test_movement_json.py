import json
from dataclasses import dataclass
from typing import Any

import pytest

from risorius.core.movement import Dominance, LipSegment, ManualCurve, Movement
from risorius.errors import InputError
from risorius.ports.score.movement_json import Entry, entry_to_json
from risorius.reading.json_text import parse_json

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


def entry_from_json(entry: dict[str, Any]) -> Any:
    """Return what an entry is that stands as the only member of a document."""

    @dataclass
    class Document:
        m: Entry

    return parse_json(json.dumps({"m": entry}), "x").read(Document).m


HAND: dict[str, Any] = {"channel": "manual", "keys": {"masseter": [[0, 0], [1, 0.5]]}}


@pytest.mark.parametrize(
    ("entry", "at", "message"),
    [
        ({}, '"m"', "key 'm.channel' is missing; expected a text"),
        (SMILE | {"channel": "emotoin"}, '"channel"', "unknown channel 'emotoin'; did you mean 'emotion'?"),
        (SMILE | {"onset": -1}, '"onset"', "m.onset = -1 is out of range; expected a number from 0 to 21600"),
        (SMILE | {"start": -1}, '"start"', "m.start = -1 is out of range"),
        (SMILE | {"end": 1e6}, '"end"', "m.end = 1000000.0 is out of range"),
        (SMILE | {"end": 0}, '"m"', "'emotion@0': end = 0.0 must come after start = 0.0"),
        (SMILE | {"ofset": 1}, '"ofset"', "unknown key 'm.ofset'; did you mean 'offset'?"),
        (SMILE | {"phone": "M"}, '"phone"', "unknown key 'm.phone'"),
        (
            SMILE | {"function": "lineer"},
            '"function"',
            "unknown onset function 'lineer'; did you mean 'linear'?",
        ),
        (SMILE | {"targets": {"AU12.left": 2}}, '"AU12.left"', "AU12.left = 2.0 is out of range"),
        (
            SMILE | {"targets": {"AU1": 1, "AU34": 1}},
            '"AU34"',
            "AU34 (cheek puff) cannot be shown by the 35 muscles",
        ),
        (SMILE | {"targets": {f"AU{'9' * 5000}": 1}}, '"AU999', "unknown action unit 'AU999"),
        (
            SMILE | {"targets": {"masseter": [1]}},
            '"masseter"',
            "m.targets.masseter = [1] cannot be used; expected a number",
        ),
        (SMILE | {"cause": {"rul": "x"}}, '"rul"', "unknown key 'm.cause.rul'; did you mean 'rule'?"),
        (
            SMILE | {"priority": "high"},
            '"priority"',
            'm.priority = "high" cannot be used; expected a number',
        ),
        (CLOSURE | {"end": 0}, '"m"', "'phone M': end = 0.0 must come after start = 0.0"),
        (CLOSURE | {"onset": 1}, '"onset"', "unknown key 'm.onset'"),
        (CLOSURE | {"targets": {"lip_width": 30}}, '"lip_width"', "lip_width = 30.0 is out of range"),
        ({"channel": "lips"}, '"m"', "key 'm.phone' is missing"),
        (CLOSURE | {"limits": {"masseter": [1, 0]}}, '"masseter"', "the limits are reversed: 1 > 0"),
        (
            CLOSURE | {"limits": {"masseter": [0]}},
            '"masseter"',
            "m.limits.masseter = [0] cannot be used; expected a list of 2, each a number",
        ),
        (CLOSURE | {"limits": {"masseter": [0, 2]}}, '"masseter"', "masseter = 2.0 is out of range"),
        (
            CLOSURE | {"limits": {"jaw": [0, 1], "masseter": [0, 1]}},
            '"masseter"',
            "masseter is given twice; expected it once",
        ),
        (
            CLOSURE | {"dominance": {"*": {"after": "x"}}},
            '"after"',
            'm.dominance.*.after = "x" cannot be used; expected a number',
        ),
        (CLOSURE | {"yields": {"*": -1}}, '"*"', "m.yields.* = -1 is out of range; expected a number of at"),
        ({"channel": "manual"}, '"m"', "key 'm.keys' is missing"),
        (HAND | {"keys": {"masseter": []}}, '"masseter"', "there are no keys; expected [[time, value], …]"),
        (
            HAND | {"keys": {"masseter": [[1, 0], [1, 1]]}},
            "[1, 1]",
            "time 1 does not come after 1; expected rising times",
        ),
        (HAND | {"keys": {"masseter": [[0, 0], [1, 3]]}}, "[1, 3]", "masseter = 3.0 is out of range"),
        (HAND | {"keys": {"masset": [[0, 0]]}}, '"masset"', "unknown muscle or parameter 'masset'; did you"),
    ],
)
def test_a_faulty_entry_is_refused_with_its_place(entry: dict[str, Any], at: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        entry_from_json(entry)
    column = json.dumps({"m": entry}).index(at) + 1
    assert str(caught.value).startswith(f"x:1:{column}: {message}")


def test_a_name_without_side_means_both_and_units_stay() -> None:
    targets = {"AU12": 0.5, "jaw_open": 0.25}
    movement = entry_from_json(SMILE | {"targets": targets})
    assert isinstance(movement, Movement)
    assert movement.targets == {"AU12": 0.5, "masseter": 0.25}
    muscles = {"zygomatic_major.left": 0.5, "zygomatic_major.right": 0.5, "masseter": 0.25}
    assert movement.parameters == muscles


def test_lips_take_aliases_in_limits_and_dominance() -> None:
    more = {
        "limits": {"risorius": [0, 0.5]},
        "dominance": {"jaw_open": {"magnitude": 2}, "*": {"after": 0.1}},
    }
    segment = entry_from_json(CLOSURE | more)
    assert isinstance(segment, LipSegment)
    assert segment.limits == {"risorius.left": (0.0, 0.5), "risorius.right": (0.0, 0.5)}
    assert segment.dominance == {"*": Dominance(after=0.1), "masseter": Dominance(magnitude=2.0)}


def test_hand_drawn_curves_may_name_both_sides() -> None:
    curve = entry_from_json({"channel": "manual", "keys": {"mentalis": [[0, 0.5], [1, 1]]}})
    keys = ((0.0, 0.5), (1.0, 1.0))
    assert curve == ManualCurve({"mentalis.left": keys, "mentalis.right": keys})


def test_a_drawn_curve_that_replaces_comes_back() -> None:
    curve = ManualCurve({"masseter": ((0.0, 0.5), (1.0, 0.2))}, replaces=True)
    assert entry_from_json(entry_to_json(curve)) == curve


def test_what_is_written_is_small() -> None:
    """Defaults stay away, so that a person can read a score."""
    movement = entry_from_json(SMILE)
    assert entry_to_json(movement) == SMILE
    assert json.loads(json.dumps(entry_to_json(entry_from_json(CLOSURE)))) == CLOSURE


@pytest.mark.parametrize("channel", ["lips", "manual"])
def test_an_ordinary_movement_may_stand_in_the_lips_or_the_manual_channel(channel: str) -> None:
    movement = entry_from_json(SMILE | {"channel": channel})
    assert isinstance(movement, Movement)
    assert entry_to_json(movement) == SMILE | {"channel": channel}
