"""Performances as files hold them: values by name over time. Nothing here needs Blender."""

from __future__ import annotations

import csv
import json
import re
import tomllib
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, degrees
from pathlib import Path
from statistics import median
from typing import Any

APP_RATE = 60.0  # frames per second of Live Link Face, where a file does not tell
_TIMECODE = re.compile(r"(\d+):(\d{2}):(\d{2})[:;](\d+(?:\.\d+)?)")
_ROUNDED = 0.006  # frames per second that a rate may be off, of which two decimals are known
_SIDES = {"l": "left", "r": "right"}


class TrackError(Exception):
    """A file that cannot be used; one line says why."""


@dataclass(frozen=True)
class Track:
    """A performance: `times` in seconds, `values` by name, one for each time.

    `values` are weights of ARKit's shapes, or our muscles, 0 to 1. `head` holds pitch, yaw and roll of the
    head in degrees: up, to the subject's left, and tilted to the subject's left are positive. `rate` is its
    frames per second.
    """

    rate: float
    times: list[float]
    values: dict[str, list[float]]
    head: dict[str, list[float]]


def read_track(path: Path) -> Track:
    """Read `.arkit.csv` (or another take of Live Link Face) or `.performance.json`; raise TrackError."""
    try:
        if path.suffix.lower() == ".csv":
            return _from_csv(path)
        if path.suffix.lower() == ".json":
            return _from_json(json.loads(path.read_text(encoding="utf-8")), path)
    except (OSError, ValueError) as error:
        raise TrackError(f"{path.name}: cannot be read: {error}") from error
    raise TrackError(f"{path.name}: is not a performance; expected .arkit.csv or .performance.json")


def read_map(path: Path) -> dict[str, tuple[str, ...]]:
    """Return the shape keys of each ARKit shape or muscle, from the map that `risorius rig` prints."""
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8")).get("shapes")
    except (OSError, ValueError) as error:
        raise TrackError(f"{path.name}: cannot be read: {error}") from error
    if isinstance(table, dict):
        lists = {name: [keys] if isinstance(keys, str) else keys for name, keys in table.items()}
        if all(isinstance(keys, list) and all(isinstance(k, str) for k in keys) for keys in lists.values()):
            return {name: tuple(keys) for name, keys in lists.items()}
    raise TrackError(f'{path.name}: has no table of names; expected [shapes] jawOpen = "Mouth_Open"')


def plain(name: str) -> str:
    """Return a name as it is compared: `jawOpen` equals `Jaw_Open`, and `browDown_L` `BrowDownLeft`."""
    parts = [part for part in re.split(r"[\W_]+", name.lower()) if part]
    if len(parts) > 1 and parts[-1] in _SIDES:
        parts[-1] = _SIDES[parts[-1]]
    return "".join(parts)


def scene_rate(rate: float) -> tuple[int, float]:
    """Return the whole number of frames, and of seconds that they last, by which Blender states a rate.

    Rates of television, such as 24000/1001, are found although files round them to hundredths.
    """
    for frames, seconds in ((round(rate), 1.0), (round(1.001 * rate), 1.001)):
        if frames and abs(frames / seconds - rate) < _ROUNDED:
            return frames, seconds
    frames = max(ceil(rate), 1)
    return frames, frames / rate


def _from_csv(path: Path) -> Track:
    with path.open(encoding="utf-8-sig", newline="") as file:
        header, *rows = [row for row in csv.reader(file) if row]
    names = [name.strip() for name in header]
    if "Timecode" not in names or not rows:
        raise TrackError(f"{path.name}: has no frames with a Timecode; expected a take of Live Link Face")
    clock = names.index("Timecode")
    rate, times = _times([_clock(row[clock], path) for row in rows])
    columns = {
        name: [float(row[k]) for row in rows]
        for k, name in enumerate(names)
        if name.lower() not in ("timecode", "blendshapecount")
    }
    head = {part: columns.pop(f"Head{part.title()}", None) for part in ("pitch", "yaw", "roll")}
    turned = {part: [degrees(angle) for angle in angles] for part, angles in head.items() if angles}
    shapes = {name: values for name, values in columns.items() if not name.endswith(("Yaw", "Pitch", "Roll"))}
    return Track(rate, times, shapes, turned)


def _clock(text: str, path: Path) -> tuple[float, float]:
    """Return whole seconds and the frame in the second."""
    match = _TIMECODE.fullmatch(text.strip())
    if match is None:
        raise TrackError(f"{path.name}: '{text}' is not a time code; expected HH:MM:SS:FF.mmm")
    hours, minutes, seconds, frame = (float(part) for part in match.groups())
    return 3600.0 * hours + 60.0 * minutes + seconds, frame


def _times(clocks: list[tuple[float, float]]) -> tuple[float, list[float]]:
    """Return the rate, which shows where one second ends and the next begins, and seconds since frame 1."""
    pairs = list(pairwise(clocks))
    steps = [b[1] - a[1] for a, b in pairs if b[0] == a[0]]
    ends = [b[1] - a[1] for a, b in pairs if b[0] - a[0] == 1.0]
    rate = APP_RATE if not ends else max(round((median(steps) if steps else 1.0) - median(ends), 2), 1.0)
    seconds = [whole + frame / rate for whole, frame in clocks]
    return rate, [second - seconds[0] for second in seconds]


def _from_json(data: Any, path: Path) -> Track:
    curves = data.get("curves") if isinstance(data, dict) else None
    if not isinstance(curves, dict) or not curves or "fps" not in data:
        raise TrackError(f"{path.name}: has no curves; expected a .performance.json of Risorius")
    numerator, _, denominator = str(data["fps"]).partition("/")
    rate = float(numerator) / float(denominator or 1)
    values = {name: [float(value) for value in curve] for name, curve in curves.items()}
    head = {part: values.pop(f"head_{part}") for part in ("pitch", "yaw", "roll") if f"head_{part}" in values}
    frames = len(next(iter(values.values())))
    moving = {name: curve for name, curve in values.items() if not name.startswith("gaze_")}
    return Track(rate, [k / rate for k in range(frames)], moving, head)
