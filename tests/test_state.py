"""Nothing of a run is kept where another run could meet it (DESIGN, section 1).

What all runs share, registries and tables, is complete when its module is imported and cannot be changed.
"""

from __future__ import annotations

import ast
import dataclasses
import enum
import importlib
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import FunctionType, MappingProxyType

import numpy as np

import risorius
from risorius.reading.frozen import FrozenDict

from .collected import all_cases

ROOT = Path(risorius.__file__).parent
FILES = sorted(ROOT.rglob("*.py"))
PLAIN = (str, bytes, int, float, type(None), Fraction, Path, FunctionType, type, enum.Enum, frozenset)


@cache
def _parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def _inside_functions(tree: ast.Module) -> Iterator[ast.expr | ast.stmt]:
    """Yield all statements and expressions that run later than at import; those of `register` are not."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name != "register":
            for statement in node.body:
                yield from (n for n in ast.walk(statement) if isinstance(n, ast.expr | ast.stmt))


def test_no_function_changes_what_its_module_holds() -> None:
    wrong = []
    for path in FILES:
        tree = _parsed(path)
        held = {name for node in tree.body for name in _assigned(node)}
        wrong += [
            f"{path}:{node.lineno}: {ast.unparse(node)}"
            for node in _inside_functions(tree)
            if isinstance(node, ast.Global) or _changed(node) in held
        ]
    assert not wrong, "\n".join(wrong)


def _assigned(node: ast.stmt) -> Iterator[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
    yield from (target.id for target in targets if isinstance(target, ast.Name))


def _changed(node: ast.expr | ast.stmt) -> str | None:
    """Return the name of what a statement or call changes by key or by a method of dicts, lists and sets."""
    if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store | ast.Del):
        return node.value.id if isinstance(node.value, ast.Name) else None
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in CHANGING:
        return node.func.value.id if isinstance(node.func.value, ast.Name) else None
    return None


CHANGING = {
    *("append", "extend", "insert", "remove", "pop", "popitem", "clear", "sort"),
    *("add", "discard", "update", "setdefault"),
}


def test_plug_ins_are_registered_when_their_module_is_imported() -> None:
    late = [
        f"{path}:{node.lineno}: {ast.unparse(node)}"
        for path in FILES
        for node in _inside_functions(_parsed(path))
        if isinstance(node, ast.Call) and _registers(node.func)
    ]
    assert not late, "\n".join(late)


def _registers(function: ast.expr) -> bool:
    if isinstance(function, ast.Attribute):
        return function.attr == "register" and ast.unparse(function.value) != "atexit"
    return isinstance(function, ast.Name) and function.id == "register"


LOCKED = {"shared_engine"}  # one program that speaks for all runs, behind a lock


def _shared_tables() -> Iterator[tuple[str, str]]:
    """Yield module and name of all public cached functions that take nothing."""
    for path in FILES:
        module = ".".join(("risorius", *path.relative_to(ROOT).with_suffix("").parts))
        for node in _parsed(path).body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and not node.args.args:
                cached = any("cache" in ast.unparse(decorator) for decorator in node.decorator_list)
                yield from [(module, node.name)] if cached and node.name not in LOCKED else ()


def test_no_table_that_runs_share_can_be_changed() -> None:
    with all_cases() as case:
        for module, name in _shared_tables():
            with case(f"{module}.{name}"):
                table = getattr(importlib.import_module(module), name)()
                assert sorted(set(_changeable(table, name))) == []


def _changeable(value: object, path: str) -> Iterator[str]:
    """Yield the path of every part that can be changed."""
    if isinstance(value, PLAIN):
        return
    if isinstance(value, np.ndarray):
        parts: dict[str, object] = {} if not value.flags.writeable else {" is an open array": []}
    elif isinstance(value, FrozenDict | MappingProxyType):
        parts = {f"[{key}]": part for key, part in value.items()}
    elif isinstance(value, tuple):
        parts = {f"[{index}]": part for index, part in enumerate(value)}
    elif dataclasses.is_dataclass(value) and type(value).__dataclass_params__.frozen:
        parts = {f".{field.name}": getattr(value, field.name) for field in dataclasses.fields(value)}
    else:
        yield f"{path} is a {type(value).__name__}"
        return
    for name, part in parts.items():
        yield from _changeable(part, path + name)
