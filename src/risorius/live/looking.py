"""Directions that a live face is told to look in: eyes and head go there, stay, and come back."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from ..channels.eye_head import Angles, head_duration, head_share
from ..core.arrays import Array
from ..core.functions import ONSET_FUNCTIONS
from ..core.parameters import INDEX, PARAMETERS
from ..errors import InputError, ParameterError, unknown
from ..rules.markup import markup_table
from ..rules.match import EYES
from ..rules.saccade import saccade_duration

_EYE = [INDEX[name] for name in EYES]
_HEAD = [INDEX["head_pitch"], INDEX["head_yaw"]]
# Looks nearer to straight ahead bring the head to rest (paper B, section 5.2), degrees.
_AHEAD = 5.0
FARTHEST = (40.0, 60.0)
"""Degrees up or down and aside to which one can look with eyes and head."""


def direction_of(target: str | Angles) -> Angles:
    """Return pitch and yaw, in degrees, of a direction by name (`markup.toml`) or by its angles.

    Raises InputError for an unknown name, ParameterError for angles that are out of range.
    """
    if isinstance(target, str):
        names = markup_table().gaze
        if target.lower() not in names:
            raise InputError(unknown("direction", target, names))
        angles = names[target.lower()]
        return angles.pitch, angles.yaw
    try:
        pitch, yaw = (float(angle) for angle in target)
    except (TypeError, ValueError):
        message = f"{target!r} is not a direction; expected a name, or pitch and yaw in degrees"
        raise InputError(message) from None
    for name, angle, limit in zip(("pitch", "yaw"), (pitch, yaw), FARTHEST, strict=True):
        if not abs(angle) <= limit:
            raise ParameterError(f"{name} = {angle:g} is out of range; expected -{limit:g} to {limit:g}")
    return pitch, yaw


class Looking:
    """The look that is held; the face's own looks if none is.

    The eyes go as they do in a performance (main sequence, Freedman's law), and hold the direction while the
    head moves.
    """

    def __init__(self, fps: Fraction) -> None:
        self._fps = fps
        self._asked: tuple[Angles | None, float] | None = None
        self._lasts = math.inf
        self._target: Angles | None = None
        self._begun: int | None = None
        self._gaze_from = self._turned_from = self._turned_to = np.zeros(2)
        self._saccade = self._turn = 0.0
        self._shown: tuple[Array, Array] = (np.zeros(2), np.zeros(2))

    def look(self, direction: Angles | None, seconds: float = math.inf) -> None:
        """Look there from the next frame on, for so long; None gives the looks back to the face."""
        self._asked = direction, seconds

    @property
    def is_told(self) -> bool:
        """Tell whether a look is held that nothing but another one ends."""
        return self._target is not None and math.isinf(self._lasts)

    def shown(self, values: Array, index: int) -> Array:
        """Return the values of the next frame, `index`, with the look that is held."""
        if self._asked is not None:
            (target, self._lasts), self._asked = self._asked, None
            if target != self._target or self._begun is None:
                self._begin(target, values, index)
        if self._begun is None:
            return values
        seconds = float((index + 1 - self._begun) / self._fps)
        if seconds > self._lasts:
            self.look(None)
            return self.shown(values, index)
        own = values[_EYE] + values[_HEAD]
        goal = own if self._target is None else np.array(self._target)
        arrived = _share("saccade", seconds, self._saccade)
        followed = _share("minimum_jerk", seconds - self._saccade, self._turn)
        gaze = self._gaze_from + arrived * (goal - self._gaze_from)
        turned = self._turned_from + followed * (self._turned_to - self._turned_from)
        self._shown = gaze, turned
        if self._target is None and arrived == followed == 1.0:
            self._begun = None
            return values
        turned_values = values.copy()
        turned_values[_HEAD] = _within(_HEAD, values[_HEAD] + turned)
        turned_values[_EYE] = _within(_EYE, gaze - turned_values[_HEAD])
        return turned_values

    def _begin(self, target: Angles | None, values: Array, index: int) -> None:
        own = values[_EYE] + values[_HEAD]
        gaze, turned = (own, np.zeros(2)) if self._begun is None else self._shown
        if target is None and self._begun is None:
            return
        goal = own if target is None else np.array(target)
        eye = gaze - values[_HEAD] - turned
        if target is None or math.hypot(*target) < _AHEAD:
            turn = -turned
        else:
            turn = np.array([head_share(g, e) for g, e in zip(goal - gaze, eye, strict=True)])
        self._target, self._begun = target, index
        self._gaze_from, self._turned_from, self._turned_to = gaze, turned, turned + turn
        self._saccade = saccade_duration(math.dist(goal, gaze))
        self._turn = head_duration(math.hypot(*turn))


def _share(function: str, seconds: float, whole: float) -> float:
    """Return how much of a movement of `whole` seconds has happened."""
    if max(seconds, 0.0) >= whole:
        return 1.0
    return float(ONSET_FUNCTIONS.get(function)(np.array([max(seconds, 0.0) / whole]))[0])


def _within(columns: list[int], angles: Array) -> Array:
    """Return angles of these parameters within their ranges."""
    ranges = [PARAMETERS[column] for column in columns]
    limited: Array = np.clip(angles, [p.low for p in ranges], [p.high for p in ranges])
    return limited
