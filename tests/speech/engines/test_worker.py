"""The task that speaks, asked as the engine asks it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import pytest

from risorius.machine.workers import Worker
from risorius.speech.engines import worker as worker_module


@pytest.fixture
def worker() -> Iterator[Worker]:
    with Worker() as worker:
        yield worker


def ask(worker: Worker, request: object) -> tuple[dict[str, Any], bytes]:
    answer, sound = worker.call(f"{worker_module.__file__}:answer", request)
    return answer, sound


def test_bad_requests_are_answered_and_survived(worker: Worker) -> None:
    for request in (
        [],
        {},
        {"op": "sing"},
        {"op": "speak"},
        {"op": "speak", "text": 5, "voice": "en-us"},
        {"op": "speak", "text": "a", "voice": "xx"},
        {"op": "transcribe", "voice": "en-us"},
    ):
        answer, sound = ask(worker, request)
        assert answer["error"]
        assert sound == b""
    answer, sound = ask(worker, {"op": "speak", "text": "Well.", "voice": "en-us"})
    assert len(sound) > 10_000
    assert [name for _, name, _ in answer["phones"]][:3] == ["w", "'E", "l"]


def test_positions_are_those_of_the_words(worker: Worker) -> None:
    text = "naïve 😀 map"
    answer, _ = ask(worker, {"op": "speak", "text": text, "voice": "en-us", "ipa": True})
    places = {name: position for _, name, position in answer["phones"]}
    assert places["v"] == 0
    assert places["m"] == text.index("map")
    assert len(answer["ipa"]) == len(answer["phones"])


def test_it_imports_nothing_of_the_package() -> None:
    program = (
        "import sys, runpy; runpy.run_path(sys.argv[1], run_name='worker');"
        "print([m for m in sys.modules if m.split('.')[0] in ('risorius', 'numpy', 'scipy', 'numba')])"
    )
    command = [sys.executable, "-I", "-S", "-c", program, worker_module.__file__]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip() == "[]"
