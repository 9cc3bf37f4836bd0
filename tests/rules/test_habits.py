"""Habits are changed and deleted by a user's file, as rules are (paper B, section 3.2)."""

from collections.abc import Callable

import numpy as np
import pytest

from risorius.channels import ChannelInputs, compose
from risorius.core.movement import Movement
from risorius.core.speech.utterance import Utterance
from risorius.errors import RisoriusError
from risorius.rules.doctor import examine
from risorius.rules.habits import HABITS
from risorius.rules.profiles import profile_of
from risorius.rules.rule_set import extended, shipped

Maker = Callable[..., Utterance]
BLINKS = '[[habit]]\nid = "manipulators.lids.natural"\nsource = "mine"\n'


def movements(said: Utterance, text: str, who: str = "lively") -> tuple[Movement, ...]:
    rules = extended(shipped(), text, "my.toml")
    return compose(ChannelInputs(said.duration, said, rules=rules, profile=profile_of(who))).movements


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('delete = ["manipulators.lids.rnadom"]', "unknown rule 'manipulators.lids.rnadom'"),
        (
            BLINKS.replace("natural", "natral") + "numbers = {}",
            "unknown habit 'manipulators.lids.natral'; did you mean",
        ),
        (
            BLINKS + 'numbers = { "intervall.0" = 2.0 }',
            "unknown number of manipulators.lids.natural 'intervall.0'",
        ),
        (BLINKS + 'numbers = { "interval.0" = 0.0 }', "is out of range; expected 0.2 to 60"),
    ],
)
def test_habits_that_do_not_fit_are_refused_with_their_place(text: str, message: str) -> None:
    with pytest.raises(RisoriusError, match=message) as error:
        extended(shipped(), text, "my.toml")
    assert str(error.value).startswith("my.toml:")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (BLINKS + "numbers = {}", "changes nothing: it has no numbers"),
        (
            'delete = ["manipulators"]\n' + BLINKS + 'numbers = { "interval.0" = 2.0 }',
            "is changed and deleted; expected one of both",
        ),
        (
            (BLINKS + 'numbers = { "interval.0" = 2.0 }\n') * 2,
            "gives 'interval.0' twice; the last one holds",
        ),
        (BLINKS.replace("mine", " ") + 'numbers = { "interval.0" = 2.0 }', "lacks a source"),
    ],
)
def test_the_doctor_names_habits_that_are_ill(text: str, message: str) -> None:
    (finding,) = examine(extended(shipped(), text, "my.toml"))
    assert str(finding).startswith("my.toml:")
    assert str(finding).endswith(f"habit 'manipulators.lids.natural' {message}")


def test_the_doctor_finds_nothing_in_a_habit_that_is_well() -> None:
    assert examine(extended(shipped(), BLINKS + 'numbers = { "interval.0" = 2.0 }', "my.toml")) == ()


@pytest.mark.parametrize("name", [n for n in HABITS if n not in ("gaze.scan.face", "gaze.lids.shift")])
def test_a_deleted_habit_is_not_seen(name: str, sentence_of: Maker) -> None:
    said = sentence_of("One two three[H*] four. " * 8, tail=20.0)
    assert not [
        m for m in movements(said, f'delete = ["{name}"]') if m.cause.rule == name and any(m.targets.values())
    ]


def test_eyes_that_do_not_scan_stay_where_they_look(sentence_of: Maker) -> None:
    said = sentence_of("One two.", tail=20.0)
    found = movements(said, 'delete = ["gaze.scan", "gaze.aversion"]')
    looks = [m for m in found if m.layer == "look"]
    assert all(m.targets == {"gaze_pitch": 0.0, "gaze_yaw": 0.0} for m in looks if m.start > 5.0)


def test_other_numbers_hold_for_every_profile(sentence_of: Maker) -> None:
    said = sentence_of("One two.", tail=120.0)

    def gap(text: str, who: str) -> float:
        starts = [m.start for m in movements(said, text, who) if m.channel == "manipulators"]
        return float(np.median(np.diff(starts)))

    seldom = BLINKS + 'numbers = { "interval.0" = 12.0 }'
    for who in ("neutral", "authoritative"):
        assert gap(seldom, who) > 1.5 * gap("", who)
