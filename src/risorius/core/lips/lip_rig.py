"""From the lips' articulators, in millimetres, to the muscles of one head.

A head's fit holds its mesh's measures as polynomials in the controls (`articulators.CONTROLS`): chin, gap,
width, protrusion, height of the upper lip and of the corners. The rig inverts them one after the other, so
that each control is determined by one measure:

    jaw by the chin's drop; round by the protrusion; spread by the width (or more round, if the mouth must be
    narrower than its rounding makes it); lift or lower by the corners; upper by the upper lip, which takes a
    third of what the gap is wider than the chin's drop; open by the gap that is then missing. Contact
    (`lip_seal`) closes a gap that is too wide.

Width, protrusion and corners are blended as *additions* to the effects of the jaw and the opening lips, so
that phones without such targets leave these muscles at exactly 0.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import product

import numpy as np

from ..arrays import Array, Int64Array
from ..functions import positive_part
from ..parameters import BASES, DEFAULT_THRESHOLD
from .articulators import (
    APERTURE,
    ARTICULATORS,
    CONTROLS,
    CORNERS,
    FITTED,
    JAW,
    PRESSING,
    PROTRUSION,
    SEAL_MM,
    UPPER,
    WIDEST_MM,
    WIDTH,
)

Averages = Callable[[str], Array]
"""Returns the blended values (n,) of a target, by name."""

_CONTROLS_OF: Mapping[str, tuple[str, ...]] = {
    JAW: ("jaw",),
    APERTURE: ("open", "upper"),
    WIDTH: ("round", "spread"),
    PROTRUSION: ("round", "spread"),
    UPPER: ("upper",),
    CORNERS: ("lift", "lower"),
}
_OPENED_BY: Mapping[str, tuple[str, ...]] = {
    "jaw": ("masseter",),
    "open": ("depressor_labii",),
    # The second muscle is not in the fit: it raises the lip from the wing of the nose, by about as much.
    "upper": ("levator_labii_superioris", "levator_labii_nasi"),
    "round": ("orbicularis_oris_funneler",),
}
OPENING = frozenset(p.name for bases in _OPENED_BY.values() for base in bases for p in BASES[base])
"""The muscles that part the lips."""
MEASURES = (JAW, APERTURE, WIDTH, PROTRUSION, UPPER, CORNERS)
"""The measures of a fit, mm from rest."""
NONE = len(CONTROLS)
"""Fills a term that has fewer controls: a factor of 1."""
DEGREE = 3
SEAL = "lip_seal"
_OPENING = ("jaw", "open", "upper")
_STEPS, _MOST_NEEDED, _NEAR = 6, 4, 1e-9
"""Newton's steps; most solutions need four, by the last of which they move less than the third number."""
_ROUNDS = 4
ROUNDED = 1.0
"""mm over which a control begins, so that it has no corner where the next one takes over."""
PARTED = 2.0
"""mm of gap over which the lips' own opening, or their contact, takes over from the jaw's opening."""
SEAL_ROUNDED = 0.2
"""Width, in units of the seal, over which the seal is rounded off below the most that a wide gap allows."""
RAISED = 0.25
"""The rise of the upper lip's border, which the fit measures, for each mm that the lips open beyond the
chin's drop. Its inner edge then rises by a third, and the lower lip has the rest (facts: lips-motion, 9)."""
RAISER = "levator_labii_superioris"
_LEAST_EFFECT = 0.6
"""mm of gap: `open` is taken to have at least this effect at first, a seventh of its effect at rest."""
_Targets = tuple[tuple[str, float], ...]
Powers = Sequence[Array]
"""The factors (n,), or () if all are equal, of each power of a control, from 0 to `DEGREE`."""
_Equation = tuple[Powers, Array]
"""The equation of a control: its powers, and the sum wanted of them without the first, (n,)."""
_MOST_KNOWN = 4096
"""Targets whose blended form a rig remembers: phones of one class and stress have the same in all lines."""
_HELPING = 0.95 * DEFAULT_THRESHOLD
"""The largest activation of a control's further muscles."""


@dataclass(frozen=True, eq=False)
class LipRig:
    """The lips of one head: measure = Σ coefficients · the product of each term's controls.

    `terms` (k, 3): indices into the controls, filled up with `NONE`; `coefficients` (k, 6), mm, one column
    per measure.
    """

    terms: Int64Array
    coefficients: Array
    _known: dict[_Targets, dict[str, float]] = field(default_factory=dict, init=False, repr=False)

    def passive(self, measure: str, controls: Mapping[str, Array]) -> Array:
        """Return a measure in mm for some controls; the others are 0."""
        return self._along(measure, "", controls)[0]

    def actives(self, targets: Sequence[Mapping[str, float]]) -> list[dict[str, float]]:
        """Return the articulators of targets (mm on the mesh) in the form in which they are blended.

        Width, protrusion and corners are reduced by the effects of the jaw and the opening; a missing
        aperture is what the jaw opens. Other targets are left out.
        """
        articulations = [tuple((n, v) for n, v in of.items() if n in ARTICULATORS) for of in targets]
        if len(self._known) > _MOST_KNOWN:
            self._known.clear()
        actives = {own: of for own in articulations if (of := self._known.get(own)) is not None}
        alike: dict[tuple[str, ...], list[_Targets]] = {}
        for own in dict.fromkeys(articulations):
            if own not in actives:
                alike.setdefault(tuple(name for name, _ in own), []).append(own)
        for names, group in alike.items():
            actives.update((own, {}) for own in group)
            if names:
                table = np.array([[value for _, value in own] for own in group])
                for name, values in self._actives(dict(zip(names, table.T, strict=True))).items():
                    for own, value in zip(group, values.tolist(), strict=True):
                        actives[own][name] = value
        self._known.update(actives)
        return [dict(actives[own]) for own in articulations]

    def _actives(self, targets: dict[str, Array]) -> dict[str, Array]:
        """Return what `actives` does for targets of the same articulators, (n,) each."""
        count = len(next(iter(targets.values())))
        jaw = self._jaw(targets.get(JAW, np.zeros(count)))
        targets.setdefault(APERTURE, np.maximum(self.passive(APERTURE, {"jaw": jaw}), 0.0))
        blended = {name: targets[name] for name in (JAW, APERTURE, UPPER) if name in targets}
        added = [name for name in (WIDTH, PROTRUSION, CORNERS) if name in targets]
        for _ in range(_ROUNDS if added else 0):
            controls = self.controls(lambda name: blended.get(name, np.zeros(count)), blended)
            alone = {name: controls[name] for name in controls if name in _OPENING}
            for name in added:
                blended[name] = targets[name] - self.passive(name, alone)
            if PROTRUSION not in targets:
                # Only rounding narrows a mouth, and a phone without a protrusion is not rounded.
                blended[WIDTH] = np.maximum(blended.get(WIDTH, np.zeros(count)), 0.0)
        return blended

    def moved(self, articulators: Collection[str]) -> frozenset[str]:
        """Return the parameters that targets of some articulators may move."""
        controls = {control for name in articulators for control in _CONTROLS_OF[name]}
        moved = [CONTROLS[name] for name in controls] + ([PRESSING] if articulators else [])
        bases = {base for factors in moved for base in factors}
        return frozenset(p.name for base in bases for p in BASES[base]) | ({SEAL} if articulators else set())

    def parameters(self, average: Averages, articulators: Collection[str]) -> dict[str, Array]:
        """Return the parameters that move, by name, for blended articulators (mm) from `average`."""
        controls = self.controls(average, articulators)
        seal = controls.pop(SEAL)
        pressed = positive_part(-average(APERTURE), PARTED)
        values: dict[str, Array] = {}
        for moved, amount in [*((CONTROLS[n], controls[n]) for n in controls), (PRESSING, pressed)]:
            for number, (base, factor) in enumerate(moved.items()):
                # A control's further muscles stay below the threshold, above which they would inhibit rivals.
                moves = factor * amount if number == 0 else np.minimum(factor * amount, _HELPING)
                values[base] = values.get(base, 0.0) + moves
        most = {base: np.minimum(value, 1.0) for base, value in values.items()}
        return {SEAL: np.minimum(seal, 1.0), **{p.name: most[b] for b in most for p in BASES[b]}}

    def controls(self, average: Averages, articulators: Collection[str]) -> dict[str, Array]:
        """Return the controls of some articulators, and the seal, all of the shape of `average`'s arrays."""
        jaw = self._jaw(average(JAW))
        controls = {"jaw": jaw}
        equations: dict[str, _Equation] = {}
        rounds = WIDTH in articulators or PROTRUSION in articulators
        if rounds:
            forward, aside = (self._along(m, "round", {"jaw": jaw}) for m in (PROTRUSION, WIDTH))
            equations["round"] = forward, positive_part(average(PROTRUSION), ROUNDED)
        if CORNERS in articulators:
            corners = average(CORNERS)
            for name, sign in (("lift", 1.0), ("lower", -1.0)):
                powers = self._along(CORNERS, name, {"jaw": jaw})
                equations[name] = powers, positive_part(sign * corners, ROUNDED) * sign
        solved, equations = _solved(equations), {}
        if rounds:
            first = solved["round"]
            spreading = self._along(WIDTH, "spread", {"jaw": jaw, "round": first})
            remaining = average(WIDTH) - (spreading[0] - aside[0])
            controls["round"] = _narrowed(first, forward, aside, remaining)
            equations["spread"] = spreading, positive_part(remaining, ROUNDED)
        equations["upper"] = self._raising(controls, average, articulators)
        solved.update(_solved(equations))
        controls.update(
            (name, solved[name]) for name in ("spread", "lift", "lower", "upper") if name in solved
        )
        powers = self._along(APERTURE, "open", controls)
        missing = average(APERTURE) - powers[0]
        # Beside a low jaw and rounding the fit finds little effect at first: a small gap would need a leap.
        powers[1] = np.maximum(powers[1], _LEAST_EFFECT)
        controls["open"] = solve(powers, positive_part(missing, PARTED))
        controls[SEAL] = seal_of(positive_part(-missing, PARTED), np.maximum(average(APERTURE), 0.0))
        return controls

    def gap(self, values: Mapping[str, Array]) -> Array:
        """Return the gap in mm, shape (n,), that the muscles of all channels open if no seal closes it.

        `values`: by the names of `OPENING`, shape (n,) each.
        """
        controls = {
            control: np.add.reduce([values[p.name] / len(BASES[b]) for b in bases for p in BASES[b]])
            for control, bases in _OPENED_BY.items()
        }
        controls["upper"] = np.minimum(controls["upper"], 1.0)
        return self.passive(APERTURE, controls)

    def _jaw(self, drop: Array) -> Array:
        return solve(self._along(JAW, "jaw", {}), positive_part(drop, ROUNDED))

    def _raising(
        self, controls: Mapping[str, Array], average: Averages, articulators: Collection[str]
    ) -> _Equation:
        """Return the equation of `upper`: the upper lip's part in the lips' own opening, and its own raise.

        The ring muscle keeps it from the former, the more the rounder the lips.
        """
        opened = positive_part(average(APERTURE) - average(JAW), ROUNDED)
        opened = opened * (1.0 - controls.get("round", 0.0)) ** 2
        own = positive_part(average(UPPER), ROUNDED) if UPPER in articulators else 0.0
        return self._along(UPPER, "upper", {"jaw": controls["jaw"]}), RAISED * opened + own

    def _along(self, measure: str, control: str, others: Mapping[str, Array]) -> list[Array]:
        """Return a measure as a polynomial in one control for values of others: the factor of each power."""
        plan = _plan(self, measure, control, frozenset(others))
        return [np.asarray(_value(factor, others)) for factor in plan]


def _narrowed(rounding: Array, forward: Powers, aside: Powers, remaining: Array) -> Array:
    """Return `round` for a mouth that must be narrower (`remaining` below 0) than its `rounding` makes it.

    It is about the nearest to both targets: one step of Gauss and Newton from the first. It has no corner
    where the width is just reached. `forward`, `aside`: the protrusion and the width along `round`.
    """
    along, across = _slope(forward, rounding), _slope(aside, rounding)
    nearer = -across * positive_part(-remaining, ROUNDED) / (along**2 + across**2)
    return np.clip(rounding + nearer, 0.0, 1.0)


def rig_of_fit(terms: Int64Array, coefficients: Array) -> LipRig:
    """Return the rig of a fit, whose variables are those of `FITTED`: what each raises beside its own."""
    names, rows = list(CONTROLS), [tuple(sorted(term)) for term in terms.tolist()]
    upper, opening = names.index("upper"), names.index("open")
    # A fit's `upper` lacks the part that its `open` raises.
    instead = {upper: ((upper, 1.0), (opening, -FITTED["open"][RAISER]))}
    number = {row: k for k, row in enumerate(rows)}
    own = np.zeros_like(coefficients)
    for row, factors in zip(rows, coefficients, strict=True):
        for picked in product(*(instead.get(control, ((control, 1.0),)) for control in row)):
            term = tuple(sorted(control for control, _ in picked))
            own[number[term]] += np.prod([share for _, share in picked]) * factors
    return LipRig(terms, own)


def seal_of(closed: Array, left: Array) -> Array:
    """Return the seal that closes `closed` mm of a gap and leaves `left` mm, both 0 or more.

    It takes `SEAL_MM` mm by its whole way, or more from a gap of which it then leaves only what `WIDEST_MM`
    allows; without a corner where one takes over from the other.
    """
    reach, most = closed / SEAL_MM, 1.0 - left / WIDEST_MM
    near = np.maximum(SEAL_ROUNDED - np.abs(reach - most), 0.0)
    seal = np.minimum(reach, most) - near * near * (0.25 / SEAL_ROUNDED)
    return np.asarray(np.clip(seal, 0.0, 1.0))


def gap_left(gap: Array, seal: Array) -> Array:
    """Return the mm that a seal leaves of a `gap` in mm, as the face shows it."""
    return np.maximum(np.minimum(gap - SEAL_MM * seal, WIDEST_MM * (1.0 - seal)), 0.0)


@dataclass(frozen=True, slots=True)
class _Sum:
    """A polynomial in several controls: `control` times `inner`, and `rest`."""

    control: str
    inner: _Sum | float
    rest: _Sum | float


def _value(polynomial: _Sum | float, controls: Mapping[str, Array]) -> Array | float:
    """Return the values of a polynomial for values of its controls, (n,) each."""
    if isinstance(polynomial, float):
        return polynomial
    value = controls[polynomial.control] * _value(polynomial.inner, controls)
    return value + _value(polynomial.rest, controls) if polynomial.rest else value


@lru_cache(maxsize=256)
def _plan(rig: LipRig, measure: str, control: str, others: frozenset[str]) -> tuple[_Sum | float, ...]:
    """Return the polynomials in `others` by which a measure depends on each power of a control."""
    names = [*CONTROLS, ""]
    variables = {control, *others} - {""}
    powers: list[dict[tuple[str, ...], float]] = [{} for _ in range(DEGREE + 1)]
    for term, factor in zip(rig.terms.tolist(), rig.coefficients[:, MEASURES.index(measure)], strict=True):
        factors = [names[i] for i in term if i != NONE]
        if factor != 0.0 and variables.issuperset(factors):
            remaining = tuple(name for name in factors if name != control)
            terms = powers[len(factors) - len(remaining)]
            terms[remaining] = terms.get(remaining, 0.0) + float(factor)
    return tuple(map(_nested, powers))


def _nested(terms: Mapping[tuple[str, ...], float]) -> _Sum | float:
    """Return a sum of products of controls with one multiplication a term: what most have is taken out."""
    counts = Counter(name for term in terms for name in set(term))
    if not counts:
        return terms.get((), 0.0)
    control = max(counts, key=lambda name: (counts[name], name))
    inner, outer = {}, {}
    for term, factor in terms.items():
        if control in term:
            place = term.index(control)
            inner[term[:place] + term[place + 1 :]] = factor
        else:
            outer[term] = factor
    return _Sum(control, _nested(inner), _nested(outer))


def solve(powers: Powers, values: Array) -> Array:
    """Return x in 0..1 with Σ powers[k] x^k = values over k >= 1, or the nearest end without a solution.

    Newton's method within a bracket, because a muscle beside a stronger one hardly moves anything at first.
    The solution for `values` 0 is exactly 0.
    """
    return _solved({"": (powers, values)})[""]


def _solved(equations: Mapping[str, _Equation]) -> dict[str, Array]:
    """Return the solutions of some equations by name: all at once, since most have few places to solve."""
    places = [np.flatnonzero(values) for _, values in equations.values()]
    ends = np.cumsum([0, *map(len, places)]).tolist()
    table = np.empty((DEGREE + 1, ends[-1]))
    parts = [slice(*ends[k : k + 2]) for k in range(len(places))]
    for (powers, values), place, part in zip(equations.values(), places, parts, strict=True):
        for row, column in zip(table, (values, *powers[1:]), strict=True):
            row[part] = column[place] if np.ndim(column) else column
    roots = _newton(*table)
    solutions = {}
    for (name, (_, values)), place, part in zip(equations.items(), places, parts, strict=True):
        solution = solutions[name] = np.zeros(len(values))
        solution[place] = roots[part]
    return solutions


def _slope(powers: Powers, x: Array) -> Array:
    """Return the derivative of Σ powers[k] x^k."""
    _, first, second, third = powers
    return np.asarray(first + x * (2.0 * second + 3.0 * x * third))


def _newton(values: Array, first: Array, second: Array, third: Array) -> Array:
    """Return the solutions of `solve` for `values` (n,), none of them 0."""
    if not len(values):
        return values
    # Decreasing polynomials are solved with their signs reversed.
    turned = np.where(first + second + third < 0.0, -1.0, 1.0)
    values, first, second, third = (part * turned for part in (values, first, second, third))
    twice, thrice = 2.0 * second, 3.0 * third
    low, high = np.zeros(len(values)), np.ones(len(values))
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.minimum(np.maximum(values / (first + second + third), 0.0), 1.0)
        solution, going_on = x, np.arange(len(values))
        for step in range(_STEPS):
            before = x
            missing = values - x * (first + x * (second + x * third))
            beyond = missing < 0.0
            low, high = np.where(beyond, low, x), np.where(beyond, x, high)
            newton = x + missing / (first + x * (twice + x * thrice))
            inside = (newton >= low) & (newton <= high)
            x = newton if inside.all() else np.where(inside, newton, 0.5 * (low + high))
            if step + 1 == _MOST_NEEDED:
                # Each by itself, so that no solution depends on which others are solved.
                solution, going_on = x, np.flatnonzero(np.abs(x - before) > _NEAR)
                if not len(going_on):
                    return solution
                state = (first, second, third, twice, thrice, values, low, high, x)
                first, second, third, twice, thrice, values, low, high, x = (part[going_on] for part in state)
    solution[going_on] = x
    return solution
