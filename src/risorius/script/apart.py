"""Marks of one channel follow one another (paper A, section 2)."""

from __future__ import annotations

from collections.abc import Hashable, Iterable

from ..errors import InputError
from .model import Mark


def check_apart(starts: Iterable[tuple[Mark, Hashable]]) -> None:
    """Raise InputError, naming both places, if two marks of one channel and layer start together."""
    seen: dict[tuple[str, str, Hashable], Mark] = {}
    for mark, moment in starts:
        first = seen.setdefault((mark.channel, mark.layer, moment), mark)
        if first is not mark:
            where = f"channel {mark.channel}" + (f", layer '{mark.layer}'" if mark.layer else "")
            raise InputError(
                f"{mark.label} starts together with {first.label} at {first.place}, "
                f"both at {moment} in {where}; expected another time, or a layer of its own",
                mark.place,
            )
