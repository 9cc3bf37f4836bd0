"""Words of a transcript that the recording does not bear out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import NamedTuple

from ...errors import InputError, SpeechWarning, warn
from .decoder import AlignedPhone
from .lexicon import ScriptWord


class ConfidenceLimits(NamedTuple):
    """Mean log likelihoods per 10 ms frame, in pocketsphinx's units: below `doubt` a word is doubtful, below
    `poor` it is poor. If more than WRONG_SHARE of the speech is poor or unmatched, the transcript is
    rejected as belonging to another recording.
    """

    doubt: float
    poor: float


# In 80 read sentences one word in a hundred was below -58, two below -40, and no sentence below -24; three in
# four of the words put in by mistake were below -54, and every sentence with another's transcript was below
# -49. Real silences were above -20.
OWN = ConfidenceLimits(-50.0, -38.0)
# Words of other languages, by the nearest phones, fit worse: in 12 sentences of six languages, in three
# timbres of espeak-ng each, the median of the words was -27 to -46 and the least -105; with another's
# transcript the median was -56 to -92. Human voices are not measured.
FOREIGN = ConfidenceLimits(-110.0, -52.0)
WRONG_SHARE = 0.6
# In a wrong transcript at least 45 words in 100 were in doubt, in the right one at most 17 (a third of
# TIMIT's development sentences). A synthetic voice may be poor in most words, and in doubt in one.
DOUBTFUL_SHARE = 0.25
# Silence so unlikely, and so long (seconds), is speech that the transcript lacks.
DOUBTFUL_SILENCE, LEAST_MISSING = -40.0, 0.15
_SHOWN = 8


@dataclass(frozen=True, slots=True)
class AlignmentConfidence:
    """The misfit of a transcript to its recording: that of the `worst` word or silence, 0 and more (its mean
    log likelihood per 10 ms, negated, as of English; 50 and more is in doubt), and the `words` in doubt with
    their times.
    """

    worst: float
    words: tuple[str, ...]


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


def check_words(words: Sequence[ScriptWord], aligned: Sequence[AlignedPhone]) -> None:
    """Raise InputError if the words as a whole do not fit; warn (SpeechWarning) of those that may not."""
    spans = _spans(len(words), aligned)
    limits = FOREIGN if any(word.own for word in words) else OWN
    doubtful = [index for index, span in enumerate(spans) if mean_score(span) < limits.doubt]
    missing = [
        f for f in aligned if f.word < 0 and f.score < DOUBTFUL_SILENCE and f.end - f.start >= LEAST_MISSING
    ]
    named = [f"'{words[i].word.text}' at {spans[i][0].start:.2f} s" for i in doubtful]
    receive = _receiver.get()
    if receive is not None:
        scores = [*map(mean_score, spans), *(f.score for f in missing)]
        worst = min(scores, default=0.0) * OWN.doubt / limits.doubt
        receive(AlignmentConfidence(max(0.0, -worst), tuple(named)))
    reasons = []
    if doubtful:
        reasons.append(
            f"perhaps not said in the recording ({len(doubtful)} of {len(words)} words): {_listed(named)}"
        )
    if missing:
        places = _listed([f"{f.start:.2f} to {f.end:.2f} s" for f in missing])
        reasons.append(f"said in the recording, but not in the transcript: {places}")
    wrong = _seconds(missing) + sum(_seconds(span) for span in spans if mean_score(span) < limits.poor)
    # A foreign word is hardly ever in doubt by itself: there the poor ones alone tell another's transcript.
    another = limits is FOREIGN or bool(missing) or len(doubtful) >= DOUBTFUL_SHARE * len(words)
    if another and wrong > WRONG_SHARE * (_seconds(missing) + sum(map(_seconds, spans))):
        raise InputError("; ".join(["the transcript does not fit the recording", *reasons]))
    for reason in reasons:
        warn(reason, SpeechWarning)


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
