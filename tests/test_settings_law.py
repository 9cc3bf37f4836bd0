"""The law of settings: each changes some output, or is refused by name; so does each option of each command.

Fields and options are enumerated here, so that a new one without a case fails.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from risorius import api, pipeline
from risorius import solvers as solvers_module
from risorius.core.progress import quiet
from risorius.core.score import Score
from risorius.core.speech.utterance import Utterance
from risorius.errors import RisoriusError, UnusedSettingError
from risorius.rules.emotions import Display
from risorius.script import Script, parse_script
from risorius.script.plain import TextForm
from risorius.script.tree import ScriptWarning
from risorius.settings import Settings, settings_of
from risorius.settings.declare import Row, Stage, rows
from risorius.solvers import solver_key
from risorius.unused_settings import (
    CAPTURE,
    CHARACTER,
    INPUTS,
    LABELS,
    PERFORMANCE,
    POSE,
    RECORDING,
    SCORE,
    SILENCE,
    InputKind,
)

from .collected import all_cases
from .setting_cases import BASE, CASES, SKIN

if TYPE_CHECKING:
    pass

pytestmark = pytest.mark.usefixtures("rules_file")
TEXT = "Maybe you knew my moon, really?"
ANGRY = (Display("anger", 1.0),)


@pytest.fixture(scope="module")
def solvers() -> Callable[[Settings], Any]:
    """Make one solver for all settings that the face reads alike."""
    made: dict[object, Any] = {}
    make = solvers_module.make_solver

    def solver(settings: Settings) -> Any:
        key = solver_key(settings)
        return made[key] if key in made else made.setdefault(key, make(settings))

    return solver


@pytest.fixture(scope="module")
def spoken() -> Utterance:
    utterance = pipeline.speak(_script(), (), BASE, quiet, None)
    assert utterance is not None
    return utterance


@pytest.fixture(scope="module")
def score(spoken: Utterance) -> Score:
    return pipeline.compose(_script(), spoken, (Display("happiness", 1.0),), BASE)


def _script() -> Script:
    return parse_script(TEXT, ".txt", "text")


def said(settings: Settings) -> object:
    utterance = pipeline.speak(_script(), ANGRY, settings, quiet, None)
    assert utterance is not None
    form = TextForm(settings.format, settings.keep_tags)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ScriptWarning)
        text = parse_script("# One (sighs)", ".txt", form=form).text
    return utterance.phones, utterance.audio.read().tobytes(), text


def planned(spoken: Utterance, settings: Settings) -> object:
    return pipeline.compose(_script(), spoken, ANGRY, settings).movements


def planned_lips(spoken: Utterance, settings: Settings) -> object:
    return pipeline.compose(_script(), spoken, ANGRY, settings).lips


def combined(score: Score, settings: Settings) -> object:
    chosen = replace(score, settings=settings.blend.planned())
    return pipeline.combine(chosen, settings).performance.values.tobytes()


def solved(settings: Settings) -> object:
    (face,) = api.pose({"AU12": 1.0, "AU26": 0.5}, settings=settings).faces()
    return face.skin.tobytes(), face.wrinkles.tobytes()


def drawn(settings: Settings, *also: str) -> list[bytes]:
    movement = {"channel": "emotion", "start": 0.0, "end": 1.0, "onset": 0.4, "offset": 0.4}
    score = {"risorius": 1, "duration": 1.0, "movements": [{**movement, "targets": {"masseter": 1.0}}]}
    Path("x.score.json").write_text(json.dumps(score))
    frames = replace(settings, fps=Fraction(4))
    api.mix("x.score.json", settings=frames).write("x.png", *also)
    return [Path(name).read_bytes() for name in ("x.png", *also)]


def outcome(stage: Stage, settings: Settings, spoken: Utterance, score: Score) -> object:
    """Return the cheapest output that the settings of a stage can change."""
    if stage is Stage.VOICE:
        return said(settings)
    if stage is Stage.PLAN:
        return planned(spoken, settings), planned_lips(spoken, settings)
    if stage in (Stage.COMBINE, Stage.FRAMES):
        return combined(score, settings)
    if stage in (Stage.HEAD, Stage.SHAPE, Stage.SKIN):
        return solved(settings)
    return drawn(settings, *(["x.vrma"] if stage is Stage.OUTPUT else []))


@pytest.mark.parametrize("stage", Stage)
def test_every_setting_changes_an_output(
    stage: Stage,
    spoken: Utterance,
    score: Score,
    solvers: Callable[[Settings], Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(solvers_module, "make_solver", solvers)
    base = SKIN if stage is Stage.APPEARANCE else BASE
    usual = outcome(stage, base, spoken, score)
    with all_cases() as case:
        for row in (row for row in rows(Settings).values() if row.entry.stage is stage):
            with case(row.name):
                assert row.name in CASES, "a new setting: give it a value that is not its default"
                settings = settings_of({row.name: CASES[row.name]}, base)
                assert settings != base
                assert outcome(stage, settings, spoken, score) != usual


def test_a_head_speaks_with_lips_of_its_own(score: Score) -> None:
    assert combined(score, replace(BASE, head="mei")) != combined(score, BASE)


def _performed(kind: InputKind, settings: Settings) -> object:
    """Perform an input of a kind; none of its files is looked at before the settings, but a performance."""
    if kind is PERFORMANCE:
        api.pose({}).write("x.performance.json")
        return api.load("x.performance.json", settings=settings)
    if kind is SILENCE:
        Path("x.bml").write_text('<bml><head id="nod" lexeme="NOD" start="0" end="1" /></bml>')
    performs: dict[str, Callable[..., object]] = {
        RECORDING.what: partial(api.speak, "Oh.", audio="missing.wav"),
        LABELS.what: partial(api.speak, "missing.TextGrid"),
        SILENCE.what: partial(api.speak, "x.bml"),
        SCORE.what: partial(api.speak, "missing.score.json"),
        CAPTURE.what: partial(api.play, "missing.arkit.csv"),
        POSE.what: partial(api.pose, {}),
        CHARACTER.what: partial(api.rig, "missing.glb"),
    }
    return performs[kind.what](settings=settings)


def _refused(kind: InputKind, row: Row) -> tuple[str, ...]:
    """Return the settings that an input of a kind refuses if one has another value than its default."""
    try:
        _performed(kind, settings_of({row.name: CASES[row.name]}))
    except UnusedSettingError as error:
        return error.names
    except RisoriusError:
        pass
    return ()


@pytest.mark.parametrize("kind", INPUTS, ids=lambda kind: kind.what)
def test_every_input_refuses_by_name_what_it_does_not_read(kind: InputKind) -> None:
    with all_cases() as case:
        for row in rows(Settings).values():
            read = row.entry.stage in kind.stages or row.name in kind.also
            with case(row.name):
                assert _refused(kind, row) == (() if read else (row.name,))
