"""Settings kept in files: presets and configurations, and what is wrong with one."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

import risorius
from risorius.cli import run
from risorius.errors import RisoriusError
from risorius.settings import Settings, settings_of
from risorius.settings.presets import load_settings, presets, values_of


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", presets())
def test_every_preset_changes_settings_and_says_what_it_is_for(name: str) -> None:
    assert load_settings(name) == settings_of(values_of((name,))) != Settings()
    assert len(presets()[name]) > 10


def test_files_lie_over_presets_and_options_over_both(folder: Path) -> None:
    Path("own.toml").write_text(
        'fps = 25\nskin = "static"\nshape = {nose_width = 0.5}\nattitude = ["polite"]\n'
    )
    settings = risorius.load_settings("draft", "own.toml", size="64x48")
    assert (settings.fps, settings.size, settings.look.quality) == (Fraction(25), (64, 48), "draft")
    assert (settings.dynamics, settings.shape, settings.attitudes) == (
        "static",
        {"nose_width": 0.5},
        ("polite",),
    )
    assert load_settings() == Settings()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("fps = 25\nfsp = 30", r"own\.toml:2:1: unknown setting 'fsp'; did you mean 'fps'"),
        ("fps = true", r"own\.toml:1:1: fps 'bool' is not a number"),
        ("\n\nfps = 0", r"own\.toml:3:1: fps = 0 is out of range"),
        ('light = "sun"', r"own\.toml:1:1: unknown light 'sun'; expected one of studio, daylight, dark"),
        ("lively = 3", r"own\.toml:1:1: lively = 3 is not True or False"),
        ("size = [1, 2, 3]", r"own\.toml:1:1: size = \(1, 2, 3\) is not width and height"),
        ("size = 720", r"own\.toml:1:1: size = 720 is not width and height"),
        ("camera = 5", r"own\.toml:1:1: camera = 5 is not a text"),
        ("[look]\nlight = 1", r"own\.toml:1:1: unknown setting 'look'"),
        ("fps = ", r"own\.toml: is not a TOML file: Invalid value"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(text: str, message: str, folder: Path) -> None:
    Path("own.toml").write_text(text)
    with pytest.raises(RisoriusError, match=message):
        load_settings("own.toml")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--preset", "closeup"], "unknown preset 'closeup'; did you mean 'close-up'?"),
        (["--config", "missing.toml"], "missing.toml: cannot be read: No such file or directory"),
        (["--config", "close-up"], "close-up: is not a .toml file; expected one for --config"),
    ],
)
def test_the_command_line_tells_it(
    arguments: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["pose", "AU1=1", *arguments, "-o", "x.muscles.csv"]) == 2
    assert capsys.readouterr().err == f"risorius: {message}\n"


def test_a_file_of_settings_changes_what_is_written(folder: Path) -> None:
    Path("own.toml").write_text("fps = 5\nlead = 0.0\ntail = 0.0\n")
    arguments = [
        "speak",
        "Oh.",
        "--preset",
        "paper-a",
        "--config",
        "own.toml",
        "--tail",
        "1",
        "-o",
        "x.score.json",
    ]
    assert run(arguments) == 2  # no output has frames
    assert run([*arguments, "-o", "x.muscles.csv"]) == 0
    times = [float(row.split(",")[0]) for row in Path("x.muscles.csv").read_text().splitlines()[1:]]
    assert times[1] == 0.2
    assert times[-1] > 1.0
    assert json.loads(Path("x.score.json").read_text())["settings"]["conflict"] == "inhibit"


def test_the_file_that_the_docs_show_can_be_used(folder: Path) -> None:
    page = Path(__file__).parents[2] / "docs" / "reference.md"
    Path("shown.toml").write_text(page.read_text().split("```toml\n")[1].split("```")[0])
    assert load_settings("shown.toml").attitudes == ("polite",)
