"""The combination as a whole: invalid scores first, then the laws of DESIGN, section 3."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from risorius import blend
from risorius.blend.layer_priority import ONE_PRIORITY
from risorius.blend.plan import CHUNK, Plan, PlanSample
from risorius.core.movement import Dominance, LipSegment, Movement
from risorius.core.parameters import INDEX, NAMES, NEUTRAL, PARAMETERS, RIVALS
from risorius.core.score import BlendSettings, Score
from risorius.errors import InputError, ParameterError
from tests.profiles import everyday, examples, samples

from . import reference
from .strategies import DURATION, movements, scores, speech

RATE = samples(2000, everyday=500)
"""Hz, at which curves are searched for jumps and compared."""
POLICIES = ("inhibit", "graded", "attenuate", "sum")
SMILE = Movement("emotion", 0.0, 4.0, 0.45, 0.75, {"zygomatic_major.left": 0.8})


def with_settings(**changes: object) -> BlendSettings:
    return replace(BlendSettings(), **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("score", "error", "words"),
    [
        (Score(4.0, settings=with_settings(conflict="graaded")), ParameterError, "did you mean 'graded'"),
        (
            Score(4.0, settings=with_settings(lips="dominanse")),
            ParameterError,
            "dominance",
        ),
        (
            Score(4.0, settings=with_settings(onset_function="linaer")),
            ParameterError,
            "did you mean 'linear'",
        ),
        (Score(4.0, settings=with_settings(activation_threshold=1.5)), InputError, "expected 0 to 1"),
        (Score(4.0, settings=with_settings(min_onset=-0.1)), InputError, "min_onset"),
        (Score(4.0, settings=with_settings(min_offset=float("nan"))), InputError, "min_offset"),
        (Score(-1.0), InputError, "duration"),
        (Score(4.0, (SMILE, replace(SMILE, end=2.0))), InputError, "both start at"),
        (Score(4.0, (replace(SMILE, targets={"zygomatic_major": 0.5}),)), ParameterError, "did you mean"),
        (
            Score(4.0, (), (LipSegment("M", 0, 1, {"head_yaw": 3.0}),)),
            InputError,
            "lips cannot move head_yaw",
        ),
        (
            Score(4.0, (), (LipSegment("M", 0, 1, {}, {}, {"*": Dominance(-1.0)}),)),
            InputError,
            "dominance",
        ),
        (
            Score(4.0, (), (LipSegment("M", 0, 1, {}, precision={"*": -1.0}),)),
            InputError,
            "precision of \\* = -1",
        ),
        (
            Score(4.0, (), (LipSegment("M", 0, 1, {}, precision={"*": float("nan")}),)),
            InputError,
            "precision",
        ),
    ],
)
def test_what_cannot_be_performed_is_refused(score: Score, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        blend.combine(score, Fraction(30))


class TestResult:
    def test_an_empty_score_is_neutral(self) -> None:
        performance = blend.combine(Score(2.0), Fraction(30))
        assert performance.values.shape == (61, len(NAMES))
        assert (performance.values == NEUTRAL).all()

    def test_no_times_give_no_values(self) -> None:
        assert blend.at(Score(2.0, (SMILE,)), np.zeros(0)).shape == (0, len(NAMES))

    def test_fractional_frame_rate(self) -> None:
        performance = blend.combine(Score(2.0, (SMILE,)), Fraction(24000, 1001))
        assert len(performance.values) == 49
        assert performance.score.movements == (SMILE,)

    def test_times_may_come_in_any_order(self) -> None:
        times = np.array([3.0, 0.2, 1.7, 0.2])
        assert (
            blend.at(Score(4.0, (SMILE,)), times)
            == blend.at(Score(4.0, (SMILE,)), np.sort(times))[[3, 0, 2, 1]]
        ).all()

    @pytest.mark.full
    def test_chunks_do_not_show(self) -> None:
        times = np.linspace(118.0, 122.0, 400)
        segment = LipSegment("UW", 119.5, 120.3, {"orbicularis_oris_funneler": 0.9})
        movement = replace(SMILE, start=118.0, end=121.9)
        score = Score(130.0, (movement,), (segment,))
        many = np.concatenate((times, np.linspace(0, 1, CHUNK)))
        together = blend.at(score, many)[: len(times)]
        alone = np.concatenate([blend.at(score, times[i : i + 1]) for i in range(len(times))])
        assert together == pytest.approx(alone, abs=1e-12)


@pytest.mark.parametrize("policy", POLICIES)
@examples(25)
@given(found=movements(("signals",), most=1, shortest=1))
def test_a_lone_movement_is_reproduced(policy: str, found: tuple[Movement, ...]) -> None:
    for movement in found:
        score = Score(DURATION, (movement,), settings=with_settings(conflict=policy))
        times = np.arange(0, DURATION, 0.033)
        values = blend.at(score, times)
        (span,) = reference.order([movement])
        for name, target in movement.targets.items():
            neutral = NEUTRAL[INDEX[name]]
            expected = [neutral + reference.alone(span, target - neutral, t) for t in times]
            assert values[:, INDEX[name]] == pytest.approx(np.array(expected), abs=1e-12)
        still = [i for i, name in enumerate(NAMES) if name not in movement.targets]
        assert (values[:, still] == NEUTRAL[still]).all()


@pytest.mark.parametrize("policy", everyday(POLICIES, ["graded"]))
@examples(9)
@given(data=st.data())
def test_curves_are_continuous(policy: str, data: st.DataObject) -> None:
    """Where a curve changes most between two times, the change does not survive halving their distance."""
    plan = Plan(data.draw(scores(policy)))
    times = np.arange(0.0, DURATION, 1 / RATE)
    steps = np.abs(np.diff(plan.at(times), axis=0)) * [1 / 20 if p.signed else 1.0 for p in PARAMETERS]
    columns = np.argsort(steps.max(axis=0))[-3:]
    rows = np.argmax(steps[:, columns], axis=0)
    low, high = times[rows], times[rows + 1]
    for _ in range(24):
        middle = (low + high) / 2
        a, b, c = np.split(plan.at(np.concatenate((low, middle, high))), 3)
        first, second = (np.abs(np.diagonal(part[:, columns])) for part in (b - a, c - b))
        low, high = np.where(first > second, low, middle), np.where(first > second, middle, high)
    assert max(first.max(), second.max()) < 1e-5


@pytest.mark.parametrize("policy", POLICIES)
@examples(15)
@given(data=st.data())
def test_values_stay_in_range(policy: str, data: st.DataObject) -> None:
    score = data.draw(scores(policy))
    values = blend.at(score, np.arange(0.0, DURATION, 0.011))
    assert (values >= [p.low for p in PARAMETERS]).all()
    assert (values <= [p.high for p in PARAMETERS]).all()


@pytest.mark.parametrize("policy", POLICIES)
@examples(15)
@given(data=st.data())
def test_order_of_input_does_not_matter(policy: str, data: st.DataObject) -> None:
    score = data.draw(scores(policy))
    # Of equals that start together the later in the score wins (test_layer_priority).
    assume(len({(m.channel, m.start) for m in score.movements}) == len(score.movements))
    shuffled = replace(
        score,
        movements=tuple(data.draw(st.permutations(score.movements))),
        lips=tuple(data.draw(st.permutations(score.lips))),
    )
    times = np.arange(0.0, DURATION, 0.05)
    assert (blend.at(score, times) == blend.at(shuffled, times)).all()


@pytest.mark.parametrize("policy", POLICIES)
@examples(15)
@given(data=st.data(), delay=st.sampled_from((0.5, 7.0, 119.25)))
def test_a_shifted_score_gives_shifted_curves(policy: str, data: st.DataObject, delay: float) -> None:
    score = data.draw(scores(policy))
    later = replace(
        score,
        duration=score.duration + delay,
        movements=tuple(replace(m, start=m.start + delay, end=m.end + delay) for m in score.movements),
        lips=tuple(replace(s, start=s.start + delay, end=s.end + delay) for s in score.lips),
    )
    times = np.arange(0, 64 * 6) / 64
    assert blend.at(later, times + delay) == pytest.approx(blend.at(score, times), abs=1e-9)


def _mirrored(name: str) -> str:
    return name.replace(".left", ".#").replace(".right", ".left").replace(".#", ".right")


@examples(20)
@given(score=scores())
def test_a_mirrored_score_gives_mirrored_curves(score: Score) -> None:
    def flip(mapping: dict[str, object]) -> dict[str, object]:
        return {_mirrored(name): value for name, value in mapping.items()}

    mirrored = replace(
        score,
        movements=tuple(replace(m, targets=flip(dict(m.targets))) for m in score.movements),
        lips=tuple(
            replace(s, targets=flip(dict(s.targets)), limits=flip(dict(s.limits))) for s in score.lips
        ),
    )
    times = np.arange(0.0, DURATION, 0.03)
    columns = [INDEX[_mirrored(name)] for name in NAMES]
    assert blend.at(mirrored, times)[:, columns] == pytest.approx(blend.at(score, times), abs=1e-12)


@examples(25)
@given(score=scores())
def test_the_frame_rate_does_not_matter(score: Score) -> None:
    slow = blend.combine(score, Fraction(30)).values
    fast = blend.combine(score, Fraction(1000)).values
    assert slow[::3] == pytest.approx(fast[::100], abs=1e-12)


@examples(40)
@given(score=scores())
def test_inhibit_never_shows_two_rivals_of_different_priority(score: Score) -> None:
    plan = Plan(score)
    times = np.arange(0.001, DURATION, 0.0079)
    sample = PlanSample(plan, times)
    shown = {}
    for name in (name for name in plan.moving if RIVALS[name]):
        for entry in sample.ledger(name).entries():
            dense = np.zeros(len(times))
            dense[entry.index] = entry.applied
            shown[id(entry.channel), name] = dense > plan.tuning.threshold[name] + 2e-9
    # Strata share their channel's name.
    names = {id(c): c.name for c in plan.channels}
    levels = {id(c): c.levels.at(times) for c in plan.channels}
    for (one, name), up in shown.items():
        for (two, other), also in shown.items():
            if names[one] != names[two] and other in RIVALS[name]:
                # Strata of channels of one priority differ by a few steps.
                differ = np.abs(levels[one] - levels[two]) > ONE_PRIORITY
                assert not (up & also & differ).any()


@examples(25)
@given(score=scores(priorities=False))
def test_inhibit_changes_nothing_far_from_a_conflict(score: Score) -> None:
    plan = Plan(score)
    times = np.arange(0.001, DURATION, 0.0083)
    sample = PlanSample(plan, times)
    for channel in plan.channels:
        for name in channel.curves:
            reach = max(plan.tuning.min_onset[name], plan.tuning.min_offset[name])
            near = np.zeros(len(times), dtype=bool)
            for level in channel.levels.distinct:
                for other, _, rival in plan.inputs.rivals(channel, name, level):
                    for start, end in other.above(rival, plan.tuning.threshold[rival]):
                        near |= (times > start - reach) & (times < end + reach)
            entry = sample.ledger(name).entry(channel)
            far = ~near[entry.index]
            assert (entry.resolved[far] == entry.requested[far]).all()


def test_a_change_of_priority_makes_no_jump() -> None:
    strong = Movement(
        "emotion", 0.0, 4.0, 0.3, 1.5, {"zygomatic_major.left": 1.0}, priority=80.0, release_priority=10.0
    )
    rounded = Movement("signals", 1.0, 5.0, 0.3, 0.3, {"orbicularis_oris_funneler": 0.9})
    values = blend.at(Score(5.0, (strong, rounded)), np.arange(0, 5, 1e-4))
    smile, funnel = (values[:, INDEX[n]] for n in ("zygomatic_major.left", "orbicularis_oris_funneler"))
    assert np.abs(np.diff(values, axis=0)).max() < 2e-3
    assert smile[20000] == 1.0
    assert funnel[20000] == 0.0
    assert smile[30000] == 0.0
    assert funnel[30000] == pytest.approx(0.9)


Curve = Callable[[np.ndarray], np.ndarray]


@examples(12)
@given(found=movements(("manipulators", "signals", "emotion"), most=3, directions=False, layers=("",)))
def test_inhibit_agrees_with_a_search_over_samples(found: tuple[Movement, ...]) -> None:
    """Section 6 of paper A done on samples, level after level, with one minimum duration for all."""
    minimum, frame = 0.2, 1 / RATE
    score = Score(DURATION, found, settings=with_settings(min_onset=minimum, min_offset=minimum))
    times = np.arange(0, 9.0, frame)
    result = dict(zip(NAMES, blend.at(score, times).T, strict=True))
    expected = _inhibited_on_samples(found, times, minimum)
    slope = 2 * np.log(2) / minimum
    for name, curve in expected.items():
        assert result[name] == pytest.approx(curve, abs=3 * slope * frame)


def _inhibited_on_samples(
    found: tuple[Movement, ...], times: np.ndarray, minimum: float
) -> dict[str, np.ndarray]:
    names = sorted({name for m in found for name in m.targets})
    active: dict[str, np.ndarray] = {}
    combined = {name: np.zeros(len(times)) for name in names}
    for channel in ("manipulators", "signals", "emotion"):
        held = [m for m in found if m.channel == channel]
        wanted = {n: _alone(held, n, times) for n in names}
        settled_here = {}
        for name in names:
            stopped = np.any(
                [active[r] for r in RIVALS[name] if r in active] or [np.zeros(len(times), bool)], axis=0
            )
            settled_here[name] = _restrained(wanted[name], stopped, times, minimum)
            combined[name] = np.maximum(combined[name], settled_here[name])
        for name, curve in settled_here.items():
            active[name] = active.get(name, False) | (curve > 0.1)
    return combined


def _alone(held: list[Movement], name: str, times: np.ndarray) -> np.ndarray:
    """The concatenation is proven elsewhere (test_concatenate); here it is the input."""
    alone = tuple(
        replace(m, channel="emotion", targets={k: v for k, v in m.targets.items() if k == name}) for m in held
    )
    return blend.at(Score(DURATION, alone), times)[:, INDEX[name]]


def _restrained(curve: np.ndarray, stopped: np.ndarray, times: np.ndarray, minimum: float) -> np.ndarray:
    where = np.flatnonzero(stopped)
    if not len(where):
        return curve
    k = np.searchsorted(where, np.arange(len(times)))
    last = np.where(k > 0, times[where[np.maximum(k - 1, 0)]], -np.inf)
    following = np.where(k < len(where), times[where[np.minimum(k, len(where) - 1)]], np.inf)
    left = np.exp2(np.minimum((times - last) / minimum, 1)) - 1
    right = np.exp2(np.minimum((following - times) / minimum, 1)) - 1
    return np.where(stopped, 0.0, np.minimum(curve, np.minimum(left, right)))


@examples(10)
@given(lips=speech())
def test_speech_alone_leaves_all_else_at_rest(lips: tuple[LipSegment, ...]) -> None:
    values = blend.at(Score(DURATION, (), lips), np.arange(0, DURATION, 0.02))
    aimed = {name for s in lips for name in s.targets}
    still = [i for i, name in enumerate(NAMES) if name not in aimed]
    assert (values[:, still] == NEUTRAL[still]).all()


def test_a_plan_takes_over_the_work_on_the_same_lips_and_gives_the_same_values():
    lips = tuple(
        LipSegment(phone, 0.2 * k, 0.2 * k + 0.2, {"masseter": 0.1 * (k % 5), "mentalis.left": 0.3})
        for k, phone in enumerate("ABCDEFGHIJ")
    )
    smile = Movement("emotion", 0.3, 1.7, 0.2, 0.3, {"zygomatic_major.left": 0.8})
    one = Plan(Score(2.0, (smile,), lips))
    moved = replace(one.score, movements=(replace(smile, start=0.6),))
    two = Plan(moved, like=one)
    assert two.lips is one.lips
    times = np.linspace(0.0, 2.0, 200)
    assert np.array_equal(two.at(times), Plan(moved).at(times))
    others = (
        replace(moved, lips=lips[:-1]),
        replace(moved, settings=BlendSettings(lips="lookahead")),
        replace(moved, settings=BlendSettings(min_onset=0.2)),
        replace(moved, settings=BlendSettings(contact=False)),
    )
    for other in others:
        assert Plan(other, like=one).lips is not one.lips
    graded = replace(moved, settings=BlendSettings(conflict="graded"))
    assert Plan(graded, like=one).lips is one.lips
    assert np.array_equal(Plan(graded, like=one).at(times), Plan(graded).at(times))
