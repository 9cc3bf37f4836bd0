"""Felt and posed expressions on the curves that are shown."""

from __future__ import annotations

import numpy as np
import pytest

import risorius
from risorius.errors import ParameterError
from risorius.rules.emotions import emotion, emotions
from risorius.rules.expressions import expressed, expressions

SMILE = "zygomatic_major.left"


def rise(expression: str, script: str, **more: object) -> tuple[float, float]:
    """Return how long a smile takes from 5 to 95 % of its height, and its largest acceleration, 1/s²."""
    settings = risorius.Settings(expression=expression, fps=500, lively=False)
    take = risorius.speak(script, settings=settings, **more)
    curve = take.curves[SMILE]
    curve = curve[: int(curve.argmax()) + 1] / curve.max()
    seconds = (np.searchsorted(curve, 0.95) - np.searchsorted(curve, 0.05)) / 500.0
    return float(seconds), float(np.abs(np.diff(curve, 2)).max() * 500.0**2)


@pytest.mark.parametrize(
    ("script", "more"),
    [
        ("Ha.", {"emotion": "happiness:0.8@0-2"}),
        ('<PHONEME text="Ha." /><EMOTIONDISPLAY time="0" duration="2" joy="0.8" />', {}),
    ],
)
def test_posed_smiles_rise_faster_and_less_smoothly(tmp_path, script: str, more: dict[str, object]) -> None:
    if script.startswith("<"):
        file = tmp_path / "smile.xml"
        file.write_text(script)
        script = str(file)
    felt, posed = rise("felt", script, **more), rise("posed", script, **more)
    assert posed[0] < 0.7 * felt[0]
    assert posed[1] > 2.0 * felt[1]


def test_felt_smiles_rise_as_measured() -> None:
    assert 0.5 <= emotion("happiness").onset <= 0.75


def test_only_what_is_felt_changes_what_else_is_done() -> None:
    known = emotions()
    posed = expressed(known, "posed")
    assert known["sadness"].modulation.rates
    assert not posed["sadness"].modulation.rates
    assert all(posed[n].onset < known[n].onset and posed[n].offset < known[n].offset for n in known)
    assert expressed(known, "felt") == known
    assert set(expressions()) == {"felt", "posed"}
    with pytest.raises(ParameterError, match="unknown expression 'feigned'"):
        expressed(known, "feigned")
