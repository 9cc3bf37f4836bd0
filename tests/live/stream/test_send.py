"""Frames on time over a real socket, and the faults of the line."""

from __future__ import annotations

import socket
import sys
import threading
from collections.abc import Iterator
from fractions import Fraction
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest

from risorius.core.speech.audio import silence
from risorius.errors import InputError, OutputError
from risorius.live.stream import Address, parse_address, receiver_socket, send
from risorius.live.stream import clock as clocks
from risorius.live.stream.clock import MachineClock, SoundClock

from .clocks import SleepingClock

FPS = Fraction(50)


class Receiver:
    """Collects datagrams."""

    def __init__(self) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(5.0)
        self.got: list[bytes] = []
        self.address = Address("127.0.0.1", self.socket.getsockname()[1])

    def collect(self, last: bytes) -> threading.Thread:
        def run() -> None:
            data = b""
            while data != last:
                data = self.socket.recv(2048)
                self.got.append(data)

        thread = threading.Thread(target=run)
        thread.start()
        return thread


@pytest.fixture
def receiver() -> Iterator[Receiver]:
    found = Receiver()
    yield found
    found.socket.close()


class Steps(MachineClock):
    """A clock that says what it is told to: the time of each question."""

    def __init__(self, times: list[float]) -> None:
        super().__init__()
        self.times = times
        self.slept: list[float] = []

    def now(self) -> float:
        return self.times.pop(0) if len(self.times) > 1 else self.times[0]

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)


@pytest.mark.parametrize(
    "text", ["", ":80", "host:", "host:99999", "host:x", "host:0", "1.2.3.4:5:6", "host:a:9"]
)
def test_no_address(text: str) -> None:
    with pytest.raises(InputError, match="is not an address; expected HOST or HOST:PORT"):
        parse_address(text, 11111)


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("host", Address("host", 39539)),
        ("10.0.0.2:5", Address("10.0.0.2", 5)),
        ("[::1]:7", Address("::1", 7)),
        ("[::1]", Address("::1", 39539)),
    ],
)
def test_addresses(text: str, address: Address) -> None:
    assert parse_address(text, 39539) == address


def test_an_unknown_host_is_named() -> None:
    with pytest.raises(OutputError, match=r"'no\.such\.host\.invalid:9' cannot be reached"):
        send(lambda k: [b"x"], 1, FPS, Address("no.such.host.invalid", 9), MachineClock())


def test_a_receiver_that_is_not_there_is_named(receiver: Receiver) -> None:
    receiver.socket.close()
    with pytest.raises(OutputError, match=r"nothing listens at 127\.0\.0\.1"):
        send(lambda k: [b"x"], 50, FPS, receiver.address, MachineClock())


def test_a_stream_that_nobody_takes_is_named() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        to = Address(*server.getsockname())
    with pytest.raises(OutputError, match=rf"nothing listens at {to}"):
        send(lambda k: [b"x"], 50, FPS, to, MachineClock(), tcp=True)


def test_a_receiver_that_goes_away_is_named() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        to = Address(*server.getsockname())
        threading.Thread(target=lambda: server.accept()[0].close()).start()
        with pytest.raises(OutputError, match=rf"the receiver at {to} has closed the connection"):
            send(lambda k: [b"x" * 1000], 500, FPS, to, MachineClock(), tcp=True)


def test_a_receiver_that_does_not_read_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(receiver_socket, "PATIENCE", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as server:
        to = Address(*server.getsockname())
        with pytest.raises(OutputError, match=rf"'{to}' has not answered for 0.2 s"):
            send(lambda k: [bytes(1_000_000)], 500, FPS, to, MachineClock(), tcp=True)


def test_frames_come_at_their_time(receiver: Receiver) -> None:
    thread, clock = receiver.collect(b"24"), SleepingClock()
    late: list[float] = []

    def packets(k: int) -> list[bytes]:
        late.append(clock.now() - k / 50)
        return [b"%d" % k]

    sent = send(packets, 25, FPS, receiver.address, clock)
    thread.join(10.0)
    assert (sent.frames, sent.dropped) == (25, 0)
    assert receiver.got == [b"%d" % k for k in range(25)]
    # Never early; and the last frame no later than the first ones: nothing piles up.
    assert min(late) > -1e-9
    assert max(late) < 0.001


def test_late_frames_are_dropped(receiver: Receiver) -> None:
    thread = receiver.collect(b"9")
    clock = Steps([0.0, 0.02, 0.13, 0.145, 9.0])
    sent = send(lambda k: [b"%d" % k], 10, FPS, receiver.address, clock)
    thread.join(10.0)
    assert receiver.got == [b"0", b"1", b"6", b"7", b"9"]
    assert (sent.frames, sent.dropped) == (5, 5)


def test_it_waits_for_the_next_frame_and_while_the_sound_has_not_begun(receiver: Receiver) -> None:
    clock = Steps([-0.05, -0.05, 0.0, 0.005, 0.005, 0.02])
    send(lambda k: [b"%d" % k], 2, FPS, receiver.address, clock)
    assert clock.slept == pytest.approx([0.05, 0.015])


class FakeStream:
    latency = 0.1
    opened: ClassVar[list[FakeStream]] = []

    def __init__(self, callback, **settings: object) -> None:
        self.callback, self.settings, self.state = callback, settings, "new"
        self.opened.append(self)

    def start(self) -> None:
        self.state = "playing"

    def stop(self) -> None:
        self.state = "stopped"

    def close(self) -> None:
        self.state = "closed"


def test_the_sound_is_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    fake = SimpleNamespace(OutputStream=FakeStream, PortAudioError=RuntimeError)
    monkeypatch.setitem(sys.modules, "sounddevice", fake)
    monkeypatch.setattr(clocks, "time", SimpleNamespace(perf_counter=lambda: 7.0))
    audio = silence(1.0)
    with SoundClock(audio) as clock:
        stream = FakeStream.opened[-1]
        assert clock.now() == pytest.approx(-0.1)
        out = np.ones((11_025, 1), np.int16)
        stream.callback(out, 11_025, None, None)
        assert not out.any()
        stream.callback(out, 11_025, None, None)
        # The second block begins at 0.5 s and is heard after the latency.
        assert clock.now() == pytest.approx(0.4)
    assert stream.state == "closed"


def test_no_sound_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(**settings: object) -> None:
        raise RuntimeError("no device")

    monkeypatch.setitem(
        sys.modules, "sounddevice", SimpleNamespace(OutputStream=fails, PortAudioError=RuntimeError)
    )
    with pytest.raises(OutputError, match="no sound can be played \\(no device\\); expected --without-sound"):
        SoundClock(silence(0.1))
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    with pytest.raises(OutputError, match="sound needs sounddevice"):
        SoundClock(silence(0.1))
