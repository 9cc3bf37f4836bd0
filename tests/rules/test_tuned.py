"""Profiles tuned by number: every number has its range, and the file says nothing but what was changed."""

from __future__ import annotations

import tomllib

import pytest

from risorius.errors import RisoriusError
from risorius.rules.profiles import profile, profile_from, profile_texts, profiles
from risorius.rules.tuned import numbers_of, tuned_text

WRONG = [
    ("lovely", {}, "unknown profile 'lovely'; did you mean 'lively'"),
    ("lively", {"blinks.wait": 0.0}, "blinks.wait = 0.0 is out of range; expected a number from 0.2 to 60"),
    ("lively", {"blinks.wai": 1.0}, "unknown number of a profile 'blinks.wai'; did you mean 'blinks.wait'"),
    ("lively", {"name": 1.0}, "unknown number of a profile 'name'"),
    ("lively", {"blinks": 1.0}, "unknown number of a profile 'blinks'"),
    ("lively", {"gaze.speaking.length.2": 1.0}, "did you mean 'gaze.speaking.length.1'"),
    ("lively", {"gaze.speaking.length.x": 1.0}, "did you mean 'gaze.speaking.length.1'"),
    ("lively", {"rates": 1.0}, "unknown number of a profile 'rates'"),
    ("lively", {"rates.signals": 9.0}, "out of range"),
    ("lively", {"side": float("nan")}, ""),
]


@pytest.mark.parametrize(("base", "numbers", "message"), WRONG)
def test_what_cannot_be_set_is_named(base, numbers, message):
    with pytest.raises((RisoriusError, ValueError)) as caught:
        tuned_text(base, "mine", numbers)
    assert message in str(caught.value)


@pytest.mark.parametrize("name", profiles())
def test_every_number_of_a_profile_lies_in_its_range_and_can_be_set(name):
    for number in numbers_of(profile(name)):
        assert number.low is None or number.low <= number.value
        assert number.high is None or number.value <= number.high
    numbers = {number.key: number.value for number in numbers_of(profile(name))}
    again = profile_from(tuned_text(name, "mine", numbers), "mine", profile_texts())
    assert list(numbers_of(again)) == list(numbers_of(profile(name)))


def test_the_file_says_what_was_changed_alone():
    text = tuned_text("lively", "mine", {"blinks.wait": 2.0, "rates.signals.brows": 0.5, "head.dwell.1": 1.0})
    found = tomllib.loads(text)
    assert found.pop("description")
    assert found.pop("source")
    assert found == {
        "name": "mine",
        "base": "lively",
        "blinks": {"wait": 2.0},
        "rates": {"signals.brows": 0.5},
        "head": {"dwell": [0.35, 1.0]},
    }
