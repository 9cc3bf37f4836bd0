"""Paper A's markup (section 2): spoken lines and shown marks, each element with its time.

A script need not say anything: a listener, or a smile in silence, lasts as long as `duration` or a mark says.
"""

from __future__ import annotations

from dataclasses import replace

from ..core.units import MAX_SECONDS
from ..errors import InputError, Place
from .anchor import Base
from .apart import check_apart
from .attributes import Attributes
from .elements import CONTAINER, EXAMPLE, Attribute, read_elements, unknown_element
from .marks import ELEMENTS, marks_of
from .model import Mark, Script, SpokenLine, script_of
from .notation import read_brackets, read_tune, write_out
from .quote import one_line
from .speakable import check_length, check_speakable

SPOKEN = "PHONEME"
KNOWN = (SPOKEN, *ELEMENTS, CONTAINER)


def parse_markup(text: str, source: str = "text") -> Script:
    """Return the script of a markup document.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected.
    """
    lines: list[SpokenLine] = []
    latest: float | None = None
    marks: list[Mark] = []
    language: str | None = None
    duration: float | None = None
    for element in read_elements(text, source, KNOWN):
        attributes = Attributes(element)
        if element.name == SPOKEN:
            lines.append(_line(attributes, latest))
            latest = latest if lines[-1].start is None else lines[-1].start
        elif element.name in ELEMENTS:
            marks.extend(marks_of(attributes))
        elif element.name == CONTAINER:
            duration = max(duration or 0.0, attributes.duration("duration") or 0.0) or None
            language = _language(attributes, language)
        else:
            raise unknown_element(element, KNOWN)
    _check_length(lines, marks, duration, source)
    check_apart((mark, mark.start) for mark in marks)
    script = script_of(tuple(lines), tuple(marks), timed=True, source=source, language=language)
    return replace(script, duration=duration or 0.0)


def _line(attributes: Attributes, latest: float | None) -> SpokenLine:
    """Return the line of a PHONEME; its time, if given, comes after `latest`, that of the lines before."""
    start, text = attributes.number("time", 0.0, MAX_SECONDS), attributes.take("text")
    accents = attributes.take("accents")
    attributes.finish()
    if text is None:
        raise attributes.error('text is missing; expected e.g. text="Hello."')
    check_speakable(text.value, text.place.file, text.place)
    if start is not None and latest is not None and start <= latest:
        raise attributes.error(
            f"time = {start:g} is not after {latest:g}, the time of the text before; expected a later time"
        )
    if accents is None:
        return SpokenLine(text.value, start, attributes.place)
    tunes = [read_tune(bracket) for bracket in read_brackets(accents.value, _somewhere(accents))]
    written = write_out(read_brackets(text.value, _somewhere(text)), tunes)
    return SpokenLine(written.text, start, attributes.place, directions=written.directions)


def _somewhere(attribute: Attribute) -> Place:
    """Return where an attribute's value begins."""
    place = attribute.place
    column = None if place.column is None else place.column + len(attribute.name) + len('="')
    return Place(place.file, place.line, column)


def _language(attributes: Attributes, before: str | None) -> str | None:
    attribute = attributes.take("language")
    attributes.finish()
    if attribute is None:
        return before
    language = one_line(attribute.value.strip())
    if not language or before not in (None, language):
        raise attributes.error(f"language = '{language}' after '{before}'; expected one language in a script")
    return language


def _check_length(lines: list[SpokenLine], marks: list[Mark], duration: float | None, source: str) -> None:
    """Raise InputError if there is nothing to perform, or nothing says how long it lasts."""
    if lines:
        check_length(sum(len(line.text) for line in lines), lines[-1].place)
    elif not marks and duration is None:
        raise InputError(f"the script is empty; expected e.g. {EXAMPLE}", Place(source, 1))
    elif duration is None and all(mark.end.base is Base.END for mark in marks):
        raise InputError(
            f"the script has no words and does not say how long it lasts; expected a duration in "
            f"{CONTAINER} or here",
            marks[0].place,
        )
