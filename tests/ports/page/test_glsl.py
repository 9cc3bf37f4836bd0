"""The translator of formulas refuses what it does not know; that its GLSL is right: `test_skin.py`."""

from __future__ import annotations

import math

import pytest

from risorius.machine.kernels.jit import f4
from risorius.machine.kernels.vec import Vec, along, dot, smooth
from risorius.ports.page.glsl import glsl_of
from risorius.ports.page.skin_formulas import shading

TABLE = [1.0, 2.0]
INFINITE = math.inf


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
    return x * TABLE


def powered(x: float) -> float:
    return x**2


def halved(x: float) -> float:
    x //= 2
    return x


def doubled(x: Vec) -> Vec:
    return x * 2


def compared(x: float) -> float:
    return 1.0 if x == 2.0 else 0.0


def trusted(x: float) -> float:
    return 1.0 if x else 0.0


def both(x: float) -> float:
    return 1.0 if x > 0.0 and x < 1.0 else 0.0


def branched(x: float) -> float:
    if x > 1.0:
        return x
    else:  # noqa: RET505
        return 1.0


def scoped(x: float) -> float:
    if x > 1.0:
        y = x
    return y


def changed(x: float) -> float:
    x = (x, x, x)
    return x + 1.0


def least(x: float) -> float:
    return min(x, 1.0, 2.0)


def named(x: float) -> float:
    return smooth(x, b=1.0, t=0.5)


def defaulted(x: float, y: float = 1.0) -> float:
    return x + y


def listed(*x: float) -> float:
    return x[0]


def mistaken(x: Vec) -> Vec:
    return dot(x, x)


def unmixed(x: float) -> float:
    return dot(x, x)


def beyond(x: Vec) -> float:
    return x[3]


def sliced(x: Vec) -> float:
    return x[:1][0]


def unpacked(x: Vec) -> float:
    a, b = x
    return a + b


def four(x: float) -> tuple[float, float, float, float]:
    return x, x, x, x


def judged(x: float) -> bool:
    return x > 1.0


def silent(x: float) -> None:
    x += 1.0


def ended(x: float) -> float:  # noqa: RET503
    if x > 1.0:
        return x


def yes(x: float) -> float:
    return True


def endless(x: float) -> float:
    return x + INFINITE


def nowhere(x: float) -> float:
    return x + missing  # noqa: F821


UNKNOWN = [
    looped, counted, unknown, before, looked_up, powered, halved, doubled, compared, trusted, both, branched,
    scoped, changed, least, named, defaulted, listed, mistaken, unmixed, beyond, sliced, unpacked, four,
    judged, silent, ended, yes, endless, nowhere,
]  # fmt: skip


def bumped(x: float) -> float:
    """Return a number."""
    if x < f4(0):
        return f4(0)
    x *= f4(0.5)
    y, x = x, f4(2)
    return y * math.pi - x


def called_with_more(x: float) -> float:
    return bumped(x, x)


def moved(place: Vec, x: float) -> tuple[float, float]:
    a, b, c = along(place, (f4(0), f4(1), f4(0)), bumped(x))
    return a, b if x > f4(1) else -c


@pytest.mark.parametrize("function", UNKNOWN)
def test_what_is_not_known_is_refused(function):
    """Here, not by the compiler of a graphics card in somebody's page."""
    with pytest.raises(ValueError, match=f"{function.__name__}|neither"):
        glsl_of([function], {})


def test_a_function_is_called_with_what_it_takes():
    with pytest.raises(ValueError, match="bumped is given 2; expected 1"):
        glsl_of([bumped, called_with_more], {})


@pytest.mark.parametrize("value", ["text", True, math.nan, (1.0, 2.0), (1.0, 2.0, "x")])
def test_a_constant_that_is_not_a_number_is_refused(value):
    with pytest.raises(ValueError, match="neither a"):
        glsl_of([], {"NAME": value})


def test_all_shading_formulas_of_the_pages_are_translated():
    assert shading().formulas.count("lib_") > 40


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
