"""The translator of formulas refuses what it does not know; that its GLSL is right: `test_stage_parts.py`."""

from __future__ import annotations

import math

import pytest

from risorius.core.kernels.jit import f4
from risorius.core.kernels.vec import Vec, along
from risorius.ports.glsl import glsl_of

TABLE = [1.0, 2.0]


def looped(x: float) -> float:
    while x > 1.0:
        x -= 1.0
    return x


def counted(x: int) -> float:
    return f4(x)


def unknown(x: float) -> float:
    return math.tan(x)


def before(x: float) -> float:
    return bumped(x)


def looked_up(x: float) -> float:
    return x * TABLE  # type: ignore[operator]


def bumped(x: float) -> float:
    """Return a number."""
    if x < f4(0):
        return f4(0)
    x *= f4(0.5)
    y, x = x, f4(2)
    return y * math.pi - x


def moved(place: Vec, x: float) -> tuple[float, float]:
    a, b, c = along(place, (f4(0), f4(1), f4(0)), bumped(x))
    return a, b if x > f4(1) else -c


@pytest.mark.parametrize("function", [looped, counted, unknown, before, looked_up])
def test_what_is_not_known_is_refused(function):
    with pytest.raises(ValueError, match=f"{function.__name__}|neither"):
        glsl_of([function], {})


def test_a_constant_that_is_no_number_is_refused():
    with pytest.raises(ValueError, match="neither a number nor three"):
        glsl_of([], {"NAME": "text"})


def test_functions_become_glsl():
    assert glsl_of([bumped, moved], {"HALF": 0.5, "UP": (0.0, 1.0, 0.0)}).split("\n") == [
        "const float HALF = 5.0e-01;",
        "const vec3 UP = vec3(0.0e+00, 1.0e+00, 0.0e+00);",
        "float lib_bumped(float v_x) {",
        "  if (v_x < 0.0e+00) { return 0.0e+00; }",
        "  v_x *= 5.0e-01;",
        "  float t_0 = v_x;",
        "  float t_1 = 2.0e+00;",
        "  float v_y = t_0;",
        "  v_x = t_1;",
        "  return ((v_y * 3.1415927e+00) - v_x);",
        "}",
        "vec2 lib_moved(vec3 v_place, float v_x) {",
        "  vec3 t_0 = (v_place + vec3(0.0e+00, 1.0e+00, 0.0e+00) * lib_bumped(v_x));",
        "  float v_a = t_0[0];",
        "  float v_b = t_0[1];",
        "  float v_c = t_0[2];",
        "  return vec2(v_a, (v_x > 1.0e+00 ? v_b : (-v_c)));",
        "}",
        "",
    ]
