import pytest

from risorius.core.utterance import Phone, check_continuous


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
