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


def test_the_melody_is_released_where_a_pause_begins(sentence_of: Maker) -> None:
    said = sentence_of("One two[H*] three. Four five six[H*].", pause=0.6, tail=2.0)
    said = replace(said, syllables=tuple(replace(s, pitch=2.0) for s in said.syllables))
    found = compose(ChannelInputs(said.duration, said)).movements
    melody = [m for m in found if m.cause.rule == "head.melody.pitch"]
    curve = combine(
        replace(compose(ChannelInputs(said.duration, said)), movements=tuple(melody), lips=()), Fraction(FPS)
    )
    pitch = curve.curves["head_pitch"]
    ends = {word.end for word in said.words}
    for pause in (p for p in said.pauses if p.start in ends):
        assert pitch[round(FPS * pause.start)] > 2.0
        assert np.abs(pitch[round(FPS * (pause.start + 0.31)) : round(FPS * pause.end)]).max() < 1e-6


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
