"""Names of ARKit's shapes as programs and artists spell them, found among morph targets."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence

from ...core.arkit import SHAPES

_LIKE = 0.88  # how alike names must be for a guess
_SIDES = {"l": "left", "r": "right", "lft": "left", "rgt": "right", "left": "left", "right": "right"}
_LEAST = 2  # shapes that must share a prefix before it counts as one

ShapeTargets = Mapping[str, tuple[str, ...]]
"""The names of the morph targets of each ARKit shape: several if meshes spell it each in its own way."""


def guess_map(*meshes: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Return the names that most likely are ARKit's shapes among the morph targets of each mesh.

    Case, punctuation, prefixes, and the way sides are written do not count: `blendShape5.jawOpen`,
    `Head_jawOpen`, `eyeBlink.L`. A mesh has at most one target for a shape. Names that are only alike count
    if no mesh has a better one.
    """
    found = [_named(names) for names in meshes]
    missing = [shape for shape in SHAPES if not any(shape in named for named in found)]
    for names, named in zip(meshes, found, strict=True):
        named.update(_alike(names, missing, set(named.values())))
    targets = {shape: tuple(dict.fromkeys(n[shape] for n in found if shape in n)) for shape in SHAPES}
    return {shape: names for shape, names in targets.items() if names}


def _named(names: Sequence[str]) -> dict[str, str]:
    """Return the targets of one mesh by the shape whose name they have, with a prefix or without."""
    found: dict[str, str] = {}
    prefixed: dict[tuple[str, ...], dict[str, str]] = {}
    for name in names:
        words = _words(name)
        for first in range(len(words)):
            shape = _SHAPE_OF.get(_plain(words[first:]))
            if shape is not None:
                (prefixed.setdefault(tuple(words[:first]), {}) if first else found).setdefault(shape, name)
                break
    for named in prefixed.values():
        if len(named) >= min(_LEAST, len(names)):
            for shape, name in named.items():
                found.setdefault(shape, name)
    return found


def _alike(names: Iterable[str], missing: Iterable[str], taken: set[str]) -> dict[str, str]:
    """Return the targets of one mesh, besides those taken, whose names are like those of missing shapes."""
    free = {_plain(_words(name)): name for name in names if name not in taken}
    found = {}
    for shape in missing:
        wanted = _plain(_words(shape))
        near = difflib.get_close_matches(wanted, list(free), n=1, cutoff=_LIKE)
        if near and _side(near[0]) == _side(wanted):
            found[shape] = free.pop(near[0])
    return found


def _words(name: str) -> list[str]:
    """Return the words of a name without what stands before its last dot, sides spelled out.

    A side, as in `eyeBlink.L`, and a copy's number, as in `jawOpen.001`, may follow the name.
    """
    parts = [part for part in re.split(r"\s*[.:|]\s*", name.strip()) if part and not part.isdigit()] or [name]
    stem = parts[-2:] if len(parts) > 1 and parts[-1].lower() in _SIDES else parts[-1:]
    words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+", "_".join(stem))
    return [_SIDES.get(word.lower(), word.lower()) for word in words]


def _plain(words: Sequence[str]) -> str:
    """Return words as names are compared: in one, the side at the end."""
    side = next((word for word in reversed(words) if word in ("left", "right")), "")
    return "".join(word for word in words if word not in ("left", "right")) + side


def _side(plain: str) -> str:
    return next((side for side in ("left", "right") if plain.endswith(side)), "")


_SHAPE_OF = {_plain(_words(shape)): shape for shape in SHAPES}
