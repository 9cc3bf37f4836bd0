"""What is given to the engine, and where each character of it comes from."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.languages import language_of
from risorius.speech.text.normalise import normalise


def spoken(text: str, language: str = "en-us") -> str:
    return " ".join(normalise(text, 0, len(text), language_of(language)).text.split())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("“Quoted” ‘single’ \"plain\" it’s dogs’ rock'n'roll", "Quoted single plain it's dogs rock'n'roll"),
        ("a 😀 b ❤\ufe0f c 👩\u200d👧", "a b c"),
        ("e\u0301te\u0301 soft\u00adhyphen \ufeffa\u200bb", "été softhyphen a b"),
        ("ﬁne 𝐇𝐞𝐥𝐥𝐨 Ｈｉ", "fine Hello Hi"),
        ("*bold* _it_ `code` <b>x</b> [y]", "bold it code b x /b y"),
        ("one\ntwo\tthree\x00four", "one two three four"),
        ("20° up & 50%", "20° up & 50%"),
        ("\ud800", ""),
    ],
)
def test_signs_that_nobody_reads_are_left_out(text, expected) -> None:
    assert spoken(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Mr. Smith vs. Dr. Jones, e.g. here", "mister Smith versus doctor Jones, for example here"),
        ("St. Mark St. by", "Saint Mark Street by"),
        ("5 p.m. Then", "5 P M. Then"),
        ("at 5 p.m. it rained etc.", "at 5 P M it rained et cetera."),
        ("J. K. Rowling", "J K Rowling"),
        ("It is I. He came.", "It is I. He came."),
        ("the U.S. army in L.A. Then U.S.", "the U.S army in L.A. Then U.S."),
        ("Plan B. Then J. Bobson", "Plan B. Then J Bobson"),
        ("Shh, mm.", "shush, hmm."),
        ("Jan. 5 and Jan. Then", "January 5 and Jan. Then"),
        ("No. 5, but no. Then", "number 5, but no. Then"),
        (
            "$5.50, $1, $0.99, £3.01, $0",
            "5 dollars 50 cents, 1 dollar, 99 cents, 3 pounds 1 penny, 0 dollars",
        ),
        ("$3.5 million, $1,200.00 and €5.5", "3.5 million dollars, 1,200 dollars and 5.5 euros"),
        (
            "12 km/h, 5kg, 20°C, 10–20 mm",
            "12 kilometres per hour, 5 kilograms, 20 degrees Celsius, 10 to 20 millimetres",
        ),
        ("https://example.com wait--what", "example.com wait—what"),
    ],
)
def test_english_is_written_out(text, expected) -> None:
    assert spoken(text) == expected


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("en-gb", "Dr. Weiß pays $5.50", "doctor Weiß pays 5 dollars 50 cents"),
        ("enm", "Dr. Weiß pays $5.50", "Dr. Weiß pays $5.50"),
        ("pl", "Dr. Weiß płaci $5.50", "Dr. Weiß płaci $5.50"),
        ("de", "Dr. Weiß zahlt z. B. $5.50", "Doktor Weiß zahlt zum Beispiel $5.50"),
        (
            "de",
            "am 3. Oktober, 10–20 km/h usw.",
            "am 3. Oktober, 10 bis 20 Kilometer pro Stunde und so weiter.",
        ),
        ("fr", "M. Dupont, p. ex., à 5 km", "monsieur Dupont, par exemple, à 5 kilomètres"),
        ("es", "El Sr. Pérez, pág. 5", "El señor Pérez, página 5"),
        ("it", "Il sig. Rossi, pag. 5 ecc.", "Il signor Rossi, pagina 5 eccetera."),
        ("nl", "Mevr. Jansen, d.w.z. nr. 5", "mevrouw Jansen, dat wil zeggen nummer 5"),
        ("pt-br", "O Sr. Silva, pág. 5", "O senhor Silva, página 5"),
    ],
)
def test_each_language_is_written_out_in_its_way(language: str, text: str, expected: str) -> None:
    assert spoken(text, language) == expected


@given(st.text(max_size=40), st.text(max_size=40))
def test_every_character_comes_from_its_place(before, text) -> None:
    whole = before + text + " after"
    result = normalise(whole, len(before), len(before) + len(text), language_of("en-us"))
    assert len(result.origin) == len(result.text)
    assert list(result.origin) == sorted(result.origin)
    assert all(len(before) <= place < len(before) + len(text) for place in result.origin)
    assert "\n" not in result.text
    assert "\0" not in result.text
    result.text.encode()


def test_an_expansion_belongs_to_what_it_stands_for() -> None:
    text = "pay $3.5 million to Dr. Fu"
    result = normalise(text, 0, len(text), language_of("en-us"))
    for word, source in (("million", "million"), ("dollars", "million"), ("3.5", "$3.5"), ("doctor", "Dr.")):
        assert result.origin[result.text.index(word)] == text.index(source)
