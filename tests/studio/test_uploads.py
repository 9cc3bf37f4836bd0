"""Uploads that are broken off, or are larger than they may be."""

from __future__ import annotations

import os
import time

import anyio
import pytest
from starlette.requests import Request

from risorius.studio import app
from risorius.studio.uploads import TooLargeError, UnfinishedUploadError, to_file, to_memory


def request(*messages):
    left = list(messages)

    async def receive():
        return left.pop(0)

    return Request({"type": "http", "method": "POST", "headers": []}, receive)


PIECE = {"type": "http.request", "body": b"ab", "more_body": True}
ENDS = [
    ({"type": "http.disconnect"}, UnfinishedUploadError),
    ({"type": "http.request", "body": bytes(100), "more_body": False}, TooLargeError),
]


@pytest.mark.parametrize(("end", "error"), ENDS)
def test_an_upload_that_does_not_come_whole_leaves_nothing(tmp_path, end, error):
    with pytest.raises(error):
        anyio.run(to_file, request(PIECE, end), tmp_path, 50)
    assert not list(tmp_path.iterdir())
    with pytest.raises(error):
        anyio.run(to_memory, request(PIECE, end), 50)


def test_a_server_sweeps_away_what_a_killed_one_had_begun_to_take_in(tmp_path, monkeypatch):
    monkeypatch.setattr(app, "warm_up", lambda solvers: None)
    studio = app.Studio(tmp_path)

    async def begin():
        async with studio.app().router.lifespan_context(None):
            pass

    session = tmp_path / "line"
    session.mkdir()
    names = ("upload-killed", "upload-under-way", "recording.wav", "uploads")
    for name in names:
        (session / name).write_bytes(b"RIFF")
    day = time.time() - 90_000
    for name in names:
        if name != "upload-under-way":
            os.utime(session / name, (day, day))
    anyio.run(begin)
    assert {path.name for path in session.iterdir()} == set(names) - {"upload-killed"}
