"""The marks of a script in the files that have times: score, TextGrid and BML feedback."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

import risorius
from risorius.ports.score.score_json import read_score_file

SSML = "<speak>Hello <mark name='first'/> there. How <mark name='a &amp; b'/>are you?</speak>"
BML = '<bml><speech id="s1"><text>It is <sync id="T1"/>my <sync id="T2"/>turn</text></speech></bml>'


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [("x.ssml", SSML, {"first": 1, "a & b": 3}), ("x.bml", BML, {"T1": 2, "T2": 3}), ("x.txt", "Hi.", {})],
)
def test_marks_are_written_with_the_time_of_their_word(
    name: str, text: str, expected: dict[str, int], tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text)
    score, feedback, grid = (
        tmp_path / f"x.{suffix}" for suffix in ("score.json", "feedback.xml", "TextGrid")
    )
    take = risorius.speak(tmp_path / name)
    take.write(score, feedback, grid)
    assert take.utterance is not None
    times = {name: take.utterance.words[word].start for name, word in expected.items()}

    read = read_score_file(score).utterance
    assert read is not None
    assert {mark.name: mark.time for mark in read.marks} == pytest.approx(times)
    points = [node for node in ET.fromstring(feedback.read_bytes()).iter() if node.tag.endswith("}sync")]
    by_id = {node.attrib["id"]: float(node.attrib["time"]) for node in points}
    assert {name: by_id[name] for name in expected} == pytest.approx(times, abs=1e-5)
    assert ('"marks"' in grid.read_text()) == bool(expected)
    assert ('"marks"' in score.read_text()) == bool(expected)
