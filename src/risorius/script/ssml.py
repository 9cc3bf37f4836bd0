"""SSML 1.1 documents: words and directions for speaking them. Unsupported parts are named and left out.

A new element is a function from the writer and the node, and its lines in `ELEMENTS` and `ATTRIBUTES`.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from ..core.directions import Break, DirectedSpan, Directions, Emphasis, Sync
from ..core.speech.characters import stands_alone
from ..core.speech.voice_style import PLAIN
from ..errors import RisoriusError
from ..rules.ssml import ssml_table
from .amounts import adjustment, pitch_in_hertz, read_seconds
from .elements import Attribute
from .model import Script, SpokenLine, script_of
from .quote import one_line, quoted
from .say_as import said_as
from .speakable import check_speakable
from .transcription import read_arpabet, read_ipa
from .tree import Text, Unknowns, XmlNode, read_tree

ROOT = "speak"
_ARPABET_NAMES = ("x-arpabet", "arpabet", "cmu-arpabet", "x-cmu-arpabet")
_ENDS = tuple(".!?…:;。！？।")
_AS_WRITTEN = "the words are spoken as written"
_QUOTES = "\"'"
_CLOSING = frozenset(".,;:!?…)]}%»”’")
_OPENING = frozenset({"Ps", "Pi", "Sc"})


def parse_ssml(text: str, source: str = "text") -> Script:
    """Return the script of an SSML document.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected;
    warns (ScriptWarning) of what is not understood.
    """
    root = read_tree(text, source, ROOT)
    writer = SsmlWriter(Unknowns())
    writer.write(root)
    spoken, directions = writer.finished()
    check_speakable(spoken, source, root.place)
    line = SpokenLine(spoken, None, root.place, directions=directions)
    return script_of((line,), timed=False, source=source, language=root.text_of("lang"))


@dataclass
class SsmlWriter:
    """Writes the words of a document down, one blank between them, and the directions for speaking them."""

    unknowns: Unknowns
    text: str = ""
    spans: list[DirectedSpan] = field(default_factory=list)
    breaks: list[Break] = field(default_factory=list)
    syncs: list[Sync] = field(default_factory=list)
    # Whether an element begins or ends here.
    at_edge: bool = False

    def finished(self) -> tuple[str, Directions]:
        """Return the text and its directions."""
        return self.text.rstrip(), Directions(tuple(self.spans), tuple(self.breaks), syncs=tuple(self.syncs))

    def write(self, node: XmlNode) -> None:
        """Write the contents of a node."""
        for child in node.children:
            if isinstance(child, Text):
                self.put(child.text)
            else:
                self.perform(child)

    def put(self, text: str) -> None:
        """Write text, blanks and line ends as one blank; words that only an element divides stay two."""
        flat = re.sub(r"\s+", " ", text)
        if flat and self.at_edge and words_touch(self.text, flat):
            self.text += " "
        if flat:
            self.at_edge = False
        self.text += flat.lstrip() if not self.text or self.text.endswith(" ") else flat

    def perform(self, node: XmlNode) -> None:
        """Apply an element."""
        self.at_edge = True
        if node.name in ELEMENTS:
            self.unknowns.check(node, ATTRIBUTES.get(node.name, ()))
            ELEMENTS[node.name](self, node)
        else:
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place, "its words are spoken plainly")
            self.write(node)
        self.at_edge = True

    def name_place(self, name: str, node: XmlNode) -> None:
        """Name the place that is reached; SSML lets a name come again."""
        self.syncs.append(Sync(name, len(self.text), node.place))

    def leave_out(self, attribute: Attribute, error: RisoriusError, instead: str = "it is left out") -> None:
        """Warn of a value that is not understood."""
        self.unknowns.misunderstood(error.message, error.place or attribute.place, instead)

    def within(self, node: XmlNode, **asked: object) -> None:
        """Write the contents of a node as a span with a direction."""
        index = len(self.spans)
        start = len(self.text)
        self.write(node)
        self.add(index, start, node, **asked)

    def say_instead(self, node: XmlNode, written: str, spoken: str) -> None:
        """Write words for which others are said."""
        before = len(self.text)
        self.put(written)
        if spoken.strip() and spoken.strip() != written.strip():
            self.add(len(self.spans), before, node, spoken=spoken.strip())

    def add(self, index: int, start: int, node: XmlNode, **asked: object) -> None:
        """Direct what was written from `start` on, without the blanks around it."""
        end = len(self.text.rstrip())
        while start < end and self.text[start] == " ":
            start += 1
        if end > start:
            # Before those inside it: the later one is the inner one.
            self.spans.insert(index, DirectedSpan(start, end, node.place, **asked))  # type: ignore[arg-type]


def words_touch(before: str, after: str) -> bool:
    """Tell whether a text would run into the next one: two words, or a sentence and the next."""
    if before[-1:].isspace() or not before or stands_alone(before[-1]) or stands_alone(after[0]):
        return False
    begins = after[0].isalnum() or unicodedata.category(after[0]) in _OPENING
    begins |= after[0] in _QUOTES and after[1:2].isalnum()
    quoted_before = before[-1] in _QUOTES and not before[-2:-1].isspace() and len(before) > 1
    ends = before[-1].isalnum() or before[-1] in _CLOSING or quoted_before
    return begins and ends


def _plain(writer: SsmlWriter, node: XmlNode) -> None:
    writer.write(node)


def _token(writer: SsmlWriter, node: XmlNode) -> None:
    language = node.text_of("lang")
    writer.within(node, language=language) if language else writer.write(node)


def _sentence(writer: SsmlWriter, node: XmlNode) -> None:
    language = node.text_of("lang")
    writer.put(" ")
    start = len(writer.text)
    if language is None:
        writer.write(node)
    else:
        writer.within(node, language=language)
    writer.text = writer.text.rstrip()
    if len(writer.text) > start and not writer.text.endswith(_ENDS):
        writer.text += "."
    writer.put(" ")


def _break(writer: SsmlWriter, node: XmlNode) -> None:
    seconds = _break_seconds(writer, node)
    last = len(writer.text.rstrip())
    writer.syncs = [replace(s, ends=True) if s.at >= last > 0 else s for s in writer.syncs]
    if seconds > 0.0:
        writer.put(" ")
    writer.breaks.append(Break(len(writer.text), seconds, node.place))


def _break_seconds(writer: SsmlWriter, node: XmlNode) -> float:
    """Return how long a break lasts; one whose time or strength is not understood is a usual one."""
    table = ssml_table().breaks
    time = node.get("time")
    if time is not None:
        try:
            return read_seconds(time)
        except RisoriusError as error:
            writer.leave_out(time, error)
    return table[_choice(writer, node, "strength", tuple(table), "medium")]


def _choice(writer: SsmlWriter, node: XmlNode, name: str, known: Sequence[str], default: str) -> str:
    """Return an attribute that is one of `known`; warn of others, and return the default."""
    try:
        return node.choice(name, known, default)
    except RisoriusError as error:
        attribute = node.get(name)
        assert attribute is not None
        writer.leave_out(attribute, error, f"it is read as {default}")
        return default


def _emphasis(writer: SsmlWriter, node: XmlNode) -> None:
    level = _choice(writer, node, "level", tuple(Emphasis), Emphasis.MODERATE)
    writer.within(node, emphasis=Emphasis(level))


def _prosody(writer: SsmlWriter, node: XmlNode) -> None:
    manner, hertz = adjustment(node, ssml_table(), writer.leave_out), pitch_in_hertz(node)
    if manner != PLAIN or hertz is not None:
        writer.within(node, manner=manner, pitch=hertz)
    else:
        writer.write(node)


def _phoneme(writer: SsmlWriter, node: XmlNode) -> None:
    alphabet = (node.text_of("alphabet") or "ipa").lower()
    transcription = node.get("ph")
    if transcription is None:
        _missing(writer, node, "ph")
        writer.write(node)
    elif alphabet != "ipa" and alphabet not in _ARPABET_NAMES:
        writer.unknowns.tell(f"alphabet {quoted(alphabet)}", transcription.place, _AS_WRITTEN)
        writer.write(node)
    else:
        read = read_ipa if alphabet == "ipa" else read_arpabet
        try:
            writer.within(node, phones=read(transcription))
        except RisoriusError as error:
            writer.leave_out(transcription, error, _AS_WRITTEN)
            writer.write(node)


def _mark(writer: SsmlWriter, node: XmlNode) -> None:
    name = node.text_of("name") or node.text_of("mark")
    if name:
        writer.name_place(name, node)
    else:
        _missing(writer, node, "name")


def _sub(writer: SsmlWriter, node: XmlNode) -> None:
    alias = node.get("alias")
    if alias is None:
        _missing(writer, node, "alias")
        writer.write(node)
        return
    written = _words_of(node)
    if written:
        writer.say_instead(node, written, alias.value)
    else:
        writer.put(alias.value)


def _words_of(node: XmlNode) -> str:
    """Return all text in an element."""
    parts = (child.text if isinstance(child, Text) else _words_of(child) for child in node.children)
    return " ".join("".join(parts).split())


def _missing(writer: SsmlWriter, node: XmlNode, name: str) -> None:
    writer.unknowns.tell(f"<{one_line(node.written)}> without {name}", node.place)


def _say_as(writer: SsmlWriter, node: XmlNode) -> None:
    kind = node.text_of("interpret-as")
    words = _words_of(node)
    if kind is None:
        _missing(writer, node, "interpret-as")
        writer.put(words)
        return
    spoken = said_as(kind.lower(), words, node.text_of("format"))
    if spoken == "" and words:
        writer.unknowns.tell(f"interpret-as {quoted(kind)}", node.place)
        return
    if spoken is None:
        writer.unknowns.tell(f"interpret-as {quoted(kind)}", node.place, _AS_WRITTEN)
    writer.say_instead(node, words, spoken or words)


def _lang(writer: SsmlWriter, node: XmlNode) -> None:
    language = node.text_of("lang")
    if language:
        writer.within(node, language=language)
    else:
        _missing(writer, node, "xml:lang")
        writer.write(node)


def _voice(writer: SsmlWriter, node: XmlNode) -> None:
    voice, language = node.text_of("name"), node.text_of("lang") or node.text_of("languages")
    if voice or language:
        writer.within(node, voice=voice, language=None if voice else language)
    else:
        writer.write(node)


def _silent(writer: SsmlWriter, node: XmlNode) -> None:
    """Leave out an element that is not for speaking."""


ELEMENTS: Mapping[str, Callable[[SsmlWriter, XmlNode], None]] = {
    ROOT: _plain,
    "p": _sentence,
    "s": _sentence,
    "w": _token,
    "token": _token,
    "break": _break,
    "emphasis": _emphasis,
    "prosody": _prosody,
    "phoneme": _phoneme,
    "mark": _mark,
    "bookmark": _mark,
    "sub": _sub,
    "say-as": _say_as,
    "lang": _lang,
    "voice": _voice,
    "desc": _silent,
    "meta": _silent,
    "metadata": _silent,
}


ATTRIBUTES: Mapping[str, tuple[str, ...]] = {
    ROOT: ("version", "schemaLocation"),
    "break": ("time", "strength"),
    "emphasis": ("level",),
    "prosody": ("rate", "pitch", "range", "volume"),
    "phoneme": ("alphabet", "ph"),
    "mark": ("name",),
    "bookmark": ("mark",),
    "sub": ("alias",),
    "say-as": ("interpret-as", "format"),
    "voice": ("name", "languages"),
    "meta": ("name", "content", "http-equiv"),
}
"""The attributes of each element that are understood; none of the others."""
