"""GLSL of the library's own shading formulas, for pages that shade on the graphics card.

A device function of numbers and vectors is plain Python: it is translated from its source, with the constants
that it uses, so that no formula and no number is written twice.
"""

from __future__ import annotations

import ast
import inspect
import math
from collections.abc import Callable, Iterable, Mapping
from textwrap import dedent
from typing import Any

import numpy as np

_SIZES = {"float": 1, "vec2": 2, "vec3": 3}
_ARGUMENTS = {"float": "float {}", "Vec": "vec3 {}", "AmbientLight": "vec3 {}[2]"}
_KINDS = {"float": "float", "Vec": "vec3"}
_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
_COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
# Functions that GLSL has, or that are one expression in it, and what they return (None: what they are given).
_SHORT: Mapping[str, tuple[str, str | None]] = {
    "dot": ("dot({}, {})", "float"),
    "cross": ("cross({}, {})", "vec3"),
    "mix": ("mix({}, {}, {})", "vec3"),
    "add": ("({} + {})", "vec3"),
    "sub": ("({} - {})", "vec3"),
    "scale": ("({} * {})", "vec3"),
    "times": ("({} * {})", "vec3"),
    "along": ("({0} + {1} * {2})", "vec3"),
    "unit": ("normalize({})", "vec3"),
    "saturate": ("clamp({}, 0.0, 1.0)", "float"),
    "bounded": ("clamp({0}, 0.0, {1})", "float"),
    "smooth": ("smoothstep({}, {}, {})", "float"),
    "min": ("min({}, {})", "float"),
    "max": ("max({}, {})", "float"),
    "abs": ("abs({})", "float"),
    "sqrt": ("sqrt({})", "float"),
    "exp": ("exp({})", "float"),
    "sin": ("sin({})", "float"),
    "atan2": ("atan({}, {})", "float"),
    "floor": ("floor({})", "float"),
    "f4": ("{}", None),
}


def glsl_of(functions: Iterable[Callable[..., Any]], constants: Mapping[str, object]) -> str:
    """Return GLSL that defines `constants`, numbers or tuples of three, and `functions`.

    Each function stands after those that it calls; `_name` becomes `lib_name`. Raises ValueError
    for what this small translator does not know.
    """
    lines = [
        f"const {'vec3' if isinstance(value, tuple) else 'float'} {name} = {_literal(value)};"
        for name, value in constants.items()
    ]
    known: dict[str, str] = {}
    lines.extend(_Translation(function, known).text() for function in functions)
    return "\n".join(lines) + "\n"


def _name(function: str) -> str:
    return f"lib_{function.strip('_')}"


def _called(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else ast.unparse(function)


def _literal(value: object) -> str:
    if isinstance(value, tuple):
        return f"vec3({', '.join(map(_literal, value))})"
    if isinstance(value, int | float | np.floating | np.integer):
        number = float(value)
        # The shortest digits of float32.
        digits = np.format_float_scientific(np.float32(number), unique=True, trim="0")
        return digits if number >= 0 else f"({digits})"
    raise ValueError(f"{value!r} is neither a number nor three")


class _Translation:
    """One function, translated; `known` are the kinds that the functions before return, this one added."""

    def __init__(self, function: Callable[..., Any], known: dict[str, str]) -> None:
        tree = ast.parse(dedent(inspect.getsource(function))).body[0]
        assert isinstance(tree, ast.FunctionDef)
        self._tree, self._known = tree, known
        self._globals: dict[str, Any] = inspect.unwrap(function).__globals__
        self._kinds: dict[str, str] = {}
        self._temporaries = 0

    def text(self) -> str:
        arguments = []
        for argument in self._tree.args.args:
            kind = ast.unparse(argument.annotation) if argument.annotation else ""
            if kind not in _ARGUMENTS:
                raise ValueError(f"{self._tree.name}: {argument.arg} is a {kind}")
            self._kinds[argument.arg] = _KINDS.get(kind, "vec3[2]")
            arguments.append(_ARGUMENTS[kind].format(f"v_{argument.arg}"))
        body = [line for statement in self._tree.body for line in self._statement(statement)]
        kind = self._returned()
        self._known[self._tree.name] = kind
        return f"{kind} {_name(self._tree.name)}({', '.join(arguments)}) {{\n  " + "\n  ".join(body) + "\n}"

    def _returned(self) -> str:
        kind = ast.unparse(self._tree.returns) if self._tree.returns else ""
        count = kind.count("float")
        return _KINDS.get(kind) or ("vec2" if count == 2 else "vec3")

    def _statement(self, statement: ast.stmt) -> list[str]:
        match statement:
            case ast.Expr(ast.Constant()):  # the docstring
                return []
            case ast.Return(value) if value is not None:
                return [f"return {self._expression(value)};"]
            case ast.Assign([target], value):
                return self._assigned(target, value)
            case ast.AnnAssign(ast.Name() as target, _, value) if value is not None:
                return self._assigned(target, value)
            case ast.AugAssign(ast.Name(name), operator, value):
                return [f"v_{name} {_OPERATORS[type(operator)]}= {self._expression(value)};"]
            case ast.If(test, body, []):
                inner = " ".join(line for part in body for line in self._statement(part))
                return [f"if ({self._expression(test)}) {{ {inner} }}"]
        raise ValueError(f"{self._tree.name}: {ast.unparse(statement)}")

    def _assigned(self, target: ast.expr, value: ast.expr) -> list[str]:
        if isinstance(target, ast.Name):
            kind = self._kind(value)
            declared = "" if target.id in self._kinds else f"{kind} "
            self._kinds.setdefault(target.id, kind)
            return [f"{declared}v_{target.id} = {self._expression(value)};"]
        assert isinstance(target, ast.Tuple)
        if isinstance(value, ast.Tuple):
            # All values are those before the first is assigned.
            parts = [(f"t_{self._temporaries + k}", one) for k, one in enumerate(value.elts)]
            lines = [f"{self._kind(one)} {name} = {self._expression(one)};" for name, one in parts]
            kinds = [self._kind(one) for one in value.elts]
            sources = [name for name, _ in parts]
            self._temporaries += len(parts)
        else:
            name, kind = f"t_{self._temporaries}", self._kind(value)
            self._temporaries += 1
            lines = [f"{kind} {name} = {self._expression(value)};"]
            sources = [f"{name}[{k}]" for k in range(_SIZES[kind])]
            kinds = ["float"] * len(sources)
        for one, source, kind in zip(target.elts, sources, kinds, strict=True):
            assert isinstance(one, ast.Name)
            declared = "" if one.id in self._kinds else f"{kind} "
            self._kinds.setdefault(one.id, kind)
            lines.append(f"{declared}v_{one.id} = {source};")
        return lines

    def _expression(self, node: ast.expr) -> str:
        match node:
            case ast.Constant(value):
                return _literal(value)
            case ast.Name(name):
                return f"v_{name}" if name in self._kinds else _literal(self._globals[name])
            case ast.Attribute(ast.Name("math"), "pi"):
                return _literal(math.pi)
            case ast.Call(called, arguments):
                return self._call(called, arguments)
            case ast.Tuple(parts):
                return f"vec{len(parts)}({', '.join(map(self._expression, parts))})"
            case ast.Subscript(value, ast.Constant(int(place))):
                return f"{self._expression(value)}[{place}]"
        return self._operation(node)

    def _operation(self, node: ast.expr) -> str:
        match node:
            case ast.UnaryOp(ast.USub(), operand):
                return f"(-{self._expression(operand)})"
            case ast.BinOp(left, operator, right):
                sign = _OPERATORS[type(operator)]
                return f"({self._expression(left)} {sign} {self._expression(right)})"
            case ast.Compare(left, [operator], [right]):
                return f"{self._expression(left)} {_COMPARISONS[type(operator)]} {self._expression(right)}"
            case ast.IfExp(test, body, orelse):
                chosen, other = self._expression(body), self._expression(orelse)
                return f"({self._expression(test)} ? {chosen} : {other})"
        raise ValueError(f"{self._tree.name}: {ast.unparse(node)}")

    def _call(self, called: ast.expr, arguments: list[ast.expr]) -> str:
        name = _called(called)
        given = [self._expression(argument) for argument in arguments]
        if name in _SHORT:
            return _SHORT[name][0].format(*given)
        if name in self._known:
            return f"{_name(name)}({', '.join(given)})"
        raise ValueError(f"{self._tree.name}: {name} is not translated before it")

    def _kind(self, node: ast.expr) -> str:
        match node:
            case ast.Name(name) if name in self._kinds:
                return self._kinds[name]
            case ast.Name(name):
                return "vec3" if isinstance(self._globals[name], tuple) else "float"
            case ast.Tuple(parts):
                return f"vec{len(parts)}"
            case ast.Call(called, arguments):
                name = _called(called)
                if name in _SHORT:
                    return _SHORT[name][1] or self._kind(arguments[0])
                return self._known[name]
        return "float"
