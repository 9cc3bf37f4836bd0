"""Pitch accents from the sound: where they are, of which type, and how sure that is."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from ...core.speech.tobi import UNKNOWN_ACCENT
from ...core.speech.utterance import Accent, Phone, Utterance
from ...languages import Language, language_of
from ..structure.accents import PRIMARY
from .contour import Contour
from .cues import Cues, vowel_of
from .pitch import STEP
from .rules import TypeRule, probability, prosody_rules
from .runs import Run

# Semitones by which a shape must pass a rule's threshold for its label to be twice as likely as not.
_MARGIN = 1.0
_FALLING_FROM_HIGH, _HIGH = "H+!H*", ("H*", "L+H*", "!H*", "L+!H*", "H+!H*")


class Shape(NamedTuple):
    """The tune on a vowel and around it, in semitones above the speaker's floor.

    `peak` is the highest value on the vowel or shortly after, at `time`, `valley` the lowest before it and
    `fallen` the lowest after it. `dip` is the vowel's lowest; `before` and `after` are the highest values on
    both sides of the dip. `begun`: the mean of the vowel's first half.
    """

    time: float
    peak: float
    valley: float
    fallen: float
    dip: float
    before: float
    after: float
    begun: float

    @property
    def rise(self) -> float:
        """Semitones up to the peak."""
        return self.peak - self.valley

    @property
    def depth(self) -> float:
        """Semitones by which the dip lies below both sides."""
        return min(self.before, self.after) - self.dip

    @property
    def excursion(self) -> float:
        """Semitones by which peak or dip stand out on both sides."""
        return max(min(self.rise, self.peak - self.fallen), self.depth, 0.0)


def find_accents(
    utterance: Utterance, run: Run, cues: Cues, contour: Contour | None, last_words: Collection[int]
) -> tuple[Accent, ...]:
    """Return the accents of a run in order, whose phrases end with some of `last_words`.

    Candidates are the syllables with primary stress, and all of words of one syllable. Without voice their
    type is unknown ("*").
    """
    accents: list[Accent] = []
    kind = prosody_rules().type_
    language = language_of(utterance.language)
    previous: tuple[int, float] | None = None
    for index in run.syllables:
        syllable = utterance.syllables[index]
        if previous is not None and any(previous[0] <= word < syllable.word for word in last_words):
            previous = None
        vowel = vowel_of(utterance.phones, syllable)
        voiced = contour is not None and contour.is_voiced(vowel.start, vowel.end)
        shape = shape_of(vowel, contour, kind) if contour is not None and voiced else None
        sure = _sureness(utterance, language, index, cues.prominence[index - run.syllables.start], shape)
        if sure < prosody_rules().accent.threshold:
            continue
        label, certain, time = UNKNOWN_ACCENT, 1.0, 0.5 * (vowel.start + vowel.end)
        if shape is not None and contour is not None:
            ends = syllable.word in last_words and utterance.words[syllable.word].end == syllable.end
            label, certain = _type(shape, contour, kind, previous[1] if previous else None, ends)
            time = min(max(shape.time, vowel.start), vowel.end) if label in _HIGH else time
            previous = (syllable.word, shape.peak) if label in _HIGH else previous
        accents.append(Accent(time, syllable.word, index, label, confidence=round(sure * certain, 3)))
    return tuple(accents)


def shape_of(vowel: Phone, contour: Contour, kind: TypeRule) -> Shape:
    """Return the tune around a vowel."""
    on = contour.within(vowel.start, vowel.end + kind.late_peak)
    at = int(on.argmax())
    time = vowel.start + at * STEP
    inside = contour.within(vowel.start, vowel.end)
    low = vowel.start + int(inside.argmin()) * STEP
    return Shape(
        time=time,
        peak=float(on[at]),
        valley=float(contour.within(vowel.start - kind.before, time).min()),
        fallen=float(contour.within(time, vowel.end + kind.after).min()),
        dip=float(inside.min()),
        before=float(contour.within(vowel.start - kind.before, low).max()),
        after=float(contour.within(low, vowel.end + kind.after).max()),
        begun=float(contour.within(vowel.start, 0.5 * (vowel.start + vowel.end)).mean()),
    )


def _sureness(
    utterance: Utterance, language: Language, index: int, prominence: float, shape: Shape | None
) -> float:
    """Return how likely a syllable is to be accented, 0..1."""
    rule = prosody_rules().accent
    syllable = utterance.syllables[index]
    word = utterance.words[syllable.word]
    alone = all(
        s.word != syllable.word
        for s in utterance.syllables[max(index - 1, 0) : index + 2]
        if s is not syllable
    )
    if syllable.stress < PRIMARY and not alone:
        return 0.0
    excursion = shape.excursion if shape else 0.0
    counted = min(excursion, rule.largest_excursion) if excursion >= rule.least_excursion else 0.0
    content = not language.is_function_word(word.text)
    stressed = syllable.stress >= PRIMARY and content
    # Its low pitch does not speak against a valley.
    hollow = shape is not None and shape.depth >= prosody_rules().type_.valley
    standing = max(prominence, 0.0) if hollow else prominence
    odds = rule.base + rule.content * stressed + rule.prominence * standing
    return probability(odds + rule.excursion * counted)


def _type(
    shape: Shape, contour: Contour, kind: TypeRule, previous: float | None, ends: bool
) -> tuple[str, float]:
    """Return an accent's label, and how sure its type is, 0..1.

    `previous`: the phrase's peak before it. `ends`: it is on the phrase's last syllable, so that a rise after
    it is the boundary's.
    """
    flat = shape.begun - shape.dip <= kind.valley_flat
    if flat and shape.depth >= kind.valley and contour.share(shape.dip) <= kind.valley_share:
        scoop = shape.after - shape.dip - kind.scooped_rise
        scooped = scoop >= 0.0 and not ends
        return ("L*+H" if scooped else "L*"), _certainty(min(shape.depth - kind.valley, abs(scoop)))
    lower = 0.0 if previous is None else previous - shape.peak
    stepped = lower >= kind.downstep
    drop = shape.before - shape.peak
    if drop >= kind.high_before:
        return _FALLING_FROM_HIGH, _certainty(drop - kind.high_before)
    steep = shape.rise - kind.steep_rise
    if steep >= 0.0 and contour.share(shape.valley) <= kind.low_share:
        return ("L+!H*" if stepped else "L+H*"), _certainty(steep)
    return ("!H*" if stepped else "H*"), _certainty(min(abs(steep), abs(lower - kind.downstep)))


def _certainty(margin: float) -> float:
    """Return 0.5 at a threshold, nearing 1 with semitones of distance from it."""
    return probability(margin / _MARGIN)
