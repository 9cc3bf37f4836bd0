"""Plain text: one line to speak; words between asterisks are emphasised. Markdown is made plain first."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from ..core.choices import MARKDOWN
from ..core.directions import DirectedSpan, Directions, Emphasis
from ..core.speech.characters import HIDDEN, shown
from ..errors import Place, warn
from .markdown import LeftOut, is_markdown, without_marks
from .model import Script, SpokenLine, script_of
from .speakable import check_speakable, position
from .transcript import without_speakers, without_tags
from .tree import ScriptWarning

# Asterisks around words, as in "I like *this* one"; not "2 * 3 * 4".
_FOCUS = re.compile(r"(?<![\w*])\*([^\W_](?:[^*\n]*[\w.!?])?)\*(?![\w*])")
_STRONG = re.compile(r"(?<![\w*])\*\*([^\W_](?:[^*\n]*[\w.!?:%)])?)\*\*(?![\w*])")
_LEVELS = ((_STRONG, Emphasis.STRONG), (_FOCUS, Emphasis.MODERATE))
# Places of what is left out that a warning names.
_NAMED = 3


class TextForm(NamedTuple):
    """The form of a text: `format` Markdown, plain, or None: Markdown if two kinds of its marks occur.

    `keep_tags`: words in brackets that name a sound are spoken. `heard`: it is the transcript of a recording,
    where every tag, and the names of speakers, are no words.
    """

    format: str | None = None
    keep_tags: bool = False
    heard: bool = False

    def is_markdown(self, text: str) -> bool:
        """Tell whether a text is Markdown."""
        return is_markdown(text) if self.format is None else self.format == MARKDOWN


USUAL_FORM = TextForm()


def parse_plain(text: str, source: str = "text", form: TextForm = USUAL_FORM) -> Script:
    """Return the script that speaks `text`; raise InputError if that cannot be spoken.

    Warns (ScriptWarning) of what is left out of Markdown. Marks are hidden in the script's text, whose
    characters stay at their places.
    """
    check_speakable(text, source)
    written = text
    if form.is_markdown(text):
        plain = without_marks(text)
        _tell(plain.left_out, text, f"{source}: read as Markdown")
        text = plain.text
        check_speakable(text, source)
    text = _only_words(text, written, source, form)
    directions = read_focus(text, written, source)
    line = SpokenLine(without_asterisks(text), None, Place(source, 1, 1), directions=directions)
    return script_of((line,), timed=False, source=source)


def only_words(text: str, source: str, form: TextForm) -> str:
    """Return a text in which only words are left, as `parse_plain` reads it; warn of what is hidden.

    Raises InputError if no words are left.
    """
    if form.is_markdown(text):
        return parse_plain(text, source, form).text
    return _only_words(text, text, source, form)


def _only_words(text: str, written: str, source: str, form: TextForm) -> str:
    """Hide tags, in a transcript also the names of speakers; `written`: the text as in the source."""
    if form.keep_tags:
        return text
    plain = without_tags(text, known_only=not form.heard)
    left_out = plain.left_out
    if form.heard:
        plain = without_speakers(plain.text)
        left_out = (*left_out, *plain.left_out)
    if left_out:
        check_speakable(shown(plain.text), source)
        _tell(left_out, written, source)
    return plain.text


def parse_markdown(text: str, source: str = "text", form: TextForm = USUAL_FORM) -> Script:
    """Return the script that speaks Markdown, unless the `form` says that it is plain."""
    return parse_plain(text, source, form._replace(format=form.format or MARKDOWN))


def read_focus(text: str, written: str, source: str) -> Directions:
    """Return the emphasis of the `*words*` and `**words**` of a text, `written` so in the source."""
    spans = [
        DirectedSpan(m.start(1), m.end(1), position(source, written, m.start()), emphasis=level)
        for pattern, level in _LEVELS
        for m in pattern.finditer(text)
    ]
    return Directions(tuple(sorted(spans, key=lambda span: span.start)))


def without_asterisks(text: str) -> str:
    """Return a text whose marks of emphasis are hidden."""
    for pattern, _ in _LEVELS:
        text = pattern.sub(_hidden, text)
    return text


def _hidden(match: re.Match[str]) -> str:
    marks = HIDDEN * (match.start(1) - match.start())
    return f"{marks}{match[1]}{marks}"


def _tell(left_out: Sequence[LeftOut], text: str, source: str) -> None:
    """Warn, in one line, of what is left out."""
    if not left_out:
        return
    counts = Counter(part.name for part in left_out)
    first = {part.name: part.at for part in reversed(left_out)}
    named = [
        f"{name} (line {text.count(chr(10), 0, first[name]) + 1}{f', {count} times' if count > 1 else ''})"
        for name, count in list(counts.items())[:_NAMED]
    ]
    more = len(counts) - len(named)
    if more:
        named.append(f"{more} more {'kind' if more == 1 else 'kinds'}")
    joint = "; " if source.endswith("Markdown") else ": "
    warn(f"{source}{joint}left out: {', '.join(named)}", ScriptWarning)
