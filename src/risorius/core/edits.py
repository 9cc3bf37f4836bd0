"""Changes of a score by hand: blocks moved, stretched, added and deleted, curves drawn.

Every change is a function from a score to a score; scores are frozen, so that to undo is to take the one
before. A movement keeps its id through all changes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from .movement import Movement
from .score import Score


def identified(score: Score) -> Score:
    """Return the score with an id for every movement, each its own: what has one keeps it, if it is first.

    Others are called by channel, layer and start, or by their id with a number.
    """
    wanted = [m.id or _by_place(m) for m in score.movements]
    names = _distinct(wanted, {m.id for m in score.movements if m.id})
    movements = (
        m if m.id == name else replace(m, id=name) for m, name in zip(score.movements, names, strict=True)
    )
    return replace(score, movements=tuple(movements))


def _by_place(m: Movement) -> str:
    return ".".join(part for part in (m.channel, m.layer) if part) + f"@{m.start:.3f}"


def _distinct(wanted: list[str], given: set[str]) -> Iterator[str]:
    seen: Counter[str] = Counter()
    taken = set(given)
    for name in wanted:
        seen[name] += 1
        if seen[name] == 1:
            taken.add(name)
            yield name
            continue
        number = seen[name]
        while f"{name}#{number}" in taken:
            number += 1
        taken.add(f"{name}#{number}")
        yield f"{name}#{number}"
