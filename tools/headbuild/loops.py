"""Edge loops of a quad mesh: the rings about the mouth, the eyes, the chest and the arms."""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from risorius.core.arrays import AnyArray


class Loops:
    """Walks the closed edge loops of a quad mesh, given as (n, 4) vertex indices."""

    def __init__(self, quads: AnyArray) -> None:
        """Index the edges and neighbours of ``quads``."""
        self._quads = quads
        self._faces_of_edge: dict[tuple[int, int], list[int]] = defaultdict(list)
        self._neighbours: dict[int, set[int]] = defaultdict(set)
        for index, face in enumerate(quads.tolist()):
            for a, b in zip(face, face[1:] + face[:1], strict=True):
                self._faces_of_edge[_edge(a, b)].append(index)
                self._neighbours[a].add(b)
                self._neighbours[b].add(a)

    def walk(self, a: int, b: int) -> list[int]:
        """The closed loop that starts along the edge a → b; raise ValueError if it does not close."""
        loop = [a, b]
        while True:
            following = self._next(loop[-2], loop[-1])
            if following == a:
                return loop
            if following is None or following in loop:
                raise ValueError(f"the edge loop from {a}-{b} does not close")
            loop.append(following)

    def _next(self, a: int, b: int) -> int | None:
        beside = {v for face in self._faces_of_edge[_edge(a, b)] for v in self._quads[face].tolist()}
        ahead = [v for v in self._neighbours[b] if v not in beside]
        return ahead[0] if len(self._neighbours[b]) == 4 and len(ahead) == 1 else None

    def fill(self, seed: int, barriers: list[list[int]]) -> AnyArray:
        """Indices of the faces reached from vertex ``seed`` without crossing any of the loops
        ``barriers``.
        """
        closed = {_edge(a, b) for loop in barriers for a, b in zip(loop, loop[1:] + loop[:1], strict=True)}
        reached = {index for index, face in enumerate(self._quads.tolist()) if seed in face}
        front = list(reached)
        while front:
            face = self._quads[front.pop()].tolist()
            for a, b in zip(face, face[1:] + face[:1], strict=True):
                if _edge(a, b) not in closed:
                    fresh = [f for f in self._faces_of_edge[_edge(a, b)] if f not in reached]
                    reached.update(fresh)
                    front.extend(fresh)
        return np.array(sorted(reached))


def fill_inside(loops: Loops, quads: AnyArray, seed: int, border: list[int]) -> AnyArray:
    """Sorted vertices of `quads` (n, 4) that are reached from `seed` within the loop `border`, without it."""
    return np.setdiff1d(np.unique(quads[loops.fill(seed, [border])]), border)


def columns(loop: list[int], points: AnyArray) -> AnyArray:
    """Pairs (k, 2) of upper and lower vertices of an even loop about a slit, by ascending x; ``points`` is
    (n, 3).

    A corner of the slit is a vertex of the loop (then left out) or lies between two vertices, whichever makes
    the pairs' x agree best.
    """
    half, ring = len(loop) // 2, np.array(loop)
    candidates = []
    for start in range(len(loop)):
        turned = np.roll(ring, -start)
        candidates.append(np.stack([turned[1:half], turned[:half:-1]], axis=1))
        candidates.append(np.stack([turned[:half], turned[: half - 1 : -1]], axis=1))
    result = min(candidates, key=lambda pairs: float(np.abs(np.diff(points[pairs][:, :, 0])).mean()))
    result = result[np.argsort(points[result][:, :, 0].mean(axis=1), kind="stable")]
    up = points[result[:, 0], 1].mean() > points[result[:, 1], 1].mean()
    return result if up else result[:, ::-1]


def _edge(a: int, b: int) -> tuple[int, int]:
    return (a, b) if a < b else (b, a)
