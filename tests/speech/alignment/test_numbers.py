"""Numbers in a transcript are sought as they are said where they stand."""

from __future__ import annotations

import pytest

from risorius.speech.alignment import align
from risorius.speech.alignment.lexicon import read_transcript
from risorius.speech.synthesis import synthesize_line


@pytest.mark.parametrize(
    ("text", "word", "phones"),
    [
        ("On March 3 we go.", "3", "TH ER D"),
        ("It ends on 4/23/2021 at last.", "4/23/2021", "EY P R AH L T W EH N T IY TH ER D"),
        ("They have 3 dogs.", "3", "TH R IY"),
    ],
)
def test_a_date_is_found_in_speech(text: str, word: str, phones: str) -> None:
    said = synthesize_line(text, lead=0.4, tail=0.4)
    found = align(said.audio, text)
    heard, known = (next(w for w in u.words if w.text == word) for u in (found, said))
    symbols = [p.symbol for p in found.phones[heard.first_phone : heard.last_phone] if p.symbol]
    assert " ".join(symbols).startswith(phones)
    assert heard.start == pytest.approx(known.start, abs=0.08)
    assert heard.end == pytest.approx(known.end, abs=0.08)


def test_the_reading_in_context_comes_first() -> None:
    _, words = read_transcript("On March 3 we go.")
    assert words[2].readings[0] == ("TH", "ER", "D")
    assert ("TH", "R", "IY") in words[2].readings
