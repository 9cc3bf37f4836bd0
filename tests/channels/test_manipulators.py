"""Blinks that nothing asks for: by measured intervals, and as the papers' sources print them."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from risorius.channels import ChannelInputs, Display, compose
from risorius.channels.blinks import PELACHAUD as PHASES
from risorius.channels.blinks import blink_depth
from risorius.channels.manipulators import itti_wait, natural_interval
from risorius.core.counter_rng import CounterRng
from risorius.core.movement import Cause, Movement
from risorius.core.speech.utterance import Utterance
from risorius.errors import ParameterError
from risorius.rules.profiles import profile, profile_of, profiles
from risorius.rules.synchrony import synchrony

Maker = Callable[..., Utterance]
LID = "orbicularis_oculi_palpebralis.left"
HABITS = profile("neutral").blinks
LONG = " ".join(
    [
        "The council[H*] waited for the spring[H*] of that year, because nobody[H*] had the money[L+H*].",
        "Then a woman[H*] called Marta walked into the meeting[H*] with a drawing[H*] under her arm.",
    ]
    * 8
)


def blinks(found: tuple[Movement, ...], rule: str = "") -> list[Movement]:
    return sorted(
        (m for m in found if LID in m.targets and m.cause.rule.startswith(rule)), key=lambda m: m.start
    )


def test_an_unknown_model_is_refused() -> None:
    with pytest.raises(ParameterError, match="did you mean 'itti'"):
        profile_of("neutral", "iti")


def test_natural_intervals_are_log_normal() -> None:
    logs = np.log([natural_interval(CounterRng(0, number), 3.0, 0.6) for number in range(20_000)])
    assert logs.mean() == pytest.approx(np.log(3.0), abs=0.02)
    assert logs.std() == pytest.approx(0.6, abs=0.02)
    assert ((logs - logs.mean()) ** 3).mean() / logs.std() ** 3 == pytest.approx(0.0, abs=0.06)


def test_itti_s_waits_follow_the_printed_hazards() -> None:
    waits = np.array([itti_wait(CounterRng(0, number), 1.8) for number in range(20_000)])
    assert waits.min() >= 1.8
    # None of one blink a second over 1.8 s, then ten a second: facts: science/03, section 3.1.
    for since, survival in ((1.0, np.exp(-1.0)), (1.8, np.exp(-1.8)), (1.9, np.exp(-2.8))):
        assert np.mean(waits > 1.8 + since) == pytest.approx(survival, abs=0.01)
    assert waits.mean() == pytest.approx(1.8 + (1 - np.exp(-1.8)) + 0.1 * np.exp(-1.8), abs=0.02)


def test_itti_waits_from_the_last_shift_of_attention_or_blink(sentence_of: Maker) -> None:
    said = sentence_of(LONG, tail=60.0)
    found = compose(ChannelInputs(said.duration, said, profile=profile_of("neutral", "itti"))).movements
    eyes = [m for m in found if m.channel == "gaze" and m.layer == "look"]
    ways = [
        np.hypot(*(b.targets[n] - a.targets[n] for n in ("gaze_pitch", "gaze_yaw")))
        for a, b in pairwise(eyes)
    ]
    shifts = [(m, way) for m, way in zip(eyes[1:], ways, strict=True) if m.function == "saccade"]
    assert sum(way < 5.0 for _, way in shifts) > 20  # scanning does not count
    ends = np.array(
        sorted([*(m.start + m.onset for m, way in shifts if way > 5.0), *(m.end for m in blinks(found))])
    )
    added = blinks(found, "manipulators.lids.itti")
    assert len(added) > 5
    for blink in added[1:]:  # the eyes have blinked before the clip
        assert blink.start - ends[ends < blink.start + 1e-9].max() >= HABITS.wait - 1e-9
        assert blink.end - blink.start == pytest.approx(0.19)


@pytest.mark.parametrize("name", list(profiles()))
def test_itti_s_blinks_come_10_to_20_times_a_minute_in_silence(name: str) -> None:
    speaker = profile_of(name, "itti")
    counts = [
        len(blinks(compose(ChannelInputs(60.0, profile=speaker), seed=s).movements, "manipulators.lids.itti"))
        for s in range(6)
    ]
    assert all(8 <= count <= 22 for count in counts)
    assert 10.0 <= np.mean(counts) <= 20.0


def test_itti_s_blinks_come_between_those_of_rules_while_something_is_said(sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    speaker = profile_of("neutral", "itti")
    counts = [
        len(blinks(compose(ChannelInputs(said.duration, said, profile=speaker), seed=s).movements))
        for s in range(6)
    ]
    assert 10.0 <= np.mean(counts) / (said.duration / 60.0) <= 26.0
    added = blinks(
        compose(ChannelInputs(said.duration, said, profile=speaker)).movements, "manipulators.lids.itti"
    )
    assert added


def test_pelachaud_s_blinks_are_periodic_on_phonemes_with_eyes_closed_for_a_while(sentence_of: Maker) -> None:
    said = sentence_of(LONG, phone=0.085, tail=30.0)
    found = compose(ChannelInputs(said.duration, said, profile=profile_of("neutral", "pelachaud"))).movements
    edges = np.array([0.0, *(p.end for p in said.phones)])
    every = blinks(found)
    added = blinks(found, "manipulators.lids.pelachaud")
    assert len(added) > 10
    for blink in added:
        before = max((m.end for m in every if m.end <= blink.start), default=None)
        if before is not None:
            closest = np.abs(edges - (before + HABITS.period)).min()
            closest = 0.0 if closest > synchrony().reach else closest
            assert abs(blink.start - before - HABITS.period) == pytest.approx(closest, abs=1e-6)
    for blink in (m for m in every if m.cause.rule != "gaze.lids.shift"):
        closed = blink.end - blink.offset - (blink.start + blink.onset)
        assert PHASES[1] / 2 - 1e-6 <= closed <= PHASES[1] + synchrony().reach
    lengths = [m.end - m.start for m in every]
    assert np.mean(lengths) == pytest.approx(0.25, abs=0.03)
    assert blinks(found, "gaze.lids.shift") == [] or max(lengths) < 0.4


def test_natural_blinks_in_speech_come_15_to_26_times_a_minute_and_half_are_not_complete(
    sentence_of: Maker,
) -> None:
    said = sentence_of(LONG)
    found = [
        m
        for seed in range(8)
        for m in blinks(compose(ChannelInputs(said.duration, said), seed=seed).movements)
    ]
    assert 15.0 <= len(found) / (8 * said.duration / 60.0) <= 26.0
    assert 0.4 <= np.mean([m.targets[LID] < 0.97 for m in found]) <= 0.6


def test_natural_intervals_are_neither_periodic_nor_clipped() -> None:
    starts = np.array([m.start for m in blinks(compose(ChannelInputs(1200.0)).movements)])
    gaps = np.diff(starts)
    assert 0.45 < gaps.std() / gaps.mean() < 0.9
    assert gaps.max() > 3.0 * np.median(gaps)
    assert np.unique(gaps.round(2)).size > 0.8 * min(gaps.size, 300)


def test_blinks_of_the_papers_are_complete() -> None:
    for model in ("itti", "pelachaud"):
        habits = profile_of("neutral", model).blinks
        assert {blink_depth(habits, CounterRng(0, n)) for n in range(50)} == {1.0}


def test_most_looks_beyond_30_degrees_share_a_moment_with_a_blink() -> None:
    marks = tuple(
        Movement(
            "gaze", 3.0 * k + 1.0, 3.0 * k + 2.0, 0.1, 0.1, {"gaze_yaw": 31.0}, f"look.{k}", cause=Cause("m")
        )
        for k in range(60)
    )
    found = blinks(compose(ChannelInputs(181.0, marks=marks)).movements)
    starts = np.array([m.start for m in found])
    shared = [np.abs(starts - m.start).min() < 0.15 for m in marks]
    assert np.mean(shared) > 0.6


@pytest.mark.parametrize("felt", [(), (Display("happiness", 0.7),)])
def test_when_all_is_said_the_speaker_looks_at_the_listener(
    felt: tuple[Display, ...], sentence_of: Maker
) -> None:
    said = sentence_of(" ".join(["One two three four five six."] * 3), tail=20.0)
    for seed in range(8):
        found = compose(ChannelInputs(said.duration, said, emotions=felt), seed=seed).movements
        after = [m for m in found if m.layer == "look" and m.end > said.words[-1].end]
        assert after
        assert all(np.hypot(m.targets["gaze_pitch"], m.targets["gaze_yaw"]) < 6.0 for m in after)


def test_a_smile_does_not_look_aside(sentence_of: Maker) -> None:
    said = sentence_of(LONG)

    def away(felt: tuple[Display, ...]) -> float:
        looks = [
            m
            for m in compose(ChannelInputs(said.duration, said, emotions=felt)).movements
            if m.channel == "gaze" and m.function == "saccade"
        ]
        return sum(np.hypot(m.targets["gaze_pitch"], m.targets["gaze_yaw"]) > 6.0 for m in looks)

    assert away(()) > 5
    assert away((Display("happiness", 0.7),)) == 0


def test_added_blinks_keep_clear_of_others(sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    found = blinks(compose(ChannelInputs(said.duration, said)).movements)
    added = {m.id for m in found if m.channel == "manipulators"}
    for a, b in pairwise(found):
        if a.id in added or b.id in added:
            assert b.start - a.end > 0.1
