"""The worker program, spoken to as it is: one JSON line in, one JSON line and sound out."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from risorius.speech.engines import worker as worker_module


@pytest.fixture
def worker():
    with subprocess.Popen(
        [sys.executable, worker_module.__file__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as process:
        yield process
        process.stdin.close()


def ask(worker, line: str):
    worker.stdin.write(line.encode() + b"\n")
    worker.stdin.flush()
    answer = json.loads(worker.stdout.readline())
    return answer, worker.stdout.read(answer["bytes"])


def test_bad_requests_are_answered_and_survived(worker) -> None:
    for line in (
        "",
        "no JSON",
        "[]",
        "{}",
        '{"op": "sing"}',
        '{"op": "speak"}',
        '{"op": "speak", "text": 5, "voice": "en-us"}',
        '{"op": "speak", "text": "a", "voice": "xx"}',
        '{"op": "transcribe", "voice": "en-us"}',
    ):
        answer, sound = ask(worker, line)
        assert answer["error"]
        assert sound == b""
    answer, sound = ask(worker, json.dumps({"op": "speak", "text": "Well.", "voice": "en-us"}))
    assert answer["bytes"] == len(sound) > 10_000
    assert [name for _, name, _ in answer["phones"]][:3] == ["w", "'E", "l"]


def test_the_end_of_input_ends_it(worker) -> None:
    worker.stdin.close()
    assert worker.wait(timeout=5) == 0


def test_positions_are_those_of_the_words(worker) -> None:
    text = "naïve 😀 map"
    answer, _ = ask(worker, json.dumps({"op": "speak", "text": text, "voice": "en-us", "ipa": True}))
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
