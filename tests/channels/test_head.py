"""The head on curves: quick on accents, slow between them, home when all is said (paper B, section 5.2)."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from risorius.blend import combine
from risorius.channels import ChannelInputs, compose
from risorius.channels.head import noise_steps
from risorius.core.counter_rng import CounterRng
from risorius.core.speech.utterance import Utterance
from risorius.core.time import on_tick
from risorius.rules.profiles import profile

Maker = Callable[..., Utterance]
FPS = 100
AXES = ("head_pitch", "head_yaw", "head_roll")
TEXT = (
    "The council[H*] waited for the spring[H*] of that year, because nobody[H*] had the money[L+H*]. "
    "Then a woman[H*] called Marta walked into the meeting[H*] with a drawing[H*] under her arm."
)


def measured(said: Utterance) -> Utterance:
    """Return an utterance whose syllables have pitch, as those of measured sound."""
    numbers = CounterRng(3)
    syllables = [replace(s, pitch=numbers.normal(i, limit=2.0)) for i, s in enumerate(said.syllables)]
    return replace(said, syllables=tuple(syllables))


@pytest.fixture(scope="module")
def clips(request: pytest.FixtureRequest) -> list[tuple[Utterance, dict[str, np.ndarray]]]:
    """Return a measured utterance of two sentences and its curves by several seeds."""
    said = measured(request.getfixturevalue("sentence_of")(TEXT, phone=0.09))
    scores = [compose(ChannelInputs(said.duration, said), seed=s, without=("lips",)) for s in range(8)]
    return [(said, combine(score, Fraction(FPS)).curves) for score in scores]


def speed(curves: dict[str, np.ndarray]) -> np.ndarray:
    """Return the head's speed in degrees a second."""
    return FPS * np.sqrt(sum(np.gradient(curves[name]) ** 2 for name in AXES))


def test_the_head_is_half_as_fast_again_on_accents_as_elsewhere_in_speech(clips) -> None:
    near, far = [], []
    for said, curves in clips:
        times = np.arange(len(curves["head_yaw"])) / FPS
        spoken = np.any([(times >= w.start) & (times < w.end) for w in said.words], axis=0)
        accents = np.array([said.syllables[a.syllable].start for a in said.accents])
        on = np.abs(np.subtract.outer(times, accents)).min(axis=1) <= 0.15
        near.append(speed(curves)[spoken & on])
        far.append(speed(curves)[spoken & ~on])
    assert np.concatenate(near).mean() >= 1.5 * np.concatenate(far).mean()


def test_the_head_has_gone_home_soon_after_the_last_word(clips) -> None:
    for said, curves in clips:
        end = said.words[-1].end
        assert max(abs(curves[name]).max() for name in AXES) > 2.0
        for name in AXES:
            assert abs(curves[name][round(FPS * (end + 0.5)) :]).max() < 1.0


def test_pauses_slow_the_head_down(clips) -> None:
    for said, curves in clips:
        times = np.arange(len(curves["head_yaw"])) / FPS
        spoken = np.any([(times >= w.start) & (times < w.end) for w in said.words], axis=0)
        last = times > said.words[-1].end + 0.45
        assert speed(curves)[last].mean() < 0.35 * speed(curves)[spoken].mean()


def test_the_melody_goes_home_slowly_in_a_long_pause_and_soon_at_the_end(sentence_of: Maker) -> None:
    said = sentence_of("One two[H*] three. Four five six[H*].", pause=0.6, tail=2.0)
    said = replace(said, syllables=tuple(replace(s, pitch=2.0) for s in said.syllables))
    found = compose(ChannelInputs(said.duration, said)).movements
    melody = [m for m in found if m.cause.rule == "head.melody.pitch"]
    curve = combine(
        replace(compose(ChannelInputs(said.duration, said)), movements=tuple(melody), lips=()), Fraction(FPS)
    )
    pitch = curve.curves["head_pitch"]
    inner, last = (p for p in said.pauses if p.start > 0.0)
    assert pitch[round(FPS * last.start)] > 2.0
    assert np.abs(pitch[round(FPS * (last.start + 0.31)) : round(FPS * last.end)]).max() < 1e-6
    went = pitch[round(FPS * inner.start)] - pitch[round(FPS * inner.end) - 1]
    assert went == pytest.approx(2.0 * (inner.end - inner.start), rel=0.1)


def test_the_melody_is_held_through_a_short_pause(sentence_of: Maker) -> None:
    said = sentence_of("One two[H*] three, four five six[H*].", pause=0.3)
    heights = [2.0 if s.word < 3 else -1.0 for s in said.syllables]
    syllables = tuple(replace(s, pitch=h) for s, h in zip(said.syllables, heights, strict=True))
    said = replace(said, syllables=syllables)
    score = compose(ChannelInputs(said.duration, said))
    melody = tuple(m for m in score.movements if m.cause.rule == "head.melody.pitch")
    pitch = combine(replace(score, movements=melody, lips=()), Fraction(FPS)).curves["head_pitch"]
    pause = next(p for p in said.pauses if p.start > 0.0)
    held = pitch[round(FPS * pause.start) + 1 : round(FPS * pause.end)]
    assert held.min() > 4.0
    assert np.ptp(held) < 1e-6


@pytest.mark.parametrize("name", ["neutral", "lively", "reserved", "authoritative"])
@pytest.mark.parametrize("pause", [0.15, 0.3, 0.7])
def test_every_inner_pause_is_slower_than_half_of_speech(name: str, pause: float, sentence_of: Maker) -> None:
    text = (
        "Yes[H*], the ferry[H*], you know, was late[H*]. No[H*], nobody[L+H*] saw it, or heard[H*] it! "
        "Well[H*], if the captain[H*] sleeps, who[H*] will steer? I never[L+H*] asked, I promise[H*]."
    )
    said = measured(sentence_of(text, phone=0.08, pause=pause))
    for seed in range(4):
        score = compose(
            ChannelInputs(said.duration, said, profile=profile(name)), seed=seed, without=("lips",)
        )
        moving = speed(combine(score, Fraction(60)).curves) * 60 / FPS
        times = np.arange(len(moving)) / 60
        spoken = np.any([(times >= w.start) & (times < w.end) for w in said.words], axis=0)
        accents = [said.syllables[a.syllable].start for a in said.accents]
        peaks = [moving[spoken & (np.abs(times - a) <= 0.15)].max() for a in accents]
        inner = [p for p in said.pauses if 0.0 < p.start < said.words[-1].end]
        assert len(inner) == 11
        for quiet in inner:
            inside = moving[(times >= quiet.start) & (times < quiet.end)]
            assert inside.mean() < 0.5 * moving[spoken].mean(), (seed, quiet)
            assert inside.max() < np.mean(peaks), (seed, quiet)


@pytest.mark.parametrize("seed", range(6))
def test_no_beat_begins_in_a_pause(seed: int, sentence_of: Maker) -> None:
    said = sentence_of(
        "Well[H*], then[H*], so[H*], one[H*] more[L+H*], good[H*]. Fine[H*], no[H*].", phone=0.1
    )
    found = compose(ChannelInputs(said.duration, said), seed=seed).movements
    beats = [m for m in found if m.cause.rule.startswith(("signals.nod", "signals.swing", "head.verbal"))]
    assert beats
    starts = [m.start for m in beats if not m.layer.endswith("gesture") or m.id.endswith(".1")]
    assert not [s for s in starts for p in said.pauses if p.start < s < p.end]


def test_the_tilt_of_a_comma_rises_over_the_last_word_and_is_left_over_the_next(sentence_of: Maker) -> None:
    for seed in range(20):
        said = sentence_of("One two longest[H*], remarkable three four.", phone=0.09)
        found = compose(ChannelInputs(said.duration, said), seed=seed).movements
        pause = next(p for p in said.pauses if p.start > 0.0)
        for tilt in (m for m in found if m.cause.rule == "punctuators.tilt.comma"):
            assert tilt.start <= said.words[2].start + 1e-6
            assert tilt.start + tilt.onset == pytest.approx(pause.start)
            assert tilt.end - tilt.offset == pytest.approx(pause.end)
            assert tilt.end >= said.words[3].end - 1e-6


def test_the_melody_is_quick_on_accents_and_slow_between_them(sentence_of: Maker) -> None:
    said = sentence_of("One two three[H*] four five six.")
    pitches = (0.5, -0.5, 2.0, 1.0, 0.0, -1.0)
    said = replace(
        said, syllables=tuple(replace(s, pitch=p) for s, p in zip(said.syllables, pitches, strict=True))
    )
    found = compose(ChannelInputs(said.duration, said)).movements
    melody = [m for m in found if m.cause.rule == "head.melody.pitch"]
    assert [m.targets["head_pitch"] > 1.0 for m in melody] == [False, True, False, False]
    assert [round(m.onset, 2) for m in melody] == [0.48, 0.24, 0.72, 0.24]


SAMPLE = 22_050
EDGES = st.lists(st.integers(0, 5 * SAMPLE), max_size=8, unique=True).map(
    lambda samples: [sample / SAMPLE for sample in sorted(samples)]
)


@given(EDGES, st.integers(0, 1000))
@example([0.00816326530612245, 0.1509297052154195, 0.8868480725623583, 2.586621315192744], 141)
def test_each_movement_of_the_noise_begins_where_the_last_one_ends(edges: list[float], seed: int) -> None:
    steps = list(noise_steps((0.5, 1.3), edges, edges[-1:], 5.0, CounterRng(seed)))
    assert steps[0][0] == 0.0
    assert steps[-1][1] >= 5.0
    assert all(a[1] == b[0] and on_tick(a[0]) < on_tick(b[0]) for a, b in pairwise(steps))
    assert {edge for edge in edges if 0.0 < edge < 5.0} <= {start for start, _, _ in steps}
    assert all(0.0 < share <= 1.0 for _, _, share in steps)
