import pytest

from risorius.core.speech.tobi import boundary_tone, pitch_accent
from risorius.errors import ParameterError


@pytest.mark.parametrize(
    ("text", "message"),
    [("L+H", r"unknown pitch accent 'L\+H'; did you mean 'L\+H\*'"), ("", "expected one of H"), ("H%", "H%")],
)
def test_an_unknown_accent_names_the_nearest(text: str, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        pitch_accent(text)


@pytest.mark.parametrize("text", ["H*", "", "LLL%", "L+H*"])
def test_an_unknown_boundary_is_an_error(text: str) -> None:
    with pytest.raises(ParameterError, match="boundary tone"):
        boundary_tone(text)


@pytest.mark.parametrize(
    ("text", "label"), [("h*", "H*"), (" L+h* ", "L+H*"), ("l+!h*", "L+!H*"), ("*", "*")]
)
def test_accents_come_in_any_case(text: str, label: str) -> None:
    assert pitch_accent(text) == label


@pytest.mark.parametrize(
    ("text", "label"),
    [("LH%", "L-H%"), ("LL%", "L-L%"), ("h-h%", "H-H%"), ("L-", "L-"), ("%", "%")],
)
def test_boundaries_come_in_both_spellings(text: str, label: str) -> None:
    assert boundary_tone(text) == label
