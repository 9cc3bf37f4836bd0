"""Make movements of speech and marks: one file per channel, each a plain function."""

from ..rules.emotions import Display
from .compose import HORIZON, built_channels, compose
from .from_script import inputs_of
from .inputs import ChannelInputs

__all__ = ["HORIZON", "ChannelInputs", "Display", "built_channels", "compose", "inputs_of"]
