"""Words of a transcript that the recording does not bear out."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

from ...errors import InputError
from ..engine import SpeechWarning
from .decoder import Found
from .lexicon import ScriptWord

# Mean log likelihood per 10 ms frame (pocketsphinx's units). Of 80 read sentences the worst word in a hundred
# had -55 and the worst sentence -30; half of the words put in by mistake had less than -70, and no sentence with
# another's transcript more than -47.
DOUBTFUL_WORD = -55.0
WRONG_TRANSCRIPT = -38.0
_SHOWN = 8


def check_words(words: Sequence[ScriptWord], found: Sequence[Found]) -> None:
    """Raise InputError if the words as a whole do not fit; warn (SpeechWarning) of those that may not."""
    spans = _spans(len(words), found)
    lengths = [sum(f.end - f.start for f in span) for span in spans]
    scores = [
        sum(f.score * (f.end - f.start) for f in span) / n for span, n in zip(spans, lengths, strict=True)
    ]
    doubtful = [index for index, score in enumerate(scores) if score < DOUBTFUL_WORD]
    mean = sum(s * n for s, n in zip(scores, lengths, strict=True)) / sum(lengths)
    named = ", ".join(f"'{words[i].word.text}' at {spans[i][0].start:.2f} s" for i in doubtful[:_SHOWN]) + (
        f" and {len(doubtful) - _SHOWN} more" if len(doubtful) > _SHOWN else ""
    )
    if mean < WRONG_TRANSCRIPT:
        raise InputError(
            f"the transcript does not fit the recording; {len(doubtful)} of {len(words)} words are in doubt: {named}"
        )
    if doubtful:
        warnings.warn(f"not sure to be said in the recording: {named}", SpeechWarning, stacklevel=3)


def _spans(count: int, found: Sequence[Found]) -> list[list[Found]]:
    spans: list[list[Found]] = [[] for _ in range(count)]
    for phone in found:
        if phone.word >= 0:
            spans[phone.word].append(phone)
    return spans
