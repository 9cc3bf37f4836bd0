"""How high espeak-ng's voices are, by their files."""

from __future__ import annotations

from pathlib import Path

import pytest

from risorius.speech.engines.espeak import EspeakEngine
from risorius.speech.engines.espeak_voices import mean_pitch
from risorius.speech.engines.voices import find_voice


@pytest.fixture
def data(tmp_path: Path) -> Path:
    for name, text in (
        ("lang/gmw/en", "name English\nlanguage en\n"),
        ("lang/zls/hr", "name Croatian\npitch  81 120\n"),
        ("voices/!v/f3", "language variant\npitch 140 240 // high\nformant 0 1\n"),
        ("voices/!v/m1", "language variant\n"),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.mark.parametrize(
    ("key", "hertz"),
    [
        ("gmw/en", 103.6),
        ("zls/hr", 104.4),
        ("gmw/en+f3", 200.0),
        ("zls/hr+m1", 104.4),
        ("no/such", 103.6),
    ],
)
def test_the_variant_comes_before_the_voice_and_the_voice_before_the_usual(
    key: str, hertz: float, data: Path
) -> None:
    assert mean_pitch(data, key) == pytest.approx(hertz)


def test_tones_leave_the_mean_unknown(engine: EspeakEngine) -> None:
    assert engine.mean_pitch(find_voice("en-us+f3", engine=engine)) == pytest.approx(200.0)
    assert engine.mean_pitch(find_voice(None, "cmn", engine)) is None
