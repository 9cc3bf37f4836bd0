"""Every regular expression of the package takes a time that grows with the text, not with its square."""

from __future__ import annotations

import ast
import importlib
import pkgutil
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

import risorius
from risorius import languages
from risorius.languages import language_of
from risorius.languages.readings import readings_of

from .fuzz.guard import HangError, bounded
from .profiles import samples

LENGTH = 50_000
CHARACTERS = samples("0a_ .,:;-+*#\"'()[]{}<>=/\\%@!?\n\t&$é…。", "0a .!\n")
PREFIXES = samples(("", "a", "1", '"', "#", "a:"), ("",))
LANGUAGES = sorted(table.parent.name for table in Path(languages.__path__[0]).glob("*/readings.toml"))
_USES = {"compile", "match", "fullmatch", "search", "sub", "split", "finditer", "findall"}


@cache
def _patterns() -> dict[str, re.Pattern[str]]:
    """Return the compiled patterns of all modules, those within functions, and those of the languages."""
    patterns: dict[str, re.Pattern[str]] = {}
    for module in pkgutil.walk_packages(risorius.__path__, "risorius."):
        if not module.name.endswith("__main__"):
            held = vars(importlib.import_module(module.name))
            patterns |= {f"{module.name}.{name}": p for key, v in held.items() for name, p in _held(key, v)}
    for path in sorted(Path(risorius.__path__[0]).rglob("*.py")):
        patterns |= {f"{path.stem}:{line}": p for line, p in _written(path.read_text())}
    for code in ("en-us", "de", "fr-fr", "es", "it", "nl", "pt"):
        patterns[f"abbreviations of {code}"] = language_of(code).abbreviations.pattern
    for code in LANGUAGES:
        readings = readings_of(code)
        rules = (*readings.own, *readings.rules("en-gb"), *readings.rules())
        patterns |= {f"readings of {code}, {n}": rule.pattern for n, rule in enumerate(rules)}
    return {name: p for name, p in patterns.items() if isinstance(p.pattern, str)}


def _held(name: str, value: object) -> Iterator[tuple[str, re.Pattern[str]]]:
    if isinstance(value, re.Pattern):
        yield name, value
    elif isinstance(value, tuple | list):
        for item in value:
            yield from _held(name, item)
    elif isinstance(value, Mapping) and not name.startswith("__"):
        for key, item in value.items():
            yield from _held(f"{name}[{key}]", item)


def _written(source: str) -> Iterator[tuple[int, re.Pattern[str]]]:
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in _USES:
            first = node.args[0] if node.args else None
            on_re = isinstance(node.func.value, ast.Name) and node.func.value.id == "re"
            if on_re and isinstance(first, ast.Constant) and isinstance(first.value, str):
                yield node.lineno, re.compile(first.value)


def test_patterns_are_found() -> None:
    assert len(_patterns()) > 60


def test_no_pattern_goes_back_over_what_it_has_read() -> None:
    slow = []
    for name, pattern in _patterns().items():
        for text in (f"{prefix}{char * LENGTH}\0" for prefix in PREFIXES for char in CHARACTERS):
            try:
                with bounded(0.5):
                    pattern.search(text)
                    pattern.fullmatch(text)
            except HangError:
                slow.append(f"{name} on {text[:3]!r}")
                break
    assert not slow


def test_a_pattern_that_goes_back_is_noticed() -> None:
    with pytest.raises(HangError), bounded(0.2):
        re.compile(r"\d+\.?\d*x").search("0" * LENGTH)
