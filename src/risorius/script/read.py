"""Read a user's text, or the file that it names, into a script: one reader per suffix.

A new format is a file with a function from text and name to a script, and its line in `READERS`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from ..core.registry import Registry
from ..errors import InputError, Place, UnusedSettingError, unknown
from .bml import parse_bml
from .files import names_something, read_text
from .kinds import SUFFIXES, is_apml, misplaced
from .markup import parse_markup
from .model import Script
from .plain import USUAL_FORM, TextForm, parse_markdown, parse_plain
from .quote import LONGEST_PATH, one_line
from .ssml import parse_ssml
from .suffixes import INPUT_SUFFIXES, RECORDING_SUFFIXES
from .utt import parse_utterance

ScriptReader = Callable[[str, str], Script]


def _parse_apml(text: str, source: str) -> Script:
    """Return the script of a document in APML, whose reader is loaded with the first one."""
    from .apml import parse_apml

    return parse_apml(text, source)


def _parse_xml(text: str, source: str) -> Script:
    """Return the script of an XML document, by its root: APML, or the markup."""
    return (_parse_apml if is_apml(text) else parse_markup)(text, source)


READERS: Registry[ScriptReader] = Registry("suffix")
READERS.register(".txt")(parse_plain)
READERS.register(".xml")(_parse_xml)
READERS.register(".utt")(parse_utterance)
READERS.register(".ssml")(parse_ssml)
READERS.register(".bml")(parse_bml)
READERS.register(".apml")(_parse_apml)
READERS.register(".md")(parse_markdown)
READERS.register(".markdown")(parse_markdown)

# Texts, whose form can be chosen.
TEXT_READERS = {"": parse_plain, ".txt": parse_plain, ".md": parse_markdown, ".markdown": parse_markdown}
_WORD = re.compile(r"[^\s\0]+")
_ENDING = re.compile(r"\.\d{0,4}[A-Za-z][A-Za-z0-9]{0,4}")


def read_script(
    script: str, *, text: bool = False, source: str = "text", form: TextForm = USUAL_FORM
) -> Script:
    """Return the script of `script`: a file if it names one or ends like one, else the words themselves.

    `text`: take it as words whatever it looks like. `source` names the words in messages. `form`: that of
    a text. Raises InputError or ParameterError with the place in the file.
    """
    if text or not script.strip():
        return parse_plain(script, source, form)
    suffix = _suffix(script)
    named = suffix in (*INPUT_SUFFIXES, *READERS) or _is_like_a_name(script)
    if not named and not names_something(script):
        _check_kind(script, source)
        return parse_plain(script, source, form)
    return _read_file(script, suffix, form)


def _is_like_a_name(script: str) -> bool:
    """Tell whether it is one word with a slash, or with an ending of up to five letters, as a file's name."""
    _, dot, ending = script.rpartition(".")
    like = "/" in script or _ENDING.fullmatch(dot + ending[:6])
    return bool(like and _WORD.fullmatch(script))


def parse_script(text: str, suffix: str, source: str = "text", form: TextForm = USUAL_FORM) -> Script:
    """Return the script of a text in the format of files with `suffix` (".xml"); no file is opened.

    `form`: that of a text. Raises InputError or ParameterError with the place in the text.
    """
    if suffix in TEXT_READERS:
        return TEXT_READERS[suffix](text, source, form)
    chosen = [name for name, value in form._asdict().items() if value and name != "heard"]
    if chosen:
        raise UnusedSettingError(chosen, f"'{suffix}' has a form of its own; expected a text", Place(source))
    return READERS.get(suffix)(text, source)


def _check_kind(text: str, source: str, suffix: str = "") -> None:
    """Raise InputError if a text, in a file with this suffix, is something else than it is taken for."""
    kind = misplaced(text, suffix)
    if kind is not None:
        hint = ", or --text to have it spoken as it stands" if suffix in TEXT_READERS else ""
        raise InputError(f"{kind}{hint}", Place(source))


def _suffix(script: str) -> str:
    return Path(script).suffix.lower() if "\0" not in script else ""


def _read_file(path: str, suffix: str, form: TextForm) -> Script:
    place = Place(one_line(path, LONGEST_PATH))
    if not names_something(path):
        raise InputError("there is no such file; expected a file, or --text to have the words spoken", place)
    if suffix in RECORDING_SUFFIXES:
        raise InputError("is a recording; expected it after --audio", place)
    if suffix in SUFFIXES:
        raise InputError(SUFFIXES[suffix], place)
    content = read_text(path)
    _check_kind(content, place.file, suffix)
    if suffix and suffix not in READERS:
        raise InputError(unknown("suffix", suffix, READERS), place)
    return parse_script(content, suffix, place.file, form)
