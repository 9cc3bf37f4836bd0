"""What paper B asks, on the curves that are shown: each rule read off a curve.

Rules fire wherever they can here; a curve is that of the movements that they made, combined as in any
performance.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.channels import ChannelInputs, Display, compose
from risorius.core.action_units import resolve_targets
from risorius.core.movement import Movement
from risorius.core.parameters import RIVALS
from risorius.core.speech.utterance import PauseKind, Utterance
from risorius.rules.emotions import emotion, emotion_text
from risorius.rules.profiles import profile_of
from risorius.rules.rule_set import extended, shipped

from .channels.at_work import FROWN, INNER, LID, LONG, PUNCTUATED, THOUGHT_OUT, Maker, movements
from .paper_curves import (
    FPS,
    FRAME,
    HEAD,
    NOSE,
    OUTER,
    SMILE,
    Curves,
    active,
    closures,
    edges_of,
    minimum_jerk,
    near,
    part,
    performed,
    shown,
    value,
)

TOLD = " ".join(
    [
        "The council[H*] waited for the spring[H*] of that year, because nobody[H*] had the money[L+H*].",
        "Then a woman[H*] called Marta walked into the meeting[H*] with a drawing[H*] under her arm.",
    ]
    * 6
)


# Paper B, section 2.1


def test_accents_gather_rapid_movements(sentence_of: Maker) -> None:
    accented, plain = sentence_of("She likes popcorn[L+H*]."), sentence_of("She likes popcorn.")
    curves, without = shown(accented, "signals."), shown(plain, "signals.")
    word = accented.words[2]
    for name in (INNER, OUTER, "depressor_labii.left", LID, "head_pitch"):
        start, end = active(curves[name])
        assert word.start - 0.15 <= start < word.end
        assert end <= word.end + 0.35
        assert np.ptp(without[name]) == 0.0


def test_commas_are_slow_and_accents_are_quick(sentence_of: Maker) -> None:
    slow, quick = [], []
    for seed in range(12):
        curves = shown(sentence_of("One two[H*], three four."), "punctuators.tilt", "signals.nod", seed=seed)
        slow.append(np.abs(np.diff(curves["head_roll"])).max())
        quick.append(np.abs(np.diff(curves["head_pitch"])).max())
    assert 0.0 < np.mean(slow) < 0.6 * np.mean(quick)


def test_the_last_pause_is_still(sentence_of: Maker) -> None:
    said = sentence_of("One two, three four.", tail=1.5)
    curves = shown(said, "punctuators.", also=("emotion",), emotions=(Display("happiness", 0.6),))
    held = {name: part(c, said.words[-1].end + 0.6, said.duration - 0.05) for name, c in curves.items()}
    assert max(float(np.ptp(c)) for name, c in held.items() if "palpebralis" not in name) < 1e-9
    assert held[SMILE].min() > 0.6


@pytest.mark.parametrize("text", ["One, two.", "One. Two."])
def test_eyes_close_in_pauses(text: str, sentence_of: Maker) -> None:
    said = sentence_of(text)
    for start, _ in closures(shown(said, "punctuators.lids")[LID]):
        assert any(p.start - 0.05 <= start <= p.end for p in said.pauses)


def test_eyes_are_kept_wet_at_human_rates(sentence_of: Maker) -> None:
    said = sentence_of(TOLD)
    count = 0
    for seed in range(4):
        found = compose(ChannelInputs(said.duration, said), seed=seed).movements
        lids = performed([m for m in found if LID in m.parameters], said.duration)[LID]
        count += len(closures(lids, 0.3))
    assert 15.0 <= count / (4 * said.duration / 60.0) <= 26.0


def strongest(curves: Curves, unit: str, time: float) -> float:
    """Return how far the muscles that have most of a unit contract, at a time."""
    weights = resolve_targets({unit: 1.0})
    most = max(weights.values())
    return max(value(curves[name], time) for name, weight in weights.items() if weight == most)


@pytest.mark.parametrize(
    ("name", "units", "others"),
    [
        ("happiness", ("AU6", "AU12"), ("AU4", "AU9", "AU15")),
        ("sadness", ("AU1", "AU4", "AU15"), ("AU9", "AU12")),
        ("surprise", ("AU1", "AU2", "AU5", "AU26"), ("AU4", "AU9", "AU12", "AU15")),
        ("fear", ("AU1", "AU2", "AU5", "AU20"), ("AU9", "AU12")),
        ("anger", ("AU4", "AU7", "AU24"), ("AU1", "AU12")),
        ("disgust", ("AU9",), ("AU1", "AU2", "AU12")),
    ],
)
def test_six_emotions_have_their_prototypes(
    name: str, units: tuple[str, ...], others: tuple[str, ...]
) -> None:
    found = compose(ChannelInputs(4.0, emotions=(Display(name, 1.0, 0.0, 4.0),), lively=False)).movements
    curves = performed(found, 4.0)
    for unit in units:
        assert strongest(curves, unit, 2.0) > 0.25, unit
    for unit in others:
        assert strongest(curves, unit, 2.0) < 0.1, unit


# Paper B, sections 2.1.1 and 3


@pytest.mark.parametrize("dropped", ["head", "gaze", "punctuators"])
def test_channels_are_independent(dropped: str, sentence_of: Maker) -> None:
    said = sentence_of("Well[H*], what about Julia[H*]? She likes popcorn[L+H*].")
    inputs = ChannelInputs(said.duration, said, emotions=(Display("disgust", 0.7),))
    whole = compose(inputs)
    own = {p for m in whole.movements if m.channel == dropped for p in m.parameters}
    rivals = {rival for name in own for rival in RIVALS[name]}
    full = performed(whole.movements, said.duration)
    less = performed(compose(inputs, without=(dropped,)).movements, said.duration)
    untouched = [n for n in full if n not in own | rivals and not n.startswith(("gaze", "head"))]
    assert len(untouched) > 10
    for name in untouched:
        assert full[name].tobytes() == less[name].tobytes()


def test_an_action_is_a_set_of_units_that_add(sentence_of: Maker) -> None:
    unit = Movement("signals", 0.2, 1.8, 0.2, 0.2, {"AU6": 0.4, "AU12": 0.5})
    curves = performed([unit], 2.0)
    for name in (SMILE, "orbicularis_oculi_orbitalis.left"):
        wanted = min(
            resolve_targets({"AU12": 1.0}).get(name, 0.0) * 0.5
            + resolve_targets({"AU6": 1.0}).get(name, 0.0) * 0.4,
            1.0,
        )
        assert value(curves[name], 1.0) == pytest.approx(wanted, abs=1e-6)


NUCLEAR = "signals.brows.nuclear"
USUAL_RATE = 4.8  # syllables a second, of two phones here


def with_rule(said: Utterance, *changes: tuple[str, str]) -> Curves:
    """Return the curves with the rule for nuclear accents changed by a user's file, and nothing random."""
    lines = [line for line in shipped().get(NUCLEAR).text.splitlines() if not line.startswith("probability")]
    text = "\n".join(lines).replace(", vary = 0.25", "")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    found = compose(ChannelInputs(said.duration, said, rules=extended(shipped(), text, "my.toml"))).movements
    return performed([m for m in found if m.channel in ("signals", "punctuators")], said.duration)


def test_a_rule_of_one_channel_changes_and_the_rest_stays(sentence_of: Maker) -> None:
    said = sentence_of("She likes popcorn[H*], but not here.")
    usual, less = with_rule(said), with_rule(said, ("AU1 = 0.5, AU2 = 0.5", "AU1 = 0.25, AU2 = 0.25"))
    word = said.words[2]
    whole, half = (part(c[INNER], word.start - 0.2, word.end + 0.1) for c in (usual, less))
    assert half.max() == pytest.approx(0.5 * whole.max(), rel=1e-6)
    for name in HEAD:
        assert usual[name].tobytes() == less[name].tobytes()


def test_type_and_time_are_two_variables(sentence_of: Maker) -> None:
    said = sentence_of("She likes popcorn[H*] and nothing else.", phone=0.1)
    usual = with_rule(said)
    other = with_rule(said, ("AU1 = 0.5, AU2 = 0.5", "AU4 = 0.5"))
    assert active(other[FROWN]) == pytest.approx(active(usual[INNER]), abs=0.02)
    later = with_rule(said, ("lead = 0.06", "lead = -0.2"))
    assert later[INNER].max() == pytest.approx(usual[INNER].max(), abs=1e-9)
    assert active(later[INNER])[0] >= active(usual[INNER])[0] + 0.15


def test_what_the_face_does_begins_and_is_whole_on_phonemes(sentence_of: Maker) -> None:
    """Sections 3.1 and 5.2: the closest set of phonemes whose duration equals the onset."""
    for phone in (0.06, 0.08, 0.1):
        said = sentence_of("She likes popcorn[H*] most.", phone=phone)
        curve = shown(said, NUCLEAR)[INNER]
        start, _ = active(curve, 1e-6)
        whole = float(np.flatnonzero(curve > curve.max() - 1e-6)[0]) * FRAME
        assert near(edges_of(said), start) <= 2 * FRAME
        assert near(edges_of(said), whole) <= 2 * FRAME
        # Signals are shorter in fast speech (section 5.2): by the usual rate over that of the line.
        wanted = 0.12 * np.clip(2 * phone * USUAL_RATE, 0.7, 1.3)
        assert whole - start == pytest.approx(phone * round(wanted / phone), abs=2 * FRAME)


# Paper B, sections 4 and 5


def test_lips_shape_each_phoneme() -> None:
    take = risorius.speak("My mother moved a big pie.", settings=risorius.Settings(fps=FPS, lively=False))
    assert take.utterance is not None
    seals = [p for p in take.utterance.phones if p.symbol in ("M", "P", "B")]
    assert len(seals) >= 5
    for phone in seals:
        assert part(take.curves["lip_seal"], phone.start, phone.end + FRAME).max() > 0.95
    rounded = next(p for p in take.utterance.phones if p.symbol == "UW")
    wide = next(p for p in take.utterance.phones if p.symbol == "IH")
    tops = [part(take.curves["orbicularis_oris_funneler"], p.start, p.end).max() for p in (rounded, wide)]
    assert tops[0] > 2.0 * tops[1]


def test_blinks_of_paper_b(sentence_of: Maker) -> None:
    """1/8 s of closure, 1/24 s closed, 1/12 s of aperture, on phonemes, and again after a period."""
    said = sentence_of(LONG, phone=0.085)
    habits = profile_of("neutral", "pelachaud")
    rules = ("manipulators.lids.pelachaud",)
    curve = shown(said, "none", also=rules, profile=habits)[LID]
    spans = closures(curve, 1e-4)
    assert len(spans) > 8
    shut = closures(curve, 1.0 - 1e-4)
    assert len(shut) == len(spans)
    for (start, end), (closed, opens) in zip(spans, shut, strict=True):
        # Within long silences there is none to keep to.
        assert near(edges_of(said), start) <= 2 * FRAME or near(edges_of(said), start) > 0.1
        assert closed - start == pytest.approx(1 / 8, abs=0.085)
        assert 1 / 48 - FRAME <= opens - closed <= 1 / 24 + 0.1
        assert end - opens == pytest.approx(1 / 12, abs=0.085)
    assert np.mean([end - start for start, end in spans]) == pytest.approx(0.25, abs=0.04)
    gaps = [b[0] - a[1] for a, b in pairwise(spans)]
    assert np.median(gaps) == pytest.approx(habits.blinks.period, abs=0.1)
    # A few wait for a head that turns, whose own blinks are left out here.
    assert np.mean(np.abs(np.subtract(gaps, habits.blinks.period)) <= 0.1 + FRAME) > 0.75


def test_fast_speech_makes_signals_short_and_small(sentence_of: Maker) -> None:
    sizes, lengths = [], []
    for phone in (0.06, 0.12, 0.24):
        curve = shown(sentence_of("She likes popcorn[H*] most.", phone=phone), NUCLEAR)[INNER]
        start, end = active(curve, 1e-4)
        sizes.append(float(curve.max()))
        lengths.append(end - start)
    assert sizes == sorted(sizes)
    assert lengths[0] < lengths[-1]
    assert sizes[0] < sizes[-1]


@pytest.mark.parametrize(("text", "kind", "rule", "name"), PUNCTUATED)
def test_punctuators_come_and_go_with_their_pause(
    text: str, kind: PauseKind, rule: str, name: str, sentence_of: Maker
) -> None:
    said = sentence_of(text)
    pause = next(p for p in said.pauses if p.kind is kind)
    curve = shown(said, rule)[name].copy()
    if kind is PauseKind.FULL_STOP:  # the last silence is one, too
        curve[round((pause.end + 0.05) * FPS) :] = 0.0
    start, end = active(curve)
    assert pause.start - 0.25 <= start <= pause.start + 0.05
    assert pause.end - 0.06 <= end <= pause.end + FRAME
    assert value(curve, (pause.start + pause.end) / 2) > 0.4 * curve.max() > 0.04


def test_questions_that_only_the_voice_asks_raise_the_brows_more(sentence_of: Maker) -> None:
    rules = ("signals.brows.unmarked", "signals.brows.yes_no", "signals.brows.wh")
    voice, words, told = (
        shown(sentence_of(text), *rules)[INNER].max()
        for text in ("You like it?", "Do you like it?", "I like it.")
    )
    assert voice > words > told == 0.0


@pytest.mark.parametrize(
    ("felt", "rule", "name"),
    [
        ("anger", "punctuators.brows.angry", FROWN),
        ("disgust", "punctuators.nose.disgusted", NOSE),
        ("happiness", "punctuators.mouth.happy", SMILE),
        ("sadness", "punctuators.mouth.sad", "mentalis.left"),
    ],
)
def test_the_emotion_punctuates_in_its_own_way(felt: str, rule: str, name: str, sentence_of: Maker) -> None:
    said = sentence_of("One two, three four.", pause=0.5)
    display = (Display(felt, 0.7),)
    comma = next(p for p in said.pauses if p.kind is PauseKind.COMMA)
    middle = (comma.start + comma.end) / 2
    curve = shown(said, rule, also=("emotion",), emotions=display)[name]
    alone = shown(said, "none", also=("emotion",), emotions=display)[name]
    assert value(curve, middle) - value(alone, middle) > 0.03
    assert value(curve, comma.start - 0.3) == pytest.approx(value(alone, comma.start - 0.3), abs=1e-6)
    assert np.ptp(shown(said, rule)[name]) == 0.0


def test_related_utterances_move_the_head_alike(sentence_of: Maker) -> None:
    said = sentence_of("One two. Three four. Five six.")
    yaw = shown(said, "regulators.head")["head_yaw"]
    starts = [said.words[k].start for k in (0, 2, 4)]
    first, second, third = (part(yaw, at, at + 0.45) for at in starts)
    assert np.abs(first).max() > 1.0
    assert np.abs(first - second).max() < 0.05 * np.abs(first).max()
    assert np.abs(first - third).max() < 0.05 * np.abs(first).max()


def test_emotion_alters_how_much_is_moved_but_not_where(sentence_of: Maker) -> None:
    said = sentence_of(LONG)

    def signals(*felt: Display) -> tuple[float, list[float]]:
        found = compose(ChannelInputs(said.duration, said, emotions=felt)).movements
        curves = performed([m for m in found if m.channel == "signals"], said.duration)
        raised = closures(curves[INNER], 0.05)
        return float(np.abs(np.diff(curves[INNER])).sum()), [start for start, _ in raised]

    plain, sad, afraid = signals(), signals(Display("sadness", 1.0)), signals(Display("fear", 1.0))
    assert sad[0] < 0.7 * plain[0]
    assert afraid[0] > 1.1 * plain[0]
    accents = np.array([said.syllables[a.syllable].start for a in said.accents])
    for _, starts in (sad, afraid):
        assert all(near(accents, start) < 0.35 for start in starts)


def test_an_emotion_of_ones_own_shows_its_units(tmp_path: Path) -> None:
    file = tmp_path / "smirk.toml"
    file.write_text(emotion_text("smirk", {"AU14.left": 0.8, "AU6": 0.3}))
    take = risorius.speak("Ha.", emotion={str(file): 1.0}, settings=risorius.Settings(fps=FPS, lively=False))
    wanted = resolve_targets({"AU14.left": 0.8, "AU6": 0.3})
    name = "orbicularis_oculi_orbitalis.right"
    assert take.curves[name].max() == pytest.approx(wanted[name], abs=1e-6)


@pytest.mark.parametrize("name", ["happiness", "anger", "sadness"])
def test_a_display_rises_holds_and_falls_by_its_own_onset_and_offset(name: str) -> None:
    felt = emotion(name)
    display = Display(name, 0.8, 1.0, 5.0)
    found = compose(ChannelInputs(6.0, emotions=(display,), lively=False)).movements
    assert {m.function for m in found} == {felt.function or "minimum_jerk"}
    curves = performed(found, 6.0)
    times = np.arange(len(curves[SMILE])) * FRAME
    rise = minimum_jerk((times - 1.0) / felt.onset)
    fall = minimum_jerk((times - 5.0 + felt.offset) / felt.offset)
    moved = [n for n in curves if curves[n].max() > 0.1 and n != "gaze_distance"]
    assert moved
    for moving in moved:
        if moving.startswith(("lip_", "head", "gaze")):
            continue
        wanted = value(curves[moving], 3.0) * rise * (1.0 - fall)
        assert np.abs(curves[moving] - wanted).max() < 1e-3, moving


def test_the_speaker_looks_away_first_and_at_the_listener_last(sentence_of: Maker) -> None:
    said = sentence_of(THOUGHT_OUT)
    found = movements(said, "regulators.eyes")
    curves = performed([m for m in found if m.channel in ("regulators", "gaze", "head")], said.duration)
    away = np.hypot(*(curves[f"gaze_{a}"] + curves[f"head_{a}"] for a in ("pitch", "yaw")))
    assert part(away, 0.0, 0.6).max() > 3.0
    assert part(away, said.words[-1].end + 0.1, said.duration).max() < 5.5


def test_eyes_scan_the_listener_where_nothing_is_asked(sentence_of: Maker) -> None:
    curves = shown(sentence_of("One two.", tail=30.0), "none", also=("gaze.scan",))
    world = np.stack([curves[f"gaze_{a}"] + curves[f"head_{a}"] for a in ("pitch", "yaw")])
    still = np.abs(np.diff(world)).sum(axis=0) < 1e-6
    fixations = {tuple(p.round(2)) for p in world.T[1:][still]}
    assert len(fixations) > 10
    assert np.hypot(*world).max() < 5.5
