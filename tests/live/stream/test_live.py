"""A live face sent to another program."""

from __future__ import annotations

import io
import os
import socket
import sys
import threading
import time
from collections.abc import Iterator
from types import SimpleNamespace

import numpy as np
import pytest

from risorius import Live, Settings
from risorius.cli import run
from risorius.core.arkit import INDEX
from risorius.errors import OutputError
from risorius.live.stream import PROTOCOLS, ArkitMoment, Options, send_live

QUICK = Settings(lively=False, dynamics="static")


class Datagrams:
    """What arrives at a port, and when."""

    def __init__(self) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.to = f"127.0.0.1:{self.socket.getsockname()[1]}"
        self.got: list[tuple[float, bytes]] = []
        self.thread = threading.Thread(target=self._collect, daemon=True)
        self.thread.start()

    def _collect(self) -> None:
        while data := self.socket.recv(65_536):
            self.got.append((time.monotonic(), data))

    def end(self) -> list[tuple[float, bytes]]:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as last:
            last.sendto(b"", self.socket.getsockname())
        self.thread.join(10.0)
        self.socket.close()
        return self.got


@pytest.fixture
def datagrams() -> Iterator[Datagrams]:
    made = Datagrams()
    yield made
    made.end() if made.thread.is_alive() else made.socket.close()


def face() -> Live:
    return Live(QUICK, fps=30, arkit=True)


def test_each_frame_is_sent_when_it_is_due(datagrams: Datagrams) -> None:
    live, same = face(), face()
    for each in (live, same):
        each.say("Oh.")
        each.close()
    frames = list(same.frames())
    start = time.monotonic()
    assert send_live(live, "livelink", datagrams.to).frames == len(frames)
    got = datagrams.end()
    packets = PROTOCOLS.get("livelink").make(same.fps, Options())
    expected: list[bytes] = []
    for frame in frames:
        assert frame.arkit is not None
        assert frame.rotations is not None
        turns = np.degrees(frame.rotations).reshape(3, 3)
        expected += packets(ArkitMoment(frame.index, frame.arkit, turns[0], turns[1:]))
    assert [data for _, data in got] == expected
    assert got[-1][0] - start > (len(frames) - 1) / 30 - 0.05
    assert max(frame.arkit[INDEX["jawOpen"]] for frame in frames if frame.arkit is not None) > 0.1


def test_a_sentence_that_cannot_be_said_is_told_and_the_face_goes_on(datagrams: Datagrams) -> None:
    live = face()
    told: list[str] = []
    text = "Far too many words for one short second of sound, as nobody on earth says them."
    live.say(audio=np.full(8_000, 0.1), rate=8_000, text=text)
    live.close()
    assert send_live(live, "vmc", datagrams.to, progress=lambda line, *_: told.append(line)).frames > 20
    assert "do not fit" in " ".join(told)


@pytest.fixture
def device(monkeypatch: pytest.MonkeyPatch) -> list[np.ndarray]:
    """A sound device that takes a tenth of a second before it is full; returns what it plays."""
    played: list[np.ndarray] = []

    class Output:
        latency = 0.1

        def __init__(self, samplerate: int, **_: object) -> None:
            self.rate, self.until = samplerate, time.monotonic()

        def write(self, samples: np.ndarray) -> None:
            played.append(samples[:, 0].copy())
            now = time.monotonic()
            self.until = max(self.until, now) + len(samples) / self.rate
            time.sleep(max(self.until - now - self.latency, 0.0))

        def start(self) -> None: ...
        def stop(self) -> None: ...
        def close(self) -> None: ...

    fake = SimpleNamespace(OutputStream=Output, PortAudioError=OSError)
    monkeypatch.setitem(sys.modules, "sounddevice", fake)
    return played


def test_the_sound_is_played_whole_and_sets_the_pace(datagrams: Datagrams, device: list[np.ndarray]) -> None:
    live, same = face(), face()
    for each in (live, same):
        each.say("Oh.")
        each.close()
    frames = list(same.frames())
    start = time.monotonic()
    send_live(live, "livelink", datagrams.to, sound=True)
    np.testing.assert_array_equal(np.concatenate(device), np.concatenate([f.sound for f in frames]))
    assert time.monotonic() - start > len(frames) / 30
    assert len(datagrams.end()) == len(frames)


def test_without_a_device_it_says_so(datagrams: Datagrams, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    with pytest.raises(OutputError, match="expected --without-sound"):
        send_live(face(), "livelink", datagrams.to, sound=True)


STREAMED = ["stream", "-", "--without-sound", "--still", "--skin", "static", "--fps", "30"]


def test_standard_input_is_said_as_it_comes(
    datagrams: Datagrams, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    reading, writing = os.pipe()
    text = "Ja. Schön. ".encode()
    with os.fdopen(reading, "rb") as source:
        monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=source))
        seen: list[int] = []

        def write() -> None:
            os.write(writing, text[:8])  # in the middle of a character
            while not datagrams.got:
                time.sleep(0.01)
            seen.append(len(datagrams.got))
            os.write(writing, text[8:])
            os.close(writing)

        thread = threading.Thread(target=write)
        thread.start()
        assert run([*STREAMED, "--language", "de", "--to", datagrams.to]) == 0
        thread.join()
    got = datagrams.end()
    assert 0 < seen[0] < len(got)
    assert f"Sent {len(got)} frames" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("data", "fault"),
    [(b"", "stdin: is empty; expected a text"), (b"Oh. \xff", "stdin: is not UTF-8; expected a text")],
)
def test_input_that_cannot_be_said_is_one_line(
    datagrams: Datagrams,
    data: bytes,
    fault: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(data)))
    assert run([*STREAMED, "--to", datagrams.to]) == 2
    assert fault in capsys.readouterr().err


def test_an_emotion_with_times_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*STREAMED, "--emotion", "joy:0.5@1-2"]) == 2
    assert "expected NAME:INTENSITY" in capsys.readouterr().err
