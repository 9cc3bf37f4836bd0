"""Words do not begin in the pause before them."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from risorius.speech import synthesize_line
from risorius.speech.alignment import align
from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.spectra import BANDS, STEP_SECONDS
from risorius.speech.alignment.unheard_pauses import with_pauses

QUIET, LOUD = -10.0, 0.0


@pytest.mark.parametrize("voice", ["en-us", "en-gb"])
@pytest.mark.parametrize(
    "text",
    [
        "Cookie? No. The sun is hot. Cookie? The cat ran. Put it down. Take two. The end.",
        "Who took the cookie? I did not. Paul, come here. Five, four, three, two, one.",
        "Keep it. Then go on. That is all. Do you think so? Both of them. Put it there.",
    ],
)
def test_words_after_pauses_begin_when_they_are_said(text: str, voice: str) -> None:
    said = synthesize_line(text, voice=voice, lead=0.3, tail=0.3)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = align(said.audio, text)
    early = [b.start - a.start for a, b in zip(found.words, said.words, strict=True)]
    assert max(early) < 0.08


def levels(*spans: tuple[float, float]) -> np.ndarray:
    """Return levels of a second that is loud but in the spans."""
    made = np.full((round(1.0 / STEP_SECONDS), BANDS), LOUD)
    for start, end in spans:
        made[round(start / STEP_SECONDS) : round(end / STEP_SECONDS)] = QUIET
    return made


def spoken(first: str, second: str, edge: float = 0.4) -> list[AlignedPhone]:
    return [AlignedPhone(first, 0.2, edge, 0, 0.0), AlignedPhone(second, edge, 0.9, 1, 0.0)]


def test_a_pause_between_words_becomes_silence() -> None:
    found = with_pauses(levels((0.45, 0.7)), spoken("N", "DH"), 0.0)
    assert [(p.symbol, round(p.start, 2), round(p.end, 2)) for p in found] == [
        ("N", 0.2, 0.45),
        ("", 0.45, 0.7),
        ("DH", 0.7, 0.9),
    ]


@pytest.mark.parametrize(("first", "second", "quiet"), [("N", "K", 0.15), ("T", "K", 0.2), ("N", "DH", 0.1)])
def test_a_closure_is_no_pause(first: str, second: str, quiet: float) -> None:
    phones = spoken(first, second)
    assert with_pauses(levels((0.45, 0.45 + quiet)), phones, 0.0) == phones


def test_within_a_word_there_is_no_pause() -> None:
    phones = [phone._replace(word=0) for phone in spoken("N", "DH")]
    assert with_pauses(levels((0.45, 0.8)), phones, 0.0) == phones


def test_silence_goes_on_until_the_word_sounds() -> None:
    phones = [AlignedPhone("", 0.0, 0.3, -1, 0.0), AlignedPhone("K", 0.3, 0.9, 0, 0.0)]
    found = with_pauses(levels((0.0, 0.6)), phones, 0.0)
    assert [round(p.end, 2) for p in found] == [0.6, 0.9]
    nearly = with_pauses(levels((0.0, 0.36)), phones, 0.0)
    assert nearly == phones
