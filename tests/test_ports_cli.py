"""The commands that let performances in and out: one line for each fault."""

import io
import socket
import sys
import threading
from pathlib import Path
from types import SimpleNamespace

import pytest

from risorius.cli import run

FAST = ["--fps", "10"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["play", "none.arkit.csv", "-o", "y.muscles.csv"], "none.arkit.csv: cannot be read"),
        (["play", "none.arkit.csv"], "no output named; expected -o y.mp4"),
        (["play", "x.txt", "-o", "y.muscles.csv"], "x.txt: is to be spoken; expected risorius speak"),
        (["stream", "Hi.", "--protocol", "livlink"], "unknown protocol 'livlink'; did you mean 'livelink'?"),
        (["stream", "Hi.", "--to", "host:x"], "'host:x' is not an address"),
        (["stream", "Hi.", "--to", "a", "--listen", "b"], "--to and --listen exclude each other"),
        (["stream", "Hi.", "--names", "vrm"], "unknown set of names 'vrm'"),
        (["rig", "none.glb"], "none.glb: cannot be read"),
        (["rig", "none.glb", "--perform", "Hi."], "--perform and -o go together"),
        (["speak", "Hi.", "-o", "none/x.glb"], "the folder 'none' does not exist"),
        (["pose", "AU12=1", "-o", "x.visemes.json"], ".visemes.json needs spoken words, and there are none"),
    ],
)
def test_faults_are_one_line(
    arguments: list[str],
    message: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(arguments) == 2
    error = capsys.readouterr().err
    assert error.startswith("risorius: ")
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_reached_is_told_before_the_face_is_made(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("risorius.face.fit.arkit_fit.ArkitFit.track", lambda *_: pytest.fail("made"))
    assert run(["stream", "Oh.", "--to", "no.such.host.invalid", "--without-sound", *FAST]) == 2
    assert "risorius: 'no.such.host.invalid:11111' cannot be reached" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    assert run(["stream", "Oh.", *FAST]) == 2
    assert "risorius: sound needs sounddevice" in capsys.readouterr().err


def test_a_sentence_is_streamed(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(b"Ja.")))
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", 0))
    receiver.settimeout(60.0)
    got: list[bytes] = []

    def collect() -> None:
        while not got or got[-1]:
            got.append(receiver.recv(2048))

    to = f"127.0.0.1:{receiver.getsockname()[1]}"
    thread = threading.Thread(target=collect)
    thread.start()
    assert (
        run(["stream", "-", "--language", "de", "--to", to, "--without-sound", "--subject", "me", *FAST]) == 0
    )
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as last:
        last.sendto(b"", receiver.getsockname())  # the end
    thread.join(10.0)
    receiver.close()
    frames = [data for data in got if data]
    assert {len(data) for data in frames} == {306 + 2}
    assert f"Sent {len(frames)} frames" in capsys.readouterr().err


def test_what_the_weights_leave_over_is_said(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    outputs = ["-o", str(tmp_path / "x.arkit.csv"), "-o", str(tmp_path / "x.vrma")]
    assert run(["speak", "Oh.", "--still", "--skin", "static", *FAST, *outputs]) == 0
    told = [
        line
        for line in capsys.readouterr().err.splitlines()
        if line.startswith("ARKit weights differ from the face by 0.")
    ]
    assert len(told) == 1
    assert told[0].endswith(" mm at most")
