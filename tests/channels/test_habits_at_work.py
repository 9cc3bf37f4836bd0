"""Habits at work: what a speaker does that no rule asks for, on whole sentences."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from risorius.channels import ChannelInputs, compose
from risorius.core.speech.utterance import PauseKind
from risorius.rules.profiles import attitude, profile

from .at_work import LID, LONG, Maker, by_rule, movements


def test_periodic_blinks_fill_what_is_left_between_voluntary_ones(sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    habits = replace(profile("neutral").blinks, model="pelachaud", period=1.5)
    found = movements(said, "punctuators.lids.comma", profile=replace(profile("neutral"), blinks=habits))
    blinks = sorted((m for m in found if LID in m.targets), key=lambda m: m.start)
    assert {m.channel for m in blinks} >= {"manipulators", "punctuators"}
    gaps = [b.start - a.end for a, b in pairwise(blinks)]
    assert max(gaps) < 2.1


def test_blinks_of_paper_b_last_a_quarter_of_a_second_on_phonemes(sentence_of: Maker) -> None:
    said = sentence_of(LONG, phone=0.085)
    habits = replace(profile("neutral").blinks, model="pelachaud")
    found = movements(said, "signals.lids", profile=replace(profile("neutral"), blinks=habits))
    blinks = by_rule(found, "signals.lids.blink")
    edges = np.array([p.end for p in said.phones])
    assert len(blinks) > 20
    assert np.mean([b.end - b.start for b in blinks]) == pytest.approx(0.25, abs=0.06)
    assert all(np.abs(edges - b.start).min() < 1e-9 for b in blinks)


def test_attitudes_hold_their_posture(sentence_of: Maker) -> None:
    said = sentence_of("One two.")
    found = compose(ChannelInputs(said.duration, said, attitudes=(attitude("ironic"),))).movements
    (face,) = by_rule(found, "emotion.posture.speaker")
    assert face.targets["frontalis_lateralis.left"] > face.targets.get("frontalis_lateralis.right", 0.0)
    (held,) = by_rule(found, "head.posture.speaker")
    assert held.targets["head_roll"] < 0.0


@pytest.mark.parametrize(
    ("text", "rule"), [("One, two.", "punctuators.lids.comma"), ("One. Two.", "punctuators.lids.stop")]
)
def test_blinks_occur_in_pauses(text: str, rule: str, sentence_of: Maker) -> None:
    said = sentence_of(text)
    blinks = by_rule(movements(said, "punctuators.lids"), rule)
    assert blinks
    for blink in blinks:
        assert any(p.start - 0.05 <= blink.start <= p.end for p in said.pauses)


def test_where_no_rule_asks_the_eyes_scan_the_listener_s_face(sentence_of: Maker) -> None:
    said = sentence_of("One two.", tail=30.0)
    scans = by_rule(movements(said, "none"), "gaze.scan.face")
    about = [m for m in scans if m.cause.trigger == "the listener's face"]
    points = np.array([(m.targets["gaze_pitch"], m.targets["gaze_yaw"]) for m in about])
    assert len(points) > 10
    assert np.hypot(*points.T).max() < 5.0
    assert points.std(axis=0).min() > 0.5
    assert len(np.unique(np.diff([m.start for m in about]).round(3))) > 8


def test_noise_is_halved_at_commas_and_a_fifth_in_final_pauses(sentence_of: Maker) -> None:
    said = sentence_of("One two, three four. " * 40, pause=1.2, phone=0.3)

    def change(kind: PauseKind | None) -> float:
        spans = [(p.start, p.end) for p in said.pauses if kind in (None, p.kind)]
        found = by_rule(compose(ChannelInputs(said.duration, said)).movements, "head.noise.idle")
        steps = pairwise(found)
        return float(
            np.std(
                [
                    b.targets["head_pitch"] - a.targets["head_pitch"]
                    for a, b in steps
                    if any(s <= b.start < e for s, e in spans) == (kind is not None)
                ]
            )
        )

    assert change(PauseKind.COMMA) == pytest.approx(0.5 * change(None), rel=0.35)
    assert change(PauseKind.FULL_STOP) == pytest.approx(0.2 * change(None), rel=0.45)
