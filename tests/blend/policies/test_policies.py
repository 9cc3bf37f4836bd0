"""The four policies on one conflict: a smile below a rounding of the lips."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from risorius import blend
from risorius.blend.conflict import POLICIES
from risorius.core.movement import LipSegment, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score
from risorius.face.fit.lip_file import load_lip_rig

SMILE, ROUND = "zygomatic_major.left", "orbicularis_oris_funneler"
MINIMUM = 0.25


def score(policy: str, rounding: float = 0.8, smile: float = 1.0, **settings: float) -> Score:
    return Score(
        8.0,
        (
            Movement("emotion", 0.0, 8.0, 1.0, 1.0, {SMILE: smile}),
            Movement("signals", 3.0, 5.0, 0.5, 0.5, {ROUND: rounding}),
        ),
        settings=BlendSettings(conflict=policy, **settings),  # type: ignore[arg-type]
    )


def smile(policy: str, times: object, **more: float) -> np.ndarray:
    return blend.at(score(policy, **more), np.asarray(times, dtype=np.float64))[:, INDEX[SMILE]]


def test_all_four_are_there() -> None:
    assert set(POLICIES) == {"inhibit", "graded", "attenuate", "sum"}


class TestInhibit:
    """Paper A, section 6 and Figure 6."""

    START = 3 + 0.5 * math.log2(1 + 0.1 / 0.8)
    END = 5 - START + 3

    def test_gone_while_the_rival_is_over_its_threshold(self) -> None:
        assert not smile("inhibit", [self.START + 1e-6, 4.0, self.END - 1e-6]).any()

    def test_released_before_and_restored_after_at_the_fastest_pace(self) -> None:
        for x in (0.05, 0.12, 0.249):
            expected = 2 ** (x / MINIMUM) - 1
            assert smile("inhibit", [self.START - x, self.END + x]) == pytest.approx([expected] * 2, abs=1e-9)

    def test_whole_beyond_the_minimum_durations(self) -> None:
        times = [2.0, self.START - MINIMUM - 1e-9, self.END + MINIMUM + 1e-9, 6.5]
        assert smile("inhibit", times) == pytest.approx(np.ones(4), abs=1e-7)

    def test_a_weak_smile_yields_later(self) -> None:
        x = MINIMUM * math.log2(1.3)
        assert smile("inhibit", [self.START - x - 1e-6], smile=0.3)[0] == pytest.approx(0.3)

    def test_a_rival_at_its_threshold_inhibits_nothing(self) -> None:
        assert smile("inhibit", [4.0], rounding=0.1)[0] == 1.0
        assert smile("inhibit", [4.0], rounding=0.1, activation_threshold=0.05)[0] == 0.0

    def test_settings_override_the_minimum_durations(self) -> None:
        near = self.START - 0.1
        assert smile("inhibit", [near], min_offset=0.0)[0] == 1.0
        assert smile("inhibit", [near], min_offset=1.0)[0] == pytest.approx(2**0.1 - 1)
        assert smile("inhibit", [self.END + 0.1], min_offset=1.0)[0] == pytest.approx(2**0.4 - 1)
        assert smile("inhibit", [self.END + 0.1], min_onset=1.0)[0] == pytest.approx(2**0.1 - 1)

    def test_equal_priorities_do_not_inhibit_each_other(self) -> None:
        pair = (
            Movement("gaze", 0.0, 2.0, 0.1, 0.1, {SMILE: 0.5}),
            Movement("head", 0.0, 2.0, 0.1, 0.1, {ROUND: 0.5}),
        )
        values = blend.at(Score(2.0, pair), np.array([1.0]))
        assert values[0, [INDEX[SMILE], INDEX[ROUND]]].tolist() == [0.5, 0.5]

    def test_the_other_side_is_free_of_a_sided_rival(self) -> None:
        pair = (
            Movement("emotion", 0.0, 2.0, 0.1, 0.1, {SMILE: 0.5, "zygomatic_major.right": 0.5}),
            Movement("signals", 0.0, 2.0, 0.1, 0.1, {"triangularis.left": 0.5}),
        )
        values = blend.at(Score(2.0, pair), np.array([1.0]))
        assert values[0, [INDEX[SMILE], INDEX["zygomatic_major.right"]]].tolist() == [0.0, 0.5]

    def test_a_suppressed_rival_suppresses_nothing(self) -> None:
        chain = (
            Movement("lips", 0.0, 2.0, 0.1, 0.1, {"orbicularis_oris_presser": 0.5}),
            Movement("signals", 0.0, 2.0, 0.1, 0.1, {ROUND: 0.5}),
            Movement("emotion", 0.0, 2.0, 0.1, 0.1, {SMILE: 0.5}),
        )
        values = blend.at(Score(2.0, chain), np.array([1.0]))
        assert values[0, [INDEX[ROUND], INDEX[SMILE]]].tolist() == [0.0, 0.5]

    def test_an_overwhelming_emotion_wins_over_speech(self) -> None:
        pair = (
            Movement("emotion", 0.0, 4.0, 0.1, 1.0, {SMILE: 0.9}, priority=80.0, release_priority=10.0),
            Movement("lips", 0.0, 4.0, 0.1, 0.1, {ROUND: 0.9}),
        )
        values = blend.at(Score(4.0, pair), np.array([2.0, 3.6]))
        assert values[:, INDEX[SMILE]].tolist() == [0.9, 0.0]
        assert values[:, INDEX[ROUND]].tolist() == [0.0, 0.9]

    def test_what_recovers_after_a_change_of_priority_inhibits_only_when_it_has_risen(self) -> None:
        recovering = Movement(
            "emotion", 0.0, 6.0, 0.0, 4.0, {ROUND: 1.0}, priority=80.0, release_priority=10.0
        )
        score = Score(
            6.0,
            (
                Movement("signals", 0.0, 2.0, 0.0, 0.0, {"orbicularis_oris_presser": 1.0}, priority=90.0),
                recovering,
                Movement("head", 0.0, 6.0, 0.0, 0.0, {SMILE: 0.5}, priority=5.0),
            ),
            settings=BlendSettings(min_onset=1.0, min_offset=0.01),
        )
        risen = 2 + math.log2(1.1)
        values = blend.at(score, np.array([1.0, risen - 0.02, risen + 0.02]))
        assert values[:, INDEX[SMILE]].tolist() == [0.5, 0.5, 0.0]
        assert values[:, INDEX[ROUND]] == pytest.approx([0, 2 ** (risen - 2.02) - 1, 2 ** (risen - 1.98) - 1])


class TestGraded:
    def test_gives_way_by_degrees(self) -> None:
        kept = [smile("graded", [4.0], rounding=r)[0] for r in (0.1, 0.2, 0.3, 0.5, 0.9)]
        assert kept == pytest.approx([1.0, 1 - 0.15625, 0.5, 0.0, 0.0])

    def test_changes_no_faster_than_the_minimum_durations(self) -> None:
        values = smile("graded", np.arange(2, 6, 0.001), min_onset=0.8, min_offset=0.4)
        assert np.diff(values).max() <= 0.001 / 0.8 * 1.01
        assert -np.diff(values).min() <= 0.001 / 0.4 * 1.01

    @pytest.mark.parametrize("asked", [0.5, 1.0])
    def test_half_a_smile_goes_and_comes_as_fast_as_a_whole_one(self, asked: float) -> None:
        steps = np.diff(smile("graded", np.arange(2, 7, 0.001), smile=asked, min_onset=1.2, min_offset=0.8))
        assert steps.max() == pytest.approx(0.001 / 1.2, rel=0.01)
        assert -steps.min() == pytest.approx(0.001 / 0.8, rel=0.01)


class TestAttenuate:
    def test_the_formula(self) -> None:
        times = np.arange(2, 6, 0.01)
        rival = blend.at(score("attenuate"), times)[:, INDEX[ROUND]]
        assert smile("attenuate", times) == pytest.approx(1 - 0.8 * rival)

    def test_never_removed(self) -> None:
        assert smile("attenuate", [4.0], rounding=1.0)[0] == pytest.approx(0.2)


@pytest.mark.parametrize("policy", ["graded", "attenuate"])
def test_who_gives_way_changes_with_the_priority(policy: str) -> None:
    pair = (
        Movement("emotion", 0.0, 8.0, 0.1, 0.1, {SMILE: 0.5}),
        Movement("signals", 1.0, 8.0, 0.1, 5.0, {ROUND: 1.0}, release_priority=5.0),
    )
    values = blend.at(Score(8.0, pair, settings=BlendSettings(conflict=policy)), np.array([2.0, 4.0]))
    asked = 2 ** (4 / 5) - 1
    kept = {"graded": (0.0, 0.0), "attenuate": (0.2, 0.6)}[policy]
    assert values[:, INDEX[SMILE]] == pytest.approx([0.5 * kept[0], 0.5])
    assert values[:, INDEX[ROUND]] == pytest.approx([1.0, asked * kept[1]], abs=1e-12)


class TestSum:
    def test_nothing_gives_way(self) -> None:
        assert smile("sum", [4.0])[0] == 1.0

    def test_the_same_muscle_adds_and_is_clipped(self) -> None:
        pair = tuple(
            Movement(channel, 0.0, 2.0, 0.1, 0.1, {SMILE: 0.4, ROUND: 0.7})
            for channel in ("emotion", "signals")
        )
        values = blend.at(Score(2.0, pair, settings=BlendSettings(conflict="sum")), np.array([1.0]))
        assert values[0, [INDEX[SMILE], INDEX[ROUND]]].tolist() == [0.8, 1.0]


def test_attenuate_adds_channels_and_clips() -> None:
    frown = "corrugator_supercilii.left"
    shown = Movement("emotion", 0.0, 4.0, 0.5, 0.5, {frown: 0.4})
    signal = Movement("signals", 1.0, 3.0, 0.5, 0.5, {frown: 0.5})
    twice = replace(shown, layer="b")

    def peak(*movements: Movement) -> float:
        score = Score(4.0, movements, settings=BlendSettings(conflict="attenuate"))
        return float(blend.at(score, np.array([2.0]))[0, INDEX[frown]])

    assert peak(shown, signal) == pytest.approx(0.9)
    assert peak(replace(shown, targets={frown: 0.8}), signal) == 1.0
    assert peak(shown, twice) == 0.4


RAISER = "levator_labii_superioris.left"


@pytest.mark.parametrize("policy", ["inhibit", "graded", "attenuate"])
def test_the_upper_lip_of_an_open_vowel_takes_nothing_from_a_smile(policy: str) -> None:
    """It is a part of the lips' opening; a score that names the muscle has Table 2's conflict."""
    smiles = Movement("emotion", 0.0, 4.0, 0.3, 0.3, {SMILE: 0.9})
    opened = {"jaw_drop": 8.4, "lip_aperture": 15.0}

    def shown(targets: dict[str, float]) -> np.ndarray:
        lips = (LipSegment("AE", 0.5, 3.5, targets),)
        both = Score(4.0, (smiles,), lips, settings=BlendSettings(conflict=policy))
        return blend.at(both, np.array([2.0]), load_lip_rig())[0]

    assert shown(opened)[INDEX[RAISER]] > 0.2
    assert shown(opened)[INDEX[SMILE]] == pytest.approx(0.9)
    assert shown({RAISER: 0.3})[INDEX[SMILE]] < 0.85
