"""What the figures of the documentation show: paper A's own figures, and what our combination adds to them.

Every curve and face comes from the code that performs; only the formulas that were printed wrong are written
here once more, as they were printed (`printed_alone`, `printed_overlap`), to be drawn beside ours.
Run from the repository, with the extra `docs` installed:
    python docs/figures.py [NAME …]     (all figures if none is named; they are written to docs/pictures)
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

from risorius import blend
from risorius.api import speak
from risorius.charts.paper_a import FIGURE_4 as FIGURE_4
from risorius.charts.paper_a import FIGURE_5 as FIGURE_5
from risorius.charts.paper_a import FIGURE_6, FUNNELER, ZYGOMATIC
from risorius.core.functions import ONSET_FUNCTIONS, exponential
from risorius.core.movement import Movement
from risorius.core.parameters import INDEX, parameters_named
from risorius.core.performance import Performance
from risorius.core.score import BlendSettings, Score
from risorius.pipeline import combine
from risorius.settings import BlendChoices, Settings
from risorius.take import Take

Array = npt.NDArray[np.float64]

ROOT = Path(__file__).parent.parent
PICTURES = ROOT / "docs" / "pictures"
POLICIES = ("inhibit", "graded", "attenuate", "sum")
FUNCTIONS = tuple(ONSET_FUNCTIONS)

PRESSER = "orbicularis_oris_presser"
RAISER = "levator_labii_superioris"


def display(start: float, end: float, onset: float, offset: float, value: float = 1.0) -> Movement:
    """Return a smile's Zygomatic Major as an emotion displays it; seconds."""
    return Movement("emotion", start, end, onset, offset, {ZYGOMATIC: value})


# Where the printed formulas break.
TO_NOTHING = (display(0.0, 5.0, 1.5, 2.0), replace(display(3.0, 9.0, 2.0, 2.0), targets={PRESSER: 0.5}))
LONG_RELEASE = (display(0.0, 6.0, 1.0, 3.0), display(4.0, 8.0, 0.3, 1.0, 0.4))
NESTED = (display(0.0, 8.0, 1.0, 2.0, 0.9), display(2.5, 4.5, 0.5, 0.6, 0.4))
TOO_SHORT = display(0.0, 3.0, 2.0, 3.0)
# One movement, and one that takes over before it is done.
FUNCTION_ALONE = display(0.0, 4.0, 1.2, 1.2)
FUNCTION_OVERLAP = (
    display(0.0, 3.0, 1.0, 1.0, 0.5),
    display(1.5, 4.0, 1.0, 1.0),
    display(3.0, 6.0, 1.0, 1.2, 0.3),
)

SMILING_SENTENCE = "It is easy to see you in the moonlight."
FINE = Fraction(200)
DEMONSTRATION = ROOT / "examples" / "demo.xml"


def curve(
    movements: Movement | Sequence[Movement], times: Array, parameter: str = ZYGOMATIC, **settings: object
) -> Array:
    """Return one parameter of a score of movements at times in seconds, shape (n,)."""
    given = (movements,) if isinstance(movements, Movement) else tuple(movements)
    end = max(m.end for m in given)
    score = Score(end, given, settings=BlendSettings(**settings))  # type: ignore[arg-type]
    return blend.at(score, times)[:, INDEX[parameter]]


def printed_alone(movement: Movement, times: Array) -> Array:
    """Return a movement by the four cases of section 4 as printed, the first that fits, shape (n,)."""
    onset_end, offset_start = movement.start + movement.onset, movement.end - movement.offset
    cases = (
        (times > movement.start) & (times < onset_end),
        (times >= onset_end) & (times <= offset_start),
        (times > offset_start) & (times < movement.end),
    )
    values = (
        exponential((times - movement.start) / movement.onset),
        np.ones(len(times)),
        exponential((movement.end - times) / movement.offset),
    )
    return np.asarray(movement.targets.get(ZYGOMATIC, 0.0) * np.select(cases, values, 0.0))


def printed_overlap(first: Movement, second: Movement, times: Array) -> Array:
    """Return two movements by section 5.2, case (2), as printed: a release to a lower target, shape (n,)."""
    level = printed_alone(first, np.array([second.start]))[0]
    target = second.targets.get(ZYGOMATIC, 0.0)
    xi = first.offset * (1.0 - np.log2(1.0 + level - target))
    since = times - second.start
    cases = (since <= 0.0, since < xi, since <= second.onset)
    release = level - target + exponential(since / first.offset)
    values = (printed_alone(first, times), release, np.full(len(times), target))
    return np.asarray(np.select(cases, values, printed_alone(second, times)))


def figure_6(times: Array) -> dict[str, tuple[Array, Array]]:
    """Return the Zygomatic Major and the Orbicularis Oris, before the combination and after it."""
    smile, speech = FIGURE_6
    return {
        "before": (curve(smile, times), curve(speech, times, FUNNELER)),
        "after": (curve(FIGURE_6, times), curve(FIGURE_6, times, FUNNELER)),
    }


def pressed_and_raised(presser: float, raiser: float, conflict: str) -> Take:
    """Return a face on which a signal presses the lips while an emotion raises the upper lip (Figure 3)."""
    lifted = {p.name: raiser for p in parameters_named(RAISER)}
    movements = (
        Movement("signals", 0.0, 1.0, 0.0, 0.0, {PRESSER: presser}),
        Movement("emotion", 0.0, 1.0, 0.0, 0.0, lifted),
    )
    return combine(
        Score(1.0, movements, settings=BlendSettings(conflict=conflict)), Settings(fps=Fraction(2))
    )


FACES = {
    "Lip Presser": (1.0, 0.0, "inhibit"),
    "Lip Raiser": (0.0, 1.0, "inhibit"),
    "their plain sum": (1.0, 1.0, "sum"),
    "ours (attenuate)": (1.0, 1.0, "attenuate"),
    "ours (inhibit)": (1.0, 1.0, "inhibit"),
}
"""Figure 3: how much the lips are pressed, how much the upper lip is raised, and the policy."""


@cache
def smiling(conflict: str) -> Take:
    """Return a sentence said with a full smile, combined by a policy, at 200 frames per second."""
    settings = Settings(fps=FINE, lively=False, blend=BlendChoices(conflict=conflict))
    return speak(SMILING_SENTENCE, text=True, emotion={"happiness": 1.0}, settings=settings)


@cache
def demonstration() -> Take:
    """Return paper A's demonstration (section 6, Figure 7), by its policy."""
    return speak(str(DEMONSTRATION), settings=Settings(blend=BlendChoices(conflict="inhibit")))


def finely(take: Take) -> Performance:
    """Return the curves of a take at 200 frames per second."""
    return combine(take.score, replace(take.settings, fps=FINE)).performance


def silent(take: Take) -> Performance:
    """Return the curves that a take would have if nothing were said, at 200 frames per second."""
    return combine(replace(take.score, lips=()), replace(take.settings, fps=FINE)).performance


def main(names: Sequence[str]) -> None:
    """Draw the figures of these names, or all."""
    from drawing import FIGURES

    PICTURES.mkdir(exist_ok=True)
    for name in names or FIGURES:
        if name not in FIGURES:
            raise SystemExit(f"no figure '{name}'; expected one of {', '.join(FIGURES)}")
        path = PICTURES / f"{name}.png"
        FIGURES[name](path)
        print(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1024} kB")


if __name__ == "__main__":
    main(sys.argv[1:])
