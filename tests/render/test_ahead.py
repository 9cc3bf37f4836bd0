from dataclasses import fields

import numpy as np
import pytest

from risorius.render import ahead


class Program:
    """Stands in for a process."""

    def __init__(self):
        self.done = []

    def wait(self, patience=None):
        self.done.append("waited")

    def kill(self):
        self.done.append("killed")


@pytest.fixture
def started(monkeypatch, tmp_path):
    """The programs that are started, with nothing compiled and two processors."""
    found = []
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(ahead, "processors", lambda: 2)
    monkeypatch.setattr(ahead.workers, "start", lambda *_, **__: found.append(Program()) or found[-1])
    return found


def test_what_is_not_compiled_is_and_waited_for(started):
    with ahead.compiled_ahead("realistic"):
        assert started[0].done == []
    assert started[0].done[0] == "waited"


def test_a_block_that_fails_waits_for_nobody(started):
    with pytest.raises(KeyError), ahead.compiled_ahead("clay"):
        raise KeyError
    assert started[0].done[0] == "killed"


def test_what_is_compiled_is_not_compiled_again(started, tmp_path):
    ahead._mark("muscles").touch()
    with ahead.compiled_ahead("clay"):
        pass
    assert started == []
    with ahead.compiled_ahead("realistic"):
        pass
    assert len(started) == 1


def test_one_processor_compiles_in_one_process(started, monkeypatch):
    monkeypatch.setattr(ahead, "processors", lambda: 1)
    with ahead.compiled_ahead("realistic"):
        pass
    assert started == []


def test_the_face_at_rest_needs_the_same_kernels_as_one_that_is_solved(head, face):
    solved, resting = face(), ahead._resting(head)
    for field in fields(solved):
        a, b = getattr(solved, field.name), getattr(resting, field.name)
        if isinstance(a, np.ndarray):
            assert (a.dtype, a.shape, a.flags.c_contiguous) == (b.dtype, b.shape, b.flags.c_contiguous)
    assert np.abs(solved.skin - resting.skin).max() < 0.5
