"""Receivers that greet first, at the ports that the app's page for developers names."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

from risorius.core.arkit import INDEX
from risorius.errors import InputError, OutputError
from risorius.live.stream import PROTOCOLS, Address, clock, send_take, wait_for_greeting
from risorius.live.stream.ifacialmocap import GREETINGS
from risorius.live.stream.protocols import Asked
from risorius.live.stream.send import SendCounts
from risorius.take import Take

from .clocks import SleepingClock

GREETING = b"iFacialMocap_sahuasouryya9218sauhuiayeta91555dy3719"
OVER_TCP = b"iFacialMocap_UDPTCP_sahuasouryya9218sauhuiayeta91555dy3719"
PHONE, PC = "127.0.0.2", "127.0.0.1"


def udp(host: str, port: int = 0) -> socket.socket:
    line = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    line.bind((host, port))
    line.settimeout(20.0)
    return line


def free_port(host: str) -> int:
    with udp(host) as line:
        return int(line.getsockname()[1])


@pytest.fixture
def sleeping(monkeypatch: pytest.MonkeyPatch) -> SleepingClock:
    """The clock of what is sent: it sleeps no real time."""
    found = SleepingClock()
    monkeypatch.setattr(clock, "MachineClock", lambda: found)
    return found


@contextmanager
def greeting(port: int, *said: bytes) -> Iterator[None]:
    """Say it again and again, as receivers do until they are answered."""
    answered = threading.Event()

    def run() -> None:
        with udp(PC) as line:
            while not answered.wait(0.02):
                for words in said:
                    line.sendto(words, (PHONE, port))

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield
    finally:
        answered.set()
        thread.join()


def test_nobody_greets() -> None:
    at = Address(PHONE, free_port(PHONE))
    with pytest.raises(OutputError, match=rf"no receiver sent its greeting to {at} within 0.1 s"):
        wait_for_greeting(at, GREETINGS, 0.1)


def test_a_port_that_is_taken_and_an_address_of_another_machine() -> None:
    with udp(PHONE) as taken, pytest.raises(InputError, match=r"cannot listen at '127.0.0.2:\d+': Address"):
        wait_for_greeting(Address(PHONE, taken.getsockname()[1]), GREETINGS, 0.1)
    with pytest.raises(InputError, match=r"cannot listen at '192.0.2.1:9'"):
        wait_for_greeting(Address("192.0.2.1", 9), GREETINGS, 0.1)


def test_a_protocol_without_a_greeting(clip: Take) -> None:
    with pytest.raises(InputError, match=r"livelink has no greeting to wait for; .* one of ifacialmocap$"):
        send_take(clip, "livelink", listen="127.0.0.2")


@pytest.mark.parametrize(
    ("said", "protocol", "dialect"),
    [
        (GREETING, "ifacialmocap", "v1"),
        (GREETING + b"|sendDataVersion=v2", "ifacialmocap", "v2"),
        (GREETING + b"\0", "ifacialmocap", "v1"),
        (OVER_TCP, "ifacialmocap-tcp", "v1"),
        (OVER_TCP + b"|sendDataVersion=v2\n", "ifacialmocap-tcp", "v2"),
    ],
)
def test_who_greets_is_known_with_what_they_ask_for(said: bytes, protocol: str, dialect: str) -> None:
    at = Address(PHONE, free_port(PHONE))
    with greeting(at.port, b"hello", b"", said[:20], said):
        assert wait_for_greeting(at, GREETINGS, 10.0) == (PC, Asked(protocol, dialect))


@pytest.mark.parametrize(("said", "joint"), [(GREETING, "-"), (GREETING + b"|sendDataVersion=v2", "&")])
def test_a_receiver_greets_and_is_sent_the_performance(
    clip: Take, said: bytes, joint: str, sleeping: SleepingClock
) -> None:
    """Both ends at port 49983, as the app and its receivers are, on two addresses of this machine."""
    port = PROTOCOLS.get("ifacialmocap").port
    assert port == 49983
    clip.arkit  # noqa: B018  (fitted before anyone waits)
    sent: list[SendCounts] = []
    with udp(PC, port) as receiver, greeting(port, said):
        thread = threading.Thread(target=lambda: sent.append(send_take(clip, "ifacialmocap", listen=PHONE)))
        thread.start()
        thread.join(60.0)
        got = [receiver.recv(4096) for _ in range(sent[0].frames)]
    assert len(got) == len(clip.times) >= 3
    opened = [dict(part.split(joint) for part in data.decode().split("|=")[0].split("|")) for data in got]
    assert all(len(pairs) == 52 for pairs in opened)
    jaw = [int(pairs["jawOpen"]) for pairs in opened]
    wanted = np.round(100.0 * clip.arkit.weights[:, INDEX["jawOpen"]])
    assert max(jaw) > 10
    assert set(jaw) <= set(wanted)
    assert sleeping.now() == pytest.approx(clip.times[-1], abs=1e-3)


def test_a_receiver_greets_and_is_sent_a_stream(clip: Take, sleeping: SleepingClock) -> None:
    """The app connects to the receiver's port 49986; frames end with a mark, wherever the stream is cut."""
    clip.arkit  # noqa: B018  (fitted before anyone waits)
    sent: list[SendCounts] = []
    with socket.create_server((PC, PROTOCOLS.get("ifacialmocap-tcp").port)) as receiver:
        assert receiver.getsockname()[1] == 49986
        receiver.settimeout(20.0)
        thread = threading.Thread(target=lambda: sent.append(send_take(clip, "ifacialmocap", listen=PHONE)))
        thread.start()
        with greeting(49983, OVER_TCP + b"|sendDataVersion=v2"):
            line, _ = receiver.accept()
        data = b""
        with line:
            while more := line.recv(100):
                data += more
        thread.join(10.0)
    *frames, rest = data.split(b"___iFacialMocap")
    assert rest == b""
    assert len(frames) == sent[0].frames >= 3
    jaw = [
        int(dict(part.split("&") for part in f.decode().split("|=")[0].split("|"))["jawOpen"]) for f in frames
    ]
    assert max(jaw) > 10
    assert set(jaw) <= set(np.round(100.0 * clip.arkit.weights[:, INDEX["jawOpen"]]))
    assert sleeping.now() == pytest.approx(clip.times[-1], abs=1e-3)
