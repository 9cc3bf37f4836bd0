"""Texts that are not UTF-8 close their connection and nothing else."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import pytest
from websockets.exceptions import ConnectionClosed

from .running import Running, running


@pytest.fixture
def server() -> Iterator[Running]:
    with running() as server:
        yield server


@pytest.mark.parametrize("fragments", [[b'{"do": "sai\xff"}'], [b'{"do": "sai\xc3', b'"}']])
def test_a_text_that_is_not_utf8_closes_its_connection_and_no_other(
    server: Running, fragments: list[bytes]
) -> None:
    """A character may be cut between two fragments, but not be left out."""
    with server.client() as other, server.client() as client:
        assert other.start(fps=10)["is"] == client.start(fps=10)["is"] == "started"
        client.socket.send(fragments if len(fragments) > 1 else fragments[0], text=True)
        with suppress(ConnectionClosed):
            for _ in range(100):
                client.receive()
        assert client.socket.protocol.close_code == 1007
        other.send("close")
        assert other.frames()
    with server.client() as client:
        assert client.start(fps=10)["is"] == "started"


def test_a_character_may_be_cut_between_two_fragments(server: Running) -> None:
    with server.client() as client:
        assert client.start(fps=10)["is"] == "started"
        client.socket.send([b'{"do": "sai\xc3', b'\xa9"}'], text=True)
        assert "sai\u00e9" in client.until("error")["message"]
