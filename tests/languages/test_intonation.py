"""The rules of intonation: what they refuse, and which row decides."""

from dataclasses import replace

import pytest

from risorius.core.speech.utterance import Ending
from risorius.errors import InputError
from risorius.languages import language_of
from risorius.languages.intonation import AccentRule, BoundaryRule, Candidate
from risorius.reading.toml import parse

PLAIN = Candidate(True, False, False, False, False, Ending.STATEMENT)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('label = "X*"', "unknown pitch accent 'X\\*'"),
        ('labl = "H*"', "unknown key 'labl'; did you mean 'label'"),
        ('label = "H*"\nconfidence = 2', "confidence = 2 is out of range"),
        ('ends = ["coma"]', "ends"),
    ],
)
def test_rules_that_are_none(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse(AccentRule, text, "x.toml")


def test_a_boundary_needs_a_known_tone() -> None:
    with pytest.raises(InputError, match="unknown boundary tone 'LX%'"):
        BoundaryRule((Ending.STATEMENT,), "LX%", 1.0)


@pytest.mark.parametrize(
    ("change", "label"),
    [
        ({}, "H*"),
        ({"nuclear": True}, "H*"),
        ({"nuclear": True, "ends": Ending.YES_NO_QUESTION}, "L*"),
        ({"nuclear": True, "ends": Ending.EXCLAMATION}, "L+H*"),
        ({"ends": Ending.EXCLAMATION}, "H*"),
        ({"focus": True, "content": False}, "L+H*"),
        ({"after_focus": True, "nuclear": True}, None),
        ({"content": False}, None),
        ({"content": False, "only": True}, "H*"),
        ({"lexical_tone": True}, None),
        ({"lexical_tone": True, "nuclear": True}, "*"),
    ],
)
def test_the_first_row_that_fits_decides(change: dict[str, object], label: str | None) -> None:
    rule = language_of("und").intonation.accent_of(replace(PLAIN, **change))
    assert (rule.label if rule else None) == label


@pytest.mark.parametrize("ending", list(Ending))
def test_every_ending_has_a_boundary(ending: Ending) -> None:
    rule = language_of("und").intonation.boundary_of(ending)
    assert rule is not None
    assert 0.0 < rule.confidence < 1.0
