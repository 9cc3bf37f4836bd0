"""The law of options: each option of each command reaches what it is for, and changes what is written.

Options are enumerated here, so that a new one without a case fails.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import click
import pytest

from risorius import api
from risorius.charts import figures as charts
from risorius.cli import commands, run
from risorius.live import stream
from risorius.live.serve import server as live_server
from risorius.settings import Settings, settings_of
from risorius.settings.declare import rows
from risorius.studio import server

from .collected import all_cases
from .setting_cases import BASE, CASES

if TYPE_CHECKING:
    from risorius.batches.library import BatchPlan
    from risorius.cli.console import Console

pytestmark = pytest.mark.usefixtures("rules_file")
NO_BYTE = {
    "patience": "how long the command waits for a receiver's greeting",
    "without_sound": "which clock counts while frames are sent",
    "port": "where a server is",
    "host": "where a server listens",
    "token_file": "who may use a server",
    "origins": "whose pages may use a server",
    "clients": "how many may use a server",
    "rig": "whose weights a server can send: tests/live/serve/test_server.py",
    "no_browser": "who opens the studio's page",
    "folder": "where the studio's sessions are",
    "jobs": "how many processes perform a batch",
    "timeout": "when a line of a batch is given up",
    "ray": "which cluster performs a batch",
    "journal": "where the journal of a batch is",
    "help": "prints the help",
    "quiet": "how much is said: tests/cli/test_messages.py",
    "json": "in which form it is said: tests/cli/test_messages.py",
}
"""Options that by design change no byte of any output, and what they do."""


VALUES: dict[str, list[str]] = {
    "outputs": ["-o", "z.png"],
    "align outputs": ["-o", "z.TextGrid"],
    "is_text": ["--text"],
    "emotions": ["--emotion", "anger:0.5"],
    "audio": ["--audio", "x.wav"],
    "transcript": ["--transcript", "Ah."],
    "face": ["--face", "1"],
    "protocol": ["--protocol", "vmc"],
    "to": ["--to", "10.0.0.1"],
    "listen": ["--listen", "127.0.0.1"],
    "patience": ["--patience", "1"],
    "subject": ["--subject", "me"],
    "stream names": ["--names", "arkit"],
    "without_sound": ["--without-sound"],
    "map_file": ["--map", "x.toml"],
    "perform": ["--perform", "Ah."],
    "output": ["-o", "z.glb"],
    "explain at": ["--at", "0"],
    "parameter": ["--parameter", "head_yaw"],
    "parameters": ["--parameter", "head_yaw"],
    "start": ["--start", "1"],
    "end": ["--end", "1"],
    "port": ["--port", "1"],
    "no_browser": ["--no-browser"],
    "folder": ["--folder", "x"],
    "host": ["--host", "::1"],
    "token_file": ["--token-file", "token.txt"],
    "origins": ["--origin", "https://example.org"],
    "clients": ["--clients", "2"],
    "rig": ["--rig", "x.glb"],
    "batch outputs": ["-o", "{id}.glb"],
    "jobs": ["--jobs", "0"],
    "timeout": ["--timeout", "9"],
    "ray": ["--ray", "local"],
    "shard": ["--shard", "1/2"],
    "dry_run": ["--dry-run"],
    "ignore": ["--ignore", "note"],
    "journal": ["--journal", "x"],
    "sheets": ["--contact-sheet"],
    "presets": ["--preset", "close-up"],
    "configs": ["--config", "own.toml"],
}
"""What gives each option that is no setting a value."""


class FakeTake:
    """What a command writes, without anything behind it."""

    def __init__(self, calls: list[object]) -> None:
        self.calls, self.utterance = calls, None

    def write(self, *paths: Path, **_: object) -> None:
        self.calls.append(paths)


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """What the commands ask of the library, whose functions do nothing."""
    asked: list[object] = []

    def watched(name: str, result: object) -> Callable[..., object]:
        def call(*arguments: object, **options: object) -> object:
            named = {key: _plain(value) for key, value in options.items() if key not in ("progress", "say")}
            asked.append((name, *map(_plain, arguments), named))
            return result

        return call

    api.pose({}).write("x.performance.json")
    Path("token.txt").write_text("0123456789abcdef")
    Path("own.toml").write_text('light = "dark"\n')
    for name in ("speak", "mix", "play", "pose", "align"):
        monkeypatch.setattr(api, name, watched(name, FakeTake(asked)))
    monkeypatch.setattr(charts, "figures", watched("figures", None))
    character = SimpleNamespace(shapes={}, missing=(), unused=())
    monkeypatch.setattr(api, "rig", watched("rig", (character, [])))
    monkeypatch.setattr(stream, "send_take", watched("send_take", stream.SendCounts(1, 0)))
    for servers, command in ((server, "studio"), (live_server, "serve")):
        monkeypatch.setattr(servers, "serve", watched("serve", None))
        monkeypatch.setattr(sys.modules[f"risorius.cli.{command}"], "leave", lambda: None)
    for name in ("_perform", "_check"):
        monkeypatch.setattr(sys.modules["risorius.cli.batch"], name, partial(_planned, asked, name))
    return asked


def _planned(asked: list[object], name: str, plan: BatchPlan, console: Console) -> int:
    asked.append((name, {"settings": plan.settings, "plan": plan}))
    return 0


def _plain(value: object) -> object:
    """Return a value that can be compared: a performance to come is what it will be made of."""
    if isinstance(value, partial):
        return (*value.args, {name: it for name, it in value.keywords.items() if name != "progress"})
    return None if isinstance(value, FakeTake) else value


def _options() -> Iterator[tuple[str, click.Option]]:
    for name, command in commands.commands.items():
        inner = command.commands.items() if isinstance(command, click.Group) else [("", command)]
        for sub, leaf in inner:
            for parameter in leaf.params:
                if isinstance(parameter, click.Option):
                    yield f"{name} {sub}".strip(), parameter


EVERY_OPTION = sorted(_options(), key=lambda it: (it[0], str(it[1].name)))


ARGUMENTS = {
    "speak": ["Oh.", "-o", "x.png"],
    "align": ["x.wav", "Oh.", "-o", "x.TextGrid"],
    "mix": ["x.score.json", "-o", "x.png"],
    "play": ["x.arkit.csv", "-o", "x.png"],
    "pose": ["AU1=1", "-o", "x.png"],
    "stream": ["Oh."],
    "rig": ["x.glb", "--perform", "Oh.", "-o", "y.glb"],
    "explain": ["x.performance.json"],
    "figures": ["x.score.json", "-o", "x.png"],
    "rules list": [],
    "rules show": ["signals.brows.nuclear"],
    "rules doctor": [],
    "serve": [],
    "studio": [],
    "batch": ["lines.csv", "-o", "{id}.png"],
}


BESIDE = {
    "transcript": ["--audio", "x.wav"],
    "listen": ["--protocol", "ifacialmocap"],
    "patience": ["--protocol", "ifacialmocap", "--listen", "127.0.0.1"],
    "stream names": ["--protocol", "vmc"],
    "names": ["-o", "x.vrma"],
    "parameter": ["--at", "0"],
}
"""What an option needs beside it."""


def _beside(command: str, name: str) -> list[str]:
    return BESIDE.get(f"{command} {name}", BESIDE.get(name, []))


def _value_of(command: str, option: click.Option) -> list[str]:
    """Return the words that give an option a value that is not its default."""
    name = str(option.name)
    words = VALUES.get(f"{command} {name}", VALUES.get(name))
    if words is not None:
        return words
    row = rows(Settings).get(name)
    assert row is not None, f"{command} {option.opts[-1]} is a new option: give it a value"
    if option.is_flag:
        return [option.opts[-1]]
    value: Any = CASES[name]
    return [option.opts[-1], row.text(value)]


@pytest.mark.parametrize("command", dict.fromkeys(command for command, _ in EVERY_OPTION))
def test_every_option_reaches_what_it_is_for(
    command: str, calls: list[object], capsys: pytest.CaptureFixture[str]
) -> None:
    def outcome_of(words: list[str], option: click.Option) -> object:
        calls.clear()
        code = run([*command.split(), *ARGUMENTS[command], *_beside(command, str(option.name)), *words])
        return code, [*calls], capsys.readouterr().out

    with all_cases() as case:
        for option in (option for its, option in EVERY_OPTION if its == command):
            with case(option.opts[-1]):
                without = outcome_of([], option)
                assert outcome_of(_value_of(command, option), option) != without
                expected = _expected_of(command, str(option.name))
                assert expected is None or any(expected in _settings_in(call) for call in calls)


def _expected_of(command: str, name: str) -> Settings | None:
    """Return the settings with which a command calls the library if an option is given; None if none."""
    if command.partition(" ")[0] in ("rules", "align") or f"{command} {name}" in VALUES:
        return None
    return settings_of({name: CASES[name]}) if name in rows(Settings) else None


def _settings_in(call: object) -> list[Settings]:
    """Return the settings in a call, or in the performance that it is to wait for."""
    named = call[-1].values() if isinstance(call, tuple) and call and isinstance(call[-1], dict) else ()
    inner = [settings for value in named if isinstance(value, tuple) for settings in _settings_in(value)]
    return [*inner, *(value for value in named if isinstance(value, Settings))]


def test_every_option_changes_bytes_or_is_known_to_change_none() -> None:
    own = {str(option.name) for _, option in EVERY_OPTION} - set(rows(Settings))
    assert own - set(NO_BYTE) == set(CHANGING)
    assert set(NO_BYTE) <= own | {"help", "quiet", "json"}


def _written(arguments: list[str], *names: str) -> object:
    code = run(arguments)
    return code, [Path(name).read_bytes() for name in names if Path(name).exists()], sorted(Path().iterdir())


ON_FILES: list[tuple[str, list[str], list[str]]] = [
    ("is_text", ["speak", "x.txt", "-o", "y.TextGrid"], ["--text"]),
    ("emotions", ["speak", "Oh.", "-o", "y.TextGrid", "-o", "y.score.json"], ["--emotion", "anger:1"]),
    ("emotions", ["pose", "AU1=1", "-o", "y.muscles.csv"], ["--emotion", "anger:1"]),
    ("audio", ["speak", "x.TextGrid", "-o", "y.wav"], ["--audio", "x.wav"]),
    ("audio", ["play", "x.score.json", "-o", "y.wav"], ["--audio", "x.wav"]),
    ("outputs", ["speak", "Oh.", "-o", "y.TextGrid"], ["-o", "y.wav"]),
]


@pytest.mark.parametrize(
    ("name", "arguments", "option"), ON_FILES, ids=[f"{it[1][0]} {it[0]}" for it in ON_FILES]
)
def test_options_that_choose_what_is_performed_change_what_is_written(
    name: str, arguments: list[str], option: list[str]
) -> None:
    Path("x.txt").write_text("Hello.")
    api.speak("Oh, my.", settings=BASE).write("x.TextGrid", "x.wav", "x.score.json")
    names = [word for word in arguments if word.startswith("y.")]
    without = _written(arguments, *names)
    for written in names:
        Path(written).unlink(missing_ok=True)
    assert _written([*arguments, *option], *names) != without


CHANGING = {
    **{name: "files" for name, _, _ in ON_FILES},
    **dict.fromkeys(("protocol", "subject", "to", "listen"), "packets: tests/stream"),
    **dict.fromkeys(("map_file", "perform", "output"), "the character: tests/ports/mesh/test_rig.py"),
    "transcript": "words: tests/speech/test_from_recording.py",
    "parameter": "what explain prints",
    "face": "one of several faces: tests/ports/curves/test_au_csv.py",
    **dict.fromkeys(("parameters", "start", "end"), "what is drawn: tests/charts"),
    **dict.fromkeys(("presets", "configs"), "settings: tests/settings/test_presets.py"),
    **dict.fromkeys(
        ("shard", "dry_run", "ignore", "sheets"), "which lines are made, and the report: tests/batches"
    ),
}
"""Options that change what is written or sent, and where that is seen."""
