import os
import threading
from collections.abc import Iterator
from io import FileIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.ports.video import messages
from tests.profiles import examples

Pipe = tuple[FileIO, FileIO]


@pytest.fixture
def pipe() -> Iterator[Pipe]:
    reading, writing = os.pipe()
    with FileIO(reading, "r") as source, FileIO(writing, "w") as sink:
        yield source, sink


def test_a_pipe_closed_between_messages_is_noticed(pipe: Pipe) -> None:
    pipe[1].close()
    with pytest.raises(EOFError):
        messages.receive(pipe[0])


def test_a_pipe_closed_within_a_message_is_noticed(pipe: Pipe) -> None:
    messages.send(pipe[1], messages.SOUND, b"1234")
    pipe[0].read(6)
    pipe[1].close()
    with pytest.raises(EOFError):
        messages.receive(pipe[0])


def test_a_reader_that_is_gone_is_noticed(pipe: Pipe) -> None:
    pipe[0].close()
    with pytest.raises(OSError, match="Broken pipe"):
        messages.send(pipe[1], messages.END)


def test_a_message_larger_than_the_pipe_arrives_whole(pipe: Pipe) -> None:
    payload = os.urandom(3_000_000)
    sender = threading.Thread(target=messages.send, args=(pipe[1], messages.PICTURE, payload))
    sender.start()
    kind, received = messages.receive(pipe[0])
    assert (kind, bytes(received)) == (messages.PICTURE, payload)
    sender.join()


@examples(30)
@given(st.text(), st.integers(1, 9999), st.integers(1, 9999), st.none() | st.integers(1, 99_999))
def test_a_setup_is_read_back(path: str, width: int, height: int, rate: int | None) -> None:
    setup = messages.Setup(path, width, height, "24000/1001", rate)
    assert messages.Setup.decode(setup.encode()) == setup
