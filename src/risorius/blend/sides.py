"""Left and right: a side that moves as the other need not be computed twice."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.parameters import BASES, RIVALS
from .channels import Channel
from .curve import Curve
from .mouth.lips import CompiledLips, LipCurve


def twins_of(channels: Sequence[Channel], lips: CompiledLips | None) -> dict[str, str]:
    """Return for each second side that has the same values as the first at all times, the first.

    They have if all channels move both by the same curves, and limit both alike, and if the same holds of
    their rivals, of the rivals of these, and so on.
    """
    pairs = [(p[0].name, p[1].name) for p in BASES.values() if len(p) > 1]
    uneven = {name for pair in pairs if not _moved_alike(*pair, channels, lips) for name in pair}
    reached = list(uneven)
    while reached:
        rivals = set(RIVALS[reached.pop()]) - uneven
        uneven |= rivals
        reached.extend(rivals)
    return {second: first for first, second in pairs if first not in uneven}


def _moved_alike(one: str, two: str, channels: Sequence[Channel], lips: CompiledLips | None) -> bool:
    """Return whether two parameters have the same curves and limits."""
    if lips is not None and not (lips.alike(one, two) and _limited_alike(one, two, lips)):
        return False
    return all(_same(channel.curves.get(one, []), channel.curves.get(two, [])) for channel in channels)


def _limited_alike(one: str, two: str, lips: CompiledLips) -> bool:
    return lips.mouth.alike.get(one) == lips.mouth.alike.get(two)


def _same(first: Sequence[Curve], second: Sequence[Curve]) -> bool:
    """Return whether two lists hold the same curves; those of speech are compared as a whole."""
    return len(first) == len(second) and all(
        a is b or (isinstance(a, LipCurve) and isinstance(b, LipCurve))
        for a, b in zip(first, second, strict=True)
    )
