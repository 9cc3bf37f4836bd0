import pytest

from risorius.core.functions import ONSET_FUNCTIONS
from risorius.core.movement import CHANNELS
from risorius.errors import InputError, ParameterError
from risorius.rules.load import parse
from risorius.rules.timing import TimingTable, channel_timing, saccade_duration

SACCADE = "[saccade]\nlatency = 0.025\nper_degree = 0.0024\n"


def test_channels_and_functions_are_checked() -> None:
    channel = '[channels.{}]\nonset = {}\noffset = 0.1\nfunction = "{}"\n'
    with pytest.raises(ParameterError, match=r"unknown channel 'hed'; did you mean 'head'\?"):
        parse(TimingTable, SACCADE + channel.format("hed", 0.1, "linear"), "t.toml")
    with pytest.raises(ParameterError, match=r"t\.toml:4: unknown onset function 'linaer'"):
        parse(TimingTable, SACCADE + channel.format("head", 0.1, "linaer"), "t.toml")
    with pytest.raises(InputError, match=r"t\.toml:5: channels\.head\.onset = -0\.1 is out of range"):
        parse(TimingTable, SACCADE + channel.format("head", -0.1, "linear"), "t.toml")


@pytest.mark.parametrize("channel", ["lips", "manual", "nose"])
def test_channels_without_timing(channel: str) -> None:
    with pytest.raises(ParameterError, match="unknown channel with timing"):
        channel_timing(channel)


def test_every_channel_of_movements_has_a_timing() -> None:
    for channel in set(CHANNELS) - {"lips", "manual"}:
        assert channel_timing(channel).function in ONSET_FUNCTIONS


@pytest.mark.parametrize(
    ("channel", "onset", "offset"), [("emotion", 0.45, 0.75), ("signals", 0.1, 0.2), ("head", 0.2, 0.3)]
)
def test_defaults_by_channel(channel: str, onset: float, offset: float) -> None:
    assert (channel_timing(channel).onset, channel_timing(channel).offset) == (onset, offset)


def test_saccades_follow_the_main_sequence() -> None:
    assert saccade_duration(0.0) == pytest.approx(0.025)
    assert saccade_duration(10.0) == pytest.approx(0.049)
    assert saccade_duration(-10.0) == saccade_duration(10.0)
