"""`web/wire.js`: the dataclasses of `wire` and `tables` as JSDoc types, for editors to check the page by.

Run `python -m risorius.studio.wire_types` after changing one of them.
"""

from __future__ import annotations

import dataclasses
import inspect
import textwrap
import types
import typing
from collections.abc import Iterator, Mapping
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

from . import wire
from .tables import TABLES

FILE = Path(str(resources.files(__package__) / "web" / "wire.js"))
_KNOWN = frozenset(wire.EDITS.values())
_PLAIN = {str: "string", bool: "boolean", int: "number", float: "number", object: "any"}


def source() -> str:
    """Return the file's text."""
    parts = [_HEAD, *map(_typedef, _classes())]
    for title, table in (("Verb", wire.VERBS), ("EditKind", wire.EDITS), ("EventName", wire.EVENTS)):
        parts.append(
            f"/** @typedef {{{' | '.join(repr(name) for name in table)}}} {title} */".replace("'", '"')
        )
    return "\n".join([*parts, "export {};", ""])


_HEAD = "// Generated from wire.py and tables.py by `python -m risorius.studio.wire_types`: do not edit.\n"


def _classes() -> list[type]:
    found = [thing for thing in vars(wire).values() if isinstance(thing, type)]
    ours = [cls for cls in found if cls in _KNOWN or cls.__module__ == wire.__name__]
    return [*(cls for cls in ours if dataclasses.is_dataclass(cls)), *TABLES]


def _typedef(cls: type) -> str:
    words = inspect.cleandoc(cls.__doc__ or "").split("\n\n")
    lines = [line for text in words for line in textwrap.wrap(" ".join(text.split()), 105)]
    lines += [f"@typedef {{Object}} {cls.__name__}", *_verb(cls), *_properties(cls)]
    return "\n".join(["/**", *(f" * {line}" for line in lines), " */"])


def _verb(cls: type) -> Iterator[str]:
    for key, table in (("do", wire.VERBS), ("kind", wire.EDITS), ("event", wire.EVENTS)):
        for name, known in table.items():
            if known is cls:
                if key == "kind":
                    yield '@property {"edit"} do'
                yield f'@property {{"{name}"}} {key}'


def _properties(cls: type) -> Iterator[str]:
    hints = typing.get_type_hints(cls, include_extras=True)
    sent = cls in (*wire.ANSWERS, *wire.EVENTS.values(), *TABLES)
    for f in dataclasses.fields(cls):
        # What the server sends is always complete.
        given = sent or (f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING)
        name = f.name if given else f"[{f.name}]"
        yield f"@property {{{_type(hints[f.name])}}} {name}"


def _type(hint: Any) -> str:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        return _type(arguments[0])
    if origin in (types.UnionType, typing.Union):
        return "|".join("null" if a is types.NoneType else _type(a) for a in arguments)
    if origin is Literal:
        return "|".join(f'"{value}"' for value in arguments)
    if origin is tuple and arguments[-1] is Ellipsis:
        return f"Array<{_type(arguments[0])}>"
    if origin is tuple:
        return f"[{', '.join(map(_type, arguments))}]"
    if origin is Mapping:
        return f"Object<string, {_type(arguments[1])}>"
    return _PLAIN.get(hint) or str(hint.__name__)


if __name__ == "__main__":
    FILE.write_text(source(), encoding="utf-8")
