"""Kinds of files that are taken for others: what a file looks like, and how it is read."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from .prolog import COMMENTS, DECLARATION, DOCUMENT_TYPE
from .subtitles import looks_like_subtitles
from .suffixes import RECORDING_SUFFIXES, SCRIPT_SUFFIXES

_SUBTITLES = "expected them after --transcript, with their recording after --audio"
_PLAIN = "expected its text in a .txt file"
_PLAY = "expected risorius play"
_CHARACTER = "is a character; expected it after risorius rig"
RECORDING = "is a recording; expected it after --audio"
_SPOKEN = "is to be spoken; expected risorius speak"
_TEXT = "is a text; expected risorius speak"
_LABELS = "holds labels; expected risorius speak, with their recording after --audio"
SCORE = "is a score; expected risorius play or mix"
_HEAD = 4000  # bytes from which a kind is told
_APML = "(?:apml|APML|fml-apml|FML-APML)"
_XML = rf"{DECLARATION}{COMMENTS}(?:{DOCUMENT_TYPE}\s*+)?+{COMMENTS}"
# By suffix: what it is, and what reads it.
SUFFIXES: Mapping[str, str] = {
    **dict.fromkeys((".srt", ".vtt"), f"holds subtitles; {_SUBTITLES}"),
    **dict.fromkeys((".docx", ".doc", ".odt", ".rtf", ".pdf", ".epub"), f"is a document; {_PLAIN}"),
    **dict.fromkeys((".htm", ".html"), f"is a page; {_PLAIN}"),
    **dict.fromkeys((".csv", ".fap"), f"is a table: {_PLAY} for a captured face, risorius batch for lines"),
    **dict.fromkeys((".glb", ".gltf", ".vrm"), _CHARACTER),
    ".toml": "is a table; expected it after --rules or --config",
    ".fountain": "is a screenplay; expected the lines of one person in a .txt file",
    ".eaf": "is an ELAN file; expected a TextGrid exported from it",
}  # fmt: skip
# By the first bytes: documents that are archives or begin with a mark of their own.
_MAGIC: tuple[tuple[bytes, str], ...] = (
    (b"PK\x03\x04", f"is a document or an archive; {_PLAIN}"),
    (b"%PDF", f"is a PDF; {_PLAIN}"),
    (b"{\\rtf", f"is an RTF document; {_PLAIN}"),
    (b"\xd0\xcf\x11\xe0", f"is a Word document; {_PLAIN}"),
    (b"RIFF", RECORDING),
    (b"fLaC", RECORDING),
    (b"OggS", RECORDING),
    (b"ID3", RECORDING),
    (b"glTF", _CHARACTER),
)
# By the first characters: what it is and how it is read, and the suffixes of files that are read so.
_CONTENT: tuple[tuple[re.Pattern[str], str, tuple[str, ...]], ...] = (
    (
        re.compile(rf"{_XML}<(?:\w+:)?speak[\s>]", re.DOTALL),
        "looks like SSML; expected a .ssml file",
        (".ssml",),
    ),
    (re.compile(rf"{_XML}<bml[\s>]", re.DOTALL), "looks like BML; expected a .bml file", (".bml",)),
    (
        re.compile(rf"{_XML}<{_APML}[\s>]", re.DOTALL),
        "looks like APML; expected a .apml file",
        (".apml", ".xml"),
    ),
    (
        re.compile(rf"{_XML}<(?:PHONEME|EMOTIONDISPLAY)[\s>]", re.DOTALL),
        "looks like markup; expected a .xml file",
        (".xml",),
    ),
    (re.compile(r"File type = \"ooTextFile"), "looks like a TextGrid; expected a .TextGrid file", ()),
    (re.compile(r"\{\s*\"risorius\"\s*:"), "looks like a score; expected a .score.json file", ()),
    (re.compile(r"(?:<!DOCTYPE html|<html)[\s>]", re.IGNORECASE), f"looks like a page; {_PLAIN}", ()),
)


def is_apml(text: str) -> bool:
    """Tell whether a text is an XML document whose root is that of APML or of FML-APML."""
    return bool(re.match(rf"\s*+{_XML}<{_APML}[\s/>]", text, re.DOTALL))


def misplaced(text: str, suffix: str = "") -> str | None:
    """Return what a text is if it is not plain text, and how it is read; None if it may be plain.

    `suffix`: that of its file, whose own kind is not named.
    """
    if looks_like_subtitles(text):
        return f"looks like subtitles; {_SUBTITLES}, in a .srt or .vtt file"
    start = text.lstrip()[:2000]
    found = (advice for pattern, advice, own in _CONTENT if suffix not in own and pattern.match(start))
    return next(found, None)


def kind_of_bytes(data: bytes) -> str | None:
    """Return what a file is by its first bytes, and how it is read; None if that is not known."""
    return next((advice for magic, advice in _MAGIC if data.startswith(magic)), None)


def kind_of_file(path: Path) -> str | None:
    """Return what a file is by its name or its beginning, and what reads it; None if that is not known."""
    try:
        with path.open("rb") as file:
            beginning = file.read(_HEAD)
    except (OSError, ValueError):
        return None
    named = kind_of_suffix(path.name)
    by_bytes = kind_of_bytes(beginning)
    if by_bytes is not None:
        return by_bytes
    if not _is_text(beginning):
        return named
    if named is not None and named != RECORDING:
        return named
    return misplaced(beginning.decode("utf-8", "ignore")) or (_TEXT if named and beginning else None)


def _is_text(beginning: bytes) -> bool:
    if b"\0" in beginning:
        return False
    try:
        beginning[: _HEAD - 4].decode("utf-8")
    except UnicodeDecodeError as error:
        return len(beginning) == _HEAD and error.start >= _HEAD - 8
    return True


def kind_of_suffix(name: str) -> str | None:
    """Return what a file of that name is, and what reads it; None if its suffix does not tell."""
    name = name.lower()
    if name.endswith(".textgrid"):
        return _LABELS
    if name.endswith(".score.json"):
        return SCORE
    suffix = Path(name).suffix
    if suffix in SCRIPT_SUFFIXES:
        return _SPOKEN
    return RECORDING if suffix in RECORDING_SUFFIXES else SUFFIXES.get(suffix)
