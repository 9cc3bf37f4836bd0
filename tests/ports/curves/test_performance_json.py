import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from risorius.core.movement import Movement
from risorius.core.score import Score
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError
from risorius.ports.curves.performance_json import read_performance_file, write_performance_json
from risorius.ports.export_source import WritableTake, WriteOptions

SMILE = Movement("emotion", 0.0, 0.5, 0.1, 0.1, {"zygomatic_major.left": 1 / 3})


@pytest.fixture
def written(tmp_path: Path, take_of: Callable[..., WritableTake]) -> Path:
    write_performance_json(take_of(score=Score(1.0, (SMILE,))), tmp_path / "x.json", WriteOptions())
    return tmp_path / "x.json"


def _without_masseter(document: dict[str, Any]) -> None:
    del document["curves"]["masseter"]


@pytest.mark.parametrize(
    ("change", "at", "message"),
    [
        (lambda d: d.update(fps="0"), '"fps"', "fps = 0 is out of range"),
        (lambda d: d.update(fps="1e10000000"), '"fps"', "fps '1e10000000' is not a number; expected e.g. 30"),
        (lambda d: d.update(fps=[]), '"fps"', "fps = [] cannot be used; expected a number or a text"),
        (lambda d: d.update(risorius=9), '"risorius"', "version 9 is not known; expected 1"),
        (lambda d: d.pop("score"), "", "key 'score' is missing; expected an object"),
        (
            lambda d: d["score"].update(durations=1),
            '"durations"',
            "unknown key 'score.durations'; did you mean 'duration'?",
        ),
        (
            lambda d: d["score"]["movements"][0].update(end=-1),
            '"end"',
            "score.movements[0].end = -1 is out of range",
        ),
        (
            _without_masseter,
            '"curves"',
            "the curve of masseter is missing; expected one for each parameter",
        ),
        (
            lambda d: d["curves"].update(masetter=[]),
            '"masetter"',
            "unknown parameter 'masetter'; did you mean",
        ),
        (lambda d: d["curves"]["masseter"].pop(), '"masseter"', "masseter has 30 values; expected 31"),
        (
            lambda d: d["curves"]["masseter"].__setitem__(3, 1.5),
            "1.5",
            "masseter[3] = 1.5 is out of range; expected 0 to 1",
        ),
        (
            lambda d: d["curves"]["masseter"].__setitem__(3, "a"),
            '"a"',
            'curves.masseter[3] = "a" cannot be used; expected a number',
        ),
    ],
)
def test_a_faulty_performance_is_refused_with_its_place(
    written: Path, change: Callable[[Any], object], at: str, message: str
) -> None:
    document = json.loads(written.read_text())
    change(document)
    text = json.dumps(document)
    written.write_text(text)
    with pytest.raises(InputError) as caught:
        read_performance_file(written)
    place = f"{written}:1:{text.index(at) + 1}" if at else str(written)
    assert str(caught.value).startswith(f"{place}: {message}")


@pytest.mark.parametrize("fps", [Fraction(30), Fraction(24000, 1001)])
def test_a_performance_is_read_back_exactly(
    tmp_path: Path,
    take_of: Callable[..., WritableTake],
    utterance_of: Callable[..., Utterance],
    fps: Fraction,
) -> None:
    utterance = utterance_of("M AA")
    score = Score(utterance.duration, (SMILE,), text="ma", seed=7)
    take = take_of(utterance.duration, fps, utterance.audio, utterance, score=score)
    write_performance_json(take, tmp_path / "x.json", WriteOptions())
    held = read_performance_file(tmp_path / "x.json")
    assert held.performance.score == score
    assert held.performance.fps == fps
    np.testing.assert_array_equal(held.performance.values, take.performance.values)
    assert held.utterance is not None
    assert held.utterance.phones == utterance.phones


def test_fps_may_be_a_number(written: Path) -> None:
    document = json.loads(written.read_text())
    written.write_text(json.dumps(document | {"fps": 30}))
    assert read_performance_file(written).performance.fps == 30
