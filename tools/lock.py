"""Writes `requirements/`: the packages with which Risorius is tested, each with the digests of its files.

    pip install --dry-run --ignore-installed --report 311.json ".[test,site]" hatchling editables numba
    python tools/lock.py 311.json
    pip install --dry-run --ignore-installed --report bpy.json bpy
    python tools/lock.py bpy.json

The reports are pip's, one for each platform. `run.txt` is what Risorius needs to run and to be built,
`test.txt` that and what the tests need, `site.txt` what builds the site of the docs; `blender.txt` is the
program that judges the add-on for Blender, which runs in a process of its own. The files name no host:
whatever index pip is configured for must have files with these digests.
"""

from __future__ import annotations

import json
import re
import sys
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "requirements"
BUILD = ("hatchling", "editables", "numba")
BLENDER = "bpy"
_EXTRAS = re.compile(r"[A-Za-z0-9._-]+\s*\[([^\]]*)\]")
_EXTRA = re.compile(r"extra == [\"']([^\"']*)")
_NAME = re.compile(r"[A-Za-z0-9._-]+")
HEAD = "# Written by tools/lock.py. Names, versions and digests only: no package host.\n"


def name_of(requirement: str) -> str:
    """Return the name that a requirement begins with, as indexes compare names."""
    match = _NAME.match(requirement)
    return re.sub(r"[-_.]+", "-", match[0]).lower() if match else ""


def closure(names: Iterable[str], needs: Mapping[str, Sequence[str]]) -> set[str]:
    """Return packages with all that they need, those of extras that are asked for among them."""
    wanted: set[tuple[str, str]] = set()
    left = list(names)
    while left:
        need = left.pop()
        name, extras = name_of(need), _EXTRAS.match(need)
        for extra in ("", *(extras[1].split(",") if extras else ())):
            if name in needs and (name, extra) not in wanted:
                wanted.add((name, extra))
                left += [other for other in needs[name] if _is_asked(other, extra)]
    return {name for name, _ in wanted}


def _is_asked(need: str, extra: str) -> bool:
    found = _EXTRA.search(need)
    return (found[1] if found else "") == extra


def lines(names: Iterable[str], pins: Mapping[str, str], digests: Mapping[str, set[str]]) -> str:
    """Return the text of a file of requirements."""
    entries = (
        f"{name}=={pins[name]}" + "".join(f" \\\n    --hash=sha256:{d}" for d in sorted(digests[name]))
        for name in sorted(names)
    )
    return HEAD + "\n".join(entries) + "\n"


def main(reports: Sequence[str]) -> None:
    """Write the files from pip's reports."""
    pins: dict[str, str] = {}
    needs: dict[str, Sequence[str]] = {}
    digests: dict[str, set[str]] = {}
    for report in reports:
        for item in json.loads(Path(report).read_text())["install"]:
            about: dict[str, Any] = item["metadata"]
            found = item["download_info"].get("archive_info", {}).get("hashes", {}).get("sha256")
            if found is not None:
                name = name_of(about["name"])
                pins[name] = about["version"]
                needs.setdefault(name, about.get("requires_dist", []))
                digests.setdefault(name, set()).add(found)
    if BLENDER in pins:
        (FOLDER / "blender.txt").write_text(lines(closure([BLENDER], needs), pins, digests))
        return
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    run = closure([*project["dependencies"], *BUILD], needs)
    test = closure([*run, *extras["test"]], needs)
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / "run.txt").write_text(lines(run, pins, digests))
    (FOLDER / "test.txt").write_text(lines(test, pins, digests))
    (FOLDER / "site.txt").write_text(lines(closure(extras["site"], needs), pins, digests))


if __name__ == "__main__":
    main(sys.argv[1:])
