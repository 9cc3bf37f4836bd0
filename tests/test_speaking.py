"""Speaking beside what loads: the same take and pictures as in one process, whatever becomes of the other."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import risorius
from risorius import Look, Settings, speaking
from risorius.api import speak
from risorius.cli import run
from risorius.core.progress import quiet
from risorius.errors import HeadError, InputError, warnings_to
from risorius.machine.workers import Worker
from risorius.render import Renderer, RendererSetup, protocol
from risorius.speaking import speak_and_prepare

SMALL = Settings(size="48x48", fps=5, look=Look(quality="draft"), dynamics="static", profile="lively")
LINE: dict[str, Any] = {"script": "Oh, Hans said møøse.", "text": True, "emotion": ("anger:0.5@0-0.4",)}


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[Worker]:
    """The workers that speak."""
    begun: list[Worker] = []

    class Noted(Worker):
        def __init__(self) -> None:
            super().__init__()
            begun.append(self)

    monkeypatch.setenv("RISORIUS_THREADS", "")
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)
    monkeypatch.setattr(speaking, "Worker", Noted)
    return begun


def told_by(
    perform: Callable[..., risorius.Take],
) -> tuple[risorius.Take, list[tuple[object, ...]], list[str]]:
    told: list[tuple[object, ...]] = []
    warned: list[str] = []
    with warnings_to(warned.append):
        take = perform(lambda *said: told.append(said))
    return take, [said for said in told if "ompil" not in str(said)], warned


def test_take_pictures_and_what_is_told_are_the_same(
    started: list[Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    here, *said_here = told_by(lambda progress: speak(**LINE, settings=SMALL, progress=progress))
    beside, *said_beside = told_by(lambda progress: speak_and_prepare(LINE, SMALL, progress))
    assert [worker.is_closed for worker in started] == [True]
    assert said_beside == said_here
    assert said_here[0] == [("Speaking …",)]
    assert (beside.score, beside.settings) == (here.score, here.settings)
    np.testing.assert_array_equal(beside.performance.values, here.performance.values)
    opened: list[RendererSetup] = []
    open_renderer = protocol.open_renderer

    def open_counted(setup: RendererSetup) -> Renderer:
        opened.append(setup)
        return open_renderer(setup)

    monkeypatch.setattr("risorius.render.open_renderer", open_counted)
    pictures = [picture.copy() for picture in beside.pictures()]
    assert not opened, "the renderer that was prepared is not used"
    np.testing.assert_array_equal(pictures, list(here.pictures()))
    assert len(opened) == 1
    next(beside.pictures((32, 32), [0]))
    assert [setup.size for setup in opened[1:]] == [(32, 32)]


def test_warnings_are_passed_on(started: list[Worker], tmp_path: Path) -> None:
    words = tmp_path / "words.wav"
    speak("Mum put the map by the beam, and then she went home.", text=True).write(words)
    other = "Mum put the elephant by the beam, and then she went home."
    line: dict[str, Any] = {"script": other, "audio": words, "text": True}
    *_, here = told_by(lambda progress: speak(**line, settings=SMALL, progress=progress))
    *_, beside = told_by(lambda progress: speak_and_prepare(line, SMALL, progress))
    assert here
    assert beside == here
    assert len(started) == 1


def test_an_error_comes_with_its_place(started: list[Worker], tmp_path: Path) -> None:
    script = tmp_path / "wrong.xml"
    script.write_text("<nonsense/>")
    errors = []
    perform: Callable[[], risorius.Take]
    for perform in (lambda: speak(script), lambda: speak_and_prepare({"script": script}, SMALL, quiet)):
        with pytest.raises(InputError) as caught:
            perform()
        errors.append((str(caught.value), caught.value.place))
    assert errors[0] == errors[1]
    assert errors[0][1] is not None
    assert [worker.is_closed for worker in started] == [True]


@pytest.mark.parametrize("task", ["os:_exit", "risorius.none:perform"])
def test_a_process_that_ends_costs_nothing_but_time(
    task: str, started: list[Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(speaking, "TASK", task)
    take = speak_and_prepare(LINE, SMALL, quiet)
    assert take.score == speak(**LINE, settings=SMALL).score
    assert len(started) == 1


def test_it_is_ended_with_the_command(started: list[Worker], monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(speaking, "load_head", interrupted)
    with pytest.raises(KeyboardInterrupt):
        speak_and_prepare(LINE, SMALL, quiet)
    assert started[0].is_closed


def test_a_head_that_cannot_be_loaded_is_told_once(started: list[Worker], tmp_path: Path) -> None:
    (tmp_path / "head.npz").write_bytes(b"none")
    with pytest.raises(HeadError, match="damaged"):
        speak_and_prepare(LINE, Settings(head=str(tmp_path)), quiet)
    assert [worker.is_closed for worker in started] == [True]


def test_no_process_is_started_without_a_processor_for_it(
    started: list[Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RISORIUS_THREADS", "1")
    assert speak_and_prepare(LINE, SMALL, quiet).score == speak(**LINE, settings=SMALL).score
    assert not started


def test_films_are_spoken_beside_and_other_files_are_not(started: list[Worker], tmp_path: Path) -> None:
    assert run(["speak", "Hi.", "-o", str(tmp_path / "x.TextGrid")]) == 0
    assert not started
    small = ["--size", "48x48", "--fps", "5", "--quality", "draft"]
    assert run(["speak", "Hi.", *small, "-o", str(tmp_path / "x.mp4")]) == 0
    assert len(started) == 1
    settings = Settings(size="48x48", fps=5, look=Look(quality="draft"))
    speak("Hi.", text=True, settings=settings).write(tmp_path / "y.mp4")
    assert (tmp_path / "x.mp4").read_bytes() == (tmp_path / "y.mp4").read_bytes()
