"""The presets of both papers: gaze, head, blinks and regulators by the papers' own settings."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from risorius.blend import combine
from risorius.channels import ChannelInputs, compose
from risorius.core.movement import Movement
from risorius.core.speech.utterance import Utterance
from risorius.rules.profiles import profile_of
from risorius.settings.presets import load_settings, presets

Maker = Callable[..., Utterance]
EYES = ("gaze_pitch", "gaze_yaw")
HEAD = ("head_pitch", "head_yaw")
FPS = 100
SENTENCES = (
    "Oh.",
    "I am here.",
    "Yes, of course[H*]. We could have told her.",
    "Four goats[H*] live behind the school.",
)
AWAY = ("regulators.eyes.state", "regulators.eyes.continuation", "gaze.aversion.habit")


def performed(said: Utterance, seed: int) -> list[Movement]:
    speaker = profile_of(load_settings("paper-b").profile)
    return list(
        compose(ChannelInputs(said.duration, said, profile=speaker), seed=seed, without=("lips",)).movements
    )


@pytest.mark.parametrize("text", SENTENCES)
def test_paper_b_looks_away_at_every_start_and_toward_the_listener_at_every_end(
    text: str, sentence_of: Maker
) -> None:
    said = sentence_of(text, lead=0.5)
    speaker = profile_of("paper-b")
    for seed in range(10):
        score = compose(ChannelInputs(said.duration, said, profile=speaker), seed=seed, without=("lips",))
        curves = combine(score, Fraction(FPS)).curves
        angle = np.hypot(*(curves[e] + curves[h] for e, h in zip(EYES, HEAD, strict=True)))
        start, end = said.words[0].start, said.words[-1].end
        assert angle[round(FPS * (start - 0.1)) : round(FPS * (start + 0.3))].max() > 4.0
        assert angle[round(FPS * end)] < 4.0


@pytest.mark.parametrize("text", SENTENCES)
def test_paper_b_turns_the_head_with_every_look_away(text: str, sentence_of: Maker) -> None:
    said = sentence_of(text, lead=0.5)
    for seed in range(10):
        found = [m for m in performed(said, seed) if m.channel == "gaze"]
        looks = [m for m in found if m.layer == "look" and m.function == "saccade" and m.cause.rule in AWAY]
        heads = [m for m in found if m.layer == "head"]
        far = [m for m in looks if math.hypot(*(m.targets[e] for e in EYES)) > 5.0]
        assert far
        for look in far:
            turns = [h for h in heads if h.cause == look.cause and -1e-6 <= h.start - look.start < 0.6]
            assert any(
                h.targets[head] * look.targets[eye] > 0.0
                for h in turns
                for head, eye in zip(HEAD, EYES, strict=True)
            )


def test_the_presets_of_the_papers_are_complete_and_say_what_stays_ours() -> None:
    a, b = load_settings("paper-a"), load_settings("paper-b")
    assert (a.blend.conflict, a.blend.onset_function, a.blend.lips) == ("inhibit", "exponential", "dominance")
    assert (b.blend.conflict, b.blend.lips) == ("attenuate", "lookahead")
    assert (a.blinks, b.blinks) == ("itti", "pelachaud")
    assert profile_of(b.profile).blinks.model == "pelachaud"
    assert all("ours stay" in presets()[name] for name in ("paper-a", "paper-b"))
