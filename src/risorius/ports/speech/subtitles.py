"""`.srt .vtt`: the words as subtitles. Lost: all but the words and their times.

A cue holds as many phrases of a sentence as fit in two lines; a phrase that is longer is divided between
words. A line has 42 characters at most, as broadcasters' guides to subtitles have it. Punctuation is that of
the text.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from xml.sax.saxutils import escape

from ...core.speech.utterance import Phrase, Utterance
from ...core.speech.written_words import written_words
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import write_lines
from .visemes import Cue, said

LINE, LINES = 42, 2
"""Characters of a line, and lines of a cue."""


def subtitles(utterance: Utterance) -> Iterator[Cue]:
    """Yield the cues in order; the shape of each is its text, in lines."""
    shown = written_words(utterance)
    for _, phrases in groupby(utterance.phrases, key=lambda phrase: phrase.sentence):
        for first, last in _divided(list(phrases), shown):
            words = utterance.words[first:last]
            yield Cue(words[0].start, words[-1].end, "\n".join(_wrapped(shown[first:last])))


def _divided(phrases: Sequence[Phrase], shown: Sequence[str]) -> Iterator[tuple[int, int]]:
    """Yield ranges of words that fill a cue each: whole phrases of a sentence if they fit."""
    first = last = phrases[0].first_word
    for phrase in phrases:
        if last > first and not _fits(shown[first : phrase.last_word]):
            yield first, last
            first = last
        for last in range(phrase.first_word + 1, phrase.last_word + 1):
            if not _fits(shown[first:last]):
                yield first, last - 1
                first = last - 1
        last = phrase.last_word
    yield first, last


def write_srt(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write SubRip's format; raise OutputError if nothing is said."""
    rows = enumerate(subtitles(said(take)), 1)
    write_lines(path, (f"{n}\n{_span(cue, ',')}\n{cue.shape}\n" for n, cue in rows))


def write_vtt(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write WebVTT (W3C); raise OutputError if nothing is said."""
    rows = [f"{_span(cue, '.')}\n{escape(cue.shape)}\n" for cue in subtitles(said(take))]
    write_lines(path, ["WEBVTT\n", *rows])


def _wrapped(words: Sequence[str]) -> list[str]:
    return textwrap.wrap(" ".join(words), LINE, break_long_words=False, break_on_hyphens=False)


def _fits(words: Sequence[str]) -> bool:
    return len(_wrapped(words)) <= LINES


def _span(cue: Cue, point: str) -> str:
    return f"{_clock(cue.start, point)} --> {_clock(cue.end, point)}"


def _clock(seconds: float, point: str) -> str:
    thousandths = round(1000.0 * seconds)
    hours, remainder = divmod(thousandths, 3_600_000)
    return f"{hours:02d}:{remainder // 60_000:02d}:{remainder // 1000 % 60:02d}{point}{remainder % 1000:03d}"


register(".srt", "subtitles (SubRip)", {"speech"}, write_srt)
register(".vtt", "subtitles (WebVTT)", {"speech"}, write_vtt)
