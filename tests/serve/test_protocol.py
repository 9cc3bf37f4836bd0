"""Texts that are not UTF-8 are told to the client, who is closed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import pytest
from websockets.exceptions import ConnectionClosed

from .running import Client, running


@pytest.fixture
def client() -> Iterator[Client]:
    with running() as server, server.client() as made:
        yield made


@pytest.mark.parametrize("fragments", [[b'{"do": "sai\xff"}'], [b'{"do": "sai\xc3', b'"}']])
def test_a_text_that_is_not_utf8_is_told_and_closes(
    client: Client, fragments: list[bytes], caplog: pytest.LogCaptureFixture
) -> None:
    """A character may be cut between two fragments, but not be left out."""
    assert client.start(fps=10)["is"] == "started"
    client.socket.send(fragments if len(fragments) > 1 else fragments[0], text=True)
    assert client.until("error")["message"] == "the message is not UTF-8; expected JSON"
    with suppress(ConnectionClosed):
        for _ in range(100):
            client.receive()
    assert client.socket.protocol.close_code == 1007
    assert not caplog.records


def test_a_character_may_be_cut_between_two_fragments(client: Client) -> None:
    assert client.start(fps=10)["is"] == "started"
    client.socket.send([b'{"do": "sai\xc3', b'\xa9"}'], text=True)
    assert "sai\u00e9" in client.until("error")["message"]
