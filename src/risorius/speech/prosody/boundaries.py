"""Find the ends of phrases, and the tones with which they end."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.speech.tobi import UNKNOWN_BOUNDARY
from ...core.speech.utterance import Boundary, Utterance
from .contour import Contour
from .cues import Cues, vowel_of
from .rules import BoundaryOdds, probability, prosody_rules
from .running import SpeakerStatistics
from .runs import Run


class PhraseEnd(NamedTuple):
    """The tune at the end of a phrase, in semitones above the speaker's floor."""

    lowest: float
    last: float


def find_boundaries(
    utterance: Utterance, run: Run, cues: Cues, contour: Contour | None, speaker: SpeakerStatistics
) -> tuple[Boundary, ...]:
    """Return the ends of phrases in a run, in order.

    Silence after a word ends an intonational phrase, and so does the end of the utterance. Without silence a
    long last vowel and a new start of the pitch end an intermediate phrase. Without voice near the end its
    tones are unknown ("%").
    """
    rule = prosody_rules().boundary
    last_syllables = {utterance.syllables[index].word: index for index in run.syllables}
    boundaries: list[Boundary] = []
    for number in run.words:
        word = utterance.words[number]
        following = utterance.words[number + 1] if number + 1 < len(utterance.words) else None
        silence = following.start - word.end if following else np.inf
        sure = probability(4.0 * (silence - rule.pause) / rule.pause) if silence >= rule.pause else 0.0
        whole = sure >= rule.threshold
        index = last_syllables.get(number)
        if not whole and index is not None:
            length = cues.length[index - run.syllables.start] / speaker.lengthening.deviation
            sure = probability(
                rule.base + rule.lengthening * length + rule.reset * _reset(utterance, run, index, contour)
            )
        if sure < rule.threshold:
            continue
        label, certain = UNKNOWN_BOUNDARY, 1.0
        if index is not None and contour is not None:
            start = max(vowel_of(utterance.phones, utterance.syllables[index]).start, word.end - rule.window)
            if contour.is_voiced(start, word.end):
                label, certain = _tones(_ending(contour, start, word.end), contour, rule, whole)
        boundaries.append(Boundary(word.end, number, label, round(float(sure * certain), 3)))
    return tuple(boundaries)


def _reset(utterance: Utterance, run: Run, index: int, contour: Contour | None) -> float:
    """Return by how many semitones the pitch starts anew after a syllable of a run."""
    if contour is None or index + 1 not in run.syllables:
        return 0.0
    ours, next_ = (vowel_of(utterance.phones, s) for s in utterance.syllables[index : index + 2])
    return max(float(contour.at(next_.start) - contour.at(ours.end)), 0.0)


def _ending(contour: Contour, start: float, end: float) -> PhraseEnd:
    """Return the tune over the voiced frames at the end of [start, end]."""
    values = contour.within(start, end)
    voiced = np.flatnonzero(contour.voiced_within(start, end)[: len(values)])
    values = values[: int(voiced[-1]) + 1]
    return PhraseEnd(float(values.min()), float(values[-1]))


def _tones(ending: PhraseEnd, contour: Contour, rule: BoundaryOdds, whole: bool) -> tuple[str, float]:
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
