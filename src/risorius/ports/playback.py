"""Captured faces in again: ARKit CSV, FAP and action units become curves of our parameters."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..core.action_units import resolve_targets
from ..core.arkit import INDEX as ARKIT
from ..core.arrays import Array
from ..core.movement import Cause, ManualCurve
from ..core.parameters import INDEX, NAMES, NEUTRAL, PARAMETERS
from ..core.progress import Progress, quiet
from ..core.score import BlendSettings, Score
from ..errors import InputError, Place, unknown, warn
from ..face.arkit_fit import ArkitFit
from ..face.arkit_given import gaze_of
from ..face.feature_points import ANGLE, LIDS, POINTS, SHOWN, TONGUE, FeaturePoints
from ..face.head import Head
from ..face.response import TONGUE as TONGUE_FITTED
from ..face.response import Responses
from ..face.solve import FaceSolver
from .arkit_csv import read_arkit_csv
from .au_csv import read_au_csv
from .fap import FapTake, read_fap

MakeHead = Callable[[], Head]
"""Loads the head that performs; called when the file is known to be right."""
_HEAD = [INDEX[f"head_{angle}"] for angle in ("pitch", "yaw", "roll")]
_GAZE = [INDEX["gaze_pitch"], INDEX["gaze_yaw"]]
_OPEN = 0.02  # of the jaw's way: less is no opening that lips could close
_RESTS = 1e-4  # a parameter that never leaves its rest by more gets no curve


def captured(path: Path, head: MakeHead, progress: Progress = quiet) -> Score:
    """Return a file's motion as curves drawn by hand; InputError for a file that is none of `CAPTURES`."""
    name = path.name.lower()
    suffix = next((suffix for suffix in CAPTURES if name.endswith(suffix)), None)
    if suffix is None:
        raise InputError(unknown("kind of capture", "".join(path.suffixes[-2:]), CAPTURES), Place(str(path)))
    times, values = CAPTURES[suffix](path, head, progress)
    return score_of(times, values, path.name)


def score_of(times: Array, values: Array, source: str) -> Score:
    """Return values (frames, 46) at times (frames,) in seconds as a score of one set of curves."""
    low, high = (np.array([getattr(p, end) for p in PARAMETERS]) for end in ("low", "high"))
    kept = np.clip(values, low, high)
    moving = np.flatnonzero(np.abs(kept - NEUTRAL).max(axis=0) > _RESTS)
    clock = times.tolist()
    keys = {NAMES[column]: tuple(zip(clock, kept[:, column].tolist(), strict=True)) for column in moving}
    curves = (ManualCurve(keys, Cause("capture", source)),) if keys else ()
    settings = BlendSettings(contact=False)
    return Score(max(float(times[-1]), 1e-3), manual=curves, settings=settings)


def _from_arkit(path: Path, head: MakeHead, progress: Progress) -> tuple[Array, Array]:
    take = read_arkit_csv(path)
    progress("Fitting muscles …")
    performer = head()
    fit = ArkitFit(performer)
    open_, close = take.weights[:, ARKIT["jawOpen"]], take.weights[:, ARKIT["mouthClose"]]
    # Lips that are closed over an open jaw are brought together by contact, not by muscles against the jaw.
    apart = take.weights.copy()
    apart[:, ARKIT["mouthClose"]] = 0.0
    responses = Responses(FaceSolver(performer), lambda frame: fit.displacement(frame.skin))
    values = responses.of_shapes(apart, fit.seen_displacement(np.eye(len(ARKIT))))
    values[:, INDEX["lip_seal"]] = np.where(
        open_ > _OPEN, np.minimum(close / np.maximum(open_, _OPEN), 1.0), 0.0
    )
    values[:, INDEX["tongue_out"]] = take.weights[:, ARKIT["tongueOut"]]
    degrees = np.degrees(take.rotations)
    values[:, _HEAD] = degrees[:, [1, 0, 2]]
    eyes = degrees[:, 3:].reshape(-1, 2, 3).mean(axis=1)
    values[:, _GAZE] = eyes[:, [1, 0]] if np.any(degrees[:, 3:]) else np.stack(gaze_of(take.weights), axis=1)
    return take.times, values


def _from_fap(path: Path, head: MakeHead, progress: Progress) -> tuple[Array, Array]:
    take = read_fap(path)
    progress("Fitting muscles …")
    performer = head()
    points = FeaturePoints(performer)
    sizes = points.sizes()
    rows = [number - 1 for number in (*POINTS, *LIDS) if take.used[number - 1]]
    solver = FaceSolver(performer)
    responses = Responses(solver, lambda frame: points.of_skin(frame.skin) * sizes)
    values = responses.values(take.values * sizes, rows) if rows else np.tile(NEUTRAL, (len(take.times), 1))
    tongue = [number - 1 for number in TONGUE]
    if take.used[tongue].all():
        tip = Responses(solver, points.tongue_tip, TONGUE_FITTED).values(take.values[:, tongue], (0, 1))
        places = [INDEX[name] for name in TONGUE_FITTED]
        values[:, places] = tip[:, places]
    _tell_left_out(take, path)
    angles = np.degrees(take.values * ANGLE)
    values[:, _HEAD] = angles[:, 47:50] * [-1.0, 1.0, -1.0]
    values[:, _GAZE] = np.stack([-angles[:, 24:26].mean(axis=1), angles[:, 22:24].mean(axis=1)], axis=1)
    return take.times, values


def _tell_left_out(take: FapTake, path: Path) -> None:
    """Warn of parameters that do something in a file, and nothing in our face."""
    moved = np.flatnonzero(take.values.any(axis=0)) + 1
    left_out = sorted({int(number) for number in moved} - set(SHOWN))
    if left_out:
        named = ", ".join(map(str, left_out))
        warn(f"{path}: FAP {named} cannot be shown; left out")


def _from_action_units(path: Path, _head: MakeHead, _progress: Progress) -> tuple[Array, Array]:
    take = read_au_csv(path)
    values = np.tile(NEUTRAL, (len(take.times), 1))
    for k, row in enumerate(values):
        units = {f"AU{number}": float(strength[k]) for number, strength in take.units.items()}
        for name, value in resolve_targets(units).items():
            row[INDEX[name]] = value
    values[:, _HEAD], values[:, _GAZE] = take.head, take.gaze
    return take.times, values


CAPTURES: dict[str, Callable[[Path, MakeHead, Progress], tuple[Array, Array]]] = {
    ".arkit.csv": _from_arkit,
    ".au.csv": _from_action_units,
    ".fap": _from_fap,
    ".csv": _from_arkit,
}
"""Readers by suffix; a plain `.csv` is a take of Live Link Face, as its app names them."""
