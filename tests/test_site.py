"""The site of the docs: every page has its place, and the pages that are made say all there is."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

import risorius
from risorius.cli import commands

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def site() -> ModuleType:
    spec = importlib.util.spec_from_file_location("site_pages", ROOT / "docs" / "site_pages.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_page_stands_in_the_navigation_once(site: ModuleType) -> None:
    named = re.findall(r"^ +- (?:[\w ]+: )?([\w-]+\.md)$", (ROOT / "mkdocs.yml").read_text(), re.MULTILINE)
    written = {page.name for page in (ROOT / "docs").glob("*.md")}
    assert sorted(named) == sorted(written | site.pages().keys())


def test_the_pages_that_are_made_are_whole(site: ModuleType) -> None:
    pages = site.pages()
    for name in commands.commands:
        assert f"## risorius {name}" in pages["commands.md"], name
    for name in risorius.__all__:
        assert re.search(rf"^::: risorius\.(?:[\w.]+\.)?{name}$", pages["api.md"], re.MULTILINE), name
    for name in ("rules/signals.toml", "emotions/anger.toml", "lips.toml"):
        assert f"## {name}" in pages["rule-files.md"]


def test_the_gallery_plays_what_its_commands_write(site: ModuleType) -> None:
    page = (ROOT / "docs" / "gallery.md").read_text("utf-8")
    shown = re.findall(r'<iframe src="gallery/([\w.]+)"', page)
    assert shown == [line.split()[-1] for line in site.commands_of("gallery.md")] != []


@pytest.mark.full
def test_the_gallerys_pages_are_made(site: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    short = 'risorius speak "Oh." --fps 10 -o oh.html'
    monkeypatch.setattr(site, "commands_of", lambda page: [short])
    ((name, page),) = site.players()
    assert name == "gallery/oh.html"
    assert page.startswith(b"<!doctype html>")


@pytest.mark.parametrize(
    ("folder", "given", "expected"),
    [
        ("", "[how](docs/how-to.md#x)", "[how](how-to.md#x)"),
        ("", "![a](docs/pictures/demo.webp)", "![a](pictures/demo.webp)"),
        ("", "[changes](CHANGELOG.md)", "[changes](changes.md)"),
        ("", "[law](LICENSE)", "law (`LICENSE`)"),
        ("docs", "[one](rules.md)", "[one](rules.md)"),
        ("docs", "[code](../src/risorius/pipeline.py)", "code (`src/risorius/pipeline.py`)"),
        ("docs", "[start](../README.md)", "[start](index.md)"),
        ("docs", "[far](https://example.org/a.md)", "[far](https://example.org/a.md)"),
        ("docs", "[here](#there)", "[here](#there)"),
    ],
)
def test_links_stay_within_the_site(site: ModuleType, folder: str, given: str, expected: str) -> None:
    assert site.within_site(given, folder) == expected
