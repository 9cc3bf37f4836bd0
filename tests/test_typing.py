"""What a type checker says of programs that use the library."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
RIGHT = """
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
import risorius

settings = risorius.Settings(fps=60, age=40, rules="mine.toml", shape={"nose_width": 0.5})
settings = replace(settings, fps="24000/1001")
settings = risorius.Settings(fps=29.97, look=risorius.Look(overlay=("caption",)))
rate: Fraction = settings.fps
look = risorius.Look(complexion="tan")
settings = risorius.Settings(size="640x480", attitudes="polite", without=["lips"], look=look)
width, height = settings.size
take = risorius.speak(Path("scene.xml"), emotion="happiness:0.7@1-3")
said: risorius.Utterance | None = take.utterance
why: tuple[risorius.Explanation, ...] = take.explain(0.5)
take = risorius.speak("Hello.", emotion={"happiness": 0.7}, settings=settings)
take.write("x.mp4", "x.muscles.csv")
seconds: float = take.duration
"""
WRONG = """
import risorius

risorius.Settings(fps=None)
risorius.speak(5)
risorius.Settings().fps.upper()
"""


@pytest.mark.full
@pytest.mark.parametrize(("program", "faults"), [(RIGHT, 0), (WRONG, 3)])
def test_programs_are_checked(program: str, faults: int, tmp_path: Path) -> None:
    file = tmp_path / "program.py"
    file.write_text(program)
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", str(file)]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout
    assert said.count(": error: ") == faults, said
