"""The identity of a head (`identity.toml`): the recipe of its shape and the colours of its looks."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Literal

from ...core.look import HAIR_STYLES, ByteColour
from ...core.units import Share, SignedShare
from ...errors import HeadError, InputError, unknown
from ...reading.hints import Range, Then
from ...reading.source_text import SourceText
from ...reading.toml import parse, read_text

YOUNG, OLD = 25.0, 90.0  # years at which the source's young and old shapes stand
FILE = "identity.toml"
_HALF_GREY, _GREYING = 66.0, 8.0  # years: at which half of the hairs are grey, and in which this changes most


def grey_share(age: float) -> float:
    """Return the share of grey hairs at an age in years.

    A logistic curve through the mean of people of 45 to 65 years, of whom 74 % have grey hair, on 27 % of the
    scalp (Panhard, Lozano and Loussouarn 2012, Br. J. Dermatol. 167); its slope is ours.
    """
    return 1.0 / (1.0 + math.exp((_HALF_GREY - age) / _GREYING))


def _known_style(name: str) -> str:
    if name not in HAIR_STYLES:
        raise InputError(unknown("hair style", name, HAIR_STYLES))
    return name


@dataclass(frozen=True, slots=True)
class Looks:
    """The visible properties of a head besides its shape.

    `skin`, `lips`, `lining` (inside of the mouth) and `cloth`; `hair` of head and lashes, and of the `brows`
    if these have no colour of their own; `grey`, 0 to 1: which share of the hairs has lost it; `iris` at the
    pupil and at the rim. `flush`, 0 to 2: how much redder or darker cheeks, nose, ears and lids are; `beard`,
    0 to 1: how dark a shaved beard shows. `hair_style`: one of `HAIR_STYLES`; `wave`, 0 to 1: from straight
    to wavy hair of chin length; `hairs` and `brow_hairs`: how many grow on the head, and on each brow.
    """

    skin: ByteColour = (212, 165, 140)
    lips: ByteColour = (178, 108, 98)
    lining: ByteColour = (160, 84, 80)
    cloth: ByteColour = (52, 62, 78)
    hair: ByteColour = (58, 42, 32)
    grey: Share = 0.0
    hair_style: Annotated[str, Then(_known_style)] = HAIR_STYLES[0]
    wave: Share = 0.6
    brows: ByteColour | None = None
    iris: tuple[ByteColour, ByteColour] = ((132, 112, 74), (74, 94, 104))
    flush: Annotated[float, Range(0.0, 2.0)] = 1.0
    beard: Share = 0.0
    hairs: Annotated[int, Range(100, 40_000)] = 8500
    brow_hairs: Annotated[int, Range(20, 2000)] = 306


@dataclass(frozen=True, slots=True)
class Identity:
    """The recipe of a head.

    `title` describes the person in a few words; `age` in years. The shares of `sex` and of `origin` each add
    up to 1. `build` moves weight and muscle from the mean (0) to the least (-1) or the most (1). `sliders`
    names targets of the source, `{}` for both sides, with their amounts.
    """

    title: str = ""
    age: Annotated[float, Range(YOUNG, OLD)] = YOUNG
    sex: Mapping[Literal["female", "male"], Share] = field(default_factory=dict)
    origin: Mapping[Literal["african", "asian", "caucasian"], Share] = field(default_factory=dict)
    build: Mapping[Literal["weight", "muscle"], SignedShare] = field(default_factory=dict)
    sliders: Mapping[str, SignedShare] = field(default_factory=dict)
    looks: Looks = Looks()

    def at(self, age: float) -> Identity:
        """Return the same person at another age in years: of the hairs with a colour some more are grey."""
        coloured = (1.0 - self.looks.grey) * min(1.0, (1.0 - grey_share(age)) / (1.0 - grey_share(self.age)))
        return replace(self, age=age, looks=replace(self.looks, grey=1.0 - coloured))


UNNAMED = Identity()  # the identity of a head whose folder has no identity.toml


def read_identity(path: Path) -> Identity:
    """Read an `identity.toml`.

    Raises HeadError, with its place, if the file is not TOML or holds an unknown key, or a value of the wrong
    kind or out of range.
    """
    try:
        text = read_text(path)
        identity = parse(Identity, text, str(path))
        for name in ("sex", "origin"):
            _check_shares(name, getattr(identity, name), SourceText(str(path), text))
    except InputError as error:
        raise HeadError(error.message, error.place) from None
    return identity


def _check_shares(name: str, shares: Mapping[str, float], source: SourceText) -> None:
    total = sum(shares.values())
    if abs(total - 1.0) > 1e-6:
        message = f"{name} adds up to {total:g}; expected shares of 0 and more that add up to 1"
        raise source.error((name,), message)
