"""Which content words carry no accent, by the rules of their language; and that a nucleus is left."""

from __future__ import annotations

import pytest

from risorius.languages import language_of, languages, plain_word
from risorius.script import read_script
from risorius.speech import synthesize_script
from risorius.speech.synthesis import synthesize_line


def accented(text: str, language: str, engine) -> list[str]:  # type: ignore[no-untyped-def]
    """Return the accented words, nuclei in capitals."""
    said = synthesize_line(text, language=language, engine=engine)
    words = [(said.words[a.word].text, a.nuclear) for a in said.accents]
    return [word.upper() if nuclear else word.lower() for word, nuclear in words]


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("de", "Ich habe gestern ein Buch gelesen.", ["gestern", "BUCH"]),
        ("de", "Wir wollen mit dem Auto nach Köln fahren.", ["auto", "KÖLN"]),
        ("de", "Ich möchte fünf Äpfel und ein Stück Käse kaufen.", ["äpfel", "KÄSE"]),
        ("de", "Das Haus ist offen.", ["haus", "OFFEN"]),
        ("de", "Ich will schlafen.", ["SCHLAFEN"]),
        ("de", "Wir essen gute Äpfel.", ["essen", "gute", "ÄPFEL"]),
        ("nl", "Ik heb gisteren een boek gelezen.", ["gisteren", "BOEK"]),
        ("nl", "Ik wil een stuk kaas kopen.", ["KAAS"]),
        ("nl", "Ik zie de oude bomen.", ["zie", "oude", "BOMEN"]),
        ("fr", "Je voudrais un petit pain.", ["voudrais", "PAIN"]),
        ("fr", "Marie mange une grande pomme rouge.", ["mange", "ROUGE"]),
        ("en-us", "I bought a new book yesterday.", ["bought", "new", "BOOK"]),
        ("en-us", "Today.", ["TODAY"]),
        ("en-us", "He came today again.", ["CAME"]),
        ("es", "Quiero comprar un libro nuevo.", ["quiero", "comprar", "libro", "NUEVO"]),
    ],
)
def test_cases(language: str, text: str, expected: list[str], engine) -> None:  # type: ignore[no-untyped-def]
    assert accented(text, language, engine) == expected


def test_who_emphasises_a_word_is_heeded() -> None:
    said = synthesize_script(read_script("Ich will Käse *kaufen*.", text=True), language="de")
    assert [(said.words[a.word].text, a.nuclear) for a in said.accents][-1] == ("kaufen", True)


@pytest.mark.parametrize("code", languages())
def test_the_words_are_as_words_are_looked_up(code: str) -> None:
    rules = language_of(code).accents
    listed = (*rules.trailing, *rules.verbs, *rules.not_verbs, *rules.determiners, *rules.adjectives)
    assert [word for word in listed if word != plain_word(word)] == []
