"""The channels of paper B, each by its rules, on small utterances."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from risorius.blend import combine
from risorius.channels import ChannelInputs, Display, built_channels, compose
from risorius.core.choices import BLINK_MODELS
from risorius.core.movement import Movement
from risorius.core.score import Score
from risorius.core.speech.utterance import Accent, PauseKind
from risorius.rules.profiles import attitude, profile, profile_of, profiles
from risorius.rules.rule_set import shipped

from .at_work import FROWN, INNER, LONG, PUNCTUATED, SAID, THOUGHT_OUT, Maker, by_rule, movements


def test_accents_gather_brows_head_mouth_and_blinks(sentence_of: Maker) -> None:
    found = movements(sentence_of("She likes popcorn[L+H*]."), "signals.")
    rules = {m.cause.rule for m in found if m.channel == "signals"}
    assert "signals.brows.contrast" in rules
    assert "signals.mouth.accent" in rules
    assert "signals.lids.blink" in rules
    assert rules & {"signals.nod.accent", "signals.nod.overshoot"}
    assert {m.cause.trigger for m in found if m.channel == "signals"} == {'"popcorn"'}


def test_brows_lead_the_accented_syllable(sentence_of: Maker) -> None:
    said = sentence_of("She likes popcorn[H*] most.", phone=0.06)
    (raise_,) = by_rule(movements(said, "signals.brows.nuclear"), "signals.brows.nuclear")
    lead = said.syllables[2].start - raise_.start
    assert 0.0 <= lead <= 0.13


@pytest.mark.parametrize(("text", "kind", "rule", "moved"), PUNCTUATED)
def test_pauses_are_punctuated_by_their_kind_from_start_to_end(
    text: str, kind: PauseKind, rule: str, moved: str, sentence_of: Maker
) -> None:
    said = sentence_of(text)
    pause = next(p for p in said.pauses if p.kind is kind)
    found = by_rule(movements(said, "punctuators.brows"), rule)
    assert found[0].end == pytest.approx(pause.end)
    assert pause.start - 0.25 <= found[0].start <= pause.start
    assert found[0].parameters[moved] > 0.0


@pytest.mark.parametrize("tail", [0.3, 0.7, 4.0])
def test_the_last_silence_is_punctuated_once_and_held_to_the_end(tail: float, sentence_of: Maker) -> None:
    said = sentence_of("One two, three four.", tail=tail)
    found = movements(said, "punctuators.mouth", emotions=(Display("happiness", 0.6),))
    after = [m for m in found if m.channel == "punctuators" and m.end > said.words[-1].end]
    assert len(after) == 1
    assert after[0].end - after[0].offset > said.duration
    smile = combine(Score(said.duration, tuple(found)), Fraction(100)).curves["zygomatic_major.left"]
    still = smile[round(100 * (after[0].start + after[0].onset)) + 1 :]
    assert np.ptp(still) < 1e-9
    assert still[0] > 0.7


@pytest.mark.parametrize("intensity", [0.3, 0.5, 0.7, 0.8, 1.0])
@pytest.mark.parametrize(("felt", "moved"), [("anger", FROWN), ("disgust", "levator_labii_nasi.left")])
def test_punctuators_are_seen_above_the_display_at_every_intensity(
    felt: str, moved: str, intensity: float, sentence_of: Maker
) -> None:
    said = sentence_of("One two, three four.", pause=0.5)
    prefix = "punctuators.brows.angry" if felt == "anger" else "punctuators.nose"
    found = movements(said, prefix, emotions=(Display(felt, intensity),))
    curve = combine(Score(said.duration, tuple(found)), Fraction(100)).curves[moved]
    (comma,) = (p for p in said.pauses if p.kind is PauseKind.COMMA)
    middle = round(50 * (comma.start + comma.end))
    before = curve[round(100 * comma.start) - 20]
    assert curve[middle] - before > 0.05


@pytest.mark.parametrize(
    ("felt", "rule", "moved"),
    [
        ("anger", "punctuators.brows.angry", FROWN),
        ("disgust", "punctuators.nose.disgusted", "levator_labii_nasi.left"),
        ("happiness", "punctuators.mouth.happy", "zygomatic_major.left"),
        ("sadness", "punctuators.mouth.sad", "triangularis.left"),
    ],
)
def test_the_type_of_punctuation_depends_on_the_emotion(
    felt: str, rule: str, moved: str, sentence_of: Maker
) -> None:
    said = sentence_of("One two, three four.")
    with_it = movements(said, "punctuators.", emotions=(Display(felt, 0.8),))
    assert by_rule(with_it, rule)[0].parameters[moved] > 0.0
    assert not by_rule(movements(said, "punctuators."), rule)


def test_speakers_look_away_at_the_start_and_at_the_listener_at_the_end(sentence_of: Maker) -> None:
    said = sentence_of(THOUGHT_OUT)
    found = movements(said, "regulators.eyes")
    away = by_rule(found, "regulators.eyes.state")[0]
    assert away.start == 0.0
    assert np.hypot(away.targets["gaze_pitch"], away.targets["gaze_yaw"]) > 3.0
    last = [m for m in found if m.layer == "look" and m.end > said.words[-1].end - 0.4]
    assert last
    # Where a face is, seen from 0.8 m.
    assert all(np.hypot(m.targets["gaze_pitch"], m.targets["gaze_yaw"]) < 5.0 for m in last)


def test_short_turns_do_not_begin_with_a_look_away(sentence_of: Maker) -> None:
    """Nor those whose first sentence is short: more is not known yet."""
    for text in ("Oh really?", f"Oh really? {LONG}"):
        assert not by_rule(movements(sentence_of(text), "regulators.eyes"), "regulators.eyes.state")


@pytest.mark.parametrize("seed", range(8))
def test_a_look_away_at_the_end_of_a_turn_comes_back(seed: int, sentence_of: Maker) -> None:
    """Whatever begins before, from .4 s before the end of the last word on the eyes are on the listener."""
    said = sentence_of(f"{THOUGHT_OUT} Um[H*]… I don't know[H*].")
    found = [m for m in movements(said, "", seed=seed) if m.layer == "look" and m.channel == "gaze"]
    last = [m for m in found if m.end > said.words[-1].end - 0.4]
    assert last
    assert all(np.hypot(m.targets["gaze_pitch"], m.targets["gaze_yaw"]) < 5.0 for m in last)


def test_listeners_nod_and_blink_back(sentence_of: Maker) -> None:
    said = sentence_of("One two. Three.", tail=12.0)
    listening = ((3.0, 12.0),)
    found = movements(said, "regulators.", listening=listening)
    for rule in ("regulators.nod.listening", "regulators.lids.listening", "regulators.brows.listening"):
        inside = by_rule(found, rule)
        assert inside
        assert all(m.start >= 3.0 for m in inside)
    assert not by_rule(movements(said, "regulators."), "regulators.nod.listening")


@pytest.mark.parametrize("seed", [94, 132, 147])
def test_two_blinks_that_begin_with_the_same_phoneme_are_one(seed: int, sentence_of: Maker) -> None:
    """Two of one layer that start together cannot be performed."""
    said = sentence_of("Mayonnaise, mayonnaise and mayonnaise again. We will see.", tail=3.0)
    found = movements(said, "regulators.lids", listening=((0.1, said.duration),), seed=seed)
    assert by_rule(found, "regulators.lids.listening")


def test_related_utterances_share_a_head_pattern(sentence_of: Maker) -> None:
    said = sentence_of("One two. Three four. Five six.")
    found = by_rule(movements(said, "regulators.head"), "regulators.head.pattern")
    assert len(found) == 3
    assert len({tuple(m.targets.items()) for m in found}) == 1


@pytest.mark.parametrize(
    ("text", "rule", "moved"),
    [
        ("Yes, I do.", "head.verbal.yes", "head_pitch"),
        ("No, I do not.", "head.verbal.no", "head_yaw"),
        ("I don't know.", "signals.shrug.unknown", "frontalis_lateralis.left"),
    ],
)
def test_words_that_the_head_or_brows_say_too(text: str, rule: str, moved: str, sentence_of: Maker) -> None:
    found = by_rule(movements(sentence_of(text), "head.verbal", "signals.shrug"), rule)
    assert found
    assert all(m.parameters[moved] != 0.0 for m in found)


def test_beats_pause_while_the_head_says_no(sentence_of: Maker) -> None:
    said = sentence_of("No[H*], never[H*].")
    found = movements(said, "signals.nod", "signals.swing", "head.verbal")
    shakes = [m for m in found if m.cause.rule.startswith("head.verbal")]
    beats = [m for m in found if m.channel == "signals"]
    assert shakes
    assert not any(b.start < s.end and s.start < b.end for b in beats for s in shakes)


def test_an_emblem_is_shown_at_the_word_that_refers_to_it(sentence_of: Maker) -> None:
    said = sentence_of("She was very sad[H*] then.")
    (emblem,) = by_rule(movements(said, "emotion.emblem"), "emotion.emblem.sadness")
    assert emblem.start < said.words[3].end
    assert said.words[3].start < emblem.end
    assert emblem.end - emblem.start < 1.5
    assert all(n.startswith(("frontalis", "triangularis", "mentalis")) for n in emblem.parameters)


@pytest.mark.parametrize("word", ["sad", "sorry", "lonely"])
def test_an_emblem_of_what_is_displayed_already_is_not_shown(word: str, sentence_of: Maker) -> None:
    said = sentence_of(f"She was very {word}[H*] then.")

    def emblems(*displays: Display) -> list[Movement]:
        found = movements(said, "emotion.emblem", emotions=displays)
        return by_rule(found, "emotion.emblem.sadness")

    assert len(emblems()) == len(emblems(Display("fear", 1.0))) == 1
    assert emblems(Display("sadness", 0.4)) == []
    assert len(emblems(Display("sadness", 0.4, said.duration - 0.1, None))) == 1


@pytest.mark.parametrize(
    ("felt", "rule"),
    [
        ((), "punctuators.brows.comma"),
        ((Display("anger", 0.8),), "punctuators.brows.angry"),
        ((Display("disgust", 0.8),), "punctuators.nose.disgusted"),
        ((Display("happiness", 0.8),), "punctuators.mouth.happy"),
    ],
)
@pytest.mark.parametrize("pause", [0.06, 0.15, 0.4])
def test_punctuators_begin_with_their_pause_and_last_long_enough_to_be_seen(
    felt: tuple[Display, ...], rule: str, pause: float, sentence_of: Maker
) -> None:
    said = sentence_of("One two, three four.", pause=pause, phone=0.08)
    comma = next(p for p in said.pauses if p.kind is PauseKind.COMMA)
    found = by_rule(movements(said, "punctuators.", emotions=felt), rule)
    mark = next(m for m in found if m.start < comma.end)
    assert mark.start == pytest.approx(comma.start)
    assert mark.end == pytest.approx(comma.end) or pause < 0.25 <= mark.end - mark.start + 1e-6
    assert mark.onset >= 0.1 - 1e-6


@pytest.mark.parametrize(("text", "kind", "rule", "moved"), PUNCTUATED)
def test_no_punctuator_begins_before_its_pause(
    text: str, kind: PauseKind, rule: str, moved: str, sentence_of: Maker
) -> None:
    said = sentence_of(text, pause=0.4)
    pause = next(p for p in said.pauses if p.kind is kind)
    found = by_rule(movements(said, "punctuators.brows"), rule)[0]
    assert (found.start, found.end) == pytest.approx((pause.start, pause.end))


@pytest.mark.parametrize(("felt", "more"), [("sadness", False), ("fear", True)])
def test_a_sad_speaker_moves_less_and_a_fearful_one_more(felt: str, more: bool, sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    plain, moved = (
        [
            m
            for m in compose(ChannelInputs(said.duration, said, emotions=e)).movements
            if m.channel == "signals"
        ]
        for e in ((), (Display(felt, 1.0),))
    )
    assert len(moved) > 1.15 * len(plain) if more else len(moved) < 0.7 * len(plain)


@pytest.mark.parametrize("felt", ["anger", "disgust", "fear", "happiness", "sadness", "surprise", "boredom"])
def test_emotion_changes_neither_place_nor_type_of_accents(felt: str, sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    before = said.accents
    found = compose(ChannelInputs(said.duration, said, emotions=(Display(felt, 1.0),))).movements
    assert said.accents == before
    texts = {f'"{said.words[a.word].text}"' for a in before}
    on_accents = [m for m in found if m.cause.rule in ("signals.nod.accent", "signals.mouth.accent")]
    assert on_accents
    assert {m.cause.trigger for m in on_accents} <= texts


@pytest.mark.parametrize("dropped", built_channels())
def test_a_channel_left_out_leaves_the_others_as_they_were(dropped: str, sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    inputs = ChannelInputs(
        said.duration, said, emotions=(Display("joy", 0.5),), attitudes=(attitude("ironic"),)
    )
    whole, less = (compose(inputs, without=w) for w in ((), (dropped,)))
    assert [m for m in whole.movements if m.channel != dropped] == list(less.movements)
    assert less.lips == (() if dropped == "lips" else whole.lips)
    assert len(less.movements) + len(less.lips) < len(whole.movements) + len(whole.lips)


@pytest.mark.parametrize(
    "pair", [("lively", "reserved"), ("lively", "authoritative"), ("neutral", "reserved")]
)
def test_profiles_differ_in_how_much_the_face_moves(pair: tuple[str, str], sentence_of: Maker) -> None:
    said = sentence_of(LONG)

    def amount(name: str) -> float:
        found = compose(ChannelInputs(said.duration, said, profile=profile(name))).movements
        return sum(abs(m.targets.get("head_pitch", 0.0)) for m in found if m.channel in ("signals", "head"))

    assert amount(pair[0]) > 1.3 * amount(pair[1])


def test_the_head_follows_pitch_where_the_sound_was_measured(sentence_of: Maker) -> None:
    said = sentence_of("One two[H*] three.")
    loud = tuple(replace(s, pitch=2.0 if i == 1 else -0.5) for i, s in enumerate(said.syllables))
    found = by_rule(movements(replace(said, syllables=loud), "none"), "head.melody.pitch")
    assert [np.sign(m.targets["head_pitch"]) for m in found] == [-1.0, 1.0, -1.0, 0.0]
    assert not by_rule(movements(said, "none"), "head.melody.pitch")


def test_a_comma_is_underlined_by_slow_movement(sentence_of: Maker) -> None:
    tilts, beats = [], []
    for seed in range(40):
        said = sentence_of("One two[H*], three four.")
        found = movements(said, "punctuators.tilt", "signals.nod", seed=seed)
        (tilt,) = by_rule(found, "punctuators.tilt.comma")
        tilts.append(abs(tilt.targets["head_roll"]) / tilt.onset)
        beats += [abs(m.targets["head_pitch"]) / m.onset for m in found if m.channel == "signals"]
    assert np.mean(tilts) < 0.5 * np.mean(beats)


def test_all_four_sets_of_regulators_are_there(sentence_of: Maker) -> None:
    found = movements(sentence_of(THOUGHT_OUT), "regulators.eyes")
    rules = {m.cause.rule for m in found}
    assert {f"regulators.eyes.{n}" for n in ("state", "within", "continuation")} <= rules
    assert shipped().get("regulators.eyes.turn").rule.effect.look == "listener"


def test_a_question_that_only_the_voice_asks_raises_the_brows_more(sentence_of: Maker) -> None:
    def size(text: str) -> float:
        found = movements(sentence_of(text), "signals.brows.unmarked", "signals.brows.yes_no")
        return max((m.parameters[INNER] for m in found if m.channel == "signals"), default=0.0)

    assert size("You like it[L*]?") > size("Do you like it[L*]?") > 0.0
    assert size("You like it[H*].") == 0.0


@pytest.mark.parametrize("who", list(profiles()))
@pytest.mark.parametrize("model", BLINK_MODELS)
def test_any_seed_and_speaker_make_a_score_that_can_be_performed(
    who: str, model: str, sentence_of: Maker
) -> None:
    said = sentence_of(SAID)
    speaker = profile_of(who, model)
    for seed in range(25):
        score = compose(ChannelInputs(said.duration, said, profile=speaker), seed=seed)
        assert all(0.0 <= m.start < m.end for m in score.movements)


@pytest.mark.full
def test_alignment_falls_to_chance_where_accents_are_permuted(sentence_of: Maker) -> None:
    said = sentence_of(LONG * 2)
    starts = np.array([said.syllables[a.syllable].start for a in said.accents])
    rng = np.random.default_rng(0)

    def alignment(accents: tuple[Accent, ...]) -> float:
        """Return the share of the true accents that brows meet, performed from those given."""
        found = compose(ChannelInputs(said.duration, replace(said, accents=accents))).movements
        raises = np.array([m.start for m in found if m.cause.rule.startswith("signals.brows")])
        return float(np.mean(np.abs(np.subtract.outer(starts, raises)).min(axis=1) < 0.15))

    permuted = []
    for _ in range(12):
        words = sorted(rng.choice(len(said.words), len(said.accents), replace=False).tolist())
        moved = zip(said.accents, words, strict=True)
        permuted.append(tuple(replace(a, word=w, syllable=w) for a, w in moved))
    chance = [alignment(accents) for accents in permuted]
    assert alignment(said.accents) > np.mean(chance) + 4.0 * np.std(chance)
    # Chance: as often as an accent lies within reach of any other word's.
    assert np.mean(chance) < 0.65 * alignment(said.accents)


def test_a_display_shows_less_only_while_another_is_beside_it() -> None:
    joy, grief = Display("happiness", 0.8), Display("sadness", 0.8, 2.0, 3.0)
    found = compose(ChannelInputs(6.0, emotions=(joy, grief), lively=False)).movements
    smile = [m for m in found if m.layer == "1.happiness"]
    assert [m.start for m in smile] == [0.0, 2.0, 3.0]
    cheeks = [m.parameters["orbicularis_oculi_orbitalis.left"] for m in smile]
    assert cheeks[0] == cheeks[2] > cheeks[1]
    corners = [m.parameters["zygomatic_major.left"] for m in smile]
    assert corners[0] == corners[1] == corners[2]
    apart = compose(
        ChannelInputs(6.0, emotions=(joy, Display("pride", 0.0, 2.0, 3.0)), lively=False)
    ).movements
    assert [m.start for m in apart if m.layer == "1.happiness"] == [0.0]


def test_a_gesture_takes_over_from_one_that_is_still_going_on(sentence_of: Maker) -> None:
    said = sentence_of("No yes.", phone=0.2)
    found = movements(said, "head.verbal")
    yes = next(m.start for m in found if m.cause.rule == "head.verbal.yes")
    no = [m.start for m in found if m.cause.rule == "head.verbal.no"]
    assert 0 < len(no) < 4
    assert max(no) < yes
