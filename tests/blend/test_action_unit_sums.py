"""Action units in scores: muscles first in a blend, added and clipped before that by `attenuate`."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.blend.plan import at
from risorius.core.action_units import resolve_targets
from risorius.core.movement import Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score
from risorius.errors import ParameterError

MIDDLE = np.array([1.0])


def value(name: str, policy: str, *movements: tuple[str, dict[str, float]]) -> float:
    """Return a parameter at the apex of movements of some channels."""
    made = tuple(
        Movement(channel, 0.0, 2.0, 0.2, 0.2, targets, layer=str(number))
        for number, (channel, targets) in enumerate(movements)
    )
    score = Score(2.0, made, settings=BlendSettings(conflict=policy))
    return float(at(score, MIDDLE)[0, INDEX[name]])


@pytest.mark.parametrize("policy", ["inhibit", "graded", "sum", "attenuate"])
def test_units_and_their_muscles_give_the_same_curves(policy: str) -> None:
    units = {"AU6": 0.4, "AU7": 0.5, "AU12.left": 0.8, "AU26": 0.6, "head_yaw": 4.0}
    for name in resolve_targets(units):
        both = [value(name, policy, ("emotion", targets)) for targets in (units, resolve_targets(units))]
        assert both[0] == both[1] != 0.0


def test_units_of_channels_add_and_clip_before_they_become_muscles() -> None:
    # Paper B, 6.4: AU26 is 0.6 + 0.6, clipped at 1; a jaw of 0.35 of the masseter, and not of 0.42.
    channels = ("emotion", {"AU26": 0.6}), ("signals", {"AU26": 0.6})
    assert value("masseter", "attenuate", *channels) == pytest.approx(0.35)
    assert value("masseter", "sum", *channels) == pytest.approx(0.42)
    assert value("masseter", "inhibit", *channels) == pytest.approx(0.21)


def test_units_that_sum_below_one_add() -> None:
    channels = ("emotion", {"AU26": 0.3}), ("signals", {"AU26": 0.5}), ("punctuators", {"masseter": 0.1})
    assert value("masseter", "attenuate", *channels) == pytest.approx(0.35 * 0.8 + 0.1)


def test_a_side_adds_to_both_sides() -> None:
    channels = ("emotion", {"AU22": 0.7}), ("signals", {"AU22.left": 0.6})
    assert value("depressor_labii.left", "attenuate", *channels) == pytest.approx(0.8)
    assert value("depressor_labii.right", "attenuate", *channels) == pytest.approx(0.8 * 0.7)


def test_an_attenuated_unit_adds_what_is_left_of_it() -> None:
    # A smile of lower priority keeps 1 - 0.8 of itself beside the full funneler (07), then adds to the other.
    rival = ("manipulators", {"orbicularis_oris_funneler": 1.0})
    channels = (rival, ("emotion", {"AU12": 1.0}), ("signals", {"AU12": 1.0}))
    assert value("zygomatic_major.left", "attenuate", *channels) == pytest.approx(0.4)


def test_layers_of_a_channel_do_not_add() -> None:
    layers = ("emotion", {"AU26": 0.6}), ("emotion", {"AU26": 0.5})
    assert value("masseter", "attenuate", *layers) == pytest.approx(0.35 * 0.6)


def test_a_unit_above_one_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"AU12 = 1\.5 is out of range"):
        value("masseter", "inhibit", ("emotion", {"AU12": 1.5}))
