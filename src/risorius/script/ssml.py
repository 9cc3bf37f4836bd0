"""SSML 1.1 documents: words and directions for speaking them. Unsupported parts are named and left out.

A new element is a function from the writer and the node, and its lines in `ELEMENTS` and `ATTRIBUTES`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ..core.directions import Break, DirectedSpan, Directions, Emphasis, Sync
from ..core.speech.voice_style import PLAIN, VoiceAdjustment
from ..errors import InputError, RisoriusError
from ..rules.ssml import ssml_table
from .amounts import decibels, factor, read_seconds, semitones
from .model import Script, SpokenLine, script_of
from .quote import one_line, quoted
from .say_as import SAY_AS
from .speakable import check_speakable
from .transcription import read_arpabet, read_ipa
from .tree import Text, Unknowns, XmlNode, read_tree

ROOT = "speak"
_ARPABET_NAMES = ("x-arpabet", "arpabet", "cmu-arpabet", "x-cmu-arpabet")
_ENDS = tuple(".!?…:;。！？।")


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
    sync_names: set[str] = field(default_factory=set)

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
        """Write text, blanks and line ends as one blank."""
        flat = re.sub(r"\s+", " ", text)
        self.text += flat.lstrip() if not self.text or self.text.endswith(" ") else flat

    def perform(self, node: XmlNode) -> None:
        """Apply an element."""
        if node.name in ELEMENTS:
            self.unknowns.check(node, ATTRIBUTES.get(node.name, ()))
            try:
                ELEMENTS[node.name](self, node)
            except RisoriusError as error:
                raise error.at(node.place) from None
        else:
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place, "its words are spoken plainly")
            self.write(node)

    def within(self, node: XmlNode, **asked: object) -> None:
        """Write the contents of a node as a span with a direction."""
        index = len(self.spans)
        start = len(self.text)
        self.write(node)
        end = len(self.text.rstrip())
        if end > start:
            # Before those inside it: the later one is the inner one.
            self.spans.insert(index, DirectedSpan(start, end, node.place, **asked))  # type: ignore[arg-type]


def _plain(writer: SsmlWriter, node: XmlNode) -> None:
    writer.write(node)


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
    time = node.get("time")
    if time is None:
        seconds = ssml_table().breaks[node.choice("strength", tuple(ssml_table().breaks), "medium")]
    else:
        seconds = read_seconds(time)
    if seconds > 0.0:
        writer.put(" ")
        writer.breaks.append(Break(len(writer.text), seconds, node.place))


def _emphasis(writer: SsmlWriter, node: XmlNode) -> None:
    level = node.choice("level", tuple(Emphasis), Emphasis.MODERATE)
    writer.within(node, emphasis=Emphasis(level))


def _prosody(writer: SsmlWriter, node: XmlNode) -> None:
    table = ssml_table()
    manner = VoiceAdjustment(
        rate=factor(node, "rate", table.rate),
        pitch=semitones(writer.unknowns, node, table.pitch),
        range=factor(node, "range", table.range),
        volume=decibels(node, table.volume),
    )
    writer.within(node, manner=manner) if manner != PLAIN else writer.write(node)


def _phoneme(writer: SsmlWriter, node: XmlNode) -> None:
    alphabet = (node.text_of("alphabet") or "ipa").lower()
    transcription = node.required("ph", 'ph="həˈləʊ"')
    if alphabet == "ipa":
        writer.within(node, phones=read_ipa(transcription))
    elif alphabet in _ARPABET_NAMES:
        writer.within(node, phones=read_arpabet(transcription))
    else:
        writer.unknowns.tell(
            f"alphabet {quoted(alphabet)}", transcription.place, "the words are spoken as written"
        )
        writer.write(node)


def _mark(writer: SsmlWriter, node: XmlNode) -> None:
    name = node.required("name", 'name="here"').value.strip()
    if name in writer.sync_names:
        raise InputError(f"the mark {quoted(name)} is set twice; expected it once", node.place)
    writer.sync_names.add(name)
    writer.syncs.append(Sync(name, len(writer.text), node.place))


def _sub(writer: SsmlWriter, node: XmlNode) -> None:
    writer.put(node.required("alias", 'alias="World Wide Web"').value)


def _say_as(writer: SsmlWriter, node: XmlNode) -> None:
    kind = node.required("interpret-as", 'interpret-as="characters"').value.strip().lower()
    words = "".join(child.text for child in node.children if isinstance(child, Text)).strip()
    if kind not in SAY_AS:
        writer.unknowns.tell(f"interpret-as {quoted(kind)}", node.place, "the words are spoken as written")
        writer.put(words)
    else:
        writer.put(SAY_AS[kind](words))


def _lang(writer: SsmlWriter, node: XmlNode) -> None:
    writer.within(node, language=node.required("lang", 'xml:lang="de"').value.strip())


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
    "w": _plain,
    "token": _plain,
    "break": _break,
    "emphasis": _emphasis,
    "prosody": _prosody,
    "phoneme": _phoneme,
    "mark": _mark,
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
    "sub": ("alias",),
    "say-as": ("interpret-as",),
    "voice": ("name", "languages"),
    "meta": ("name", "content", "http-equiv"),
}
"""The attributes of each element that are understood; none of the others."""
