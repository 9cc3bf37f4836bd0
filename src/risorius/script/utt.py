"""Utterance files: paper B's input (section 5.1), as `docs/reference.md` gives its grammar.

The emotion and its intensity stand at the head; then each sentence with its phrases in brackets, their
accents and boundary tones, and its phonemes with their durations, as far as they are known.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

from ..core.directions import Break, DirectedSpan, Directions
from ..errors import InputError, ParameterError, Place, unknown
from .anchor import Anchor, Base, parse_number
from .dectalk import Dictated, read_phonemes
from .displays import display_mark
from .model import Mark, Script, SpokenLine, script_of
from .notation import Bracket, Item, Tune, Written, has_brackets, read_brackets, read_tune, write_out
from .quote import one_line, quoted
from .speakable import check_length, check_speakable

HEAD = ("emotion", "language", "answers")
BODY = ("text", "accents", "phonemes")
# Seconds of a pause whose duration is not given.
PAUSE = 0.2
_COMMENT = re.compile(r"\s#")
_EMOTION = re.compile(r"(?<![\w -])[^\W\d_][\w -]*+")


@dataclass(frozen=True, slots=True)
class _Entry:
    """A line `key: value`; `place` is the value's."""

    key: str
    value: str
    place: Place


@dataclass
class _Sentence:
    """A text with the entries below it."""

    text: _Entry
    rest: dict[str, _Entry] = field(default_factory=dict)


def parse_utterance(text: str, source: str = "text") -> Script:
    """Return the script of an utterance file.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected.
    """
    entries = list(_entries(text, source))
    head = [e for e in entries if e.key in HEAD]
    sentences = _sentences(entries)
    if not sentences:
        raise InputError("the script has no words; expected at least one line 'text: …'", Place(source, 1))
    language, question = _only(head, "language"), _only(head, "answers")
    line = _joined([_written(sentence) for sentence in sentences], sentences[0].text.place)
    check_length(len(line.text), line.place)
    if question is not None:
        check_speakable(question.value, question.place.file, question.place)
        line = replace(line, directions=replace(line.directions, answers=question.value))
    marks = tuple(chain.from_iterable(_display(entry) for entry in head if entry.key == "emotion"))
    code = language.value if language else None
    return script_of((line,), marks, timed=False, source=source, language=code)


def _entries(text: str, source: str) -> Iterator[_Entry]:
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        key, colon, rest = line.partition(":")
        indent = len(line) - len(line.lstrip())
        if not (colon and key.strip()) or "#" in key:
            shown = quoted(line.strip())
            message = f"{shown} is not a line of an utterance file; expected e.g. text: (JUlia prefers)"
            raise InputError(message, Place(source, number, indent + 1))
        if key.strip().lower() not in (*HEAD, *BODY):
            place = Place(source, number, indent + 1)
            raise ParameterError(unknown("key", one_line(key.strip()), (*HEAD, *BODY)), place)
        comment = _COMMENT.search(rest)
        value = rest[: comment.start()] if comment else rest
        column = len(key) + 2 + len(value) - len(value.lstrip())
        yield _Entry(key.strip().lower(), value.strip(), Place(source, number, column))


def _only(entries: Sequence[_Entry], key: str) -> _Entry | None:
    matching = [entry for entry in entries if entry.key == key]
    if len(matching) > 1:
        raise InputError(f"{key} is given twice; expected it once", matching[1].place)
    return matching[0] if matching else None


def _sentences(entries: Sequence[_Entry]) -> list[_Sentence]:
    sentences: list[_Sentence] = []
    for entry in entries:
        if entry.key in HEAD:
            if sentences:
                raise InputError(
                    f"{entry.key} comes after the text; expected it before the first text", entry.place
                )
        elif entry.key == "text":
            sentences.append(_Sentence(entry))
        elif not sentences:
            raise InputError(f"{entry.key} comes before the text; expected it after its text", entry.place)
        elif entry.key in sentences[-1].rest:
            raise InputError(f"{entry.key} is given twice; expected it once for a text", entry.place)
        else:
            sentences[-1].rest[entry.key] = entry
    return sentences


def _written(sentence: _Sentence) -> Written:
    entry = sentence.text
    check_speakable(entry.value, entry.place.file, entry.place)
    bracketed = has_brackets(entry.value)
    phrases = read_brackets(entry.value, entry.place) if bracketed else (_bare(entry),)
    tunes: list[Tune] = []
    if "accents" in sentence.rest:
        line = sentence.rest["accents"]
        tunes = [read_tune(bracket) for bracket in read_brackets(line.value, line.place)]
        if not tunes:
            raise InputError("no accents; expected e.g. (L+H* LH%) (H* LL%)", line.place)
    written = write_out(phrases, tunes)
    if "phonemes" not in sentence.rest:
        return written
    line = sentence.rest["phonemes"]
    return _dictated(written, read_brackets(line.value, line.place), line.place)


def _bare(entry: _Entry) -> Bracket:
    items = tuple(
        Item(m[0], Place(entry.place.file, entry.place.line, (entry.place.column or 1) + m.start()))
        for m in re.finditer(r"\S+", entry.value)
    )
    return Bracket(items, entry.place, "")


def _dictated(written: Written, brackets: Sequence[Bracket], place: Place) -> Written:
    """Return the text with its phonemes; those of each word in turn, `_` for a pause before the next."""
    if len(brackets) != len(written.words):
        message = f"{len(brackets)} brackets of phonemes for {len(written.words)} of words; expected one each"
        raise InputError(message, place)
    read = [[(item, read_phonemes(item)) for item in bracket.items] for bracket in brackets]
    for bracket, items, words in zip(brackets, read, written.words, strict=True):
        spoken = sum(not _is_pause(phones) for _, phones in items)
        if spoken != len(words):
            message = f"phonemes of {spoken} words for {len(words)} words; expected those of each"
            raise InputError(message, bracket.place)
    _check_timing([phone for items in read for _, phones in items for phone in phones], place)
    spans: list[DirectedSpan] = []
    breaks: list[Break] = []
    words = tuple(chain.from_iterable(written.words))
    for item, phones in chain.from_iterable(read):
        if _is_pause(phones):
            at = words[len(spans)][0] if len(spans) < len(words) else len(written.text)
            breaks.append(Break(at, sum(p.seconds or PAUSE for p in phones), item.place))
        else:
            seconds = tuple(p.seconds for p in phones if p.seconds is not None)
            spans.append(
                DirectedSpan(
                    *words[len(spans)], item.place, phones=tuple(p.symbol for p in phones), seconds=seconds
                )
            )
    marked = written.directions
    directions = Directions((*marked.spans, *spans), tuple(breaks), marked.accents, marked.boundaries)
    return replace(written, directions=directions)


def _is_pause(phones: Sequence[Dictated]) -> bool:
    return not any(phone.symbol for phone in phones)


def _check_timing(phones: Sequence[Dictated], place: Place) -> None:
    timed = sum(phone.seconds is not None for phone in phones if phone.symbol)
    spoken = sum(bool(phone.symbol) for phone in phones)
    if timed not in (0, spoken):
        raise InputError(
            f"{timed} of {spoken} phonemes have a duration; expected all of them, or none", place
        )


def _joined(sentences: Sequence[Written], place: Place) -> SpokenLine:
    """Return the sentences as one line."""
    text = ""
    directions = Directions()
    for written in sentences:
        text += " " if text else ""
        directions = directions.joined(written.directions.moved(len(text)))
        text += written.text
    return SpokenLine(text, None, place, directions=directions)


def _display(entry: _Entry) -> Iterator[Mark]:
    """Yield the displays, over the whole, that a line `emotion: happiness 0.7, surprise 0.2` asks for."""
    for part in re.finditer(r"[^,]+", entry.value):
        column = (entry.place.column or 1) + part.start() + len(part[0]) - len(part[0].lstrip())
        yield _mark(part[0], Place(entry.place.file, entry.place.line, column))


def _mark(written: str, place: Place) -> Mark:
    name, _, numbers = " ".join(written.split()).rpartition(" ")
    number, outdoes, level = numbers.partition("/")
    intensity, priority = parse_number(number), parse_number(level) if outdoes else None
    if not _EMOTION.fullmatch(name) or intensity is None or (outdoes and priority is None):
        raise InputError(
            f"{quoted(written.strip())} is not an emotion; expected e.g. happiness 0.7 or happiness 0.7/80",
            place,
        )
    start, end = Anchor(Base.START, 0.0, place=place), Anchor(Base.END, 0.0, place=place)
    return display_mark(name, intensity, (start, end), place, priority)
