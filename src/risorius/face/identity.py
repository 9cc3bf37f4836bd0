"""The identity of a head (`identity.toml`): the recipe of its shape and the colours of its looks."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from ..core.look import HAIR_STYLES
from ..errors import HeadError, Place, unknown

ByteColour = tuple[int, int, int]
"""A colour in sRGB, 0 to 255."""

SEXES = ("female", "male")
ORIGINS = ("african", "asian", "caucasian")
BUILDS = ("weight", "muscle")
YOUNG, OLD = 25.0, 90.0  # years at which the source's young and old shapes stand
FILE = "identity.toml"


@dataclass(frozen=True, slots=True)
class Looks:
    """The visible properties of a head besides its shape.

    `skin`, `lips`, `lining` (inside of the mouth) and `cloth`; `hair` of head and lashes, and of the `brows`
    if these have no colour of their own; `iris` at the pupil and at the rim. `flush`, 0 to 2: how much redder
    or darker cheeks, nose, ears and lids are. `hair_style`: one of `HAIR_STYLES`; `hairs` and `brow_hairs`:
    how many grow on the head, and on each brow.
    """

    skin: ByteColour = (212, 165, 140)
    lips: ByteColour = (178, 108, 98)
    lining: ByteColour = (160, 84, 80)
    cloth: ByteColour = (52, 62, 78)
    hair: ByteColour = (58, 42, 32)
    hair_style: str = HAIR_STYLES[0]
    brows: ByteColour | None = None
    iris: tuple[ByteColour, ByteColour] = ((132, 112, 74), (74, 94, 104))
    flush: float = 1.0
    hairs: int = 8500
    brow_hairs: int = 360


_HAIRS = {"hairs": (100, 40_000), "brow_hairs": (20, 2000)}


@dataclass(frozen=True, slots=True)
class Identity:
    """The recipe of a head.

    `title` describes the person in a few words; `age` in years. The shares of `sex` and of `origin` each add
    up to 1. `build` moves weight and muscle from the mean (0) to the least (-1) or the most (1). `sliders`
    names targets of the source, `{}` for both sides, with their amounts.
    """

    title: str = ""
    age: float = YOUNG
    sex: Mapping[str, float] = field(default_factory=dict)
    origin: Mapping[str, float] = field(default_factory=dict)
    build: Mapping[str, float] = field(default_factory=dict)
    sliders: Mapping[str, float] = field(default_factory=dict)
    looks: Looks = Looks()

    def at(self, age: float) -> Identity:
        """Return the same person at another age in years."""
        return replace(self, age=age)


UNNAMED = Identity()  # the identity of a head whose folder has no identity.toml


def read_identity(path: Path) -> Identity:
    """Read an `identity.toml`.

    Raises HeadError, with its place, if the file is not TOML or holds an unknown key, or a value of the wrong
    kind or out of range.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        return _identity(table)
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise HeadError(f"not an identity: {error}", Place(str(path))) from error
    except HeadError as error:
        raise error.at(Place(str(path))) from None


def _identity(table: dict[str, Any]) -> Identity:
    _check_keys("key", table, [f.name for f in fields(Identity)])
    title = table.get("title", "")
    if not isinstance(title, str):
        raise HeadError(f"title is {title!r}; expected text")
    return Identity(
        title=title,
        age=_number("age", table.get("age", YOUNG), YOUNG, OLD),
        sex=_shares("sex", table, SEXES),
        origin=_shares("origin", table, ORIGINS),
        build=_numbers("build", table, BUILDS),
        sliders=_numbers("sliders", table),
        looks=_looks(_section("looks", table)),
    )


def _check_keys(kind: str, table: Mapping[str, Any], known: list[str] | tuple[str, ...]) -> None:
    for key in table:
        if key not in known:
            raise HeadError(unknown(kind, key, known))


def _section(name: str, table: dict[str, Any]) -> dict[str, Any]:
    section = table.get(name, {})
    if not isinstance(section, dict):
        raise HeadError(f"{name} is {section!r}; expected a table")
    return section


def _number(name: str, value: Any, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise HeadError(f"{name} is {value!r}; expected a number from {low:g} to {high:g}")
    return float(value)


def _numbers(name: str, table: dict[str, Any], known: tuple[str, ...] | None = None) -> dict[str, float]:
    section = _section(name, table)
    if known is not None:
        _check_keys(f"key of {name}", section, known)
    return {key: _number(f"{name}.{key}", value, -1.0, 1.0) for key, value in section.items()}


def _shares(name: str, table: dict[str, Any], known: tuple[str, ...]) -> dict[str, float]:
    shares = _numbers(name, table, known)
    total = sum(shares.values())
    if min(shares.values(), default=0.0) < 0.0 or abs(total - 1.0) > 1e-6:
        raise HeadError(f"{name} adds up to {total:g}; expected shares of 0 and more that add up to 1")
    return shares


def _looks(table: dict[str, Any]) -> Looks:
    _check_keys("key of looks", table, [f.name for f in fields(Looks)])
    chosen: dict[str, Any] = {}
    for key, value in table.items():
        if key in _HAIRS:
            chosen[key] = int(_number(f"looks.{key}", value, *_HAIRS[key]))
        elif key == "flush":
            chosen[key] = _number("looks.flush", value, 0.0, 2.0)
        elif key == "hair_style":
            if value not in HAIR_STYLES:
                raise HeadError(unknown("hair style", str(value), HAIR_STYLES))
            chosen[key] = value
        elif key == "iris":
            if not isinstance(value, list) or len(value) != 2:
                raise HeadError(f"looks.iris is {value!r}; expected two colours")
            chosen[key] = tuple(_colour("looks.iris", part) for part in value)
        else:
            chosen[key] = _colour(f"looks.{key}", value)
    return Looks(**chosen)


def _colour(name: str, value: Any) -> ByteColour:
    whole = isinstance(value, list) and all(isinstance(part, int) and 0 <= part <= 255 for part in value)
    if not whole or len(value) != 3:
        raise HeadError(f"{name} is {value!r}; expected a colour [red, green, blue] of 0 to 255")
    return (value[0], value[1], value[2])
