"""Options are derived from the table of settings: their help, their groups, what completes them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import click
import pytest
from click.shell_completion import ShellComplete

from risorius.cli import commands, run
from risorius.cli.options import flag, settings_from
from risorius.core.score import BlendSettings
from risorius.settings import Settings
from risorius.settings.declare import Group, rows


def completed(*words: str) -> list[str]:
    """Return what a shell offers for the last word."""
    shell = ShellComplete(commands, {}, "risorius", "_RISORIUS_COMPLETE")
    return [item.value for item in shell.get_completions(list(words[:-1]), words[-1])]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("speak", "--conf"), ["--config", "--conflict"]),
        (("speak", "--preset", "clo"), ["close-up"]),
        (("speak", "--conflict", "in"), ["inhibit"]),
        (("speak", "--skin", ""), ["springs", "biphasic", "static"]),
        (("speak", "--overlay", "caption,b"), ["caption,bars"]),
        (("speak", "--emotion", "hap"), ["happiness:"]),
        (("speak", "--shape", "nose_w"), ["nose_width:"]),
        (("speak", "--head", "st"), ["standard"]),
        (("speak", "--attitude", "iro"), ["ironic"]),
        (("speak", "--voice-emotion", "o"), ["on", "off"]),
        (("speak", "--fps", "24"), ["24", "24000/1001"]),
        (("pose", "--complexion", "t"), ["tan"]),
        (("rules", "d"), ["doctor"]),
        (("rules", "show", "signals.brows.c"), ["signals.brows.contrast"]),
        (
            ("pose", "AU44"),
            ["AU44="],
        ),
        (("explain", "x.performance.json", "--parameter", "zygomatic_ma"), ["zygomatic_major"]),
        (("stream", "--protocol", "v"), ["vmc"]),
        (("stream", "--names", "vrm"), ["vrm0", "vrm1"]),
        (("list", "mus"), ["muscles"]),
    ],
)
def test_a_shell_completes_values(words: tuple[str, ...], expected: list[str]) -> None:
    assert completed(*words) == expected


def test_what_the_page_offers_is_offered() -> None:
    page = (Path(__file__).parents[2] / "docs" / "completion.md").read_text()
    rows = re.findall(r"^\| `risorius ([^`]*)` \| (.*) \|$", page, re.MULTILINE)
    assert len(rows) == 6
    for typed, offered in rows:
        assert completed(*typed.split()) == re.findall(r"`([^`]*)`", offered)


def test_help_has_the_groups_of_the_table_in_its_order(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["speak", "--help"]) == 0
    shown = capsys.readouterr().out
    places = [shown.index(f"\n{title}:\n") for title in ("Input", *Group, "Options")]
    assert places == sorted(places)
    assert "--rate WPM" in shown
    assert "[default: 720x720]" in shown


def test_speak_has_an_option_for_every_setting_that_has_one() -> None:
    (speak,) = (command for name, command in commands.commands.items() if name == "speak")
    options = {parameter.name for parameter in speak.params if isinstance(parameter, click.Option)}
    assert {row.name for row in rows(Settings).values() if row.flag is not None} <= options


def test_values_that_count_for_nothing_are_still_chosen() -> None:
    switched = {"lively": True, "contact": True, "voice_emotion": "off"}
    settings = settings_from({"age": 0.0, "seed": 0, "lead": 0.0, "tail": None, **switched})
    assert (settings.age, settings.lead, settings.tail) == (0.0, 0.0, 0.7)
    assert (settings.lively, settings.blend.contact, settings.voice_emotion) == (False, False, False)


def test_settings_are_named_by_their_options() -> None:
    assert [flag(name) for name in ("dynamics", "lively", "contact", "emotion", "min_onset")] == [
        "--skin", "--still", "--without-contact", "--emotion", "--min-onset",
    ]  # fmt: skip


def shown_default(text: str, option: str) -> str:
    """Return the default that help names for an option."""
    found = re.search(rf"  {option} .*?\[default: ([^\]]*)\]", " ".join(text.split()).replace(" --", "  --"))
    assert found is not None, option
    return found[1]


def test_mix_combines_a_score_that_says_nothing_by_the_defaults_that_its_help_names(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["mix", "--help"]) == 0
    text = capsys.readouterr().out
    named = {o: shown_default(text, o) for o in ("--conflict", "--lips", "--onset-function")}
    assert all(default.startswith("the score's, or ") for default in named.values())
    movement = {"channel": "emotion", "start": 0.2, "end": 1.8, "onset": 0.5, "offset": 0.4}
    score = {
        "risorius": 1,
        "duration": 2.0,
        "movements": [
            {**movement, "targets": {"zygomatic_major": 0.8}},
            {**movement, "channel": "signals", "start": 0.9, "targets": {"triangularis": 0.2}},
        ],
    }
    file = tmp_path / "bare.score.json"
    file.write_text(json.dumps(score))

    def mixed(*options: str) -> str:
        assert run(["mix", str(file), *options]) == 0
        return capsys.readouterr().out

    bare = mixed()
    conflict = named["--conflict"].removeprefix("the score's, or ")
    assert mixed("--conflict", conflict) == bare
    assert all(mixed("--conflict", other) != bare for other in {"inhibit", "graded", "sum"} - {conflict})
    function = re.search(r"(\w+) if it names none", named["--onset-function"])
    assert function is not None
    assert mixed("--onset-function", function[1]) == bare
    assert mixed("--onset-function", "linear") != bare
    assert named["--lips"].endswith(BlendSettings().lips)
