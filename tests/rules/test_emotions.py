import itertools
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import PARAMETERS, RIVALS, Kind
from risorius.errors import InputError, ParameterError
from risorius.rules.emotions import (
    Display,
    Emotion,
    emotion,
    emotion_names,
    emotion_text,
    emotions,
    parse_display,
)
from risorius.rules.load import load_folder

SIX = ("anger", "disgust", "fear", "happiness", "sadness", "surprise")
MORE = ("boredom", "contempt", "doubt", "embarrassment", "interest", "pride", "relief", "worry")
ALL = tuple(sorted(SIX + MORE))
# The action units of the prototypes (facts: science/05, section 5.3), by what performs them.
PROTOTYPES = {
    "happiness": {"orbicularis_oculi_orbitalis", "zygomatic_major"},
    "sadness": {"frontalis_medialis", "corrugator_supercilii", "triangularis", "mentalis"},
    "anger": {
        "corrugator_supercilii",
        "levator_palpebrae",
        "orbicularis_oculi_palpebralis",
        "orbicularis_oris_presser",
    },
    "fear": {
        "frontalis_medialis",
        "frontalis_lateralis",
        "corrugator_supercilii",
        "levator_palpebrae",
        "risorius",
        "masseter",
    },
    "disgust": {"levator_labii_nasi", "levator_labii_superioris", "triangularis"},
    "surprise": {"frontalis_medialis", "frontalis_lateralis", "levator_palpebrae", "masseter"},
}
# Anger's stare widens the eye and tenses its lower lid (AU5 with AU7): the one pair of Table 2 in a display.
STARE = {"levator_palpebrae", "orbicularis_oculi_palpebralis"}
NOT_EMBLEMS = ("levator_palpebrae", "orbicularis_oculi", "levator_labii_nasi", "head", "gaze")

every_emotion = pytest.mark.parametrize("name", SIX)


def base(name: str) -> str:
    return name.partition(".")[0]


def vector(shown: Emotion) -> list[float]:
    targets = shown.targets(1.0)
    # Ten degrees of the head are as plain as a full contraction.
    scales = {Kind.MUSCLE: 1.0, Kind.HEAD: 10.0}
    return [targets.get(p.name, 0.0) / scales[p.kind] for p in PARAMETERS if p.kind in scales]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("hapiness", "unknown emotion 'hapiness'; did you mean 'happiness'?"),
        ("suprised", "unknown emotion 'suprised'; did you mean 'surprised'?"),
        ("", "unknown emotion ''; expected one of anger, boredom"),
    ],
)
def test_unknown_emotions_are_refused(name: str, message: str) -> None:
    with pytest.raises(ParameterError) as caught:
        emotion(name)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "emotion '' is not understood; expected e.g. joy:0.7 or joy:0.7@1-2.5"),
        ("Sad", "emotion 'Sad' has no intensity; expected e.g. Sad:0.7 or Sad:0.7@1-2.5"),
        ("joy:much", "emotion 'joy:much' is not understood"),
        ("joy:nan", "emotion 'joy:nan' is not understood"),
        ("joy:-1", "emotion 'joy:-1' is not understood"),
        ("joy:1@2-", "emotion 'joy:1@2-' is not understood"),
        ("joy:1/", "emotion 'joy:1/' is not understood"),
        ("joy:1/99999", "emotion 'joy:1/99999' is not understood"),
        ("joy:1/high", "emotion 'joy:1/high' is not understood"),
        ("joy:1@-1-2", "emotion 'joy:1@-1-2' is not understood"),
        ("jo\ny:1", "emotion 'jo y:1' is not understood"),
        ("joy:1.5", "happiness = 1.5 is out of range; expected 0 to 1"),
        ("hapiness:1", "unknown emotion 'hapiness'; did you mean 'happiness'?"),
        (
            "joy:1@2-1",
            "emotion happiness: from 2 to 1 s is not a span; expected start < end, at most",
        ),
        ("joy:1@2-2", "emotion happiness: from 2 to 2 s is not a span"),
    ],
)
def test_bad_options_are_refused(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_display(text)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize("intensity", [-0.1, 1.1, math.nan, math.inf])
def test_intensities_out_of_range_are_refused(intensity: float) -> None:
    with pytest.raises(ParameterError, match="expected 0 to 1"):
        emotion("anger").targets(intensity)
    with pytest.raises(ParameterError, match="expected 0 to 1"):
        emotion("anger").emblem_targets(intensity)


def test_the_six_emotions_and_eight_more_are_there() -> None:
    assert tuple(emotions()) == ALL


def test_files_are_named_for_their_emotions() -> None:
    assert {path: e.name for path, e in load_folder(Emotion, "emotions").items()} == {
        f"emotions/{name}.toml": name for name in ALL
    }


@pytest.mark.parametrize(
    ("alias", "name"),
    [
        ("joy", "happiness"),
        ("Happy", "happiness"),
        ("SAD", "sadness"),
        (" angry ", "anger"),
        ("afraid", "fear"),
        ("scared", "fear"),
        ("disgusted", "disgust"),
        ("surprised", "surprise"),
    ],
)
def test_aliases_in_any_case(alias: str, name: str) -> None:
    assert emotion(alias).name == name


def test_every_alias_leads_to_its_emotion() -> None:
    for name, shown in emotions().items():
        assert all(emotion_names()[alias] == name for alias in shown.aliases)


@every_emotion
def test_a_display_holds_its_prototype(name: str) -> None:
    targets = emotion(name).targets(1.0)
    assert {base(p) for p, value in targets.items() if value > 0.15} >= PROTOTYPES[name]


@every_emotion
def test_a_display_is_within_range_and_symmetric(name: str) -> None:
    targets = emotion(name).targets(1.0)
    for p in PARAMETERS:
        if p.name in targets:
            assert p.low <= targets[p.name] <= p.high
            assert targets[p.name] != 0.0
            assert p.side != "left" or targets[p.name] == targets[f"{p.base}.right"]


@every_emotion
def test_no_display_works_against_itself(name: str) -> None:
    targets = emotion(name).targets(1.0)
    for p, q in itertools.combinations(targets, 2):
        if {base(p), base(q)} != STARE:
            assert q not in RIVALS[p], f"{p} and {q} conflict"


@every_emotion
def test_an_emblem_is_a_weaker_part_of_the_face(name: str) -> None:
    shown = emotion(name)
    emblem = shown.emblem_targets(1.0)
    assert emblem
    assert not any(p.startswith(NOT_EMBLEMS) for p in emblem)
    assert max(emblem.values()) < max(shown.targets(1.0).values())
    assert shown.emblem.onset + shown.emblem.offset < shown.emblem.duration
    assert shown.emblem.onset < shown.onset
    assert shown.emblem.offset < shown.offset


def test_what_is_felt_has_a_rise_of_its_own() -> None:
    """Surprise rises in a fifth of a second, sadness slowly, felt smiles in .5 to .75 s (science/05)."""
    assert emotion("surprise").onset == 0.2
    assert emotion("sadness").onset >= 4.0 * emotion("surprise").onset
    assert 0.5 <= emotion("happiness").onset <= 0.75
    assert min(emotion(name).onset for name in emotions()) == 0.2
    assert len({(e.onset, e.offset) for e in emotions().values()}) >= 8


def test_no_two_displays_look_alike() -> None:
    for a, b in itertools.combinations(emotions().values(), 2):
        va, vb = vector(a), vector(b)
        cosine = sum(x * y for x, y in zip(va, vb, strict=True)) / (math.hypot(*va) * math.hypot(*vb))
        assert cosine < 0.8, f"{a.name} and {b.name}: {cosine:.2f}"


@given(st.sampled_from(ALL), st.floats(0.0, 1.0), st.floats(0.0, 0.01))
def test_contractions_are_continuous_and_never_fall_as_the_intensity_rises(
    name: str, intensity: float, step: float
) -> None:
    less, more = (emotion(name).targets(i) for i in (intensity, min(intensity + step, 1.0)))
    assert less.keys() == more.keys()
    for p in less:
        assert abs(less[p]) <= abs(more[p]) + 1e-12
        # No share rises more than twice as fast as the intensity.
        assert abs(more[p] - less[p]) <= 2.0 * step * max(abs(emotion(name).targets(1.0)[p]), 1e-9) + 1e-12


@pytest.mark.parametrize("name", ALL)
def test_nothing_felt_shows_nothing_and_all_of_it_the_whole(name: str) -> None:
    assert set(emotion(name).targets(0.0).values()) == {0.0}
    assert emotion(name).targets(1.0) == resolve_targets(emotion(name).units)


@pytest.mark.parametrize(
    ("text", "display"),
    [
        ("joy:0.7", Display("happiness", 0.7)),
        (" Scared:1@0.5-2. ", Display("fear", 1.0, 0.5, 2.0)),
        ("anger:0@0-.5", Display("anger", 0.0, 0.0, 0.5)),
        ("anger:1/80", Display("anger", 1.0, priority=80.0)),
        ("joy:1@0.5-2/62.5", Display("happiness", 1.0, 0.5, 2.0, 62.5)),
    ],
)
def test_options(text: str, display: Display) -> None:
    assert parse_display(text) == display


def test_an_emotion_set_by_hand_is_a_file_that_shows_it(tmp_path):
    path = tmp_path / "grin.toml"
    path.write_text(emotion_text("grin", {"AU12": 0.9, "zygomatic_minor.left": 0.4, "AU6": 0.0}))
    assert emotion(str(path)).targets(1.0) == {
        "zygomatic_major.left": 0.9,
        "zygomatic_major.right": 0.9,
        "zygomatic_minor.left": 0.4,
    }
    with pytest.raises(ParameterError, match="AU99"):
        emotion_text("grin", {"AU99": 1.0})


def test_a_display_with_a_start_alone_lasts_as_long_as_its_emotion_does() -> None:
    surprise, sadness = (parse_display(f"{name}:0.7@1.5") for name in ("surprise", "sadness"))
    shown = emotion("surprise")
    assert surprise.end == pytest.approx(1.5 + shown.onset + shown.apex + shown.offset)
    assert sadness.end > surprise.end + 3.0
    assert parse_display("surprise:0.7@1.5/80").priority == 80.0


def test_a_startle_rises_in_a_fifth_of_a_second_and_in_a_manner_of_its_own() -> None:
    assert (emotion("surprise").onset, emotion("surprise").function) == (0.2, "saccade")
    assert emotion("surprise").apex < min(e.apex for n, e in emotions().items() if n != "surprise")
    assert emotion("sadness").function == "minimum_jerk"


@pytest.mark.parametrize("name", ALL)
def test_strong_emotion_outdoes_regulators_but_neither_blinks_nor_the_lips(name: str) -> None:
    shown = emotion(name)
    levels = [shown.priority_at(step / 20) for step in range(21)]
    if name in SIX:
        assert levels[0] == 10.0
        assert levels == sorted(levels)
        assert 25.0 < levels[-1] < 30.0
    else:
        assert set(levels) == {None}


def test_a_file_says_how_an_emotion_appears_and_when_it_is_too_strong_to_speak(tmp_path: Path) -> None:
    text = emotion_text("glee", {"AU12": 1.0}).replace(
        "offset = 0.75", 'offset = 0.75\napex = 1.5\nfunction = "linear"\npriority = [10, 10, 10, 30, 80]', 1
    )
    path = tmp_path / "glee.toml"
    path.write_text(text)
    glee = emotion(str(path))
    assert (glee.apex, glee.function) == (1.5, "linear")
    assert [glee.priority_at(i) for i in (0.5, 0.75, 0.875, 1.0)] == [10.0, 30.0, 55.0, 80.0]


def test_surprise_opens_the_mouth_wide_before_it_is_full() -> None:
    assert emotion("surprise").targets(0.8)["masseter"] > 0.75 * emotion("surprise").targets(1.0)["masseter"]


def test_happiness_reaches_the_lids() -> None:
    shown = emotion("happiness").targets(0.8)
    assert shown["orbicularis_oculi_orbitalis.left"] > 0.8
    assert shown["orbicularis_oculi_palpebralis.left"] > 0.05


def test_an_embarrassed_look_falls_and_is_not_from_the_corner_of_the_eye() -> None:
    shown = emotion("embarrassment").targets(1.0)
    assert shown["gaze_pitch"] < -3.0 * abs(shown["gaze_yaw"])
    assert shown["orbicularis_oris_presser"] > shown["zygomatic_major.left"]


def test_a_file_needs_targets_alone_and_its_emblem_is_the_display(tmp_path: Path) -> None:
    file = tmp_path / "calm.toml"
    file.write_text(
        'name = "calm"\ndescription = "Calm."\nsource = "us"\n[targets]\nAU12 = 0.2\nAU43 = 0.15\n'
    )
    calm = emotion(str(file))
    assert (calm.onset, calm.offset, calm.aliases) == (0.45, 0.75, ())
    assert calm.emblem_targets(0.6) == calm.targets(0.6)
    assert calm.emblem.duration == 1.0
