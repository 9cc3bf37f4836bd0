from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from risorius.blend import combine
from risorius.channels import ChannelInputs, Display, built_channels, compose
from risorius.core.channels import CHANNELS
from risorius.core.movement import Cause, Movement
from risorius.core.score import Score
from risorius.errors import InputError, ParameterError
from risorius.face.fit.lip_file import load_lip_rig

BLINK = "orbicularis_oculi_palpebralis.left"


@pytest.mark.parametrize(
    ("inputs", "without", "error"),
    [
        (ChannelInputs(4.0), ["blinks"], ParameterError),
        (ChannelInputs(4.0, emotions=(Display("hapiness", 0.5),)), [], ParameterError),
        (ChannelInputs(4.0, emotions=(Display("happiness", 1.5),)), [], ParameterError),
        (ChannelInputs(4.0, emotions=(Display("happiness", 0.5, 2.0, 1.0),)), [], InputError),
        (ChannelInputs(0.0), [], InputError),
    ],
)
def test_bad_inputs(inputs: ChannelInputs, without: list[str], error: type[Exception]) -> None:
    with pytest.raises(error):
        compose(inputs, without=without)


def test_every_channel_but_manual_has_a_builder() -> None:
    assert set(built_channels()) == set(CHANNELS) - {"manual"}


def _by_channel(score: Score) -> dict[str, list[Movement]]:
    return {name: [m for m in score.movements if m.channel == name] for name in CHANNELS}


def test_same_seed_same_score_and_another_seed_another() -> None:
    assert compose(ChannelInputs(60.0), seed=3) == compose(ChannelInputs(60.0), seed=3)
    assert compose(ChannelInputs(60.0), seed=3) != compose(ChannelInputs(60.0), seed=4)


@pytest.mark.parametrize("dropped", ["manipulators", "head", "gaze"])
def test_a_channel_does_not_change_when_another_is_left_out(dropped: str) -> None:
    whole, less = (_by_channel(compose(ChannelInputs(60.0), without=w)) for w in ([], [dropped]))
    assert less.pop(dropped) == []
    assert all(whole[name] == movements for name, movements in less.items())


def test_every_movement_has_a_cause(utterance_of) -> None:
    utterance = utterance_of("HH AH L OW")
    score = compose(ChannelInputs(20.0, utterance, emotions=(Display("joy", 0.5),)))
    assert all(m.cause != Cause() for m in (*score.movements, *score.lips))


def test_emotions_given_separately_have_a_layer_each() -> None:
    score = compose(ChannelInputs(4.0, emotions=(Display("joy", 0.5), Display("surprise", 1.0, 1.0, 2.0))))
    layers = [m.layer for m in score.movements if m.channel == "emotion"]
    assert len(set(layers)) == 2


def test_both_eyes_blink_at_human_intervals() -> None:
    blinks = _by_channel(compose(ChannelInputs(600.0)))["manipulators"]
    starts = np.array([m.start for m in blinks])
    assert all(m.targets[BLINK] == m.targets[BLINK.replace("left", "right")] for m in blinks)
    assert np.diff(starts).min() > 0.3
    # facts: science/03, section 3.5: 10.5 to 32.5 a minute in conversation
    assert 10.5 < len(blinks) / 10 < 32.5


def test_random_blinks_keep_clear_of_marked_ones() -> None:
    marked = tuple(
        Movement("manipulators", t, t + 0.3, 0.1, 0.1, {BLINK: 1.0}) for t in np.arange(0.5, 59, 0.7)
    )
    blinks = _by_channel(compose(ChannelInputs(60.0, marks=marked)))["manipulators"]
    ends = sorted((m.start, m.end) for m in blinks)
    assert len(ends) >= len(marked)
    assert all(a[1] <= b[0] for a, b in pairwise(ends))


def test_without_liveliness_nothing_random_is_left() -> None:
    assert compose(ChannelInputs(60.0, lively=False)).movements == ()


def test_an_overwhelming_emotion_outdoes_the_lips_that_it_conflicts_with(utterance_of) -> None:
    """Paper A, section 1: one may be too happy to speak. /w/ rounds with 07, the rival of the smile's 01."""
    utterance = utterance_of("W UW W UW")
    rounding, smiles = [], []
    for priority in (None, 80.0):
        display = Display("joy", 1.0, priority=priority)
        score = compose(ChannelInputs(2.0, utterance, emotions=(display,)), without=["manipulators"])
        shown = combine(score, Fraction(100), load_lip_rig()).curves
        spoken = slice(round(100 * utterance.phones[0].start), round(100 * utterance.phones[-1].end))
        rounding.append(shown["orbicularis_oris_funneler"][spoken].mean())
        smiles.append(shown["zygomatic_major.left"][spoken].mean())
    assert rounding[1] < 0.5 * rounding[0]
    assert smiles[1] > smiles[0]
