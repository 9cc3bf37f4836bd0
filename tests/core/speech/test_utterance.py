import pytest

from risorius.core.speech.utterance import Ending, Phone, Phrase, check_continuous, check_phrases


@pytest.mark.parametrize(
    ("phones", "message"),
    [
        ((), "do not cover"),
        ((Phone("AA", 0.1, 1.0),), "do not cover"),
        ((Phone("AA", 0.0, 0.9),), "do not cover"),
        ((Phone("AA", 0.0, 0.4), Phone("M", 0.5, 1.0)), "gap or overlap"),
        ((Phone("AA", 0.0, 0.6), Phone("", 0.6, 0.6), Phone("M", 0.6, 1.0)), "no duration"),
    ],
)
def test_phones_must_be_continuous(phones: tuple[Phone, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        check_continuous(phones, 1.0)


def test_continuous_phones_pass() -> None:
    check_continuous((Phone("", 0.0, 0.4), Phone("M", 0.4, 1.0)), 1.0)


def phrase(first: int, last: int) -> Phrase:
    return Phrase(first, last, 0.0, 1.0, 0, Ending.STATEMENT)


@pytest.mark.parametrize(
    ("phrases", "message"),
    [
        ((phrase(0, 2),), "do not cover"),
        ((phrase(1, 3),), "do not cover"),
        ((phrase(0, 1), phrase(2, 3)), "do not cover"),
        ((phrase(0, 2), phrase(1, 3)), "do not cover"),
        ((phrase(0, 3), phrase(3, 3)), "no words"),
    ],
)
def test_phrases_must_cover_the_words(phrases: tuple[Phrase, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        check_phrases(phrases, 3)


def test_phrases_in_order_pass() -> None:
    check_phrases((phrase(0, 1), phrase(1, 3)), 3)
