"""The example programs of docs/voices.md speak: a command, a service over HTTP, one with times of its own."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import numpy as np
import pytest
import soundfile

from risorius.errors import SpeechError
from risorius.speech.synthesis import synthesize_line

from . import voices

EXAMPLES = Path(__file__).parents[3] / "examples" / "voices"
TEXT = "My brother's lemon, please."


def sound(form: str = "WAV", channels: int = 1) -> bytes:
    """Return a file that espeak-ng's voice might have written: a second of a tone that swells."""
    times = np.arange(22_050) / 22_050
    tone = 0.4 * np.sin(2 * np.pi * 140 * times) * np.sin(np.pi * times)
    file = io.BytesIO()
    soundfile.write(file, np.stack([tone] * channels, 1), 22_050, format=form)
    return file.getvalue()


class Service(BaseHTTPRequestHandler):
    """A service that keeps what it is asked."""

    asked: list[dict[str, object]]
    answer: bytes
    key: str | None

    def do_POST(self) -> None:
        content = self.rfile.read(int(self.headers["Content-Length"]))
        self.asked.append({**json.loads(content), "key": self.headers.get("Authorization")})
        self.send_response(200 if self.answer else 503)
        self.end_headers()
        self.wfile.write(self.answer or b"no voice today")

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@pytest.fixture
def service(monkeypatch: pytest.MonkeyPatch) -> Iterator[type[Service]]:
    kind = type("OneService", (Service,), {"asked": [], "answer": sound()})
    with HTTPServer(("127.0.0.1", 0), kind) as server:
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
        monkeypatch.setenv("VOICE_URL", f"http://127.0.0.1:{server.server_port}/speech")
        monkeypatch.setenv("no_proxy", "127.0.0.1")
        yield kind
        server.shutdown()


def test_a_service_speaks(service: type[Service], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VOICE_KEY", "secret")
    said = synthesize_line(TEXT, voice=str(EXAMPLES / "service.py"), rate=350)
    assert [word.text for word in said.words] == ["My", "brother's", "lemon", "please"]
    assert said.audio.duration == pytest.approx(1.0, abs=0.01)
    (asked,) = service.asked
    assert (asked["text"], asked["speed"], asked["key"]) == (TEXT, 2.0, "Bearer secret")


def test_a_service_that_fails_is_told(service: type[Service]) -> None:
    service.answer = b""
    with pytest.raises(SpeechError, match=r"/speech answered 503: no voice today"):
        synthesize_line(TEXT, voice=str(EXAMPLES / "service.py"))


@pytest.mark.parametrize(
    ("command", "line"),
    [
        ("no-such-command {file}", "no-such-command cannot be started: No such file or directory"),
        ("false {file}", "false failed with exit code 1"),
        ("true {file}", "true wrote no sound to {file}"),
    ],
)
def test_a_command_that_fails_is_told(command: str, line: str) -> None:
    done = subprocess.run(
        [sys.executable, str(EXAMPLES / "command.py")],
        input=json.dumps({"text": "Hi."}),
        env={**os.environ, "VOICE_COMMAND": command},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr) == (1, f"VOICE_COMMAND: {line}\n")


def test_a_command_speaks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "voice.wav").write_bytes(sound())
    copy = (
        "import shutil, sys; open(sys.argv[2], 'w').write(sys.argv[4]); shutil.copy(sys.argv[1], sys.argv[3])"
    )
    words = [sys.executable, "-c", f'"{copy}"', str(tmp_path / "voice.wav"), str(tmp_path / "text")]
    monkeypatch.setenv("VOICE_COMMAND", f"{' '.join(words)} {{file}} {{text}}")
    said = synthesize_line(TEXT, voice=str(EXAMPLES / "command.py"))
    assert len(said.words) == 4
    assert (tmp_path / "text").read_text() == TEXT
    monkeypatch.delenv("VOICE_COMMAND")
    with pytest.raises(SpeechError, match="VOICE_COMMAND is not set"):
        synthesize_line(TEXT, voice=str(EXAMPLES / "command.py"))


def test_a_program_says_when_each_sound_begins() -> None:
    said = synthesize_line("Hello there.", voice=str(EXAMPLES / "json_answer.py"))
    assert [(word.text, round(word.start, 2)) for word in said.words] == [("Hello", 0.0), ("there", 0.26)]


def test_a_program_may_print_a_sound_file_of_any_kind(tmp_path: Path) -> None:
    program = tmp_path / "voice.py"
    for form, channels in (("WAV", 2), ("MP3", 1), ("FLAC", 1), ("OGG", 1)):
        (tmp_path / "voice").write_bytes(sound(form, channels))
        program.write_text(
            f"import sys; sys.stdout.buffer.write(open({str(tmp_path / 'voice')!r}, 'rb').read())"
        )
        said = synthesize_line(TEXT, voice=str(program))
        assert said.audio.duration == pytest.approx(1.0, abs=0.1), form
        assert np.abs(said.audio.read().astype(int)).max() == pytest.approx(13_000, rel=0.1), form


def test_a_file_in_the_answer_needs_no_rate(tmp_path: Path) -> None:
    program = tmp_path / "voice.py"
    (tmp_path / "voice").write_bytes(sound("MP3"))
    program.write_text(
        "import base64, json\n"
        f"data = open({str(tmp_path / 'voice')!r}, 'rb').read()\n"
        "print(json.dumps({'audio': base64.b64encode(data).decode()}))"
    )
    assert synthesize_line(TEXT, voice=str(program)).audio.sample_rate == 22_050


def test_piper_speaks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A stand-in that is called as Piper is, with the files of a voice, as docs/voices.md has it."""
    program, model = tmp_path / "piper", tmp_path / "en_US-amy-medium.onnx"
    program.write_text(f"#!{sys.executable}\n{voices.PIPER}")
    program.chmod(0o755)
    model.write_bytes(b"")
    model.with_name(f"{model.name}.json").write_text('{"espeak": {"voice": "en-us"}}')
    monkeypatch.setenv("PATH", str(tmp_path))
    assert len(synthesize_line(TEXT, voice=str(model)).words) == 4
