"""`risorius studio`: says where it is, serves, and ends when it is interrupted."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import urllib.request

from risorius.cli import run
from risorius.studio.server import bound


def test_a_port_that_is_taken_is_named(capsys):
    with bound(0) as taken:
        port = taken.getsockname()[1]
        assert run(["studio", "--no-browser", "--port", str(port)]) == 2
    assert f"port {port} cannot be used" in capsys.readouterr().err


def test_it_serves_until_it_is_interrupted(tmp_path):
    command = [
        sys.executable,
        "-m",
        "risorius",
        "studio",
        "--no-browser",
        "--port",
        "0",
        "--folder",
        str(tmp_path),
    ]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        address = re.search(r"http://127\.0\.0\.1:\d+/", process.stderr.readline())[0]
        try:
            with urllib.request.urlopen(address, timeout=60) as answer:
                assert b"<title>" in answer.read()
        finally:
            process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
        assert process.stderr.read() == ""
