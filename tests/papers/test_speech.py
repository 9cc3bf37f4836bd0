"""Rules of both papers on spoken sentences of our own: read off the curves that a voice's times give."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.channels import Display
from risorius.core.movement import Movement
from risorius.core.parameters import RIVALS
from risorius.core.speech.utterance import PauseKind, Utterance
from risorius.rules.emotions import emotion

from ..channels.at_work import FROWN, INNER, LID
from ..paper_curves import FPS, HEAD, NOSE, SMILE, closures, edges_of, minimum_jerk, near, performed
from .spoken import (
    BROTHER,
    RIVER,
    ROPES,
    SENTENCES,
    WINDOW,
    by_rule,
    curves_of,
    index,
    score_of,
    speed,
    spoken,
    utterance,
)

# Paper A, section 2


@pytest.mark.parametrize("text", SENTENCES)
def test_the_sound_begins_with_the_first_phone_and_ends_with_the_last(text: str) -> None:
    take = spoken(text)
    said = utterance(text)
    sound = take.utterance.audio.read() if take.utterance else np.zeros(0)
    rate = take.utterance.audio.sample_rate if take.utterance else 1
    loud = np.flatnonzero(np.abs(sound.astype(np.float64)) > 0.02 * np.abs(sound).max()) / rate
    assert loud[0] == pytest.approx(said.words[0].start, abs=0.06)
    assert loud[-1] == pytest.approx(said.words[-1].end, abs=0.08)


@pytest.mark.parametrize(
    ("text", "muscle"),
    [
        ('<EMOTIONDISPLAY time="0.5" duration="3" Happiness="0.8" onset="0.5" offset="0.5"/>', SMILE),
        (
            '<SCRIPT duration="4"><MOVEMENT time="0.5" duration="3" onset="0.5" offset="0.5" AU9="0.8"/>'
            "</SCRIPT>",
            NOSE,
        ),
    ],
)
def test_a_display_needs_no_words(text: str, muscle: str, tmp_path: Path) -> None:
    file = tmp_path / "silent.xml"
    file.write_text(text)
    settings = risorius.Settings(fps=FPS, lively=False)
    curve = risorius.speak(file, settings=settings).curves[muscle]
    times = np.arange(len(curve)) / FPS
    shape = minimum_jerk((times - 0.5) / 0.5) * (1.0 - minimum_jerk((times - 3.0) / 0.5))
    assert curve.max() > 0.3
    assert np.abs(curve - curve.max() * shape).max() < 0.02


def test_a_listener_without_words_nods_and_blinks_back(tmp_path: Path) -> None:
    file = tmp_path / "listener.xml"
    file.write_text('<SCRIPT duration="12"><LISTEN time="0"/></SCRIPT>')
    take = risorius.speak(file, settings=risorius.Settings(fps=FPS))
    assert take.duration == 12.0
    nods = by_rule(take.score, "regulators.")
    assert 2 <= len({m.start for m in nods if "head_pitch" in m.parameters}) <= 12
    assert np.ptp(curves_of(take.score, "regulators.")["head_pitch"]) > 1.5
    assert closures(take.curves[LID], 0.3)


def test_a_head_at_rest_is_never_quite_still_unless_wanted(tmp_path: Path) -> None:
    file = tmp_path / "rest.xml"
    file.write_text('<SCRIPT duration="8"/>')
    alive, still = (
        risorius.speak(file, settings=risorius.Settings(fps=FPS, lively=lively)).curves
        for lively in (True, False)
    )
    assert 0.2 < max(np.ptp(alive[name]) for name in HEAD) < 10.0
    assert 0.5 < np.hypot(np.ptp(alive["gaze_pitch"]), np.ptp(alive["gaze_yaw"])) < 15.0
    assert max(float(np.ptp(curve)) for curve in still.values()) == 0.0


@pytest.mark.parametrize(
    "text", ["Yes, that is my coat.", "Yes! We found it there.", "Oh, yes, the blue one."]
)
def test_a_yes_is_nodded(text: str) -> None:
    said = utterance(text)
    yes = next(w for w in said.words if w.text.lower() == "yes")
    nodded = []
    for seed in range(6):
        pitch = curves_of(score_of(said, seed=seed), "head.verbal.yes")["head_pitch"]
        nodded.append(bool(np.abs(pitch[index(yes.start - 0.2) : index(yes.end + 0.6)]).max() > 1.5))
    assert np.mean(nodded) >= 0.5


@pytest.mark.parametrize(
    ("text", "moved"),
    [
        ("Um, I left it in the car.", FROWN),
        ("I think… it was the baker.", FROWN),
        ("What a day! I am tired.", INNER),
    ],
)
def test_hesitations_and_exclamations_are_punctuated(text: str, moved: str) -> None:
    said = utterance(text)
    kinds = {PauseKind.HESITATION, PauseKind.EXCLAMATION}
    pause = next(p for p in said.pauses if p.kind in kinds)
    shown = 0
    for seed in range(6):
        curve = curves_of(score_of(said, seed=seed), "punctuators.")[moved]
        shown += bool(curve[index(pause.start) : index(pause.end) + 1].max() > 0.05)
    assert shown >= 3


# Paper B, sections 2.1 and 3


@pytest.mark.parametrize(
    "dropped", ["manipulators", "signals", "punctuators", "regulators", "emotion", "gaze", "head"]
)
def test_a_channel_that_is_left_out_leaves_the_other_curves(dropped: str) -> None:
    said, felt = utterance(RIVER), Display("disgust", 0.6)
    whole = score_of(said, felt)
    curves = curves_of(whole)
    own = {p for m in whole.movements if m.channel == dropped for p in m.parameters}
    kept = [m for m in whole.movements if m.channel != dropped]
    less = performed(kept, whole.duration, FPS)
    touched = own | {rival for name in own for rival in RIVALS[name]}
    others = [n for n in curves if n not in touched and not n.startswith(("gaze", "head"))]
    assert others
    assert all(np.array_equal(curves[name], less[name]) for name in others)


@pytest.mark.parametrize("text", SENTENCES)
def test_brows_and_mouth_begin_and_are_whole_on_phonemes(text: str) -> None:
    said = utterance(text)
    edges = edges_of(said)
    found = [
        m for seed in range(4) for m in by_rule(score_of(said, seed=seed), "signals.brows", "signals.mouth")
    ]
    assert len(found) >= 4
    for movement in found:
        for time in (movement.start, movement.start + movement.onset):
            assert near(edges, time) < 0.002, movement.cause


def test_signals_are_of_syllables_in_slow_speech_and_of_words_else() -> None:
    """A signal on the accent of a long word lasts the word, unless speech is slow."""
    text = "She bought a caravan yesterday."
    lengths = {}
    for rate in (90, 250):
        said = utterance(text, rate)
        found = [
            m for seed in range(8) for m in by_rule(score_of(said, seed=seed), "signals.brows")
            if '"caravan"' in m.cause.trigger or "car" in m.cause.trigger
        ]  # fmt: skip
        word = next(w for w in said.words if w.text == "caravan")
        assert found
        lengths[rate] = np.mean([m.end - m.start for m in found]) / (word.end - word.start)
    assert lengths[90] < lengths[250]


# Paper B, section 4


@pytest.mark.parametrize("text", SENTENCES)
def test_the_sad_show_less_and_the_afraid_more(text: str) -> None:
    said = utterance(text)
    plain, sad, afraid = (
        sum(len(by_rule(score_of(said, *felt, seed=seed), "signals.")) for seed in range(8))
        for felt in ((), (Display("sadness", 1.0),), (Display("fear", 1.0),))
    )
    assert sad < 0.85 * plain
    assert afraid > 1.1 * plain


@pytest.mark.parametrize(
    ("felt", "rule", "moved"),
    [("disgust", "punctuators.nose.disgusted", NOSE), ("happiness", "punctuators.mouth.happy", SMILE)],
)
@pytest.mark.parametrize("text", [RIVER, BROTHER, WINDOW])
def test_silences_are_punctuated_by_what_is_felt(text: str, felt: str, rule: str, moved: str) -> None:
    said = utterance(text)
    pauses = [
        p for p in said.pauses if p.kind in (PauseKind.COMMA, PauseKind.FULL_STOP) and p.end - p.start > 0.2
    ]
    seen = []
    for seed in range(6):
        score = score_of(said, Display(felt, 0.6), seed=seed)
        with_it = curves_of(score, "emotion", rule)[moved]
        alone = curves_of(score, "emotion.")[moved]
        seen += [bool((with_it - alone)[index(p.start) : index(p.end) + 1].max() > 0.02) for p in pauses]
    assert np.mean(seen) > 0.7


def test_a_surprise_that_has_a_start_alone_lasts_its_own_time() -> None:
    for text in (RIVER, WINDOW):
        display = risorius.speak(
            text, text=True, emotion="surprise:1@0.5", settings=risorius.Settings(fps=FPS, lively=False)
        ).curves["frontalis_lateralis.left"]
        moving = np.flatnonzero(display > 1e-4) / FPS
        assert moving[0] == pytest.approx(0.5, abs=0.05)
        assert moving[-1] == pytest.approx(0.5 + emotion("surprise").seconds, abs=0.05)
        assert display[index(0.75)] > 0.95


@pytest.mark.parametrize("text", [RIVER, WINDOW])
def test_anger_is_loud_and_quick_and_sadness_soft_and_slow(text: str) -> None:
    def heard(felt: str) -> tuple[float, float]:
        settings = risorius.Settings(fps=25, lively=False)
        said = risorius.speak(text, text=True, emotion={felt: 1.0}, settings=settings).utterance
        assert said is not None
        sound = said.audio.read().astype(np.float64)
        return float(np.sqrt((sound**2).mean())), said.words[-1].end - said.words[0].start

    (loud, quick), (soft, slow), (_, plain) = heard("anger"), heard("sadness"), heard("interest")
    assert loud > 1.8 * soft
    assert quick < plain < slow


# Paper B, section 5.2


@pytest.mark.parametrize("text", SENTENCES)
def test_the_last_silence_is_still(text: str) -> None:
    said = utterance(text)
    for seed in range(3):
        curves = curves_of(score_of(said, seed=seed))
        middle = index((said.words[-1].end + said.duration) / 2)
        assert speed(curves, HEAD)[middle - index(0.1) : middle + index(0.1)].mean() < 4.0


def test_most_accents_gather_several_kinds_of_movement() -> None:
    several, none, count = 0, 0, 0
    for text in SENTENCES:
        said = utterance(text)
        for seed in range(4):
            found = by_rule(score_of(said, seed=seed), "signals.")
            for accent in said.accents:
                syllable = said.syllables[accent.syllable]
                kinds = {
                    m.cause.rule.split(".")[1] for m in found
                    if m.start < syllable.end and m.end > syllable.start and m.start > syllable.start - 0.4
                }  # fmt: skip
                several, none, count = several + (len(kinds) > 1), none + (not kinds), count + 1
    assert count > 60
    assert several > 0.5 * count
    assert none < 0.3 * count


@pytest.mark.parametrize("rate", [110, 175, 250])
def test_signals_are_shorter_and_smaller_in_fast_speech(rate: int) -> None:
    slow, fast = (
        [
            m for text in (RIVER, WINDOW) for seed in range(6)
            for m in by_rule(score_of(utterance(text, words), seed=seed), "signals.brows.nuclear")
        ]
        for words in (rate - 20, rate + 60)
    )  # fmt: skip
    assert slow
    assert fast
    size = [np.mean([max(m.targets.values()) for m in found]) for found in (slow, fast)]
    lasts = [np.mean([m.end - m.start for m in found]) for found in (slow, fast)]
    assert size[0] > size[1]
    assert lasts[0] > lasts[1]


@pytest.mark.parametrize("text", [ROPES, "Is it raining? Can you see the road? Then we stay."])
def test_questions_raise_the_brows(text: str) -> None:
    said = utterance(text)
    asked = next(p for p in said.pauses if p.kind is PauseKind.QUESTION)
    raised = [
        curves_of(score_of(said, seed=seed), "punctuators.brows", "signals.brows")[INNER][
            index(asked.start - 0.3) : index(asked.end)
        ].max()
        for seed in range(6)
    ]
    assert np.mean(raised) > 0.25


def test_periodic_blinks_fill_long_speech_and_silence() -> None:
    text = f"{RIVER} {BROTHER} {WINDOW}"
    take = spoken(text, blinks="pelachaud", tail=9.0)
    said = take.utterance
    assert said is not None
    spans = closures(take.curves[LID], 0.5)
    assert all(0.05 < end - start < 0.35 for start, end in spans)
    silent = [(start, end) for start, end in spans if start > said.words[-1].end + 0.5]
    gaps = [after[0] - before[1] for before, after in pairwise(silent)]
    assert gaps
    assert np.allclose(gaps, np.median(gaps), atol=0.3)
    assert max(after[0] - before[1] for before, after in pairwise(spans)) < np.median(gaps) + 1.0


def test_natural_blinks_begin_on_phonemes_and_need_not_end_there() -> None:
    """By default the start alone keeps to a phoneme: a natural blink closes in its own time."""
    starts, ends = [], []
    for text in SENTENCES:
        said = utterance(text)
        edges = edges_of(said)
        for seed in range(6):
            for blink in by_rule(score_of(said, seed=seed), "manipulators.lids.natural"):
                if said.words[0].start < blink.start < blink.end < said.words[-1].end:
                    starts.append(near(edges, blink.start) < 0.002)
                    ends.append(near(edges, blink.end) < 0.002)
    assert len(starts) > 8
    assert np.mean(starts) > 0.9
    assert np.mean(ends) < 0.5


def test_related_sentences_move_the_head_alike() -> None:
    said = utterance("The door is old. The roof is new. The walls are thick. The stairs are steep.")
    found = by_rule(score_of(said), "regulators.head.pattern")
    assert len(found) >= 3
    targets = [tuple(sorted(m.targets.items())) for m in found]
    assert len(set(targets)) == 1


@pytest.mark.parametrize("text", SENTENCES)
def test_the_eyes_rest_on_the_listener_at_the_end(text: str) -> None:
    said: Utterance = utterance(text)
    for seed in range(3):
        curves = curves_of(score_of(said, seed=seed))
        last = slice(index(said.duration - 0.15), index(said.duration - 0.02))
        world = np.hypot(*(curves[f"gaze_{a}"] + curves[f"head_{a}"] for a in ("pitch", "yaw")))[last]
        assert np.median(world) < 7.0


def test_eyes_scan_the_face_of_the_listener() -> None:
    said = spoken("I see.", tail=12.0).utterance
    assert said is not None
    found: list[Movement] = by_rule(score_of(said), "gaze.scan.face")
    places = {tuple(round(v, 2) for v in m.targets.values()) for m in found}
    assert len(places) >= 5
    assert all(
        np.hypot(m.targets.get("gaze_pitch", 0.0), m.targets.get("gaze_yaw", 0.0)) < 6.0 for m in found
    )
