"""Explanations in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .explanation import Explanation, reasons


def narrate(explanations: Iterable[Explanation], time: float) -> Iterator[str]:
    """Yield the lines that say why parameters have their values at `time` seconds; equal sides once."""
    by_reasons: dict[tuple[str, ...], list[str]] = {}
    for explanation in explanations:
        base = explanation.parameter.partition(".")[0]
        by_reasons.setdefault((base, *reasons(explanation)), []).append(explanation.parameter)
    for (base, value, *lines), names in by_reasons.items():
        yield f"{base if len(names) > 1 else names[0]} = {value}"
        yield from (f"    {reason}" for reason in lines)
    if not by_reasons:
        yield f"at {time:g} s nothing moves"
