"""The table of settings: what is out of range, and what is derived from it."""

from __future__ import annotations

import ast
import importlib.util
import inspect
import re
from collections.abc import Callable
from dataclasses import fields, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from risorius import settings
from risorius.core.score import BlendSettings
from risorius.errors import InputError, RisoriusError
from risorius.settings import BlendChoices, Look, Settings, parse_size, settings_of
from risorius.settings.declare import rows

from ..collected import all_cases

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"fpss": 30}, "unknown setting 'fpss'; did you mean 'fps'"),
        ({"fps": "0"}, "fps = 0 is out of range"),
        ({"fps": "fast"}, "fps 'fast' is not a number"),
        ({"size": "720"}, "size '720' is not a size; expected e.g. 720x720"),
        ({"size": "8x720"}, "the width of size = 8 is out of range; expected 16 to 4096"),
        ({"rate": 79}, "rate = 79 is out of range; expected 80 to 440"),
        ({"lead": -0.1}, r"lead = -0\.1 is out of range; expected 0 to 60"),
        ({"articulation": "2.5"}, r"articulation = 2\.5 is out of range; expected 0 to 2"),
        ({"seed": "one"}, "seed 'one' is not a whole number"),
        ({"seed": -1}, "seed = -1 is out of range"),
        ({"every": 0}, "every = 0 is out of range; expected 1 to 1e"),
        ({"at": -1.0}, r"at = -1\.0 is out of range"),
        ({"dynamics": "spring"}, "unknown skin 'spring'; did you mean 'springs'"),
        ({"hair": "bold"}, "unknown hair style 'bold'; did you mean 'bald'"),
        ({"shape": "nose_widht:1"}, "unknown slider 'nose_widht'"),
        ({"min_onset": 11.0}, r"min_onset = 11\.0 is out of range; expected 0 to 10"),
        ({"voice_emotion": "maybe"}, "unknown voice emotion 'maybe'; expected one of on, off"),
    ],
)
def test_a_wrong_value_is_named(values: dict[str, object], message: str) -> None:
    with pytest.raises(RisoriusError, match=message):
        settings_of(values)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"profile": "livley"}, "unknown profile 'livley'; did you mean 'lively'"),
        ({"profile": "mine.toml"}, "mine.toml: cannot be read"),
        ({"profile": 5}, "profile = 5 is not a text"),
        ({"head": "olav"}, "unknown head 'olav'; did you mean 'olaf'"),
        ({"attitudes": ("polte",)}, "unknown attitude 'polte'; did you mean 'polite'"),
        ({"attitudes": 5}, "attitudes = 5 is not a sequence of names"),
        ({"attitudes": "polte"}, "unknown attitude 'polte'; did you mean 'polite'"),
        ({"size": (640, 480, 1)}, r"size = \(640, 480, 1\) is not width and height"),
        ({"age": "old"}, "age 'old' is not a number; expected 0 to 100"),
        ({"seed": "x"}, "seed 'x' is not a whole number; expected 0 or more"),
        ({"without": ("gase",)}, "unknown channel 'gase'; did you mean 'gaze'"),
        ({"manner": "shoot"}, "unknown manner of speech 'shoot'; did you mean 'shout'"),
        ({"shape": {"nose_widht": 1.0}}, "unknown slider 'nose_widht'; did you mean 'nose_width'"),
        ({"shape": {"nose_width": 1.5}}, r"shape nose_width = 1\.5 is out of range; expected -1 to 1"),
        ({"wrinkles": {"forehead": -1}}, "wrinkles forehead = -1 is out of range; expected 0 to 2"),
        ({"lively": "yes"}, "unknown lively 'yes'; expected one of on, off"),
        ({"blend": {}}, "blend is dict; expected risorius.BlendChoices"),
        ({"at": 1.0, "every": 2}, "at has no effect: every makes a sheet of the whole clip"),
    ],
)
def test_what_is_wrong_is_told_when_settings_are_made(values: dict[str, Any], message: str) -> None:
    with pytest.raises(RisoriusError, match=message):
        Settings(**values)


def test_choices_that_lips_and_blends_do_not_know_are_told_when_they_are_made() -> None:
    with pytest.raises(RisoriusError, match="unknown conflict policy 'grade'; did you mean 'graded'"):
        BlendChoices(conflict="grade")


def test_a_rate_is_a_fraction_and_a_file_a_path_however_they_are_given() -> None:
    settings = Settings(fps=29.97, rules="mine.toml")
    assert (settings.fps, settings.rules) == (Fraction(2997, 100), Path("mine.toml"))
    assert replace(settings, fps="24000/1001").fps == Fraction(24000, 1001)


def test_nothing_chosen_is_the_default() -> None:
    assert settings_of({}) == settings_of(dict.fromkeys(rows(Settings))) == Settings()


def test_values_go_where_they_belong_and_texts_are_read() -> None:
    values = {"fps": "24000/1001", "camera": "eyes:135", "conflict": "sum", "size": "64x32", "age": "40"}
    expected = Settings(
        fps=Fraction(24000, 1001), size=(64, 32), age=40.0,
        look=Look(camera="eyes", lens=135.0), blend=BlendChoices(conflict="sum"),
    )  # fmt: skip
    assert settings_of(values) == expected
    assert settings_of({"age": 50.0}, expected).look.lens == 135.0
    several = settings_of({"shape": "nose_width:1; ear_size:-0.5", "attitudes": "polite;ironic", "seed": 0})
    assert several.shape == {"nose_width": 1.0, "ear_size": -0.5}
    assert several.attitudes == ("polite", "ironic")


def test_choices_of_blend_lie_over_a_score_and_over_what_is_usual() -> None:
    score = BlendSettings("inhibit", min_onset=0.2)
    assert BlendChoices().over(score) == score
    assert BlendChoices(conflict="graded", contact=False).over(score) == BlendSettings(
        "graded", min_onset=0.2, contact=False
    )
    assert BlendChoices().planned() == BlendSettings("graded", rounding=0.02)
    assert BlendChoices(onset_function="linear").planned().rounding == 0.0
    assert [f.name for f in fields(BlendChoices)] == [f.name for f in fields(BlendSettings)]


def test_every_setting_is_whole() -> None:
    with all_cases() as case:
        for row in rows(Settings).values():
            entry = row.entry
            with case(row.name):
                assert entry.help.endswith((".", "…"))
                assert entry.label
                assert (entry.low is None) == (entry.high is None)
                assert entry.names is None or entry.names.choices()
                needs_none = row.flag is None or row.name in ("rules", "every")
                assert row.usual is not None or entry.unset or needs_none


def test_no_help_spells_names_that_the_table_knows() -> None:
    """Help has {names} in place of a list that would have to be kept up to date by hand."""
    spelled = []
    for call in ast.walk(ast.parse(inspect.getsource(settings))):
        if isinstance(call, ast.AnnAssign) and isinstance(call.target, ast.Name):
            row = rows(Settings).get(call.target.id)
            if row is None or row.entry.names is None or not isinstance(call.value, ast.Call):
                continue
            if row.entry.find == settings.BY_VOICE:
                continue  # its help has examples
            texts = [node.value for node in call.value.args if isinstance(node, ast.Constant)]
            words = set(re.findall(r"[\w-]+", " ".join(map(str, texts[2:]))))
            known = {choice.name for choice in row.entry.names.choices()}
            spelled += [f"{row.name}: {words & known}"] if len(words & known) > 1 else []
    assert spelled == []


def test_help_names_what_can_be_chosen() -> None:
    row = rows(Settings)["conflict"]
    assert row.entry.help.endswith(": inhibit, graded, attenuate or sum.")
    assert rows(Settings)["rate"].entry.help == "Words per minute, 80 to 440."


def test_parse_size() -> None:
    assert parse_size("640X480") == (640, 480)
    with pytest.raises(InputError):
        parse_size("640x480x3")


def test_the_page_of_settings_is_up_to_date() -> None:
    spec = importlib.util.spec_from_file_location("settings_page", DOCS / "settings_page.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert module.PAGE.read_text(encoding="utf-8") == module.page(), "run python docs/settings_page.py"
    assert inspect.getdoc(module)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Settings(fsp=30), "unknown setting 'fsp'; did you mean 'fps'"),
        (lambda: Look(camra="close-up"), "unknown setting 'camra'; did you mean 'camera'"),
        (
            lambda: Settings(camera="close-up"),
            r"camera is a setting of look; .*load_settings\(camera=",
        ),
        (
            lambda: Settings(conflict="sum"),
            r"conflict is a setting of blend; .*\(blend=BlendChoices\(conf",
        ),
    ],
)
def test_a_name_that_is_none_is_told_the_nearest(make: Callable[[], object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        make()


@pytest.mark.parametrize(
    ("settings", "field", "value"),
    [
        (Settings(size="640x480"), "size", (640, 480)),
        (Settings(size=[640, 480]), "size", (640, 480)),
        (Settings(attitudes="polite"), "attitudes", ("polite",)),
        (Settings(without=["lips", "gaze"]), "without", ("lips", "gaze")),
        (Settings(voice_emotion="off"), "voice_emotion", False),
        (Settings(shape="nose_width:0.5"), "shape", {"nose_width": 0.5}),
        (Settings(age="40"), "age", 40.0),
        (Look(complexion="tan"), "complexion", 0.5),
        (Look(overlay="bars,caption"), "overlay", ("caption", "bars")),
        (Look(camera="close-up:50"), "lens", 50.0),
        (Look(camera="close-up", lens=50.0), "lens", 50.0),
        (replace(Look(lens=50.0), camera="eyes"), "lens", 50.0),
        (replace(Look(lens=50.0), camera="eyes:60"), "lens", 60.0),
    ],
)
def test_settings_take_what_the_command_line_takes(settings: Any, field: str, value: object) -> None:
    assert getattr(settings, field) == value
