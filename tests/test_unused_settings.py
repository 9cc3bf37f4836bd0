"""A setting that nothing reads is refused by name, in the library and on the command line."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.cli import EXIT_FAULT, run
from risorius.core.arrays import Array
from risorius.errors import InputError, Place, UnusedSettingError
from risorius.ports.formats import format_for
from risorius.settings import BlendChoices, Look, Settings
from risorius.unused_settings import chosen, reject_unwritten

from .collected import all_cases

SMILE = "zygomatic_major.left"
GRIN = {"channel": "emotion", "start": 0.0, "end": 1.0, "onset": 0.4, "offset": 0.4, "targets": {SMILE: 0.6}}
POUT = {**GRIN, "channel": "signals", "targets": {"orbicularis_oris_funneler": 0.6}}
DRAWN = {**GRIN, "function": "linear"}


@pytest.fixture
def score(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the name of a score, in the current folder, of rival movements that `inhibit` combines."""
    monkeypatch.chdir(tmp_path)
    Path("x.score.json").write_text(json.dumps({"risorius": 1, "duration": 1.0, "movements": [DRAWN, POUT]}))
    return "x.score.json"


PLANNING = [
    {"voice": "de"}, {"language": "de"}, {"rate": 100}, {"voice_emotion": False}, {"lead": 0.0},
    {"tail": 1.0}, {"articulation": 1.5}, {"manner": "whisper"}, {"lively": False}, {"seed": 4},
    {"without": ("gaze",)}, {"profile": "lively"}, {"attitudes": ("polite",)}, {"blinks": "itti"},
]  # fmt: skip


@pytest.mark.parametrize("perform", [risorius.speak, risorius.mix, risorius.play])
def test_a_score_refuses_settings_of_voice_and_plan(
    perform: Callable[..., risorius.Take], score: str
) -> None:
    with all_cases() as case:
        for setting in PLANNING:
            with case(setting):
                with pytest.raises(UnusedSettingError) as refused:
                    perform(score, settings=Settings(**setting))  # type: ignore[arg-type]
                assert refused.value.names == tuple(setting)
                assert refused.value.place == Place(score)


PULLED = "links.zygomatic_major.frontalis_medialis"
LINK = f'[[entry]]\nid = "{PULLED}"\nvalues = {{ weight = 1.0 }}\nsource = "x"\n'
NOT_LINKS = {
    'delete = ["signals.nod"]\n' + LINK: "mine.toml:1:11: delete signals.nod",
    LINK + '[[entry]]\nid = "lips.phone.AA"\nvalues = {}\nsource = "x"\n': "mine.toml:5:1: lips.phone.AA",
    '[[habit]]\nid = "head.noise.idle"\nnumbers = {}\nsource = "x"\n': "mine.toml:1:1: habit head.noise.idle",
}


@pytest.mark.parametrize(("text", "told"), NOT_LINKS.items(), ids=["rule", "entry", "habit"])
def test_a_pose_and_a_score_read_links_alone_of_a_file_of_rules(text: str, told: str, score: str) -> None:
    Path("mine.toml").write_text(text)
    settings = Settings(rules="mine.toml")
    for perform, reader in (
        (lambda: risorius.pose({"AU4": 1.0}, settings=settings), "a pose"),
        (lambda: risorius.mix(score, settings=settings), "a score"),
    ):
        with pytest.raises(InputError) as refused:
            perform()
        assert str(refused.value) == f"{told} has no effect: {reader} reads only [[entry]] links.*"


def test_links_of_a_file_of_rules_move_the_skin_of_poses_and_scores(score: str) -> None:
    """Paper B, section 6.3: the user's table, which a pose shows, and a score."""
    Path(score).write_text(json.dumps({"risorius": 1, "duration": 1.0, "movements": [GRIN]}))
    Path("half.toml").write_text(LINK.replace("1.0", "0.5"))
    Path("whole.toml").write_text(LINK)

    def skin(perform: Callable[[Settings], risorius.Take], rules: str | None) -> Array:
        take = perform(Settings(rules=rules, dynamics="static"))
        (face,) = take.faces([len(take.times) // 2])
        return face.skin.copy()

    for perform in (
        lambda settings: risorius.pose({"zygomatic_major": 1.0}, settings=settings),
        lambda settings: risorius.mix(score, settings=settings),
    ):
        usual, half, whole = (skin(perform, rules) for rules in (None, "half.toml", "whole.toml"))
        assert np.abs(whole - usual).max() > 1.5 * np.abs(half - usual).max() > 1e-4


@pytest.mark.parametrize(
    "command", [["pose", "AU4=1", "-o", "y.muscles.csv"], ["mix", "x.score.json", "-o", "y.muscles.csv"]]
)
def test_links_have_no_effect_on_curves(
    command: list[str], score: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("mine.toml").write_text(LINK)
    assert run([*command, "--rules", "mine.toml"]) == EXIT_FAULT
    assert "--rules has no effect" in capsys.readouterr().err


@pytest.mark.parametrize(
    "argument",
    [{"emotion": {"anger": 1.0}}, {"audio": "missing.wav"}, {"transcript": "Oh."}],
    ids=lambda argument: next(iter(argument)),
)
def test_a_score_refuses_what_is_said_and_felt(argument: dict[str, object], score: str) -> None:
    with pytest.raises(
        UnusedSettingError, match=f"^x.score.json: {next(iter(argument))} has no effect: the movements"
    ):
        risorius.speak(score, **argument)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("options", "names"),
    [
        (["--emotion", "anger:1"], "--emotion has"),
        (["--audio", "missing.wav"], "--audio has"),
        (["--transcript", "Oh."], "--transcript has"),
        (["--still", "--seed", "4"], "--still, --seed have"),
        (["--attitude", "polite"], "--attitude has"),
        (["--voice-emotion", "off"], "--voice-emotion has"),
        (["--without", "gaze"], "--without has"),
    ],
)
def test_the_command_line_names_the_options(
    options: list[str], names: str, score: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["speak", score, *options, "-o", "x.muscles.csv"]) == EXIT_FAULT
    assert capsys.readouterr().err.startswith(f"risorius: x.score.json: {names} no effect: ")
    assert not Path("x.muscles.csv").exists()


ACTING = [
    Settings(blend=BlendChoices(conflict="sum")),
    Settings(blend=BlendChoices(onset_function="exponential")),
    Settings(blend=BlendChoices(min_onset=0.9)),
    Settings(fps=Fraction(24)),
]


@pytest.mark.parametrize("settings", ACTING)
@pytest.mark.parametrize("perform", [risorius.speak, risorius.mix, risorius.play])
def test_what_acts_after_the_plan_acts_on_a_score(
    perform: Callable[..., risorius.Take], settings: Settings, score: str
) -> None:
    take, usual = perform(score, settings=settings), perform(score)
    assert not np.array_equal(take.performance.values, usual.performance.values)


def test_a_score_keeps_what_is_not_chosen_and_takes_what_planned_scores_have_anyway(score: str) -> None:
    kept, graded = (
        risorius.mix(score, settings=Settings(blend=blend)).score.settings
        for blend in (BlendChoices(min_onset=0.2), BlendChoices(conflict="graded"))
    )
    assert (kept.conflict, kept.min_onset) == ("inhibit", 0.2)
    assert graded.conflict == "graded"


def test_a_setting_that_equals_the_default_is_not_refused(score: str) -> None:
    settings = Settings(seed=0, without=[], lead=0.5)  # type: ignore[arg-type]
    assert risorius.speak(score, emotion=(), settings=settings).duration == 1.0


VOICED = [setting for setting in PLANNING[:6] if "language" not in setting]


@pytest.mark.parametrize("setting", VOICED, ids=lambda setting: next(iter(setting)))
def test_a_recording_refuses_choices_of_a_synthesized_voice(setting: dict[str, object]) -> None:
    with pytest.raises(UnusedSettingError, match=r"^x\.wav: .* has no effect: the voice is recorded"):
        risorius.speak("Oh.", audio="x.wav", settings=Settings(**setting))  # type: ignore[arg-type]


def test_labels_and_silent_and_timed_scripts_refuse_what_no_voice_reads(tmp_path: Path) -> None:
    silent, timed = tmp_path / "a.bml", tmp_path / "b.xml"
    silent.write_text('<bml><head id="nod" lexeme="NOD" start="0" end="1" /></bml>')
    timed.write_text('<PHONEME time="0" text="Oh." />')
    with pytest.raises(UnusedSettingError, match="rate has no effect: the words are timed by a TextGrid"):
        risorius.speak("x.TextGrid", settings=Settings(rate=100))
    with pytest.raises(UnusedSettingError, match="rate has no effect: the script has no words"):
        risorius.speak(str(silent), settings=Settings(rate=100))
    with pytest.raises(UnusedSettingError, match="lead has no effect: the times of this script are absolute"):
        risorius.speak(str(timed), settings=Settings(lead=1.0, rate=200))


def test_a_performance_keeps_its_curves(score: str) -> None:
    risorius.mix(score).write("x.performance.json")
    assert (
        risorius.play("x.performance.json", settings=Settings(fps=Fraction(30), age=60.0)).settings.age
        == 60.0
    )
    for settings in (
        Settings(fps=Fraction(24)),
        Settings(blend=BlendChoices(conflict="sum")),
        Settings(seed=1),
    ):
        with pytest.raises(UnusedSettingError, match="the curves of a performance are final"):
            risorius.play("x.performance.json", settings=settings)


def test_a_capture_a_pose_and_a_character_refuse_what_they_do_not_read() -> None:
    with pytest.raises(UnusedSettingError, match=r"^x\.au\.csv: conflict has no effect: a captured face"):
        risorius.play("x.au.csv", settings=Settings(blend=BlendChoices(conflict="sum")))
    with pytest.raises(UnusedSettingError, match="fps, at have no effect: a pose"):
        risorius.pose({}, settings=Settings(at=1.0, fps=Fraction(25)))
    with pytest.raises(UnusedSettingError, match=r"^x\.glb: style has no effect: a character"):
        risorius.rig("x.glb", settings=Settings(look=Look(style="clay")))


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["rig", "x.glb", "--fps", "24"], "--fps has no effect: a character"),
        (["speak", "--audio", "x.wav", "--text"], "--text has no effect: INPUT is missing"),
        (
            ["stream", "Oh.", "--names", "arkit"],
            "--names has no effect: livelink does not use it; expected the protocol vmc",
        ),
        (["stream", "Oh.", "--protocol", "vmc", "--subject", "me"], "--subject has no effect: vmc does not"),
        (["stream", "Oh.", "--preset", "close-up"], "has no effect: no output is a picture or a video"),
        (["stream", "--text"], "nothing to perform; expected a text, a file or --audio"),
        (["stream", "Oh.", "--patience", "2"], "--patience has no effect: only --listen waits for"),
    ],
)
def test_options_of_other_commands(
    options: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(options) == EXIT_FAULT
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "outputs", "expected"),
    [
        (["--size", "64x64"], ["x.wav"], "--size has no effect: no output is a picture or a video"),
        (["--at", "1"], ["x.mp4"], "--at has no effect: no output is a single picture"),
        (["--every", "2"], ["x.obj"], "--every has no effect: no output is a single picture"),
        (
            ["--age", "60", "--skin", "static"],
            ["x.muscles.csv"],
            "--age, --skin have no effect: no output depends",
        ),
        (["--fps", "24"], ["x.score.json", "x.TextGrid"], "--fps has no effect: no output has frames"),
        (["--hair", "bald"], ["x.arkit.csv"], "--hair has no effect: no output shows hair"),
        (["--seed", "3"], ["x.TextGrid"], "--seed has no effect: no output has movements"),
    ],
)
def test_what_changes_no_output_is_refused(
    options: list[str], outputs: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["speak", "Oh.", *options, *(word for name in outputs for word in ("-o", name))]) == EXIT_FAULT
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize(
    ("settings", "outputs"),
    [
        (Settings(size=(64, 64)), ["x.wav", "x.png"]),
        (Settings(at=1.0), ["x.obj"]),
        (Settings(look=Look(hair="bald")), ["x.obj"]),
        (Settings(fps=Fraction(24)), ["x.visemes.dat"]),
        (Settings(look=Look(complexion=0.5)), ["x.glb"]),
        (Settings(seed=1, blend=BlendChoices(conflict="sum")), ["x.score.json"]),
        (Settings(), ["x.wav"]),
    ],
)
def test_what_changes_one_output_is_not_refused(settings: Settings, outputs: list[str]) -> None:
    reject_unwritten(settings, [format_for(Path(name)) for name in outputs])


def test_what_is_chosen_is_what_is_not_the_default() -> None:
    assert list(chosen(Settings())) == []
    settings = Settings(seed=1, age=0.0, look=Look(hair="bald"), blend=BlendChoices(contact=False))
    assert list(chosen(settings)) == ["age", "seed", "hair", "contact"]


def test_an_error_is_spelled_as_options() -> None:
    error = UnusedSettingError(["seed", "lively"], "why").at(Place("x"))
    assert str(error.spelled(lambda name: f"--{name}")) == "x: --seed, --lively have no effect: why"
