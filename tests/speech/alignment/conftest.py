"""A spoken line whose phones are known: espeak-ng's own times."""

from __future__ import annotations

import pytest

from risorius.core.speech.utterance import Utterance
from risorius.speech import synthesize_line

LINE = "My baby brother put the big map by the beam."


@pytest.fixture(scope="session")
def spoken() -> Utterance:
    return synthesize_line(LINE, lead=0.3, tail=0.3)
