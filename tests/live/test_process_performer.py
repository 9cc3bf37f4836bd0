"""Performing beside the frames: the same as here, whatever becomes of the process."""

from __future__ import annotations

import gc
import os
import pickle
import threading
from collections.abc import Iterator
from itertools import islice

import numpy as np
import pytest

from risorius import Live
from risorius.errors import RisoriusError, SpeechError, UnusedSettingError
from risorius.live import process_performer
from risorius.live.crossfade import CROSSFADE
from risorius.live.frame import LiveFrame
from risorius.live.pace import Pace
from risorius.live.performer import LocalPerformer, Played, perform_sentence
from risorius.live.process_performer import LostError, PerformerWorker, ProcessPerformer
from risorius.live.turn import TAIL
from risorius.machine.workers import WorkerError
from risorius.rules.emotions import Displays
from risorius.settings import Settings
from risorius.speech.engines.espeak import EspeakEngine
from risorius.speech.engines.protocol import Rendition, SpeechRequest

CHOSEN = Settings(lead=CROSSFADE, tail=TAIL)


@pytest.fixture(scope="module")
def process() -> Iterator[PerformerWorker]:
    """A process that has loaded."""
    process = PerformerWorker()
    while True:
        try:
            process.ask("text", "Oh.", (), CHOSEN)
            break
        except LostError:
            assert not process.is_lost
            threading.Event().wait(0.02)
    yield process
    process.close()


def same(one: Played, other: Played) -> None:
    np.testing.assert_array_equal(one.values, other.values)
    np.testing.assert_array_equal(one.samples, other.samples)
    assert (one.sample_rate, one.words) == (other.sample_rate, other.words)


def test_it_performs_as_here_and_says_what_is_wrong(process: PerformerWorker) -> None:
    performer, text = ProcessPerformer(process), "I like it. Do you? "
    same(performer.text(text, (), CHOSEN), LocalPerformer().text(text, (), CHOSEN))
    with pytest.raises(SpeechError, match="unknown voice"):
        process.ask("text", "Oh.", (), Settings(voice="nobody"))
    same(performer.text("Oh.", (), CHOSEN), LocalPerformer().text("Oh.", (), CHOSEN))


def test_a_turn_that_grows_is_spoken_only_where_it_has_grown(monkeypatch: pytest.MonkeyPatch) -> None:
    spoken, speak = [], EspeakEngine.synthesize

    def counted(engine: EspeakEngine, request: SpeechRequest) -> Rendition:
        spoken.append(request.text.strip())
        return speak(engine, request)

    monkeypatch.setattr(EspeakEngine, "synthesize", counted)
    performer = LocalPerformer()
    for text in ("I like it. ", "I like it. Do you? ", "I like it. Do you? I do. "):
        grown = performer.text(text, (), CHOSEN)
    # A sentence is spoken anew once another follows it: then it has its pause.
    assert spoken == ["I like it.", "I like it.", "Do you?", "Do you?", "I do."]
    same(grown, LocalPerformer().text("I like it. Do you? I do. ", (), CHOSEN))


def test_a_process_that_ends_costs_nothing_but_time() -> None:
    process = PerformerWorker()
    # Loading still: it is performed here.
    said = ProcessPerformer(process).text("Oh.", (), CHOSEN)
    process.close()
    assert process.is_lost
    same(ProcessPerformer(process).text("Oh.", (), CHOSEN), said)
    with pytest.raises(LostError):
        process.ask("text", "Oh.", (), CHOSEN)


class _Process:
    """Stands for a process that is loading."""

    started = 0

    def __init__(self) -> None:
        type(self).started += 1
        self.is_lost = False

    def ask(self, task: str, *arguments: object) -> Played:
        raise LostError


def test_faces_share_processes_and_a_lost_one_is_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process_performer, "PerformerWorker", _Process)
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    _Process.started, processes = 0, process_performer.Processes()
    faces = [processes.performer() for _ in range(4)]
    assert _Process.started == 1
    faces += [processes.performer() for _ in range(20)]
    assert _Process.started == 2
    used = [face.process for face in faces if isinstance(face, ProcessPerformer)]
    assert sorted(used.count(process) for process in set(used)) == [12, 12]
    used[0].is_lost = True  # type: ignore[misc]
    faces += [processes.performer()]
    assert _Process.started == 3
    del faces, used
    gc.collect()
    for _ in range(3):
        processes.performer()
    assert _Process.started == 3


def test_where_no_process_can_be_started_it_is_performed_here(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused() -> PerformerWorker:
        raise WorkerError("could not be started: no more processes")

    monkeypatch.setattr(process_performer, "PerformerWorker", refused)
    assert isinstance(process_performer.Processes().performer(), LocalPerformer)


def test_a_paced_face_does_not_wait_for_what_joins_before_the_last_call(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It joins as soon as it is performed, and where the turn would end otherwise it is waited for."""
    monkeypatch.setattr(Pace, "wait", lambda *_: 0.0)
    first, second = "I like it very much here, my dear friend. ", "Do you? "
    joined, allowed = threading.Event(), threading.Event()

    def perform(text: str, feelings: Displays, chosen: Settings):  # type: ignore[no-untyped-def]
        if second.strip() in text:
            joined.set()
            assert allowed.wait(30)
        return perform_sentence(text, feelings, chosen)

    def said(at: int | None) -> list[LiveFrame]:
        joined.clear()
        allowed.set() if at is None else allowed.clear()
        face = Live(perform=perform)
        face.say(first + "Do")
        iterator = face.frames(paced=True)
        frames = list(islice(iterator, 5))
        face.say(" you? ")
        face.close()
        while at is not None and len(frames) < at:
            frames.append(next(iterator))
        assert at is None or joined.wait(30)
        allowed.set()
        return frames + list(iterator)

    (early, late) = said(None), said(40)
    assert len(early) == len(late)
    np.testing.assert_array_equal([f.sound for f in late[:-1]], [f.sound for f in early[:-1]])
    np.testing.assert_allclose([f.values for f in late[50:]], [f.values for f in early[50:]], atol=1e-6)


@pytest.mark.parametrize(
    "error",
    [SpeechError("it ended"), UnusedSettingError(["lead"], "nothing reads it"), RisoriusError("a" * 300)],
)
def test_errors_come_through_as_they_are(error: RisoriusError) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert (str(again), vars(again)) == (str(error), vars(error))


def test_the_process_is_started_when_frames_are_to_come_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not with the first frame or the first sentence: it loads for a second or more."""
    started: list[object] = []
    processes = process_performer.Processes()
    monkeypatch.setattr(process_performer, "shared_processes", processes)
    monkeypatch.setattr(process_performer, "PerformerWorker", lambda: started.append(1) or FakeProcess())
    process_performer.warm_processes()
    process_performer.warm_processes()
    assert len(started) == 1
    faces = [Live() for _ in range(2)]
    iterators = [faces[0].frames(paced=True), faces[1].aframes()]
    assert len(started) == 1
    del iterators


class FakeProcess:
    is_lost = False
