"""The package's languages, from their folders."""

from __future__ import annotations

import importlib
import unicodedata
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar, cast

from ..reading.schema import build
from ..reading.source_text import SourceText
from ..reading.toml import read_tables, read_text
from .abbreviations import Abbreviations
from .intonation import IntonationTable
from .language import Language, LanguageTable, NumberReadings, PhoneTable, WordList
from .mnemonics import Mnemonics
from .phones import check_phones

T = TypeVar("T")
UNDETERMINED = "und"
_FOLDER = Path(__file__).parent


@cache
def languages() -> tuple[str, ...]:
    """Return the codes of all languages that have a folder, in order."""
    return tuple(sorted(path.parent.name for path in _FOLDER.glob("*/language.toml")))


def language_of(code: str) -> Language:
    """Return the language of a code (BCP 47): "pt-br" is "pt" unless it has a folder of its own.

    A language without a folder is as the undetermined one.
    """
    return _language(folder_of(code))


@cache
def _language(code: str) -> Language:
    table = read_table(LanguageTable, code, "language.toml")
    phones = read_table(PhoneTable, code, "phones.toml")
    listed = read_table(WordList, code, "words.toml")
    return Language(
        code=code,
        name=table.name,
        tested=table.tested,
        tones=table.tones,
        spaces=table.spaces,
        arpabet=phones.arpabet,
        function_words=frozenset(word for words in table.function_words.values() for word in words),
        fillers=frozenset(table.fillers),
        questions=table.questions,
        clauses=table.clauses,
        accents=table.accents,
        discourse=table.discourse,
        onsets=frozenset(tuple(cluster.split()) for cluster in phones.onsets),
        spellings=phones.spellings,
        tone_letters=phones.tones,
        words=frozenset(word for words in listed.words.values() for word in words.split()),
        abbreviations=read_table(Abbreviations, code, "abbreviations.toml"),
        mnemonics=_mnemonics(code),
        intonation=read_table(IntonationTable, code, "intonation.toml"),
        number_readings=_number_readings(code),
    )


def _mnemonics(code: str) -> Mnemonics:
    """Return how espeak-ng spells a language's phones; raise InputError if it dictates some, but not all."""
    table = read_table(Mnemonics, code, "mnemonics.toml")
    if table.dictated:
        check_phones(f"{code}/mnemonics.toml", table.dictated)
    return table


def folder_of(code: str) -> str:
    """Return the code of the folder of a language (BCP 47), "und" for a language without one."""
    parts = code.lower().replace("_", "-").split("-")
    names = ("-".join(parts[:count]) for count in range(len(parts), 0, -1))
    return next((name for name in names if name in languages()), UNDETERMINED)


def has_readings(code: str) -> bool:
    """Tell whether the folder of a language says how numbers and dates are read."""
    return any((_FOLDER / code / name).is_file() for name in ("readings.toml", "kanji.py"))


def module_of(code: str, name: str) -> ModuleType | None:
    """Return a module in the folder of a language, None if it has none of that name."""
    if not (_FOLDER / code / f"{name}.py").is_file():
        return None
    return importlib.import_module(f"{__package__}.{code}.{name}")


def read_table(cls: type[T], code: str, name: str) -> T:
    """Return a file of a language, laid over that of the undetermined one; either may be missing."""
    text, tables = _tables(code, name)
    if code != UNDETERMINED:
        # Each language has a name of its own.
        base = {key: value for key, value in _tables(UNDETERMINED, name)[1].items() if key != "name"}
        tables = _laid_over(base, tables)
    return build(cls, tables, SourceText(f"{code}/{name}", text))


def _tables(code: str, name: str) -> tuple[str, dict[str, Any]]:
    path = _FOLDER / code / name
    if not path.is_file():
        return "", {}
    text = unicodedata.normalize("NFC", read_text(path))
    return text, read_tables(text, f"{code}/{name}")


def _laid_over(base: Mapping[str, Any], tables: Mapping[str, Any]) -> dict[str, Any]:
    """Return both merged; `tables` overrides, and tables within both are merged again."""
    return {
        **base,
        **{
            key: _laid_over(base[key], value) if key in base and isinstance(value, dict) else value
            for key, value in tables.items()
        },
    }


def _number_readings(code: str) -> NumberReadings:
    module = module_of(code, "numbers")
    return cast(NumberReadings, getattr(module, "number_readings", lambda text: ()))
