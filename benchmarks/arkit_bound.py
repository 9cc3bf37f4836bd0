"""How near a face the 52 sculpted ARKit shapes can come at all, beside how near the fit comes.

    python benchmarks/arkit_bound.py [INPUT] [--worst 4]

For the frames that fit least: the fit's worst vertex, and the least that the worst vertex can be over all
weights from 0 to 1 (with `mouthClose` at most `jawOpen`): with every shape free, with no two shapes of jaw
and mouth that exclude each other, and with none that goes to a side, as an even face wants it. The least is a
linear programme with a plane for each vertex and direction that binds, added until the programme's value, a
lower bound, and the distance reached differ by less than 0.01 mm.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from fractions import Fraction
from itertools import chain, product

import numpy as np
from scipy.optimize import linprog

import risorius
from risorius.core.arkit import EXCLUSIVE, INDEX, SHAPES
from risorius.core.arrays import Array, FloatArray
from risorius.face.fit.arkit_direct import DIRECT
from risorius.face.fit.arkit_fit import ArkitFit

CLOSE_ENOUGH = 0.01  # mm
PLANES = 60  # of the farthest vertices, each round


def least_worst(basis: Array, wanted: Array, highest: Array, rounds: int = 100) -> tuple[float, float]:
    """Return a lower bound of the worst vertex in mm, and what was reached.

    `basis` (52, 3 n) and `wanted` (3 n,) are displacements in mm, `highest` (52,) the weights' upper limits.
    """
    shapes, goal = basis.reshape(len(SHAPES), -1, 3), wanted.reshape(-1, 3)
    closes = np.zeros(len(SHAPES) + 1)
    closes[[INDEX["mouthClose"], INDEX["jawOpen"]]] = 1.0, -1.0
    planes, limits = [closes], [0.0]
    weights, low, reached = np.zeros(len(SHAPES)), 0.0, np.inf
    for _ in range(rounds):
        away = goal - np.einsum("f,fnk->nk", weights, shapes)
        distance = np.linalg.norm(away, axis=1)
        reached = min(reached, float(distance.max()))
        if reached - low < CLOSE_ENOUGH:
            break
        for vertex in np.argsort(-distance)[:PLANES]:
            towards = away[vertex] / distance[vertex]
            planes.append(np.append(-shapes[:, vertex] @ towards, -1.0))
            limits.append(-float(towards @ goal[vertex]))
        cost = np.append(np.zeros(len(SHAPES)), 1.0)
        bounds = [(0.0, high) for high in highest] + [(0.0, None)]
        found = linprog(cost, A_ub=np.array(planes), b_ub=np.array(limits), bounds=bounds)
        weights, low = found.x[:-1], float(found.x[-1])
    return low, reached


def bounds_of(fit: ArkitFit, skin: FloatArray, weights: Array) -> tuple[float, float, float]:
    """Return the least worst vertex in mm with every shape free, with none that exclude each other, and with
    none of jaw and mouth that goes to a side.

    `weights` (52,) are the fit's; those that it does not fit stay.
    """
    basis = fit.visible_displacement(np.eye(len(SHAPES)))
    wanted = fit.displacement(skin) - fit.visible_displacement(np.where(DIRECT, weights, 0.0))

    def without(names: Iterable[str]) -> float:
        highest = (~DIRECT).astype(float)
        highest[[INDEX[name] for name in names]] = 0.0
        return least_worst(basis, wanted, highest)[0]

    sides = EXCLUSIVE[:2]  # the lids are far from the mouth, where the worst is
    return without(()), min(map(without, product(*sides))), without(chain(*sides))


def main() -> None:
    """Print a line for each of the frames that fit least."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("input", nargs="?", default="examples/demo.xml")
    parser.add_argument("--worst", type=int, default=4, metavar="FRAMES")
    asked = parser.parse_args()
    take = risorius.speak(asked.input, settings=risorius.Settings(dynamics="static", fps=Fraction(30)))
    track, fit = take.arkit, ArkitFit(take.head)
    print("all frames: {:.2f} mm root mean square, {:.2f} mm at worst".format(*track.residual))
    print(f"{(track.worst > 2.0).sum()} of {len(track.worst)} frames have a vertex over 2 mm")
    print("  time  fit rms  worst  |  least possible  one-sided  even")
    for index in np.argsort(-track.worst)[: asked.worst]:
        (frame,) = take.faces([int(index)])
        free, one_sided, even = bounds_of(fit, frame.skin, track.weights[index])
        row = f"{take.times[index]:6.2f} {track.rms[index]:8.2f} {track.worst[index]:6.2f}  |"
        print(f"{row} {free:15.2f} {one_sided:10.2f} {even:5.2f}")


if __name__ == "__main__":
    main()
