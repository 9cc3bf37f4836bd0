"""`.srt .vtt`: the words as subtitles. Lost: all but the words and their times.

A cue holds as many phrases of a sentence as fit in two lines; a phrase that is longer is divided between
words. A line has 42 characters at most, as broadcasters' guides to subtitles have it, of Chinese 16 and of
Japanese 13. Punctuation is that of the text.
"""

from __future__ import annotations

import re
import textwrap
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from xml.sax.saxutils import escape

from ...core.speech.utterance import Phrase, Utterance
from ...core.speech.written_words import written_parts
from ...languages.load import folder_of
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import write_lines
from .visemes import Cue, said

LINES = 2
"""Lines of a cue."""


@dataclass(frozen=True, slots=True)
class LineForm:
    """The form of a line: its `width` in characters, or if not `spaced`, in characters of full width."""

    width: int
    spaced: bool = True

    def wrapped(self, words: Sequence[str]) -> list[str]:
        """Return words in lines; only the blanks of the text stand between them."""
        if self.spaced:
            text = re.sub(r"\s+", " ", "".join(words).strip())
            return textwrap.wrap(text, self.width, break_long_words=False, break_on_hyphens=False)
        lines = [""]
        for word in words:
            if lines[-1].strip() and _full_width(lines[-1] + word.rstrip()) > self.width:
                lines.append("")
            lines[-1] += " ".join(re.split(r"\s+", word))
        return [line.strip() for line in lines if line.strip()]

    def fits(self, words: Sequence[str]) -> bool:
        """Tell whether words fill one cue at most."""
        return len(self.wrapped(words)) <= LINES


# Characters of a line, as guides of broadcasters and Netflix's guides for timed text have them.
SPACED = LineForm(42)
DENSE = {"cmn": LineForm(16, False), "yue": LineForm(16, False), "ja": LineForm(13, False)}


def subtitles(utterance: Utterance) -> Iterator[Cue]:
    """Yield the cues in order; the shape of each is its text, in lines."""
    form = DENSE.get(folder_of(utterance.language), SPACED)
    texts = _texts(utterance, form)
    for _, phrases in groupby(utterance.phrases, key=lambda phrase: phrase.sentence):
        for first, last in _divided(list(phrases), texts, form):
            words = utterance.words[first:last]
            yield Cue(words[0].start, words[-1].end, "\n".join(form.wrapped(texts[first:last])))


def _texts(utterance: Utterance, form: LineForm) -> list[str]:
    """Return the parts of the text that belong to each word, or words with a blank if they are not found."""
    parts = written_parts(utterance)
    words = [word.text for word in utterance.words]
    return [f"{word} " for word in words] if form.spaced and parts == words else parts


def _full_width(text: str) -> float:
    wide = sum(unicodedata.east_asian_width(char) in "WF" for char in text)
    return wide + 0.5 * (len(text) - wide)


def _divided(phrases: Sequence[Phrase], texts: Sequence[str], form: LineForm) -> Iterator[tuple[int, int]]:
    """Yield ranges of words that fill a cue each: whole phrases of a sentence if they fit."""
    first = last = phrases[0].first_word
    for phrase in phrases:
        if last > first and not form.fits(texts[first : phrase.last_word]):
            yield first, last
            first = last
        for last in range(phrase.first_word + 1, phrase.last_word + 1):
            if not form.fits(texts[first:last]):
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


def _span(cue: Cue, point: str) -> str:
    return f"{_clock(cue.start, point)} --> {_clock(cue.end, point)}"


def _clock(seconds: float, point: str) -> str:
    thousandths = round(1000.0 * seconds)
    hours, remainder = divmod(thousandths, 3_600_000)
    return f"{hours:02d}:{remainder // 60_000:02d}:{remainder // 1000 % 60:02d}{point}{remainder % 1000:03d}"


register(".srt", "subtitles (SubRip)", {"speech"}, write_srt)
register(".vtt", "subtitles (WebVTT)", {"speech"}, write_vtt)
