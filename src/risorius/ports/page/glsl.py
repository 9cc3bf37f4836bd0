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
from typing import Any, NamedTuple

import numpy as np

_PARTS = {"vec2": (2, "float"), "vec3": (3, "float"), "vec3[2]": (2, "vec3")}
_ARGUMENTS = {"float": "float {}", "Vec": "vec3 {}", "AmbientLight": "vec3 {}[2]"}
_KINDS = {"float": "float", "Vec": "vec3"}
_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
_COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
_RETURNED = {
    "float": "float",
    "Vec": "vec3",
    "tuple[float, float]": "vec2",
    "tuple[float, float, float]": "vec3",
}


class _Signature(NamedTuple):
    """The arguments and the result of a function, and the form of its call."""

    call: str
    takes: tuple[str, ...]
    returns: str


def _signature(call: str, takes: str, returns: str) -> _Signature:
    return _Signature(call, tuple("vec3" if letter == "v" else "float" for letter in takes), returns)


# Functions that GLSL has, or that are one expression in it. Of what they take, v is a vector, f a number.
_SHORT: Mapping[str, _Signature] = {
    "dot": _signature("dot({}, {})", "vv", "float"),
    "cross": _signature("cross({}, {})", "vv", "vec3"),
    "mix": _signature("mix({}, {}, {})", "vvf", "vec3"),
    "add": _signature("({} + {})", "vv", "vec3"),
    "sub": _signature("({} - {})", "vv", "vec3"),
    "scale": _signature("({} * {})", "vf", "vec3"),
    "times": _signature("({} * {})", "vv", "vec3"),
    "along": _signature("({} + {} * {})", "vvf", "vec3"),
    "unit": _signature("normalize({})", "v", "vec3"),
    "saturate": _signature("clamp({}, 0.0, 1.0)", "f", "float"),
    "bounded": _signature("clamp({}, 0.0, {})", "ff", "float"),
    "smooth": _signature("smoothstep({}, {}, {})", "fff", "float"),
    "min": _signature("min({}, {})", "ff", "float"),
    "max": _signature("max({}, {})", "ff", "float"),
    "abs": _signature("abs({})", "f", "float"),
    "sqrt": _signature("sqrt({})", "f", "float"),
    "exp": _signature("exp({})", "f", "float"),
    "sin": _signature("sin({})", "f", "float"),
    "atan2": _signature("atan({}, {})", "ff", "float"),
    "floor": _signature("floor({})", "f", "float"),
    "f4": _signature("{}", "f", "float"),
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
    signatures: dict[str, _Signature] = {}
    lines.extend(_Translation(function, signatures).text() for function in functions)
    return "\n".join(lines) + "\n"


def _name(function: str) -> str:
    return f"lib_{function.strip('_')}"


def _called(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else ast.unparse(function)


def _literal(value: object) -> str:
    if isinstance(value, tuple) and len(value) == _PARTS["vec3"][0]:
        return f"vec3({', '.join(map(_literal, value))})"
    if isinstance(value, int | float | np.floating | np.integer) and not isinstance(value, bool):
        number = float(value)
        if not math.isfinite(number):
            raise ValueError(f"{value!r} is neither a finite number nor three")
        # The shortest digits of float32.
        digits = np.format_float_scientific(np.float32(number), unique=True, trim="0")
        return digits if number >= 0 else f"({digits})"
    raise ValueError(f"{value!r} is neither a number nor three")


class _Translation:
    """One function, translated; `known` are the functions before it, to which it is added."""

    def __init__(self, function: Callable[..., Any], signatures: dict[str, _Signature]) -> None:
        tree = ast.parse(dedent(inspect.getsource(function))).body[0]
        assert isinstance(tree, ast.FunctionDef)
        self._tree, self._known = tree, signatures
        self._globals: dict[str, Any] = inspect.unwrap(function).__globals__
        self._kinds: dict[str, str] = {}
        self._temporaries = 0

    def text(self) -> str:
        """Return the function in GLSL."""
        tree, parameters = self._tree, self._tree.args
        if (
            parameters.vararg
            or parameters.kwarg
            or parameters.kwonlyargs
            or parameters.posonlyargs
            or parameters.defaults
        ):
            raise self._unknown(parameters)
        arguments = []
        for argument in parameters.args:
            kind = ast.unparse(argument.annotation) if argument.annotation else ""
            if kind not in _ARGUMENTS:
                raise ValueError(f"{tree.name}: {argument.arg} is a {kind}")
            self._kinds[argument.arg] = _KINDS.get(kind, "vec3[2]")
            arguments.append(_ARGUMENTS[kind].format(f"v_{argument.arg}"))
        takes, returns = tuple(self._kinds.values()), self._returned()
        if not isinstance(tree.body[-1], ast.Return):
            raise ValueError(f"{tree.name}: it does not end with a return")
        body = [line for statement in tree.body for line in self._statement(statement)]
        call = f"{_name(tree.name)}({', '.join('{}' for _ in takes)})"
        self._known[tree.name] = _Signature(call, takes, returns)
        head = f"{returns} {_name(tree.name)}({', '.join(arguments)})"
        return f"{head} {{\n  " + "\n  ".join(body) + "\n}"

    def _returned(self) -> str:
        kind = ast.unparse(self._tree.returns) if self._tree.returns else ""
        if kind not in _RETURNED:
            raise ValueError(f"{self._tree.name}: it returns {kind or 'nothing that is known'}")
        return _RETURNED[kind]

    def _unknown(self, node: ast.AST) -> ValueError:
        return ValueError(f"{self._tree.name}: {ast.unparse(node)} is not known")

    def _statement(self, statement: ast.stmt) -> list[str]:
        match statement:
            case ast.Expr(ast.Constant(str())):  # the docstring
                return []
            case ast.Return(value) if value is not None:
                return [f"return {self._of_kind(value, self._returned())};"]
            case ast.Assign([target], value):
                return self._assigned(target, value)
            case ast.AnnAssign(ast.Name() as target, _, value) if value is not None:
                return self._assigned(target, value)
            case ast.AugAssign(ast.Name(name), operator, value):
                if self._kinds.get(name) != "float" or type(operator) not in _OPERATORS:
                    raise self._unknown(statement)
                return [f"v_{name} {_OPERATORS[type(operator)]}= {self._of_kind(value, 'float')};"]
            case ast.If(test, body, []):
                return [f"if ({self._condition(test)}) {{ {' '.join(self._block(body))} }}"]
        raise self._unknown(statement)

    def _block(self, body: list[ast.stmt]) -> list[str]:
        """Return statements whose new names end with them, as in GLSL."""
        outside = set(self._kinds)
        lines = [line for part in body for line in self._statement(part)]
        self._kinds = {name: kind for name, kind in self._kinds.items() if name in outside}
        return lines

    def _assigned(self, target: ast.expr, value: ast.expr) -> list[str]:
        if isinstance(target, ast.Name):
            text, kind = self._expression(value)
            return [self._stored(target, text, kind)]
        if not isinstance(target, ast.Tuple):
            raise self._unknown(target)
        if isinstance(value, ast.Tuple):
            # All values are those before the first is assigned.
            parts = [self._expression(one) for one in value.elts]
            sources = [(f"t_{self._temporaries + k}", kind) for k, (_, kind) in enumerate(parts)]
            lines = [
                f"{kind} {name} = {text};" for (name, kind), (text, _) in zip(sources, parts, strict=True)
            ]
            self._temporaries += len(parts)
        else:
            name, (text, kind) = f"t_{self._temporaries}", self._expression(value)
            self._temporaries += 1
            lines = [f"{kind} {name} = {text};"]
            count, part = _PARTS.get(kind, (0, ""))
            sources = [(f"{name}[{k}]", part) for k in range(count)]
        if len(sources) != len(target.elts):
            raise self._unknown(value)
        stored = zip(target.elts, sources, strict=True)
        return lines + [self._stored(one, source, kind) for one, (source, kind) in stored]

    def _stored(self, target: ast.expr, text: str, kind: str) -> str:
        """Return an assignment, which declares a name that is new; a name keeps its kind."""
        if not isinstance(target, ast.Name) or self._kinds.get(target.id, kind) != kind:
            raise self._unknown(target)
        declared = "" if target.id in self._kinds else f"{kind} "
        self._kinds[target.id] = kind
        return f"{declared}v_{target.id} = {text};"

    def _of_kind(self, node: ast.expr, kind: str) -> str:
        """Return an expression that must be of a kind."""
        text, own = self._expression(node)
        if own != kind:
            raise ValueError(f"{self._tree.name}: {ast.unparse(node)} is a {own}; expected a {kind}")
        return text

    def _expression(self, node: ast.expr) -> tuple[str, str]:
        """Return an expression and its kind."""
        match node:
            case ast.Constant(value):
                return _literal(value), "float"
            case ast.Name(name) if name in self._kinds:
                return f"v_{name}", self._kinds[name]
            case ast.Name(name) if name in self._globals:
                value = self._globals[name]
                return _literal(value), "vec3" if isinstance(value, tuple) else "float"
            case ast.Attribute(ast.Name("math"), "pi"):
                return _literal(math.pi), "float"
            case ast.Call(called, arguments, []):
                return self._call(called, arguments)
            case ast.Tuple(parts) if f"vec{len(parts)}" in _PARTS:
                texts = [self._of_kind(part, "float") for part in parts]
                return f"vec{len(parts)}({', '.join(texts)})", f"vec{len(parts)}"
            case ast.Subscript(value, ast.Constant(int(place))):
                text, kind = self._expression(value)
                count, part = _PARTS.get(kind, (0, ""))
                if not 0 <= place < count:
                    raise self._unknown(node)
                return f"{text}[{place}]", part
        return self._operation(node)

    def _operation(self, node: ast.expr) -> tuple[str, str]:
        match node:
            case ast.UnaryOp(ast.USub(), operand):
                return f"(-{self._of_kind(operand, 'float')})", "float"
            case ast.BinOp(left, operator, right) if type(operator) in _OPERATORS:
                sign = _OPERATORS[type(operator)]
                return f"({self._of_kind(left, 'float')} {sign} {self._of_kind(right, 'float')})", "float"
            case ast.IfExp(test, body, orelse):
                (chosen, kind), condition = self._expression(body), self._condition(test)
                return f"({condition} ? {chosen} : {self._of_kind(orelse, kind)})", kind
        raise self._unknown(node)

    def _condition(self, node: ast.expr) -> str:
        match node:
            case ast.Compare(left, [operator], [right]) if type(operator) in _COMPARISONS:
                sign = _COMPARISONS[type(operator)]
                return f"{self._of_kind(left, 'float')} {sign} {self._of_kind(right, 'float')}"
        raise self._unknown(node)

    def _call(self, called: ast.expr, arguments: list[ast.expr]) -> tuple[str, str]:
        name = _called(called)
        signature = _SHORT.get(name) or self._known.get(name)
        if signature is None:
            raise ValueError(f"{self._tree.name}: {name} is not translated before it")
        call, takes, returns = signature
        if len(arguments) != len(takes):
            raise ValueError(f"{self._tree.name}: {name} is given {len(arguments)}; expected {len(takes)}")
        texts = [self._of_kind(one, kind) for one, kind in zip(arguments, takes, strict=True)]
        return call.format(*texts), returns
