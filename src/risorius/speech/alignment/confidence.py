"""Words of a transcript that the recording does not bear out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from math import inf
from statistics import median
from typing import NamedTuple

from ...errors import InputError, SpeechWarning, warn
from .decoder import AlignedPhone
from .lexicon import ScriptWord


class ConfidenceLimits(NamedTuple):
    """A word is doubtful if it fits worse than the recording's words do by more than `doubt`, or worse than
    `hopeless`, by what is known of it. If the words' mean is below `wrong`, or more than POOR_SHARE of the
    speech below `poor`, the transcript is rejected as belonging to another recording; so it is if the mean is
    below `lonely` and most of the speech has no words. All are log likelihoods per 10 ms frame, in
    pocketsphinx's units.
    """

    doubt: float
    hopeless: float
    poor: float
    wrong: float
    lonely: float


# In 192 right transcripts (TIMIT's development sentences, hibari's and espeak-ng's voices), each with 0 and
# 6 s of silence or noise before it, the words' mean was never below -39, in as many wrong ones never above
# -47, and 4 said words in 1,000 were in doubt; of words put in by mistake three in four were. Real silences
# were above -22, speech that the transcript lacks was mostly below -30.
OWN = ConfidenceLimits(24.0, -52.0, -inf, -46.0, -30.0)
# Words of other languages, by the nearest phones, fit worse: in 12 sentences of six languages, in three
# timbres of espeak-ng each, the median of the words was -27 to -46 and the least -105; with another's
# transcript the median was -56 to -92. Human voices are not measured.
FOREIGN = ConfidenceLimits(48.0, -110.0, -52.0, -inf, -52.0)
POOR_SHARE = 0.6
# A word is compared with the recording's median word, as if three more of USUAL were in it, and less the
# shorter it is: a few frames tell little. A word of EVEN seconds counts half.
USUAL, USUAL_WORDS, EVEN = -25.0, 3, 0.15
# A word that is not said is pressed between its neighbours or past the end, where its phones last as few
# frames as the model has; each such phone adds PRESSED to its misfit, of which PRESSED_LIMIT is then in
# doubt. A said word that the transcript lacks is taken by a phone beside it, which then is long and fits
# badly. In 959 words of right transcripts these two doubt 2 that likelihood alone does not; of 550
# transcripts with a word put in, left out or replaced, 37 pass without a warning, by likelihood alone 64.
LEAST_FRAMES, LEAST_MEAN, PRESSED, PRESSED_LIMIT = 0.0305, 0.029, 0.1, 1.1
LONG_PHONE, LONG_DOUBT, LONG_EVEN = 0.25, 14.0, 0.08
# Silence so unlikely, and so long (seconds), is speech that the transcript lacks; a greater share of the
# speech than the third is most of it.
DOUBTFUL_SILENCE, LEAST_MISSING, MOST_MISSING = -28.0, 0.15, 0.6
# A few words fit somewhere: for each word above FEW_WORDS the limit for `lonely` ones is lower.
FEW_WORDS, PER_WORD = 4, 2.5
# Seconds of such speech beside which a few words may be misplaced.
LONG_MISSING = 0.5
_ROUNDING = 1e-6
_SHOWN = 8


@dataclass(frozen=True, slots=True)
class AlignmentConfidence:
    """The misfit of a transcript to its recording: that of the `worst` word or silence (0 and more; 50 and
    more is in doubt), and the `words` in doubt with their times.
    """

    worst: float
    words: tuple[str, ...]


# From here on `AlignmentConfidence.worst` is in doubt.
DOUBT = 50.0
_receiver: ContextVar[Callable[[AlignmentConfidence], None] | None] = ContextVar(
    "receiver of doubt", default=None
)


@contextmanager
def receive_confidence(receive: Callable[[AlignmentConfidence], None]) -> Iterator[None]:
    """Call `receive` with the doubt about each recording that is aligned in the block, in this thread."""
    token = _receiver.set(receive)
    try:
        yield
    finally:
        _receiver.reset(token)


def check_words(
    words: Sequence[ScriptWord],
    aligned: Sequence[AlignedPhone],
    time: Callable[[float], float] = lambda seconds: seconds,
    left_out: Sequence[tuple[float, float]] = (),
) -> None:
    """Raise InputError if the words as a whole do not fit; warn (SpeechWarning) of those that may not.

    `time` returns what time is told for one of `aligned`. `left_out`: stretches that sound and have no words.
    """
    spans = _spans(len(words), aligned)
    limits = FOREIGN if any(word.own for word in words) else OWN
    misfits = word_misfits(spans, limits)
    missing = [
        f for f in aligned if f.word < 0 and f.score < DOUBTFUL_SILENCE and f.end - f.start >= LEAST_MISSING
    ]
    lonely = _beyond(spans, missing) if left_out else set[int]()
    doubtful = [index for index, misfit in enumerate(misfits) if misfit > 1.0 or index in lonely]
    named = [f"'{words[i].word.text}' at {time(spans[i][0].start):.2f} s" for i in doubtful]
    receive = _receiver.get()
    if receive is not None:
        worst = max(0.0, *misfits, *(f.score / DOUBTFUL_SILENCE for f in missing))
        receive(AlignmentConfidence(DOUBT * worst, tuple(named)))
    reasons = []
    if doubtful:
        reasons.append(
            f"perhaps not said in the recording ({len(doubtful)} of {len(words)} words): {_listed(named)}"
        )
    if missing:
        places = _listed([f"{time(f.start):.2f} to {time(f.end):.2f} s" for f in missing])
        reasons.append(f"said in the recording, but not in the transcript: {places}")
    if left_out:
        places = _listed([f"{start:.2f} to {end:.2f} s" for start, end in left_out])
        reasons.append(f"heard in the recording, but not in the transcript: {places}")
    without_words = _seconds(missing) + sum(end - start for start, end in left_out)
    if _is_anothers(spans, without_words, limits):
        raise InputError("; ".join(["the transcript does not fit the recording", *reasons]))
    for reason in reasons:
        warn(reason, SpeechWarning)


def word_misfits(spans: Sequence[Sequence[AlignedPhone]], limits: ConfidenceLimits = OWN) -> list[float]:
    """Return how badly each word fits, by what is known of it; above 1 it is in doubt."""
    scores = [*map(mean_score, spans)]
    usual = median([*scores, *[USUAL] * USUAL_WORDS])
    known = [length / (length + EVEN) for length in map(_seconds, spans)]
    misfits = [
        max((usual - score) * share / limits.doubt, (score * share + USUAL * (1.0 - share)) / limits.hopeless)
        for score, share in zip(scores, known, strict=True)
    ]
    if limits is not OWN:  # not measured
        return misfits
    return [
        max(misfit, _pressed(span, misfit), _stretched(span, usual))
        for span, misfit in zip(spans, misfits, strict=True)
    ]


def _pressed(span: Sequence[AlignedPhone], misfit: float) -> float:
    """Return how badly a word of this `misfit` fits if the lengths of its phones count, too."""
    shortest = sum(phone.end - phone.start <= LEAST_FRAMES for phone in span)
    return max(
        (misfit + PRESSED * shortest) / PRESSED_LIMIT, LEAST_MEAN * len(span) / max(_seconds(span), 1e-9)
    )


def _stretched(span: Sequence[AlignedPhone], usual: float) -> float:
    """Return how badly the worst long phone of a word fits."""
    long = [(phone, phone.end - phone.start) for phone in span if phone.end - phone.start > LONG_PHONE]
    return max(((usual - f.score) * s / (s + LONG_EVEN) / LONG_DOUBT for f, s in long), default=0.0)


def _beyond(spans: Sequence[Sequence[AlignedPhone]], missing: Sequence[AlignedPhone]) -> set[int]:
    """Return the few words before the first, or after the last, stretch of speech that has no words.

    Beside music they may be in it.
    """
    long = [silence for silence in missing if silence.end - silence.start >= LONG_MISSING]
    if not long:
        return set()
    before = {k for k, span in enumerate(spans) if span[-1].end <= long[0].start + _ROUNDING}
    after = {k for k, span in enumerate(spans) if span[0].start >= long[-1].end - _ROUNDING}
    return set[int]().union(*(few for few in (before, after) if len(few) <= FEW_WORDS))


def _is_anothers(spans: Sequence[Sequence[AlignedPhone]], missing: float, limits: ConfidenceLimits) -> bool:
    """Tell whether the words are another recording's, in which `missing` seconds of speech are not theirs."""
    speech = sum(map(_seconds, spans))
    poor = sum(_seconds(span) for span in spans if mean_score(span) < limits.poor)
    lonely = max(limits.wrong, limits.lonely - PER_WORD * max(len(spans) - FEW_WORDS, 0))
    wrong = lonely if missing > MOST_MISSING * (speech + missing) else limits.wrong
    return mean_score([f for span in spans for f in span]) < wrong or poor > POOR_SHARE * speech


def words_score(aligned: Sequence[AlignedPhone]) -> float:
    """Return the mean log likelihood per frame of all words."""
    return mean_score([f for f in aligned if f.word >= 0])


def mean_score(aligned: Sequence[AlignedPhone]) -> float:
    """Return the mean log likelihood per frame, 0 for nothing."""
    seconds = _seconds(aligned)
    if seconds <= 0.0:
        return 0.0
    return sum(f.score * (f.end - f.start) for f in aligned) / seconds


def _seconds(aligned: Sequence[AlignedPhone]) -> float:
    return sum(f.end - f.start for f in aligned)


def _listed(items: Sequence[str]) -> str:
    more = f" and {len(items) - _SHOWN} more" if len(items) > _SHOWN else ""
    return ", ".join(items[:_SHOWN]) + more


def _spans(count: int, aligned: Sequence[AlignedPhone]) -> list[list[AlignedPhone]]:
    spans: list[list[AlignedPhone]] = [[] for _ in range(count)]
    for phone in aligned:
        if phone.word >= 0:
            spans[phone.word].append(phone)
    return spans
