"""Every example performs, without a warning."""

import runpy
import time
from pathlib import Path

import pytest

from risorius.api import speak
from risorius.settings import Settings

FOLDER = Path(__file__).parent.parent / "examples"
EXAMPLES = sorted(p for p in FOLDER.iterdir() if p.is_file() and p.suffix not in (".toml", ".csv"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.name)
def test_it_performs(path: Path, tmp_path: Path) -> None:
    take = speak(str(path))
    take.write(tmp_path / "x.muscles.csv", tmp_path / "x.TextGrid")
    assert take.curves["lip_seal"].max() > 0.9 or take.curves["masseter"].max() > 0.2


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.toml")), ids=lambda p: p.name)
def test_rules_of_ones_own_are_followed(path: Path) -> None:
    said = speak("Well, that is fine.", settings=Settings(rules=path))
    assert "signals.mouth.well" in {movement.cause.rule for movement in said.performance.score.movements}


@pytest.mark.parametrize("name", ["01-julia.utt", "04-intonation.xml", "05-timed.utt"])
def test_julia_prefers_popcorn(name: str) -> None:
    said = speak(str(next(p for p in EXAMPLES if p.name == name))).utterance
    assert said is not None
    assert [(said.words[a.word].text, a.label) for a in said.accents] == [
        ("Julia", "L+H*"),
        ("popcorn", "H*"),
    ]
    assert [(said.words[b.word].text, b.label) for b in said.boundaries] == [
        ("prefers", "L-H%"),
        ("popcorn", "L-L%"),
    ]


def test_the_agent_answers_word_by_word() -> None:
    face = runpy.run_path(str(FOLDER / "agents" / "echo.py"))["EchoFace"](Settings(lively=False))
    face.say("Good morning")
    texts: list[str] = []
    deadline = time.monotonic() + 20
    for frame in face.frames(paced=True):
        texts += [frame.text] if frame.text and frame.text not in texts else []
        if len(texts) == 2 or time.monotonic() > deadline:
            break
    assert texts == ['You said: "Good morning".', "What else?"]
