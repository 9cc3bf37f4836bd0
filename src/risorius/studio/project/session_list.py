"""The sessions in the studio's folder: listed, named, copied, deleted, and put back after that."""

from __future__ import annotations

import json
import re
import secrets
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ...errors import InputError
from ..session.session_files import write_text
from ..uploads import BEGINNING
from .autosave import DRAFT, FILE

NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,39}")
"""Names that a session may have in the address."""
ABOUT = "about.json"
DELETED = ".deleted"
MOST_LISTED = 200
LONGEST_TITLE = 80
LONGEST_LINE = 120


@dataclass(frozen=True, slots=True)
class SessionEntry:
    """A session in the list. `title`: its name for people, "" if none; `changed`: seconds since 1970."""

    session: str
    title: str
    line: str
    changed: float
    open: bool


def listed(folder: Path, shown: set[str]) -> tuple[SessionEntry, ...]:
    """Return the sessions that have something in them, the latest first; pages show those in `shown`."""
    entries = sorted(_entries(folder, shown), key=lambda entry: -entry.changed)
    return tuple(entries[:MOST_LISTED])


def _entries(folder: Path, shown: set[str]) -> Iterator[SessionEntry]:
    for path in folder.iterdir() if folder.is_dir() else ():
        files = [file for name in (FILE, DRAFT) if (file := path / name).is_file()]
        if NAME.fullmatch(path.name) and files:
            changed = max(file.stat().st_mtime for file in files)
            yield SessionEntry(path.name, title(path), _line(files), changed, path.name in shown)


def title(folder: Path) -> str:
    """Return the title of a session, "" if it has none."""
    called = _object(folder / ABOUT).get("title", "")
    return called if isinstance(called, str) else ""


def rename(folder: Path, called: str) -> None:
    """Give a session a name for people; "" takes it away."""
    plain = " ".join("".join(c if c.isprintable() else " " for c in called).split())
    if len(plain) > LONGEST_TITLE:
        raise InputError(f"the name is longer than {LONGEST_TITLE} characters")
    write_text(folder / ABOUT, json.dumps({"title": plain}))


def new_name() -> str:
    """Return a name for the address that no session has."""
    return f"session-{secrets.token_hex(4)}"


def copy(source: Path, target: Path) -> None:
    """Copy a session that nobody writes to meanwhile."""
    beside = shutil.ignore_patterns("exports", f"{BEGINNING}*", ".risorius-*")
    shutil.copytree(source, target, ignore=beside, copy_function=shutil.copyfile)
    called = title(source)
    rename(target, f"{called or 'Copy'}{' (copy)' if called else ''}"[:LONGEST_TITLE])


def delete(folder: Path, name: str) -> None:
    """Lay a session aside, from where `put_back` takes it."""
    aside = folder / DELETED
    aside.mkdir(exist_ok=True)
    shutil.rmtree(aside / name, ignore_errors=True)
    (folder / name).rename(aside / name)


def put_back(folder: Path, name: str) -> None:
    """Undo `delete`."""
    aside = folder / DELETED / name
    if not NAME.fullmatch(name) or not aside.is_dir() or (folder / name).exists():
        raise InputError(f"no session '{name[:40]}' was deleted")
    aside.rename(folder / name)


def _line(files: list[Path]) -> str:
    """Return the beginning of a session's text."""
    for file in files:
        data = _object(file)
        written = data.get("made", data.get("draft"))
        source = written.get("source") if isinstance(written, dict) else None
        script = source.get("script") if isinstance(source, dict) else None
        if isinstance(script, str) and script.strip():
            return " ".join(script[: 4 * LONGEST_LINE].split())[:LONGEST_LINE]
    return ""


def _object(path: Path) -> dict[str, object]:
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return data if isinstance(data, dict) else {}
