"""Modules of JavaScript in one page: none is fetched, so that the page works from a file, offline.

A browser does not load modules from files beside a page that is a file itself. So each module stands in the
page's import map as a `data:` address, and the modules import each other by names of that map.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterator

from ...browser import ROOT

# The address in `import … from "./x.js"`, `export … from "./x.js"` and `import "./x.js"`.
_IMPORT = re.compile(r"""((?:\bfrom|\bimport)\s*)(["'])(\.{1,2}/[^"']+)\2""")
_PREFIX = "risorius/"


def import_map(entry: str) -> str:
    """Return the import map, as JSON, of a module of `browser` and all that it imports."""
    imports = {_PREFIX + name: _address(text) for name, text in sorted(_modules(entry).items())}
    return json.dumps({"imports": imports})


def name_of(entry: str) -> str:
    """Return the name by which the page imports a module."""
    return _PREFIX + entry


def _modules(entry: str) -> dict[str, str]:
    """Return the modules by their paths in `browser`, each importing by names."""
    modules: dict[str, str] = {}
    waiting = [entry]
    while waiting:
        name = waiting.pop()
        if name not in modules:
            text = (ROOT / name).read_text(encoding="utf-8")
            waiting.extend(_imported(name, text))
            modules[name] = _renamed(name, text)
    return modules


def _renamed(name: str, text: str) -> str:
    def by_name(match: re.Match[str]) -> str:
        return f'{match[1]}"{name_of(_path(name, match[3]))}"'

    return _IMPORT.sub(by_name, text)


def _imported(name: str, text: str) -> Iterator[str]:
    for match in _IMPORT.finditer(text):
        if (ROOT / _path(name, match[3])).is_file():
            yield _path(name, match[3])


def _path(name: str, address: str) -> str:
    return (ROOT / name).parent.joinpath(address).resolve().relative_to(ROOT.resolve()).as_posix()


def _address(text: str) -> str:
    return f"data:text/javascript;base64,{base64.b64encode(text.encode()).decode()}"
