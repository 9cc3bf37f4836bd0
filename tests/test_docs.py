"""The documentation cannot lie: its commands run, its files exist, and nothing is left out."""

from __future__ import annotations

import inspect
import re
import shlex
import shutil
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

import risorius
from risorius.cli import commands, run
from risorius.cli.listing import LISTINGS
from risorius.core.channels import CHANNELS
from risorius.errors import UnusedSettingError
from risorius.ports.formats import FORMATS, FileFormat, format_for
from risorius.settings import Settings
from risorius.unused_settings import reject_unwritten
from tests.collected import all_cases
from tests.profiles import everyday, samples

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.DOTALL | re.MULTILINE)
PRINTED = re.compile(r"^```sh\n(?:(?!```).*\n)*```\n```\n((?:(?!```).*\n)*)```", re.MULTILINE)
"""What a page shows as printed by the commands before it."""
SMALL = {"--size": ("64x64", Settings(size=(64, 64)))} | samples(
    {}, everyday={"--fps": ("6", Settings(fps=Fraction(6)))}
)
"""Options of commands that have them, unless they are given or change no output."""
SAVED = re.compile(r"`(\w+\.toml)`:\n```toml\n(.*?)^```", re.DOTALL | re.MULTILINE)
"""Files that a page asks its reader to write."""


def blocks(page: Path, language: str) -> list[str]:
    return [text for name, text in BLOCK.findall(page.read_text()) if name == language]


def pages_with(language: str) -> list[Path]:
    return [page for page in PAGES if blocks(page, language)]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def smaller(arguments: list[str]) -> list[str]:
    """Return options by which a command has less to draw, and starts no processes for a few lines."""
    known = {name for option in commands.commands[arguments[0]].params for name in option.opts}
    formats = [format_for(Path(b)) for a, b in pairwise(arguments) if a == "-o"]
    alone = ["--jobs", "0"] if arguments[0] == "batch" else []
    return alone + [
        text
        for name, (value, settings) in SMALL.items()
        if name in known - {*arguments} and changes_output(settings, formats)
        for text in (name, value)
    ]


def written(pattern: str) -> bool:
    """Whether there are files of that name, and none is empty."""
    files = list(Path().glob(pattern))
    return bool(files) and all(file.stat().st_size > 0 for file in files)


def changes_output(settings: Settings, formats: list[FileFormat]) -> bool:
    try:
        reject_unwritten(settings, formats)
    except UnusedSettingError:
        return False
    return True


DRAWN = {"formats.md", "looks.md", "recordings.md", "start.md"}
"""Pages whose many commands draw and fit; what they name is tested daily where it is made."""


@pytest.mark.parametrize(
    "page", everyday(pages_with("sh"), [p for p in PAGES if p.name not in DRAWN]), ids=lambda p: p.name
)
def test_commands_run(page: Path, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in SAVED.findall(page.read_text()):
        (folder / name).write_text(text)
    for line in "".join(blocks(page, "sh")).splitlines():
        program, *arguments = shlex.split(line, comments=True)
        assert program == "risorius"
        assert run([*arguments, *smaller(arguments)]) == 0, line
        if "--dry-run" not in arguments:
            patterns = [re.sub(r"\{\w+\}", "**/*", b) for a, b in pairwise(arguments) if a == "-o"]
            assert all(written(pattern) for pattern in patterns), line
    printed = " ".join(capsys.readouterr().out.split())
    for shown in PRINTED.findall(page.read_text()):
        assert " ".join(shown.split()) in printed, shown


@pytest.mark.parametrize("page", pages_with("python"), ids=lambda p: p.name)
def test_python_runs(page: Path, folder: Path) -> None:
    for code in blocks(page, "python"):
        exec(compile(code, str(page), "exec"), {})


@pytest.mark.parametrize("language", ["xml", "json"])
def test_scripts_and_scores_perform(language: str, folder: Path) -> None:
    with all_cases() as case:
        for page in pages_with(language):
            for number, text in enumerate(blocks(page, language)):
                source = folder / f"{page.stem}-{number}.{language}"
                source.write_text(text)
                with case(source.name):
                    assert run(["speak", str(source), "-o", "x.muscles.csv"]) == 0


def test_rules_are_rules_and_the_doctor_finds_them_well(folder: Path) -> None:
    with all_cases() as case:
        for page in pages_with("toml"):
            for number, text in enumerate(block for block in blocks(page, "toml") if "[[rule]]" in block):
                file = folder / f"{page.stem}-{number}.toml"
                file.write_text(text)
                with case(file.name):
                    if "\nbase = " in text:  # a profile with rules of its own
                        spoken = ["speak", "So it is.", "--profile", str(file), "-o", "x.score.json"]
                        assert run(spoken) == 0
                    else:
                        assert run(["rules", "doctor", "--rules", str(file)]) == 0


def test_links_lead_somewhere() -> None:
    wanted = [(page, target) for page in PAGES for target in re.findall(r"\]\(([^)#]+)\)", page.read_text())]
    assert wanted
    assert [f"{page.name}: {target}" for page, target in wanted if not (page.parent / target).exists()] == []


def test_every_command_channel_and_output_is_documented() -> None:
    reference = "".join(
        (ROOT / page).read_text() for page in ("docs/reference.md", "docs/formats.md", "README.md")
    )
    for name in (*commands.commands, *CHANNELS, *FORMATS):
        assert f"`{name}`" in reference or f"risorius {name}" in reference, name


def signature_of(name: str) -> str:
    """How the library's page writes a function: without types, and without what a program is told by."""
    signature = inspect.signature(getattr(risorius, name))
    named = signature.parameters.values()
    shown = [p.replace(annotation=p.empty) for p in named if p.default is p.empty or not callable(p.default)]
    return f"risorius.{name}{inspect.Signature(shown)}"


def test_the_functions_of_the_library_are_documented_as_they_are() -> None:
    page = (ROOT / "docs/reference.md").read_text()
    functions = {n for n in risorius.__all__ if inspect.isfunction(getattr(risorius, n))} - {"warnings_to"}
    for name in (*sorted(functions), "Live"):
        assert f"`{signature_of(name)}`" in page, signature_of(name)


def test_the_lists_are_documented() -> None:
    names = r"\|".join(LISTINGS)
    assert f"`risorius list {names}`" in (ROOT / "docs/reference.md").read_text()
