import gc
from dataclasses import fields

import numpy as np
import pytest

from risorius.core.progress import quiet
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
    monkeypatch.setattr(ahead.processes, "start", lambda *_, **__: found.append(Program()) or found[-1])
    return found


@pytest.fixture
def announced():
    """What is said, one entry each time."""
    return []


def first_picture(style, announced):
    def progress(stage, done=0, total=0):
        if not total:
            announced.append(style)

    with ahead.compiled_ahead(style, progress) as compiled:
        compiled()


def test_what_is_not_compiled_is_said_compiled_and_waited_for(started, announced):
    with ahead.compiled_ahead("realistic", lambda *said: announced.append(said)) as compiled:
        assert started[0].done == []
        compiled()
        assert started[0].done == ["waited"]
    total = ahead.KERNELS["realistic"]
    assert announced == [(ahead.COMPILING,), ("Compiling", total, total)]


def test_kernels_that_either_process_stores_are_counted(started, announced, tmp_path):
    (tmp_path / "earlier.nbi").touch()
    total = ahead.KERNELS["realistic"]
    counted = ahead._Counted(lambda *said: announced.append(said), total)
    for name in ("face/one.nbi", "render/two.nbi"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
        counted.tell()
        counted.tell()
    assert announced == [("Compiling", 1, total), ("Compiling", 2, total)]


def test_a_block_that_fails_waits_for_nobody_and_leaves_no_mark(started, announced):
    with pytest.raises(KeyError), ahead.compiled_ahead("clay", quiet):
        raise KeyError
    assert started[0].done[0] == "killed"
    first_picture("clay", announced)
    assert announced == ["clay"]


def test_what_is_compiled_is_not_compiled_again(started, announced):
    for style in ("muscles", "clay", "realistic", "realistic"):
        first_picture(style, announced)
    assert announced == ["muscles", "realistic"]
    assert len(started) == 2


def test_one_processor_compiles_in_one_process(started, announced, monkeypatch):
    monkeypatch.setattr(ahead, "processors", lambda: 1)
    first_picture("realistic", announced)
    assert started == []
    assert announced == ["realistic"]


def test_garbage_is_collected_again_afterwards(started):
    with ahead.compiled_ahead("clay", quiet):
        assert not gc.isenabled()
    assert gc.isenabled()


def test_the_face_at_rest_needs_the_same_kernels_as_one_that_is_solved(head, face):
    solved, resting = face(), ahead._resting(head)
    for field in fields(solved):
        a, b = getattr(solved, field.name), getattr(resting, field.name)
        if isinstance(a, np.ndarray):
            assert (a.dtype, a.shape, a.flags.c_contiguous) == (b.dtype, b.shape, b.flags.c_contiguous)
    assert np.abs(solved.skin - resting.skin).max() < 0.5
