"""Pages of the site that are made, not written: mkdocs calls the functions here (`mkdocs.yml`).

`index.md` is the README, `changes.md` the changelog; commands, public names and rule files have a page each,
made of the program itself.
"""

from __future__ import annotations

import re
import shlex
import tempfile
from collections.abc import Iterator
from inspect import isclass, isfunction, ismodule
from pathlib import Path
from textwrap import indent
from typing import Any

import click

import risorius
from risorius.cli import commands, run

ROOT = Path(__file__).resolve().parents[1]
RULES = ROOT / "src" / "risorius" / "rules" / "data"
_LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)]*)?\)")
_MOST_TABLES = 30
_PAGES = {"README.md": "index.md", "CHANGELOG.md": "changes.md"}


def on_files(files: Any, config: Any) -> Any:
    """Add the pages that are made to mkdocs' files."""
    from mkdocs.structure.files import File

    for name, text in pages().items():
        files.append(File.generated(config, name, content=text))
    for name, page in players():
        files.append(File.generated(config, name, content=page))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Return a page whose links stay within the site."""
    return within_site(markdown, "" if page.file.src_uri in _PAGES.values() else "docs")


def pages() -> dict[str, str]:
    """Return the text of each page that is made, by its name."""
    return {
        "index.md": (ROOT / "README.md").read_text(encoding="utf-8"),
        "changes.md": (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"),
        "commands.md": "\n".join(_commands()),
        "api.md": "\n".join(_classes()),
        "rule-files.md": "\n".join(_rule_files()),
    }


def players() -> Iterator[tuple[str, bytes]]:
    """Yield the name and content of each page of the gallery that plays a performance: see gallery.md."""
    for line in commands_of("gallery.md"):
        with tempfile.TemporaryDirectory() as folder:
            *arguments, name = shlex.split(line)[1:]
            file = Path(folder) / name
            if run([*arguments, str(file), "--quiet"]):
                raise RuntimeError(f"the gallery's command failed: {line}")
            yield f"gallery/{name}", file.read_bytes()


def commands_of(page: str) -> list[str]:
    """Return the commands of the blocks of a page, which end in the name of what they write."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return re.findall(r"^(risorius .* -o [\w.]+)$", text, re.MULTILINE)


def within_site(markdown: str, folder: str) -> str:
    """Return a page, which stands in `folder` of the repository, with its links as the site has them.

    What leads out of the docs is named in place of being linked.
    """

    def link(match: re.Match[str]) -> str:
        sign, text, target, anchor = match[1], match[2], match[3], match[4] or ""
        if "://" in target:
            return match[0]
        path = (ROOT / folder / target).resolve().relative_to(ROOT).as_posix()
        if path in _PAGES:
            return f"{sign}[{text}]({_PAGES[path]}{anchor})"
        if path.startswith("docs/"):
            return f"{sign}[{text}]({path.removeprefix('docs/')}{anchor})"
        return f"{text} (`{path}`)"

    return _LINK.sub(link, markdown)


def _commands() -> Iterator[str]:
    yield "# Commands\nAs `risorius COMMAND --help` prints them.\n"
    for name, command in commands.commands.items():
        inner = command.commands if isinstance(command, click.Group) else {"": command}
        for sub, leaf in inner.items():
            title = f"risorius {name} {sub}".strip()
            context = click.Context(leaf, info_name=title, max_content_width=78, terminal_width=78)
            yield f"## {title}\n```\n{leaf.get_help(context)}\n```\n"


def _classes() -> Iterator[str]:
    yield "# Classes and functions\nAll that `import risorius` gives.\n"
    for name in sorted(risorius.__all__, key=lambda name: (isclass(getattr(risorius, name)), name)):
        it = getattr(risorius, name)
        if isclass(it) or isfunction(it):
            yield f"::: {it.__module__}.{it.__qualname__}\n"
        elif ismodule(it):
            yield f"::: {it.__name__}\n"


def _rule_files() -> Iterator[str]:
    yield "# Rule files\nThe tables that perform, as their first lines say. [Rules](rules.md) tells more.\n"
    for file in sorted(RULES.rglob("*.toml")):
        text = file.read_text(encoding="utf-8")
        head = re.match(r"(?:#.*\n)*", text)
        said = [line.lstrip("# ").rstrip() for line in head[0].splitlines()] if head else []
        tables = list(dict.fromkeys(re.findall(r"^\[+([\w.-]+)", text, re.MULTILINE)))
        described = re.search(r'^description = "(.*)"$', text, re.MULTILINE)
        words = " ".join([*([f"{described[1]} "] if described else []), *said])
        yield f"## {file.relative_to(RULES).as_posix()}\n{words}\n"
        if tables:
            names = ", ".join(f"`{table}`" for table in tables[:_MOST_TABLES])
            yield f"Tables: {names}{' …' if len(tables) > _MOST_TABLES else ''}\n"
        yield f'??? note "The whole file"\n    ```toml\n{indent(text, "    ")}\n    ```\n'
