"""Uploads that are broken off, or are larger than they may be."""

from __future__ import annotations

import anyio
import pytest
from starlette.requests import Request

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
