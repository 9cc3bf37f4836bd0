"""What `lips.py` measures: speech under a display, against the same speech and the same display alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields, replace
from functools import cache

import numpy as np

from risorius import blend, pipeline
from risorius.channels import ChannelInputs, Display, compose
from risorius.core.arrays import Array, BoolArray
from risorius.core.movement import LipSegment, Movement
from risorius.core.parameters import INDEX, PARAMETERS
from risorius.core.score import Score
from risorius.face.contact.mouth import Mouth
from risorius.face.fit.lip_file import load_lip_rig
from risorius.face.fit.measure import Gauge
from risorius.face.frame import FaceFrame
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

FPS = 100
EMOTIONS = ("anger", "disgust", "fear", "happiness", "sadness", "surprise")
SMILE = "smile"
DISPLAYS = (*EMOTIONS, SMILE)
"""The six emotions at full strength, and a full smile by itself: 01 and 02."""
CLOSED_MM = 0.5
TOUCHING_MM = 0.5
WIDENED_MM = 1.0  # a display that changes the mouth's width less says nothing about how much is kept
ROUNDED = ("W", "UW", "AO", "OW")
SIBILANTS = ("S", "Z", "SH", "ZH", "CH", "JH")
UPPER_FACE = [i for i, p in enumerate(PARAMETERS) if p.group in ("brows", "lids")]
COLUMNS = ("gap", "width", "protrusion", "jaw")


class Machine:
    """The standard head, measured in mm."""

    def __init__(self) -> None:
        self.head = load_head()
        self._solver, self._gauge = FaceSolver(self.head), Gauge(self.head)
        self._lower = Mouth.of(self.head).lip(False)

    def mouth(self, values: Array) -> Array:
        """Return gap, width, protrusion and jaw drop (n, 4) for values (n, 46)."""
        return np.array([self._mouth(self._solver.solve(row)) for row in values]).reshape(-1, len(COLUMNS))

    def _mouth(self, frame: FaceFrame) -> tuple[float, ...]:
        found = self._gauge.measure(frame)
        return found.lip_gap_mm, found.mouth_width_mm, found.lip_protrusion_mm, found.jaw_drop_mm

    def from_teeth(self, values: Array) -> float:
        """Return how far the lower lip's middle is from the upper teeth's edge."""
        skin = self._solver.solve(values).skin[self._lower].astype(np.float64)
        teeth = self.head.teeth_upper.vertices
        edge = teeth[(np.abs(teeth[:, 0]) < 5.0) & (teeth[:, 1] < teeth[:, 1].min() + 2.0)]
        lip = skin[np.abs(skin[:, 0]) < 5.0]
        return float(np.linalg.norm(lip[:, None] - edge, axis=2).min())


@cache
def machine() -> Machine:
    """Return the one machine."""
    return Machine()


@dataclass
class Spoken:
    """One sentence: its score without any display, and what the mouth does, at 100 fps."""

    score: Score
    times: Array
    values: Array
    mouth: Array
    speaking: BoolArray

    @classmethod
    def of(cls, sentence: str, settings: Settings) -> Spoken:
        """Say a sentence and measure it."""
        script = read_script(sentence, text=True)
        utterance = synthesize_script(script, language=settings.language, rate=settings.rate)
        score = pipeline.compose(script, utterance, (), settings)
        times = np.arange(0.0, score.duration, 1.0 / FPS)
        values = blend.at(score, times, load_lip_rig())
        spoken = [(p.start, p.end) for p in utterance.phones if p.symbol]
        speaking = (times >= spoken[0][0]) & (times < spoken[-1][1])
        return cls(score, times, values, machine().mouth(values), speaking)

    def middles(self, phones: Iterable[str]) -> Array:
        """Return the middles of some phones' segments, of a diphthong's the last, shape (m,)."""
        segments = [s for s in self.score.lips if s.phone in phones]
        found = [s for s, b in zip(segments, [*segments[1:], None], strict=False) if not _continues(s, b)]
        return np.array([_middle(s) for s in found])

    def contacts(self, contact: str) -> Array:
        """Return the middles of the segments that ask for a contact, shape (m,)."""
        return np.array([_middle(s) for s in self.score.lips if s.targets.get(contact, 0.0) > 0.0])

    def shown(self, display: str, speaks: bool = True) -> Score:
        """Return the score with a display at full strength over all of it, with the speech or without."""
        movements = tuple(_movements(display, self.score.duration))
        return replace(self.score, movements=movements, lips=self.score.lips if speaks else ())


def _continues(segment: LipSegment, after: LipSegment | None) -> bool:
    return after is not None and after.phone == segment.phone and after.start == segment.end


def _middle(segment: LipSegment) -> float:
    return (segment.start + segment.end) / 2.0


def _movements(display: str, duration: float) -> Iterator[Movement]:
    if display == SMILE:
        names = [p.name for p in PARAMETERS if p.base in ("zygomatic_major", "zygomatic_minor")]
        yield Movement("emotion", 0.0, duration, 0.3, 0.3, dict.fromkeys(names, 1.0))
        return
    yield from compose(ChannelInputs(duration, emotions=(Display(display, 1.0),), lively=False)).movements


@dataclass
class Result:
    """Sums over sentences; `*_mm` in millimetres."""

    closures: int = 0
    closed: int = 0
    widest_mm: float = 0.0
    tucks: int = 0
    touching: int = 0
    deviation: list[float] = field(default_factory=list)
    correlation: list[float] = field(default_factory=list)
    narrower_mm: list[float] = field(default_factory=list)
    further_mm: list[float] = field(default_factory=list)
    sibilant_jaw_mm: list[float] = field(default_factory=list)
    widened_mm: list[float] = field(default_factory=list)
    widened_silent_mm: list[float] = field(default_factory=list)
    upper_kept: list[float] = field(default_factory=list)
    upper_whole: list[float] = field(default_factory=list)

    def add(self, other: Result) -> None:
        """Add another result to this one."""
        for name in (f.name for f in fields(self)):
            mine, more = getattr(self, name), getattr(other, name)
            setattr(self, name, max(mine, more) if name == "widest_mm" else mine + more)


def measure(spoken: Spoken, display: str) -> Result:
    """Return what a display does to a sentence."""
    rig = load_lip_rig()
    both = blend.Plan(spoken.shown(display), rig)
    silent = blend.at(spoken.shown(display, speaks=False), spoken.times)
    values, result = both.at(spoken.times), Result()
    mouth = machine().mouth(values)
    _touch(result, spoken, both)
    talk = spoken.speaking
    neutral, shown = spoken.mouth[talk, 0], mouth[talk, 0]
    result.deviation.append(float(shown.std() / neutral.std()))
    result.correlation.append(float(np.corrcoef(shown, neutral)[0, 1]))
    # A display is still between its onset and its offset: one frame of it is as good as all.
    held = machine().mouth(silent[len(silent) // 2 : len(silent) // 2 + 1])[0]
    rest = machine().mouth(np.where(np.arange(len(PARAMETERS)) == INDEX["gaze_distance"], 0.8, 0.0)[None])[0]
    rounded = machine().mouth(both.at(spoken.middles(ROUNDED)))
    result.narrower_mm += (held[1] - rounded[:, 1]).tolist()
    result.further_mm += (rounded[:, 2] - held[2]).tolist()
    result.sibilant_jaw_mm += machine().mouth(both.at(spoken.middles(SIBILANTS)))[:, 3].tolist()
    # What the jaw takes from the width goes with it: the jaw is speech's, and its gap is measured above.
    shut = silent[len(silent) // 2 : len(silent) // 2 + 1].copy()
    shut[:, INDEX["masseter"]] = 0.0
    widened = machine().mouth(shut)[0, 1] - rest[1]
    if abs(widened) > WIDENED_MM:
        result.widened_mm.append(float((mouth[talk, 1] - spoken.mouth[talk, 1]).mean()))
        result.widened_silent_mm.append(float(widened))
    result.upper_kept.append(float(np.minimum(values, silent)[np.ix_(talk, UPPER_FACE)].sum()))
    result.upper_whole.append(float(silent[np.ix_(talk, UPPER_FACE)].sum()))
    return result


def _touch(result: Result, spoken: Spoken, both: blend.Plan) -> None:
    gaps = machine().mouth(both.at(spoken.contacts("lip_seal")))[:, 0]
    result.closures += len(gaps)
    result.closed += int((gaps <= CLOSED_MM).sum())
    result.widest_mm = max(result.widest_mm, float(gaps.max(initial=0.0)))
    times = spoken.contacts("lip_tuck")
    alone = blend.at(spoken.score, times, load_lip_rig())
    for row, plain in zip(both.at(times), alone, strict=True):
        result.tucks += 1
        result.touching += machine().from_teeth(row) <= machine().from_teeth(_tucked(plain)) + TOUCHING_MM


def _tucked(values: Array) -> Array:
    """Return values with the lip fully at the teeth."""
    full = values.copy()
    full[INDEX["lip_tuck"]], full[INDEX["lip_seal"]] = 1.0, 0.0
    return full
