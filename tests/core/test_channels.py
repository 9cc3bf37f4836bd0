"""The table of channels, read from the lines that register them."""

import importlib

import pytest

from risorius.core.channels import CHANNELS, ChannelDeclaration, ChannelTiming, channel_timing
from risorius.core.functions import ONSET_FUNCTIONS
from risorius.errors import ParameterError


@pytest.mark.parametrize("name", ["lips", "manual", "nose"])
def test_channels_without_timing(name: str) -> None:
    with pytest.raises(ParameterError, match="unknown channel with timing"):
        channel_timing(name)


def test_a_timing_is_checked() -> None:
    with pytest.raises(ParameterError, match="unknown onset function 'linaer'; did you mean 'linear'"):
        ChannelTiming(0.1, 0.2, "linaer")
    with pytest.raises(ValueError, match="0 or more"):
        ChannelTiming(-0.1, 0.2, "linear")


@pytest.mark.parametrize("fed_by", ["rules", "marks"])
def test_a_channel_that_is_fed_needs_a_timing(fed_by: str) -> None:
    with pytest.raises(ValueError, match="expected a timing"):
        ChannelDeclaration("ears", 15.0, "risorius.channels.ears", True, **{fed_by: True})  # type: ignore[arg-type]


def test_the_channels_and_their_priorities() -> None:
    assert {name: CHANNELS.get(name).priority for name in CHANNELS} == {
        "manual": 70.0,
        "lips": 60.0,
        "manipulators": 50.0,
        "signals": 40.0,
        "punctuators": 30.0,
        "regulators": 25.0,
        "gaze": 20.0,
        "head": 20.0,
        "emotion": 10.0,
    }
    assert list(CHANNELS) == sorted(CHANNELS, key=lambda name: (-CHANNELS.get(name).priority, name))


@pytest.mark.parametrize("name", CHANNELS.names())
def test_a_channel_is_declared_in_a_file_of_its_own_name(name: str) -> None:
    channel = CHANNELS.get(name)
    assert channel.module == f"risorius.channels.{name}"
    assert importlib.import_module(channel.module).__doc__


def test_rules_and_marks_feed_all_but_lips_and_curves() -> None:
    for name in CHANNELS:
        channel = CHANNELS.get(name)
        assert channel.rules == channel.marks == (name not in ("lips", "manual"))
        assert channel.built == (name != "manual")
        if channel.rules:
            assert channel_timing(name).function in ONSET_FUNCTIONS


@pytest.mark.parametrize(
    ("name", "onset", "offset"), [("emotion", 0.45, 0.75), ("signals", 0.1, 0.2), ("head", 0.2, 0.3)]
)
def test_defaults_by_channel(name: str, onset: float, offset: float) -> None:
    timing = channel_timing(name)
    assert (timing.onset, timing.offset) == (onset, offset)
