"""The words of APML: its tones, emphasis and pauses become directions for speaking them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from ..core.directions import FOCUSED, Break, DirectedSpan, Directions, Emphasis, Sync, ToneMark
from ..core.speech.tobi import BOUNDARY_TONES, PITCH_ACCENTS
from ..errors import InputError, ParameterError, nearest, unknown
from ..languages import language_of
from ..rules.apml import apml_table
from .elements import Attribute
from .notation import PUNCTUATION, SPOKEN_WORD, accent_manner, closing_mark
from .quote import one_line
from .ssml import SsmlWriter
from .tree import XmlNode

ENGLISH = "en"
LONGEST_PAUSE = 60.0
# The accent of an emphasised word beside others whose accents are written.
FOCUS = "L+H*"


@dataclass
class ApmlWriter(SsmlWriter):
    """Writes the words of APML down, one blank between them, and the directions for speaking them.

    `closing`: the punctuation that follows unless the document writes some itself.
    """

    language: str = ENGLISH
    accents: list[ToneMark] = field(default_factory=list)
    boundaries: list[ToneMark] = field(default_factory=list)
    emphasised: list[ToneMark] = field(default_factory=list)
    closing: str = ""

    @property
    def elements(self) -> Mapping[str, Callable[[ApmlWriter, XmlNode], None]]:
        """The functions that apply elements, by their names in lower case."""
        return WORD_ELEMENTS

    @property
    def attributes(self) -> Mapping[str, Sequence[str]]:
        """The attributes of each element that are understood."""
        return WORD_ATTRIBUTES

    def finished(self) -> tuple[str, Directions]:
        """Return the text and its directions."""
        self.close("")
        text, directions = super().finished()
        accents = (*self.accents, *(self._focused() if self.accents else ()))
        ordered = tuple(sorted(accents, key=lambda tone: tone.at))
        return text, replace(directions, accents=ordered, boundaries=tuple(self.boundaries))

    def _focused(self) -> Iterator[ToneMark]:
        """Yield the accents of emphasised words to which none is written."""
        written = {tone.at for tone in self.accents}
        yield from (tone for tone in self.emphasised if tone.at not in written)

    def put(self, text: str) -> None:
        """Write text; before it the punctuation that a boundary asks for, unless it begins with some."""
        if text.strip():
            self.close(text.lstrip()[0])
        super().put(text)

    def close(self, following: str) -> None:
        """Write the punctuation that is still to come, unless that is what follows."""
        words = self.text.rstrip()
        punctuated = {words[-1:], following} & set(PUNCTUATION)
        if self.closing and words and not punctuated:
            self.text = words + self.closing + self.text[len(words) :]
            _shift(self.breaks, len(words), len(self.closing))
            _shift(self.syncs, len(words), len(self.closing))
        self.closing = ""

    def perform(self, node: XmlNode) -> None:
        """Apply an element, whose name may have any case; of an unknown one, name the nearest."""
        name = node.name.lower()
        self.at_edge = True
        if name in self.elements:
            self.unknowns.check(node, self.attributes.get(name, ()))
            self.elements[name](self, node)
        else:
            near = nearest(name, self.elements)
            meant = f"did you mean <{near}>? " if near else ""
            shown = f"<{one_line(node.written)}>"
            self.unknowns.tell(shown, node.place, f"{meant}its words are spoken plainly")
            self.write(node)
        self.at_edge = True

    def span_of(self, node: XmlNode) -> tuple[int, int] | None:
        """Write the contents of a node; return which characters they are, None without a word."""
        start = len(self.text)
        self.write(node)
        words = [m.span() for m in SPOKEN_WORD.finditer(self.text, start)]
        return (words[0][0], words[-1][1]) if words else None

    def bound(self, label: str, node: XmlNode) -> None:
        """End a phrase after the last word; raise InputError before the first one."""
        at = _last_word(self.text)
        if at is None:
            raise InputError("<boundary> stands before all words; expected it after a word", node.place)
        if self.boundaries and self.boundaries[-1].at == at:
            self.boundaries.pop()
        self.boundaries.append(ToneMark(at, label, node.place))
        self.closing = closing_mark(label, self.text.rstrip())

    def pause(self, seconds: float, node: XmlNode) -> None:
        """Pause for some seconds."""
        if seconds > 0.0:
            self.put(" ")
        self.breaks.append(Break(len(self.text), seconds, node.place))


def accented_words(text: str, span: tuple[int, int], language: str) -> list[tuple[int, int]]:
    """Return the words of a span that can carry an accent: its last one if they are all function words."""
    words = [m.span() for m in SPOKEN_WORD.finditer(text, *span)]
    known = language_of(language)
    content = [(first, last) for first, last in words if not known.is_function_word(text[first:last])]
    return content or words[-1:]


Placed = TypeVar("Placed", Break, Sync)


def _shift(placed: list[Placed], start: int, characters: int) -> None:
    """Move what stands at or after `start`, at the end of the list, by some characters."""
    index = len(placed)
    while index and placed[index - 1].at >= start:
        index -= 1
        placed[index] = replace(placed[index], at=placed[index].at + characters)


def _last_word(text: str) -> int | None:
    """Return where the last word of a text begins, None without words."""
    end = len(text.rstrip())
    while end > 0:
        start = text.rfind(" ", 0, end) + 1
        words = [m.start() for m in SPOKEN_WORD.finditer(text, start, end)]
        if words:
            return words[-1]
        end = len(text[:start].rstrip())
    return None


def label_of(attribute: Attribute, kind: str) -> str:
    """Return the ToBI label that an attribute gives, by APML's name or as it is.

    Raises ParameterError, with its place, for others.
    """
    names, labels = (
        (apml_table().accent, PITCH_ACCENTS) if kind == "accent" else (apml_table().boundary, BOUNDARY_TONES)
    )
    written = attribute.value.strip()
    known = {name.lower(): label for name, label in names.items()} | {tone.lower(): tone for tone in labels}
    known |= {tone.lower().replace("-", "", 1): tone for tone in labels if tone.endswith("%")}
    if written.lower() not in known:
        what = "pitch accent" if kind == "accent" else "boundary"
        raise ParameterError(unknown(what, one_line(written), names), attribute.place)
    return known[written.lower()]


def emphasis_of(node: XmlNode) -> Emphasis:
    """Return the level of an emphasis."""
    levels = apml_table().emphasis
    return levels[node.choice("level", tuple(levels), "moderate")]


def _emphasis(writer: ApmlWriter, node: XmlNode) -> None:
    tone = node.get("x-pitchaccent", "pitchaccent")
    level = emphasis_of(node) if tone is None or node.get("level") is not None else None
    label = label_of(tone, "accent") if tone is not None and tone.value.strip().lower() != "none" else None
    index = len(writer.spans)
    span = writer.span_of(node)
    if span is None:
        return
    if level is not None:
        writer.spans.insert(index, DirectedSpan(*span, node.place, emphasis=level))
    if label is not None:
        for first, last in accented_words(writer.text, span, writer.language):
            writer.accents.append(ToneMark(first, label, node.place))
            writer.spans.append(DirectedSpan(first, last, node.place, accent_manner(label)))
    elif level in FOCUSED:
        focused = accented_words(writer.text, span, writer.language)
        writer.emphasised += (ToneMark(first, FOCUS, node.place) for first, _ in focused)


def _boundary(writer: ApmlWriter, node: XmlNode) -> None:
    writer.bound(label_of(node.required("type", 'type="LL"'), "boundary"), node)
    writer.write(node)


def _pause(writer: ApmlWriter, node: XmlNode) -> None:
    named = "duration" if node.get("sec") is None and node.get("duration") is not None else "sec"
    node.required(named, 'sec="0.5"')
    writer.pause(node.number(named, 0.0, LONGEST_PAUSE, 0.0), node)
    writer.write(node)


WORD_ELEMENTS: Mapping[str, Callable[[ApmlWriter, XmlNode], None]] = {
    "emphasis": _emphasis,
    "boundary": _boundary,
    "pause": _pause,
}
WORD_ATTRIBUTES: Mapping[str, Sequence[str]] = {
    "emphasis": ("level", "x-pitchaccent", "pitchaccent"),
    "boundary": ("type",),
    "pause": ("sec", "duration"),
}
