"""espeak-ng's spellings of sounds as IPA (`data/spellings.toml`)."""

from __future__ import annotations

import tomllib
import unicodedata
from collections.abc import Mapping
from functools import cache
from importlib import resources

EVERYWHERE = "*"
# espeak-ng marks variants of a sound with ASCII signs.
_VARIANT_SIGNS = "-.+"


def as_ipa(name: str, language: str) -> str:
    """Return the IPA of a sound that espeak-ng calls `name`, without stress, in a language (BCP 47)."""
    plain = unicodedata.normalize("NFC", name)
    for table in (language.split("-")[0], EVERYWHERE):
        found = _tables().get(table, {}).get(plain)
        if found is not None:
            return found
    return name.strip(_VARIANT_SIGNS)


@cache
def _tables() -> dict[str, Mapping[str, str]]:
    text = resources.files(__package__).joinpath("data/spellings.toml").read_text("utf-8")
    tables: dict[str, Mapping[str, str]] = tomllib.loads(unicodedata.normalize("NFC", text))
    return tables
