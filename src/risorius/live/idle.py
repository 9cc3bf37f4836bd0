"""The face between sentences: it blinks, looks and breathes as it does where a performance is silent."""

from __future__ import annotations

from .. import channels
from ..channels.inputs import ChannelInputs
from ..pipeline import combine
from ..rules.emotions import Displays
from ..rules.profiles import attitude, profile_of
from ..rules.rule_set import emotions_of, rule_set_of
from ..settings import Settings
from ..take import Take

# Seconds that are performed at once; memory does not grow with how long the face is idle.
IDLE_SECONDS = 6.0


def idle_take(seconds: float, feelings: Displays, settings: Settings) -> Take:
    """Perform `seconds` in which nothing is said; `settings` have their profile's age."""
    inputs = ChannelInputs(
        seconds,
        emotions=feelings,
        lively=settings.lively,
        profile=profile_of(settings.profile, settings.blinks),
        attitudes=tuple(attitude(name) for name in settings.attitudes),
        rules=rule_set_of(settings.rules),
    )
    blend = settings.blend.planned()
    with emotions_of(settings.rules, settings.expression, settings.overwhelmed):
        score = channels.compose(inputs, seed=settings.seed, without=settings.without, settings=blend)
    return combine(score, settings)
