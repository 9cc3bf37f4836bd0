"""Where phrases end, and the tones with which they do."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.tobi import UNKNOWN_BOUNDARY
from ...core.utterance import Boundary, Utterance
from .contour import Contour
from .cues import Cues, vowel_of
from .pitch import STEP
from .rules import BoundaryRule, probability, prosody_rules


class Ending(NamedTuple):
    """The tune at the end of a phrase, in semitones above the speaker's floor."""

    lowest: float
    last: float


def find_boundaries(utterance: Utterance, cues: Cues, contour: Contour | None) -> tuple[Boundary, ...]:
    """Return the ends of phrases, in order.

    Silence after a word ends an intonational phrase, and so does the end of the utterance. Without silence a
    long last vowel and a new start of the pitch end an intermediate phrase. Without voice near the end its
    tones are unknown ("%").
    """
    rule = prosody_rules().boundary
    last_syllables = {s.word: index for index, s in enumerate(utterance.syllables)}
    found: list[Boundary] = []
    for number, word in enumerate(utterance.words):
        following = utterance.words[number + 1] if number + 1 < len(utterance.words) else None
        silence = following.start - word.end if following else np.inf
        sure = probability(4.0 * (silence - rule.pause) / rule.pause) if silence >= rule.pause else 0.0
        whole = sure >= rule.threshold
        index = last_syllables.get(number)
        if not whole and index is not None:
            sure = _sureness(utterance, index, cues, contour, rule)
        if sure < rule.threshold:
            continue
        label, certain = UNKNOWN_BOUNDARY, 1.0
        if index is not None and contour is not None:
            start = max(vowel_of(utterance.phones, utterance.syllables[index]).start, word.end - rule.window)
            if contour.is_voiced(start, word.end):
                label, certain = _tones(_ending(contour, start, word.end), contour, rule, whole)
        found.append(Boundary(word.end, number, label, round(float(sure * certain), 3)))
    return tuple(found)


def _sureness(
    utterance: Utterance, index: int, cues: Cues, contour: Contour | None, rule: BoundaryRule
) -> float:
    """Return how likely a phrase is to end with a syllable that no silence follows, 0..1."""
    reset = 0.0
    if contour is not None and index + 1 < len(utterance.syllables):
        ours, next_ = (vowel_of(utterance.phones, s) for s in utterance.syllables[index : index + 2])
        reset = max(float(contour.at(next_.start) - contour.at(ours.end)), 0.0)
    spread = float(cues.length.std()) or 1.0
    return probability(rule.base + rule.lengthening * cues.length[index] / spread + rule.reset * reset)


def _ending(contour: Contour, start: float, end: float) -> Ending:
    """Return the tune over what is voiced at the end of [start, end]."""
    first = max(round(start / STEP), 0)
    values = contour.within(start, end)
    voiced = np.flatnonzero(contour.voiced[first : first + len(values)])
    values = values[: int(voiced[-1]) + 1]
    return Ending(float(values.min()), float(values[-1]))


def _tones(ending: Ending, contour: Contour, rule: BoundaryRule, whole: bool) -> tuple[str, float]:
    """Return a boundary's label, and how sure its tones are, 0..1.

    The phrase accent is what the pitch comes from, high or low; the boundary tone is where it goes.
    """
    rise = ending.last - ending.lowest
    high = contour.share(ending.lowest if rise >= rule.movement else ending.last) - rule.high_share
    sure = probability(abs(high) * contour.span)
    if not whole:
        return ("H-" if high >= 0.0 else "L-"), sure
    rises = rise - rule.movement
    sure *= probability(abs(rises))
    if rises >= 0.0:
        return ("H-H%" if high >= 0.0 else "L-H%"), sure
    return ("H-L%" if high >= 0.0 else "L-L%"), sure
