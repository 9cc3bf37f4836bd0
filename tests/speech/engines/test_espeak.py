"""The espeak-ng engine: failing workers are replaced once, then reported; equal requests give equal bytes."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

from risorius.errors import SpeechError
from risorius.machine import workers
from risorius.machine.workers import Worker
from risorius.speech.engines.espeak import EspeakEngine
from risorius.speech.engines.protocol import SpeechRequest, Voice
from risorius.speech.engines.registry import ENGINES, load_engine
from risorius.speech.engines.voices import find_voice

AMERICAN = Voice("en-us", ("en-us", "en"), "male", "English (America)", "gmw/en-US")
HELLO = SpeechRequest("Hello, my baby.", AMERICAN)


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[Worker]:
    """The workers that engines start from here on."""
    made: list[Worker] = []
    monkeypatch.setattr(workers, "Worker", lambda: made.append(Worker()) or made[-1])
    return made


def test_a_worker_that_fails_twice_is_reported_and_not_tried_again(misbehaving) -> None:
    worker = misbehaving("die")
    with (
        EspeakEngine(worker.task) as engine,
        pytest.raises(
            SpeechError,
            match=r"failed twice in a row; the second time it ended .*\(exit code 3\): all is lost",
        ),
    ):
        engine.synthesize(HELLO)
    assert worker.starts == 2


@pytest.mark.parametrize("mode", ["hang", "deaf"])
def test_a_worker_that_hangs_twice_is_reported_in_time(misbehaving, mode, started: list[Worker]) -> None:
    worker = misbehaving(mode)
    with (
        EspeakEngine(worker.task, seconds=1.0, seconds_per_character=0) as engine,
        pytest.raises(SpeechError, match=r"no answer within 1 s"),
    ):
        engine.synthesize(HELLO)
    assert len(started) == 2


@pytest.mark.parametrize("mode", ["die_once", "hang_once"])
def test_a_worker_that_fails_once_is_replaced_and_the_request_repeated(misbehaving, engine, mode) -> None:
    worker = misbehaving(mode)
    with EspeakEngine(worker.task, seconds=10.0) as replaced:
        assert_same(replaced.synthesize(HELLO), engine.synthesize(HELLO))
    assert worker.starts == 2


def test_a_worker_that_is_killed_is_replaced(started: list[Worker]) -> None:
    with EspeakEngine() as engine:
        first = engine.synthesize(HELLO)
        os.kill(started[0].pid, signal.SIGKILL)
        assert_same(engine.synthesize(HELLO), first)
    assert len(started) == 2


def test_the_timeout_grows_with_the_text(misbehaving) -> None:
    with (
        EspeakEngine(misbehaving("hang").task, seconds=0.1, seconds_per_character=0.05) as engine,
        pytest.raises(SpeechError, match=r"no answer within 0\.6 s"),
    ):
        engine.synthesize(SpeechRequest("ten chars.", AMERICAN))


def test_an_error_that_the_worker_tells_is_no_reason_to_restart(started: list[Worker]) -> None:
    with EspeakEngine() as engine:
        with pytest.raises(SpeechError, match="does not know the voice 'gmw/en-XX'"):
            engine.synthesize(SpeechRequest("Hello.", Voice("x", ("en-us",), "", "", "gmw/en-XX")))
        engine.synthesize(HELLO)
    assert len(started) == 1


def test_equal_requests_give_equal_bytes_within_and_across_processes(engine) -> None:
    request = SpeechRequest("She sells sea shells; the shells she sells are shells, I'm sure.", AMERICAN)
    renditions = [engine.synthesize(request) for _ in range(3)]
    engine.synthesize(HELLO)
    renditions.append(engine.synthesize(request))
    with EspeakEngine() as other:
        renditions.append(other.synthesize(request))
    for rendition in renditions[1:]:
        assert_same(rendition, renditions[0])


def test_a_closed_engine_starts_again(engine, started: list[Worker]) -> None:
    with EspeakEngine() as other:
        other.synthesize(HELLO)
        other.close()
        assert [worker.is_closed for worker in started] == [True]
        assert_same(other.synthesize(HELLO), engine.synthesize(HELLO))
    assert len(started) == 2


def test_threads_share_a_worker(engine) -> None:
    texts = ["One apple.", "Two pears.", "Three plums.", "Four figs."]
    alone = [engine.synthesize(SpeechRequest(text, AMERICAN)) for text in texts]
    together: dict[int, object] = {}

    def speak(index: int) -> None:
        together[index] = engine.synthesize(SpeechRequest(texts[index % 4], AMERICAN))

    threads = [threading.Thread(target=speak, args=(index,)) for index in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for index, rendition in together.items():
        assert_same(rendition, alone[index % 4])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_gets_a_worker_of_its_own() -> None:
    program = """if True:
        import os
        from risorius.speech.engines.registry import load_engine
        from risorius.speech.synthesis import synthesize_line
        said = synthesize_line("Hello there.").phones
        if not (child := os.fork()):
            os._exit(0 if synthesize_line("Hello there.").phones == said else 1)
        assert os.waitpid(child, 0)[1] == 0
        assert synthesize_line("Hello there.").phones == said
    """
    subprocess.run([sys.executable, "-W", "ignore", "-c", program], check=True, timeout=30)


def test_words_are_transcribed_one_by_one(engine) -> None:
    words = ["of", "the", "Map", "car", "", "—", "button"]
    assert engine.transcribe(words, AMERICAN) == (
        ("AH", "V"),
        ("DH", "AH"),
        ("M", "AE", "P"),
        ("K", "AA", "R"),
        (),
        (),
        ("B", "AH", "T", "AH", "N"),
    )
    german = find_voice("de", engine=engine)
    assert engine.transcribe(["schön"], german) == (("ʃ", "øː", "n"),)


def test_rate_and_pitch_change_the_sound(engine) -> None:
    usual = engine.synthesize(HELLO)
    fast = engine.synthesize(SpeechRequest(HELLO.text, AMERICAN, rate=350))
    high = engine.synthesize(SpeechRequest(HELLO.text, AMERICAN, pitch=90))
    assert len(fast.samples) < 0.7 * len(usual.samples)
    assert [p.symbol for p in fast.phones] == [p.symbol for p in usual.phones]
    assert not np.array_equal(high.samples, usual.samples)


def test_the_engine_is_registered_and_shared() -> None:
    assert "espeak" in ENGINES.names() or load_engine()
    assert load_engine() is load_engine("espeak")


def assert_same(a, b) -> None:
    assert a.phones == b.phones
    assert np.array_equal(a.samples, b.samples)
