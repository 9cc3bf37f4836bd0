import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from risorius.core.channels import CHANNELS
from risorius.core.functions import ONSET_FUNCTIONS
from risorius.core.lips.articulators import ARTICULATORS
from risorius.core.movement import Cause, Dominance, LipSegment, ManualCurve, Movement
from risorius.core.parameters import PARAMETERS
from risorius.core.score import BlendSettings, Score
from risorius.core.time import on_tick
from risorius.errors import InputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.score.score_json import read_score_file, score_to_json, write_score_json
from tests.profiles import examples

MINIMAL = (
    '{"risorius": 1, "duration": 7.0, "settings": {"conflict": "inhibit", "activation_threshold": 0.1, '
    '"min_onset": 0.12, "min_offset": 0.12}, "movements": [{"channel": "emotion", "start": 0.0, "end": 7.0, '
    '"onset": 2.0, "offset": 3.0, "priority": 10, "targets": {"zygomatic_major.left": 1.0}}]}'
)


def _times(low: float = 0.0) -> st.SearchStrategy[float]:
    return st.floats(low, 100.0)


def _of_parameters(make: Callable[[Any], st.SearchStrategy[Any]]) -> st.SearchStrategy[dict[str, Any]]:
    pairs = st.sampled_from(PARAMETERS).flatmap(lambda p: st.tuples(st.just(p.name), make(p)))
    return st.lists(pairs, max_size=4).map(dict)


def _value(parameter: Any) -> st.SearchStrategy[float]:
    return st.floats(parameter.low, parameter.high)


def _limits(parameter: Any) -> st.SearchStrategy[tuple[float, float]]:
    return st.tuples(_value(parameter), _value(parameter)).map(lambda pair: (min(pair), max(pair)))


def _keys(parameter: Any) -> st.SearchStrategy[tuple[tuple[float, float], ...]]:
    key = st.tuples(_times(-5.0).map(on_tick), _value(parameter))
    keys = st.lists(key, min_size=1, max_size=4, unique_by=lambda k: k[0])
    return keys.map(lambda pairs: tuple(sorted(pairs)))


CAUSES = st.builds(Cause, st.text(max_size=5), st.text(max_size=5), st.text(max_size=5))
PRIORITIES = st.none() | st.floats(-100, 100)
POSITIVE = st.floats(0.001, 10.0)
DOMINANCES = st.builds(Dominance, POSITIVE, POSITIVE, POSITIVE, POSITIVE, st.floats(0, 1))
MOVEMENTS = st.builds(
    lambda start, length, **rest: Movement(start=start, end=start + length, **rest),
    start=_times(),
    length=POSITIVE,
    channel=st.sampled_from(CHANNELS.names()),
    onset=_times(),
    offset=_times(),
    targets=_of_parameters(_value),
    id=st.text(max_size=5),
    layer=st.sampled_from(["", "brows"]),
    priority=PRIORITIES,
    release_priority=PRIORITIES,
    function=st.sampled_from(ONSET_FUNCTIONS.names()),
    cause=CAUSES,
)
ARTICULATED = st.dictionaries(
    st.sampled_from(sorted(ARTICULATORS)), st.floats(0.0, 4.0), max_size=3
)  # all of them may be so many mm
LIPS = st.builds(
    lambda start, length, **rest: LipSegment(start=start, end=start + length, **rest),
    start=_times(),
    length=POSITIVE,
    phone=st.sampled_from(["", "M", "ʃ"]),
    targets=st.builds(lambda mm, others: {**mm, **others}, ARTICULATED, _of_parameters(_value)),
    limits=_of_parameters(_limits),
    dominance=st.dictionaries(st.sampled_from(["*", "masseter", "lip_width"]), DOMINANCES),
    cause=CAUSES,
    yields=st.dictionaries(st.sampled_from(["*", "jaw_drop", "tongue_up"]), st.floats(0.0, 30.0)),
    precision=st.dictionaries(st.sampled_from(["*", "jaw_drop", "lip_tuck"]), st.floats(0.0, 30.0)),
)
MANUAL = st.builds(ManualCurve, _of_parameters(_keys), CAUSES)
SETTINGS = st.builds(
    BlendSettings,
    conflict=st.sampled_from(["inhibit", "graded"]),
    activation_threshold=st.none() | st.floats(0, 1),
    min_onset=st.none() | _times(),
    min_offset=st.none() | _times(),
    onset_function=st.none() | st.sampled_from(ONSET_FUNCTIONS.names()),
    contact=st.booleans(),
    lips=st.sampled_from(["dominance", "effort", "lookahead"]),
)
SCORES = st.builds(
    Score,
    duration=POSITIVE,
    movements=st.lists(MOVEMENTS, max_size=4, unique_by=lambda m: (m.channel, m.layer, m.start)).map(tuple),
    lips=st.lists(LIPS, max_size=3).map(tuple),
    manual=st.lists(MANUAL, max_size=2).map(tuple),
    settings=SETTINGS,
    text=st.text(max_size=20),
    seed=st.integers(),
)


def _changed(**change: Any) -> str:
    return json.dumps({k: v for k, v in (json.loads(MINIMAL) | change).items() if v is not ...})


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        ("[]", "", "holds []; expected an object"),
        (_changed(risorius=...), "", "key 'risorius' is missing; expected a whole number"),
        (_changed(risorius=2), '"risorius"', "version 2 is not known; expected 1"),
        (
            _changed(duration=0),
            "",
            "duration = 0.0 is out of range; expected more than 0 and at most 21600 seconds",
        ),
        (
            _changed(duration=1e12),
            '"duration"',
            "duration = 1000000000000.0 is out of range; expected a number from 0 to 21600",
        ),
        (_changed(duratoin=7), '"duratoin"', "unknown key 'duratoin'; did you mean 'duration'?"),
        (
            _changed(movements={}),
            '"movements"',
            "movements = an object cannot be used; expected a list, each an object",
        ),
        (_changed(movements=[1]), "1]", "movements[0] = 1 cannot be used; expected an object"),
        (
            _changed(
                movements=[
                    {"channel": "lips", "phone": "AA", "start": 0, "end": 1, "targets": {"lip_width": 30}}
                ]
            ),
            '"lip_width"',
            "lip_width = 30.0 is out of range; expected -16 to 10 mm",
        ),
        (_changed(seed=1.5), '"seed"', "seed = 1.5 cannot be used; expected a whole number"),
        (
            _changed(settings={"conflit": "sum"}),
            '"conflit"',
            "unknown key 'settings.conflit'; did you mean 'conflict'?",
        ),
        (
            _changed(settings={"min_onset": -1}),
            '"min_onset"',
            "settings.min_onset = -1 is out of range; expected a number of at least 0",
        ),
        (
            _changed(settings={"activation_threshold": 2}),
            '"activation_threshold"',
            "settings.activation_threshold = 2 is out of range; expected a number from 0 to 1",
        ),
        (
            _changed(settings={"onset_function": "liner"}),
            '"onset_function"',
            "unknown onset function 'liner'; did you mean 'linear'?",
        ),
        (
            _changed(movements=json.loads(MINIMAL)["movements"] * 2),
            "",
            "movements 'emotion@0' and 'emotion@0' both start at 0 s in channel emotion; "
            "movements of one channel follow one another",
        ),
    ],
)
def test_a_faulty_score_is_refused_with_its_place(tmp_path: Path, text: str, at: str, message: str) -> None:
    path = tmp_path / "x.score.json"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_score_file(path)
    place = f"{path}:1:{text.index(at) + 1}" if at else str(path)
    assert str(caught.value) == f"{place}: {message}"


def test_the_smallest_score_of_the_documentation_is_read(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text(MINIMAL)
    held = read_score_file(tmp_path / "x.json")
    smile = Movement("emotion", 0.0, 7.0, 2.0, 3.0, {"zygomatic_major.left": 1.0}, priority=10.0)
    settings_ = BlendSettings("inhibit", 0.1, 0.12, 0.12)
    assert held.score == Score(7.0, (smile,), settings=settings_)
    assert held.utterance is None


@examples(100, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
@given(score=SCORES)
def test_a_score_is_read_back_exactly(
    score: Score, take_of: Callable[..., WritableTake], tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("score") / "x.score.json"
    take = take_of()
    take = replace(take, performance=replace(take.performance, score=score))
    write_score_json(take, path, WriteOptions())
    assert read_score_file(path).score == score
    first = path.read_bytes()
    write_score_json(take, path, WriteOptions())
    assert path.read_bytes() == first


def test_settings_are_written_in_full() -> None:
    """A score keeps its meaning when defaults change."""
    assert score_to_json(Score(1.0))["settings"] == {
        "conflict": "inhibit",
        "contact": True,
        "lips": "effort",
        "rounding": 0.0,
    }
