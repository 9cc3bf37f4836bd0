"""From what is said and marked to movements: one file per channel, each a plain function."""

from ..rules.emotions import Display
from .compose import HORIZON, compose
from .inputs import inputs_of
from .registry import CHANNEL_BUILDERS, Brief

__all__ = ["CHANNEL_BUILDERS", "HORIZON", "Brief", "Display", "compose", "inputs_of"]
