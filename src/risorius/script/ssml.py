"""SSML 1.1 documents: what is to be spoken and how. What is not understood is said by name, and left out.

A new element is a function from the writer and the node, and its line in `ELEMENTS`.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ..core.manner import PLAIN, Manner
from ..errors import InputError, ParameterError, RisoriusError, unknown
from ..rules.articulation import articulation
from ..rules.lips import lip_table
from ..rules.ssml import ssml_table
from .anchor import NUMBER
from .directions import Break, Directions, Emphasis, Span, Sync
from .elements import Attribute
from .model import Script, SpokenLine, script_of
from .quote import one_line, quoted
from .speakable import check_speakable
from .tree import Node, Text, Unknowns, read_tree

ROOT = "speak"
LONGEST_BREAK = 60.0
_SECONDS = re.compile(rf"({NUMBER})(ms|s)", re.ASCII)
_AMOUNT = re.compile(rf"([+-]?)({NUMBER})(%|st|Hz|dB)?", re.ASCII | re.IGNORECASE)
_STRESS = "ˈˌ"
# The second part of English diphthongs.
_GLIDES = "ɪʊ"
_ARPABET_NAMES = ("x-arpabet", "arpabet", "cmu-arpabet", "x-cmu-arpabet")
_ENDS = tuple(".!?…:;。！？।")


def parse_ssml(text: str, source: str = "text") -> Script:
    """Return the script of an SSML document.

    Raises InputError or ParameterError, with file, line and column, for anything that is not as expected;
    warns (ScriptWarning) of what is not understood.
    """
    root = read_tree(text, source, ROOT)
    writer = Writer(Unknowns())
    writer.write(root)
    spoken, directions = writer.finished()
    check_speakable(spoken, source, root.place)
    line = SpokenLine(spoken, None, root.place, directions=directions)
    return script_of((line,), timed=False, source=source, language=root.text_of("lang"))


@dataclass
class Writer:
    """Writes the words of a document down, one blank between them, and what is said about their speaking."""

    unknowns: Unknowns
    text: str = ""
    spans: list[Span] = field(default_factory=list)
    breaks: list[Break] = field(default_factory=list)
    syncs: list[Sync] = field(default_factory=list)

    def finished(self) -> tuple[str, Directions]:
        """Return the text and its directions."""
        return self.text.rstrip(), Directions(tuple(self.spans), tuple(self.breaks), syncs=tuple(self.syncs))

    def write(self, node: Node) -> None:
        """Write what stands in a node."""
        for child in node.children:
            if isinstance(child, Text):
                self.put(child.text)
            else:
                self.perform(child)

    def put(self, text: str) -> None:
        """Write text, blanks and line ends as one blank."""
        flat = re.sub(r"\s+", " ", text)
        self.text += flat.lstrip() if not self.text or self.text.endswith(" ") else flat

    def perform(self, node: Node) -> None:
        """Do what an element asks for."""
        if node.name in ELEMENTS:
            try:
                ELEMENTS[node.name](self, node)
            except RisoriusError as error:
                raise error.at(node.place) from None
        else:
            self.unknowns.tell(f"<{one_line(node.written)}>", node.place, "its words are spoken plainly")
            self.write(node)

    def within(self, node: Node, **asked: object) -> None:
        """Write what stands in a node as a span that asks for something."""
        index = len(self.spans)
        start = len(self.text)
        self.write(node)
        end = len(self.text.rstrip())
        if end > start:
            # Before those inside it: the later one is the inner one.
            self.spans.insert(index, Span(start, end, node.place, **asked))  # type: ignore[arg-type]


def _plain(writer: Writer, node: Node) -> None:
    writer.write(node)


def _sentence(writer: Writer, node: Node) -> None:
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


def _break(writer: Writer, node: Node) -> None:
    time = node.get("time")
    if time is None:
        seconds = ssml_table().breaks[node.choice("strength", tuple(ssml_table().breaks), "medium")]
    else:
        seconds = read_seconds(time)
    if seconds > 0.0:
        writer.put(" ")
        writer.breaks.append(Break(len(writer.text), seconds, node.place))


def read_seconds(attribute: Attribute) -> float:
    """Return a time such as `250ms` or `2s`; raise InputError if it is none."""
    match = _SECONDS.fullmatch(attribute.value.strip())
    seconds = float(match[1]) * (0.001 if match[2] == "ms" else 1.0) if match else -1.0
    if not 0.0 <= seconds <= LONGEST_BREAK:
        shown = f"{attribute.name} = {quoted(attribute.value)}"
        raise InputError(
            f"{shown} is no time; expected e.g. 250ms or 2s, {LONGEST_BREAK:g}s at most", attribute.place
        )
    return seconds


def _emphasis(writer: Writer, node: Node) -> None:
    level = node.choice("level", tuple(Emphasis), Emphasis.MODERATE)
    writer.within(node, emphasis=Emphasis(level))


def _prosody(writer: Writer, node: Node) -> None:
    for name in ("contour", "duration"):
        if (given := node.get(name)) is not None:
            writer.unknowns.tell(f"{name} of <prosody>", given.place)
    table = ssml_table()
    manner = Manner(
        rate=_factor(node, "rate", table.rate),
        pitch=_semitones(writer, node, table.pitch),
        range=_factor(node, "range", table.range),
        volume=_decibels(node, table.volume),
    )
    writer.within(node, manner=manner) if manner != PLAIN else writer.write(node)


def _factor(node: Node, name: str, words: Mapping[str, float]) -> float:
    """Return a factor: a word of the table, `120%` of the usual, or a change such as `+20%`."""
    attribute = node.get(name)
    if attribute is None:
        return 1.0
    value = attribute.value.strip()
    if value in words:
        return words[value]
    match = _AMOUNT.fullmatch(value)
    if match is None or match[3] not in ("%", None):
        raise _no_amount(attribute, (*words, "120%", "+20%"))
    amount = float(match[2]) * (0.01 if match[3] else 1.0)
    factor = 1.0 + amount if match[1] == "+" else 1.0 - amount if match[1] == "-" else amount
    if not 0.1 <= factor <= 10.0:
        raise InputError(f"{name} = {quoted(value)} is out of range; expected 10% to 1000%", attribute.place)
    return factor


def _semitones(writer: Writer, node: Node, words: Mapping[str, float]) -> float:
    attribute = node.get("pitch")
    if attribute is None:
        return 0.0
    value = attribute.value.strip()
    if value in words:
        return words[value]
    match = _AMOUNT.fullmatch(value)
    if match is None or (match[3] or "").lower() not in ("%", "st", "hz"):
        raise _no_amount(attribute, (*words, "+2st", "+10%"))
    if match[3].lower() == "hz":
        writer.unknowns.tell("pitch in Hz", attribute.place)
        return 0.0
    amount = float(match[1] + match[2])
    if match[3] == "%":
        share = 1.0 + 0.01 * amount if match[1] else 0.01 * amount
        amount = 12.0 * math.log2(max(share, 0.01))
    if not -24.0 <= amount <= 24.0:
        raise InputError(
            f"pitch = {quoted(value)} is out of range; expected two octaves at most", attribute.place
        )
    return amount


def _decibels(node: Node, words: Mapping[str, float]) -> float:
    attribute = node.get("volume")
    if attribute is None:
        return 0.0
    value = attribute.value.strip()
    if value in words:
        return words[value]
    match = _AMOUNT.fullmatch(value)
    if match is None or (match[3] or "").lower() != "db":
        raise _no_amount(attribute, (*words, "+6dB"))
    return max(-60.0, min(float(match[1] + match[2]), 12.0))


def _no_amount(attribute: Attribute, known: Sequence[str]) -> ParameterError:
    return ParameterError(unknown(attribute.name, one_line(attribute.value), known), attribute.place)


def _phoneme(writer: Writer, node: Node) -> None:
    alphabet = (node.text_of("alphabet") or "ipa").lower()
    given = node.required("ph", 'ph="həˈləʊ"')
    if alphabet == "ipa":
        writer.within(node, phones=read_ipa(given))
    elif alphabet in _ARPABET_NAMES:
        writer.within(node, phones=read_arpabet(given))
    else:
        writer.unknowns.tell(f"alphabet {quoted(alphabet)}", given.place, "the words are spoken as written")
        writer.write(node)


def read_ipa(attribute: Attribute) -> tuple[str, ...]:
    """Return the phones of an IPA transcription, stress marks on the vowel that follows them.

    Raises ParameterError, with the place, for a sound that is not known.
    """
    phones: list[str] = []
    stress = ""
    table = articulation()
    for part in re.split(rf"([{_STRESS}])|[\s.‿|]+", unicodedata.normalize("NFD", attribute.value)):
        if not part:
            continue
        if part in _STRESS:
            stress = part
            continue
        try:
            for letter, marks in table.letters(part):
                vowel = letter in table.vowel
                if letter in _GLIDES and not stress and phones and phones[-1][-1] in table.vowel:
                    phones[-1] += letter + marks
                    continue
                phones.append((stress if vowel else "") + letter + marks)
                stress = "" if vowel else stress
        except ParameterError as error:
            raise error.at(attribute.place) from None
    if not phones:
        raise InputError(f"{attribute.name} holds no sound; expected e.g. həˈləʊ", attribute.place)
    return tuple(phones)


def read_arpabet(attribute: Attribute) -> tuple[str, ...]:
    """Return phones of ARPAbet between blanks; raise ParameterError, with the place, for an unknown one."""
    table = lip_table()
    phones = tuple(attribute.value.upper().split())
    for phone in phones:
        if phone.rstrip("012") not in (*table.phones, *table.diphthongs):
            known = (*table.phones, *table.diphthongs)
            raise ParameterError(unknown("phone", one_line(phone), known), attribute.place)
    if not phones:
        raise InputError(f"{attribute.name} holds no sound; expected e.g. HH AH0 L OW1", attribute.place)
    return phones


def _mark(writer: Writer, node: Node) -> None:
    name = node.required("name", 'name="here"').value.strip()
    if any(sync.name == name for sync in writer.syncs):
        raise InputError(f"the mark {quoted(name)} is set twice; expected it once", node.place)
    writer.syncs.append(Sync(name, len(writer.text), node.place))


def _sub(writer: Writer, node: Node) -> None:
    writer.put(node.required("alias", 'alias="World Wide Web"').value)


def _say_as(writer: Writer, node: Node) -> None:
    kind = node.required("interpret-as", 'interpret-as="characters"').value.strip().lower()
    words = "".join(child.text for child in node.children if isinstance(child, Text)).strip()
    if kind not in SAY_AS:
        writer.unknowns.tell(f"interpret-as {quoted(kind)}", node.place, "the words are spoken as written")
        writer.put(words)
    else:
        writer.put(SAY_AS[kind](words))


def _spelt(words: str) -> str:
    return ", ".join(char.upper() for char in words if char.isalnum())


def _digits(words: str) -> str:
    return " ".join(char for char in words if char.isalnum())


def _ordinal(words: str) -> str:
    if not words.isascii() or not words.isdigit():
        return words
    teen = words[-2:-1] == "1"
    return words + ("th" if teen else {"1": "st", "2": "nd", "3": "rd"}.get(words[-1], "th"))


def _as_written(words: str) -> str:
    return words


SAY_AS: Mapping[str, Callable[[str], str]] = {
    "characters": _spelt,
    "spell-out": _spelt,
    "verbatim": _spelt,
    "digits": _digits,
    "telephone": _digits,
    "ordinal": _ordinal,
    "cardinal": _as_written,
    "number": _as_written,
    "currency": _as_written,
    "unit": _as_written,
}
"""How each `interpret-as` is read; dates and times need a format, and are not understood."""


def _lang(writer: Writer, node: Node) -> None:
    writer.within(node, language=node.required("lang", 'xml:lang="de"').value.strip())


def _voice(writer: Writer, node: Node) -> None:
    for name in ("gender", "age", "variant", "required", "ordering"):
        if (given := node.get(name)) is not None:
            writer.unknowns.tell(f"{name} of <voice>", given.place)
    voice, language = node.text_of("name"), node.text_of("lang") or node.text_of("languages")
    if voice or language:
        writer.within(node, voice=voice, language=None if voice else language)
    else:
        writer.write(node)


def _silent(writer: Writer, node: Node) -> None:
    """Leave out what is not for speaking."""


ELEMENTS: Mapping[str, Callable[[Writer, Node], None]] = {
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
