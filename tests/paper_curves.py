"""Curves of what rules and habits do, and how a rule of a paper is read off them."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import numpy as np

from risorius.blend import combine
from risorius.core.arrays import Array
from risorius.core.movement import Movement
from risorius.core.score import BlendSettings, Score
from risorius.core.speech.utterance import Utterance

from .channels.at_work import movements

FPS = 200
FRAME = 1.0 / FPS
OUTER = "frontalis_lateralis.left"
SMILE, NOSE = "zygomatic_major.left", "levator_labii_nasi.left"
HEAD = ("head_pitch", "head_yaw", "head_roll")
Curves = dict[str, Array]


def performed(found: Iterable[Movement], duration: float, fps: int = FPS, **settings: str) -> Curves:
    blend = BlendSettings(**settings)  # type: ignore[arg-type]
    return combine(Score(duration, tuple(found), settings=blend), Fraction(fps)).curves


def shown(
    said: Utterance, *prefixes: str, also: tuple[str, ...] = (), seed: int = 0, **inputs: object
) -> Curves:
    """Return the curves of what rules under the prefixes, and habits named beside, make of an utterance."""
    found = movements(said, *prefixes, seed=seed, **inputs)
    return performed([m for m in found if m.cause.rule.startswith((*prefixes, *also))], said.duration)


def active(curve: Array, least: float = 1e-3) -> tuple[float, float]:
    """Return from when to when a curve is away from rest, in seconds."""
    moving = np.flatnonzero(np.abs(curve) > least)
    assert moving.size
    return float(moving[0] * FRAME), float(moving[-1] * FRAME)


def value(curve: Array, time: float) -> float:
    return float(curve[round(time * FPS)])


def part(curve: Array, start: float, end: float) -> Array:
    return curve[round(start * FPS) : round(end * FPS)]


def closures(curve: Array, least: float = 0.4) -> list[tuple[float, float]]:
    """Return when a lid is closed beyond a share, as spans of seconds."""
    closed = np.concatenate(([0], curve > least, [0])).astype(int)
    edges = np.flatnonzero(np.diff(closed))
    return [(a * FRAME, b * FRAME) for a, b in edges.reshape(-1, 2)]


def near(times: Array, time: float) -> float:
    return float(np.abs(times - time).min())


def edges_of(said: Utterance) -> Array:
    return np.array([0.0, *(p.end for p in said.phones)])


def minimum_jerk(share: Array) -> Array:
    u = np.clip(share, 0.0, 1.0)
    return u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
