"""The data of languages: one folder each, named by its code (BCP 47), of strict tables.

`language.toml` has its function words, question words and clauses, `abbreviations.toml` texts that are
read otherwise than they are written, `phones.toml` its phones, `mnemonics.toml` how espeak-ng spells them,
`intonation.toml` its tunes; `numbers.py` gives the readings of a number. Tables that a folder lacks, and
languages without a folder, are those of `und`, the undetermined language.
"""

from .language import AccentPlaces, Clauses, Discourse, Language, Nouns, Questions, plain_word
from .load import language_of, languages

__all__ = [
    "AccentPlaces",
    "Clauses",
    "Discourse",
    "Language",
    "Nouns",
    "Questions",
    "language_of",
    "languages",
    "plain_word",
]
