"""The text of BML's speech, and the places of its sync points in it."""

from __future__ import annotations

from dataclasses import replace

from ..core.directions import Directions, Sync
from ..core.units import MAX_SECONDS
from ..errors import InputError
from .anchor import Anchor, Base, parse_number
from .quote import one_line, quoted
from .ssml import ROOT as SSML_ROOT
from .ssml import SsmlWriter
from .tree import Unknowns, XmlNode

SSML_TYPE = "application/ssml+xml"


class _SpeechWriter(SsmlWriter):
    """Writes a speech's text; `<sync id="tm1"/>` names a place in it."""

    def perform(self, node: XmlNode) -> None:
        """Apply an element."""
        if node.name != "sync":
            super().perform(node)
            return
        self.at_edge = True
        self.name_place(node.required("id", 'id="tm1"').value.strip(), node)

    def name_place(self, name: str, node: XmlNode) -> None:
        """Name the place that is reached; raise InputError if it is named already."""
        if any(sync.name == name for sync in self.syncs):
            raise InputError(f"sync point '{one_line(name)}' is set twice; expected it once", node.place)
        super().name_place(name, node)
        self.syncs[-1] = replace(self.syncs[-1], seconds=_seconds(node))


def _seconds(node: XmlNode) -> float | None:
    """Return the time of a sync point after the speech's start, if it has one; raise InputError if not so."""
    attribute = node.get("time")
    if attribute is None:
        return None
    seconds = parse_number(attribute.value.strip())
    if seconds is None or not 0.0 <= seconds <= MAX_SECONDS:
        message = f"time = {quoted(attribute.value)}; expected seconds after the start of the speech"
        raise InputError(message, attribute.place)
    return seconds


def read_words(node: XmlNode, unknowns: Unknowns) -> tuple[str, Directions]:
    """Return the words of a speech: its SSML if it has some, else its text."""
    parts = [child for child in node.children if isinstance(child, XmlNode)]
    writer = _SpeechWriter(unknowns)
    for part in parts:
        if part.name == "description" and (part.text_of("type") or SSML_TYPE) == SSML_TYPE:
            inner = [c for c in part.children if isinstance(c, XmlNode) and c.name == SSML_ROOT]
            for speak in inner:
                writer.write(speak)
            if inner:
                return writer.finished()
        elif part.name == "description":
            unknowns.tell(f"description of type '{one_line(part.text_of('type') or '')}'", part.place)
        elif part.name != "text":
            unknowns.tell(f"<{one_line(part.name)}> in <speech>", part.place)
    texts = [part for part in parts if part.name == "text"]
    if not texts:
        raise InputError("<speech>: text is missing; expected <text>Hello.</text>", node.place)
    writer.write(texts[0])
    return writer.finished()


def in_text(sync: Sync, text: str, offset: int) -> Anchor:
    """Return when a sync point of a speech is reached, whose text begins at `offset` of the script's."""
    if sync.at >= len(text):
        return Anchor(Base.TEXT_END, 0.0, character=offset + len(text), place=sync.place)
    return Anchor(Base.TEXT, 0.0, character=offset + sync.at, place=sync.place)
