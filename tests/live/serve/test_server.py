"""The server of live faces, by real sockets: its law, and what clients do to it and to each other."""

from __future__ import annotations

import base64
import json
import socket as sockets
import threading
from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from risorius import Live, Settings, Take, speak
from risorius.core.arkit import ROTATIONS, SHAPES
from risorius.core.parameters import NAMES
from risorius.errors import InputError, SpeechError
from risorius.live import hearing
from risorius.live.performer import LocalPerformer
from risorius.live.serve import limits
from risorius.live.serve.server import ServeOptions
from risorius.live.voice import VoicedPhrase
from risorius.pipeline import perform
from risorius.ports.mesh.glb_file import GlbFile
from risorius.ports.mesh.rig import Rig
from risorius.script import Script

from .running import Client, Running, running, sound_of, unpacked

TOKEN = "a token of some length"
SAID = "Hi. "
RIG = Rig(
    GlbFile(Path("x.glb"), {}, b""),
    {0: ("open", "left")},
    {"jawOpen": ("open",), "mouthSmileLeft": ("left",)},
)


@pytest.fixture(scope="module")
def server() -> Iterator[Running]:
    with running(rig=RIG, clients=3, origins=("https://example.org",)) as made:
        yield made


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let frames come however late a busy machine makes them."""
    monkeypatch.setattr(limits, "LATE", 60.0)


@pytest.fixture
def client(server: Running) -> Iterator[Client]:
    with server.client() as made:
        yield made


BAD_STARTS: list[tuple[Any, str]] = [
    ({"version": 2}, "version 2; expected 1"),
    ({"version": "1"}, "version"),
    ({"fps": 1000}, "1000 frames a second; expected 1 to 120"),
    ({"fps": "often"}, "fps 'often' is not a number"),
    ({"format": "xml"}, "expected one of json, binary"),
    ({"outputs": ["arkits"]}, "expected one of parameters, arkit, rotations, rig"),
    ({"ahead": 9}, "ahead"),
    ({"head": "olaf"}, "unknown key 'head'"),
    ({"settings": {"rules": "/etc/passwd"}}, "unknown setting 'rules'"),
    ({"settings": {"head": "/etc"}}, "unknown head '/etc'"),
    ({"settings": {"voice": "./voice.py"}}, "is a file"),
    ({"settings": {"profile": "own.toml"}}, "unknown profile"),
    ({"settings": {"articulation": 3}}, "articulation"),
    ({"settings": {"attitudes": ["polite", 3]}}, "attitude"),
]


@pytest.mark.parametrize(("start", "message"), BAD_STARTS, ids=[str(start) for start, _ in BAD_STARTS])
def test_who_asks_for_what_cannot_be_had_is_told_and_dismissed(
    client: Client, start: dict[str, Any], message: str
) -> None:
    answer = client.start(**start)
    assert answer["is"] == "error"
    assert message in answer["message"]
    assert len(answer["message"]) <= 300
    with pytest.raises(ConnectionClosed) as closed:
        client.receive()
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1008


@pytest.mark.parametrize(
    ("message", "error"),
    [
        ("Hello", "is not JSON"),
        ("[]", "is not an object"),
        ("[" * 50 + "]" * 50, "is not an object"),
        ('{"do": "sai", "text": "x"}', "did you mean 'say'"),
        ('{"do": "say"}', "text"),
        ('{"do": "say", "text": 5}', "text"),
        (json.dumps({"do": "say", "text": "x" * 10_001}), "10,001 characters; expected at most 10,000"),
        ('{"do": "feel", "emotion": "angr", "intensity": 1}', "did you mean 'angry'"),
        ('{"do": "feel", "emotion": "anger", "intensity": 2}', "out of range"),
        ('{"do": "listen", "audio": "%%", "rate": 16000}', "not base64"),
        ('{"do": "listen", "audio": "AAAA", "rate": 16000}', "3 bytes"),
        ('{"do": "listen", "audio": "AAA=", "rate": 1}', "sample rate 1"),
        ('{"do": "start", "version": 1}', "the face has started already"),
        (b"\x00\xff", "is not text"),
    ],
)
def test_a_message_that_is_wrong_is_answered_and_the_face_goes_on(
    client: Client, message: str | bytes, error: str
) -> None:
    assert client.start(fps=10)["is"] == "started"
    client.socket.send(message)
    assert error in client.until("error")["message"]
    assert client.until("frame")["is"] == "frame"


def test_frames_are_those_of_the_library_and_the_sound_is_whole(client: Client) -> None:
    started = client.start(settings={"seed": 3, "attitudes": []})
    assert started == {
        "is": "started", "version": 1, "fps": 30.0, "head": "standard", "parameters": list(NAMES),
    }  # fmt: skip
    client.send("feel", emotion="happiness", intensity=0.5)
    client.send("say", text=SAID)
    client.send("close")
    frames = client.frames()
    begun = next(e["index"] for e in client.events if e["is"] == "sentence" and e["text"])

    live = Live(Settings(seed=3))
    expected = list(islice(live.frames(), begun))
    live.feel("happiness", 0.5)
    live.say(SAID)
    live.close()
    expected += live.frames()
    assert [frame["index"] for frame in frames] == list(range(len(expected)))
    assert sum(frame["dropped"] for frame in frames) == 0
    values = np.array([frame["parameters"] for frame in frames])
    heard = np.concatenate([sound_of(frame) for frame in frames[begun:]])
    spoken = np.concatenate([frame.sound for frame in expected[begun:]])
    assert np.array_equal(heard, spoken)
    assert values.shape == (len(expected), len(NAMES))
    np.testing.assert_allclose(values[begun + 5 :], [f.values for f in expected[begun + 5 :]], atol=1e-5)


def test_packed_frames_hold_weights_in_the_order_that_was_asked(client: Client) -> None:
    started = client.start(fps=20, format="binary", outputs=["rig", "arkit", "rotations"])
    assert started["rig"] == ["open", "left"]
    assert started["arkit"] == list(SHAPES)
    assert started["rotations"] == list(ROTATIONS)
    client.send("say", text=SAID)
    client.send("close")
    headers, values, sounds = zip(*map(unpacked, client.frames()), strict=True)
    assert {header["magic"] for header in headers} == {b"RF01"}
    assert [header["time"] for header in headers] == [header["index"] / 20 for header in headers]
    columns = np.array(values)
    assert columns.shape == (len(headers), 2 + len(SHAPES) + 9)
    assert np.array_equal(columns[:, 0], columns[:, 2 + SHAPES.index("jawOpen")])
    assert columns[:, 0].max() > 0.05
    assert np.ptp(columns[:, -9:-6]) > 0.01
    assert np.abs(np.concatenate(sounds)).max() > 1_000


def test_who_is_interrupted_says_what_was_not_said(client: Client) -> None:
    client.start()
    client.send("say", text="One two three four five six seven. And more. ")
    while not client.until("sentence")["text"]:
        pass
    client.send("interrupt")
    unsaid = client.until("interrupted")["unsaid"]
    assert unsaid.endswith("seven. And more.")
    client.send("close")
    client.frames()
    with pytest.raises(ConnectionClosed) as closed:
        client.receive()
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1000


def test_one_that_sends_too_much_goes_and_the_others_stay(server: Running, client: Client) -> None:
    client.start(fps=10)
    with server.client() as other:
        other.start(fps=10)
        with suppress(ConnectionClosed):
            for _ in range(int(limits.MESSAGES_AT_ONCE) + 50):
                other.send("flush")
        assert "too much at once" in other.until("error")["message"]
        with pytest.raises(ConnectionClosed):
            other.receive()
    assert client.until("frame")["is"] == "frame"


def test_one_that_reads_nothing_goes_and_the_others_stay(
    server: Running, client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "UNREAD", 0.3)
    client.start(fps=10)
    narrow = sockets.socket()
    narrow.setsockopt(sockets.SOL_SOCKET, sockets.SO_RCVBUF, 4_096)
    narrow.connect(("127.0.0.1", server.port))
    with server.client(sock=narrow, max_queue=1) as other:
        other.start(fps=120)
        while len(server.live.clients) > 1:
            assert client.until("frame")["dropped"] == 0


def test_an_engine_that_dies_is_one_message(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    def dying(script: Script, *choices: Any, **options: Any) -> Take:
        if "dies" in script.text:
            raise SpeechError("the voice ended")
        return perform(script, *choices, **options)

    monkeypatch.setattr("risorius.live.performer.perform", dying)
    monkeypatch.setattr("risorius.live.session.process_performer", LocalPerformer)
    client.start(fps=20)
    client.send("say", text="It dies. ")
    assert client.until("error")["message"] == "the voice ended"
    client.send("say", text="Oh. ")
    client.send("close")
    client.frames()
    assert [event["text"] for event in client.events if event["is"] == "sentence"] == ["Oh."]


def test_clients_beyond_the_most_are_turned_away_until_one_goes(server: Running, client: Client) -> None:
    client.start(fps=10)
    with server.client() as second, server.client() as third:
        second.start(fps=10)
        third.start(fps=10)
        with server.client() as fourth:
            assert "3 clients are here" in fourth.receive()["message"]
    while len(server.live.clients) > 1:
        client.until("frame")
    with urlopen(f"http://127.0.0.1:{server.port}/health") as answer:
        assert json.load(answer) == {"clients": 1}


def test_one_that_vanishes_leaves_nothing(server: Running, client: Client) -> None:
    client.start(fps=10)
    with server.client() as other:
        other.start(fps=10)
        other.send("say", text="A longer sentence that is being performed. ")
        other.socket.socket.shutdown(sockets.SHUT_RDWR)
    while len(server.live.clients) > 1:
        client.until("frame")


@pytest.mark.parametrize(
    ("headers", "allowed"),
    [
        ({"Origin": "https://example.org"}, True),
        ({"Origin": "https://example.com"}, False),
        ({"Origin": "null"}, False),
        ({"Host": "evil.example"}, False),
    ],
)
def test_pages_of_other_sites_are_refused(server: Running, headers: dict[str, str], allowed: bool) -> None:
    if allowed:
        with server.client(additional_headers=headers) as made:
            assert made.start(fps=10)["is"] == "started"
    else:
        with (
            pytest.raises((InvalidStatus, ConnectionClosed)),
            server.client(additional_headers=headers) as made,
        ):
            made.receive()


def test_a_browser_finds_the_icon_it_asks_for(server: Running) -> None:
    with urlopen(f"http://127.0.0.1:{server.port}/favicon.ico") as answer:
        assert answer.headers["content-type"] == "image/svg+xml"
        assert b"<svg" in answer.read()


@pytest.mark.parametrize(
    ("said", "header", "known"),
    [
        (TOKEN, "", True),
        (None, f"Bearer {TOKEN}", True),
        (None, "", False),
        ("another token, as long", "", False),
        (None, f"Basic {TOKEN}", False),
    ],
)
def test_a_token_is_asked_for(said: str | None, header: str, known: bool) -> None:
    with running(token=TOKEN) as server, server.client(additional_headers={"Authorization": header}) as made:
        answer = made.start(token=said)
        assert answer["is"] == ("started" if known else "error"), answer
        assert known or "wrong token" in answer["message"]


def test_nobody_else_can_use_a_server_without_a_token() -> None:
    with pytest.raises(InputError, match=r"0\.0\.0\.0 can be reached from other machines"):
        ServeOptions(host="0.0.0.0")
    with pytest.raises(InputError, match="at least 16"):
        ServeOptions(token="short")
    assert ServeOptions(host="::1").token is None


def test_a_client_hears_when_it_listens(client: Client) -> None:
    client.start(fps=20, ahead=0.0)
    sound = np.concatenate([np.tile([8_000, -8_000], 12_000), np.zeros(8_000)]).astype("<i2")
    before = client.until("frame")
    client.send("listen", audio=base64.b64encode(sound.tobytes()).decode(), rate=16_000)
    column = list(NAMES).index("head_pitch")
    pitches = [client.until("frame")["parameters"][column] for _ in range(10)]
    assert min(pitches) < before["parameters"][column] - 3.0


def test_a_voice_made_elsewhere_is_played_and_looks_are_obeyed(client: Client) -> None:
    take = speak("Oh, well.", text=True)
    assert take.audio is not None
    assert take.utterance is not None
    sound, rate = take.audio.read(), take.audio.sample_rate
    words = [[word.text, word.start, word.end] for word in take.utterance.words]
    client.start(fps=30, outputs=["rotations"], settings={"lively": False, "seed": 2})
    client.send("look", pitch=0, yaw=20)
    for start in range(0, len(sound), 5_001):
        piece = sound[start : start + 5_001].astype("<i2").tobytes()
        about = {"words": words} if start == 0 else {}
        client.send("say", audio=base64.b64encode(piece).decode(), rate=rate, **about)
    client.send("close")
    frames = client.frames()
    heard = np.concatenate([sound_of(frame) for frame in frames])
    first = int(np.flatnonzero(heard)[0]) - int(np.flatnonzero(sound)[0])
    np.testing.assert_array_equal(heard[first : first + len(sound)], sound)
    last = np.degrees(frames[-1]["rotations"])
    assert last[0] + 0.5 * (last[3] + last[6]) == pytest.approx(20.0, abs=0.1)


def test_a_face_lives_on_while_a_voice_is_heard(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    hear, lived = hearing.hear_phrase, threading.Event()

    def slowly(phrase: VoicedPhrase, language: str) -> hearing.HeardPhrase:
        assert lived.wait(20)
        return hear(phrase, language)

    monkeypatch.setattr(hearing, "hear_phrase", slowly)
    monkeypatch.setattr("risorius.live.session.process_performer", LocalPerformer)
    client.start(fps=30)
    silence = base64.b64encode(bytes(16_000)).decode()
    client.send("say", audio=silence, rate=16_000, text="")
    client.send("close")
    for _ in range(20):
        client.until("frame")
    lived.set()
    # Half a second of silence is played when it has been heard.
    assert len(client.frames()) >= 15


def test_the_last_frame_comes_with_its_sound_however_late(
    client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "LATE", -10.0)
    client.start(fps=30, outputs=["arkit"])
    client.send("say", text=SAID)
    client.send("close")
    (frame,) = client.frames()
    take = speak(SAID, text=True)
    assert take.audio is not None
    assert frame["dropped"] == frame["index"] > 10
    assert len(sound_of(frame)) > 0.8 * len(take.audio.read()) - 1.0 * frame["rate"]
    assert np.abs(sound_of(frame)).max() > 1_000


@pytest.mark.parametrize(
    ("about", "fault"),
    [
        ({"audio": "%", "rate": 8_000}, "not base64"),
        ({"audio": "", "rate": 1}, "sample rate 1"),
        ({"audio": "", "rate": 8_000, "words": [["a", 1.0]]}, "words"),
        ({"audio": "", "rate": 8_000, "encoding": "mp3"}, "unknown encoding"),
    ],
)
def test_a_voice_that_cannot_be_used_is_one_error(client: Client, about: dict[str, Any], fault: str) -> None:
    client.start(fps=10)
    client.send("say", **about)
    assert fault in client.until("error")["message"]
    client.send("look", pitch=3)
    assert "give either a target, or both pitch and yaw" in client.until("error")["message"]
    client.send("look", target="lft")
    assert "'left'" in client.until("error")["message"]
