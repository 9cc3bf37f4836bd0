"""What both papers print as formulas, recomputed beside the curves that are shown; and jumps: none."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from risorius.blend import combine
from risorius.channels import ChannelInputs, Display, compose
from risorius.core.counter_rng import CounterRng
from risorius.core.movement import Movement
from risorius.core.parameters import INDEX, PARAMETERS
from risorius.core.score import Score
from risorius.core.speech.utterance import Utterance
from risorius.face.fit.lip_file import load_lip_rig
from risorius.rules.profiles import profile_of

from .channels.at_work import INNER, LID, Maker
from .paper_curves import FPS, FRAME, SMILE, active, closures, performed, shown, value

# Combination (paper B, sections 4.4 and 6.4; paper A, sections 4 to 6)


def test_attenuated_directions_follow_the_formula() -> None:
    slow = Movement("head", 0.2, 2.8, 1.0, 1.0, {"head_pitch": 12.0}, function="minimum_jerk")
    nod = Movement("signals", 1.0, 1.6, 0.2, 0.2, {"head_pitch": -8.0}, function="minimum_jerk")
    one, two, both = (performed(m, 3.0)["head_pitch"] for m in ([slow], [nod], [slow, nod]))
    wanted = one / (1 + 0.5 * np.abs(two) / 20.0) + two / (1 + 0.5 * np.abs(one) / 20.0)
    assert np.abs(both - wanted).max() < 1e-5


def test_attenuated_units_add_and_a_rival_leaves_a_fifth() -> None:
    brow = Movement("emotion", 0.2, 2.8, 0.4, 0.4, {"AU1": 0.5})
    more = Movement("signals", 0.8, 1.8, 0.2, 0.2, {"AU1": 0.4})
    both = performed([brow, more], 3.0, conflict="attenuate")[INNER]
    assert value(both, 1.3) == pytest.approx(0.9, abs=1e-6)
    smile = Movement("emotion", 0.2, 2.8, 0.4, 0.4, {SMILE: 0.8})
    lips = Movement("signals", 0.8, 1.8, 0.2, 0.2, {"orbicularis_oris_funneler": 0.7})
    alone, rival = (performed([m], 3.0)[n] for m, n in ((smile, SMILE), (lips, "orbicularis_oris_funneler")))
    shared = performed([smile, lips], 3.0, conflict="attenuate")[SMILE]
    assert np.abs(shared - alone * (1 - 0.8 * rival)).max() < 1e-5


def test_a_rival_inhibits_by_paper_a_s_formula() -> None:
    """aF = 0 where the rival is over its threshold, else min(F, Psi to the last time and to the next)."""
    fps = 1000
    smile = Movement("emotion", 0.2, 3.8, 0.4, 0.4, {SMILE: 0.8})
    lips = Movement("signals", 1.5, 2.2, 0.2, 0.2, {"orbicularis_oris_funneler": 0.9})
    name, rival = PARAMETERS[INDEX[SMILE]], PARAMETERS[INDEX["orbicularis_oris_funneler"]]
    alone, other = (performed([m], 4.0, fps)[n.name] for m, n in ((smile, name), (lips, rival)))
    shared = performed([smile, lips], 4.0, fps, conflict="inhibit")[SMILE]
    times = np.arange(len(alone)) / fps
    inhibited = times[other > rival.threshold]
    since, until = times - inhibited[-1], inhibited[0] - times
    psi = np.minimum(
        np.where(since > 0, 2.0 ** (since / name.min_onset) - 1.0, np.inf),
        np.inf if not inhibited.size else np.where(since > 0, np.inf, 2.0 ** (until / name.min_offset) - 1.0),
    )
    wanted = np.where(other > rival.threshold, 0.0, np.minimum(alone, np.minimum(psi, 1.0)))
    assert np.abs(shared - wanted).max() < 0.01
    strong = replace(smile, priority=80)
    assert np.abs(performed([strong, lips], 4.0, fps, conflict="inhibit")[SMILE] - alone).max() < 1e-6


def test_a_movement_rises_holds_and_falls_by_paper_a_s_functions() -> None:
    """Figure 4: 7 s, of which 2 s of onset and 3 s of offset."""
    curve = performed([Movement("signals", 0.5, 7.5, 2.0, 3.0, {INNER: 0.8})], 8.0)[INNER]
    times = np.arange(len(curve)) * FRAME
    rise = 2.0 ** ((times - 0.5) / 2.0) - 1.0
    fall = 2.0 ** (1.0 - (times - 4.5) / 3.0) - 1.0
    wanted = 0.8 * np.clip(np.minimum(np.minimum(rise, fall), 1.0), 0.0, None)
    assert np.abs(curve - wanted).max() < 1e-6


def test_a_channel_rises_to_a_higher_target_early_and_waits() -> None:
    """Section 5.2, case 1: by the second onset from where the first one is; then as it is alone."""
    one = Movement("signals", 0.5, 3.0, 0.4, 1.0, {INNER: 0.4})
    two = Movement("signals", 2.0, 4.0, 0.8, 0.4, {INNER: 1.0})
    curve = performed([one, two], 5.0)[INNER]
    times = np.arange(len(curve)) * FRAME
    early = (times > 2.0) & (times < 2.8)
    wanted = np.minimum(0.4 + 2.0 ** ((times[early] - 2.0) / 0.8) - 1.0, 1.0)
    assert np.abs(curve[early] - wanted).max() < 1e-5
    after = times > 2.8
    assert np.abs(curve[after] - performed([two], 5.0)[INNER][after]).max() < 1e-6


def test_the_largest_of_the_channels_is_shown_and_exponentials_have_paper_a_s_shape() -> None:
    low = Movement("emotion", 0.2, 2.8, 0.4, 0.4, {INNER: 0.4})
    high = Movement("signals", 0.8, 1.8, 0.2, 0.2, {INNER: 0.7})
    one, two, both = (performed(found, 3.0)[INNER] for found in ([low], [high], [low, high]))
    assert np.abs(both - np.maximum(one, two)).max() < 1e-7


def test_movements_of_a_channel_concatenate_by_paper_a_s_formulas() -> None:
    """Figure 5: from 1 at 2 s to 0.5, by the first one's own offset shifted to where it fits."""
    one = Movement("signals", 0.5, 3.0, 0.4, 1.0, {INNER: 1.0})
    two = Movement("signals", 2.0, 4.0, 0.6, 0.4, {INNER: 0.5})
    curve = performed([one, two], 5.0)[INNER]
    times = np.arange(len(curve)) * FRAME
    rise = (times >= 0.5) & (times <= 0.9)
    assert np.abs(curve[rise] - (2.0 ** ((times[rise] - 0.5) / 0.4) - 1.0)).max() < 1e-5
    shift = 1.0 * (1.0 - np.log2(1.0 + 0.5))
    fall = (times > 2.0) & (times < 2.0 + 1.0 - shift)
    wanted = 0.5 + (2.0 ** (1.0 - (times[fall] - 2.0 + shift)) - 1.0)
    assert np.abs(curve[fall] - wanted).max() < 1e-5
    assert value(curve, 3.2) == pytest.approx(0.5)


def test_random_blinks_of_itti_wait_since_the_last_shift_of_attention_or_blink() -> None:
    speaker = profile_of("neutral", "itti")
    curves = performed(compose(ChannelInputs(90.0, profile=speaker), seed=1).movements, 90.0)
    world = [curves[f"gaze_{a}"] + curves[f"head_{a}"] for a in ("pitch", "yaw")]
    quick = FPS * np.hypot(*np.diff(world)) > 40.0
    edges = np.flatnonzero(np.diff(np.concatenate(([False], quick, [False])).astype(int))).reshape(-1, 2)
    far = [b for a, b in edges if np.hypot(*(axis[b] - axis[a] for axis in world)) > 5.5]
    saccades = np.array(far) * FRAME  # those that scan the listener's face are smaller
    spans = closures(curves[LID], 1e-3)
    assert len(spans) > 10
    assert len(edges) > len(far) + 20
    assert len(far) > 5
    for (_, last), (start, end) in pairwise(spans):
        before = max([last, *saccades[saccades <= start]])
        assert start - before >= speaker.blinks.wait - 0.06
        assert end - start == pytest.approx(0.19, abs=0.02)


def test_an_emblem_is_weaker_shorter_and_a_part_of_its_display(sentence_of: Maker) -> None:
    said = sentence_of("She was very sad[H*] then.")
    emblem = shown(said, "emotion.emblem.sadness")
    display = shown(said, "none", also=("emotion",), emotions=(Display("sadness", 1.0),))
    moved, whole = (
        {n for n, c in curves.items() if n != "gaze_distance" and np.ptp(c) > 0.02}
        for curves in (emblem, display)
    )
    assert moved
    assert moved < whole
    assert all(emblem[n].max() < display[n].max() for n in moved)
    start, end = active(emblem[next(iter(moved))])
    assert end - start < 1.5


# Jumps: none


def measured(said: Utterance) -> Utterance:
    """Return an utterance whose syllables have pitch, as those of measured sound."""
    numbers = CounterRng(5)
    pitched = tuple(replace(s, pitch=numbers.normal(i, limit=2.0)) for i, s in enumerate(said.syllables))
    return replace(said, syllables=pitched)


@pytest.fixture(scope="module")
def scores(sentence_of: Maker) -> list[Score]:
    """Scores of several sentences, speakers and emotions, with all that habits and rules do."""
    texts = (
        "The council[H*] waited, because nobody[H*] had the money[L+H*]. You like it?",
        "Well[H*], what about Julia[H*]? She likes popcorn[L+H*]! No[H*], never.",
        "I am sure[H*]… very sure[H*]. Yes, I do.",
    )
    felt = (("happiness", 0.8), ("anger", 1.0), ("sadness", 0.6))
    found = []
    for seed, (text, (name, much)) in enumerate(zip(texts, felt, strict=True)):
        said = measured(sentence_of(text, phone=0.08, pause=0.4, tail=2.0))
        inputs = ChannelInputs(said.duration, said, emotions=(Display(name, much, 0.3, said.duration - 0.5),))
        found.append(compose(inputs, seed=seed))
    return found


RIG = load_lip_rig("standard")


@pytest.mark.parametrize("conflict", ["graded", "inhibit", "attenuate"])
def test_no_curve_jumps(scores: list[Score], conflict: str) -> None:
    """Where a curve is continuous its largest step shrinks with the frame; that of a jump stays.

    Four times as many frames make it at least half as large: saccades, blinks and what inhibits at once are
    over within few frames at 100 frames a second, so all are looked at between 400 and 1600.
    """
    for score in scores:
        blend = replace(score.settings, conflict=conflict)
        steps = {
            fps: {
                n: np.abs(np.diff(c)).max()
                for n, c in combine(replace(score, settings=blend), Fraction(fps), RIG).curves.items()
            }
            for fps in (400, 1600)
        }
        for name, coarse in steps[400].items():
            least = 1e-3 if name.startswith(("gaze", "head")) else 1e-4
            assert steps[1600][name] <= max(0.5 * coarse, least), (name, conflict)
