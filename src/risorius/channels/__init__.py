"""From what is said and marked to movements: one file per channel, each a plain function."""

from ..rules.emotions import Display
from .compose import HORIZON, built_channels, compose
from .inputs import inputs_of
from .registry import Brief

__all__ = ["HORIZON", "Brief", "Display", "built_channels", "compose", "inputs_of"]
