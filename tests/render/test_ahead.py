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
    """The programs that are started, with nothing compiled, two processors and kernels that have changed."""
    found = []
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(ahead.processes, "processors", lambda: 2)
    monkeypatch.setattr(ahead.shipped, "covers", lambda _: False)
    monkeypatch.setattr(ahead, "_PAUSE", 0.0)
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
    total = ahead.shipped.needed("realistic")
    assert announced == [(ahead.ANNOUNCED.format(15),), ("Compiling", total, total)]


def test_the_packages_code_is_not_waited_for_in_another_process(started, announced, monkeypatch):
    monkeypatch.setattr(ahead.shipped, "covers", lambda _: True)
    with ahead.compiled_ahead("realistic", lambda *said: announced.append(said)) as compiled:
        compiled()
    assert started == []
    assert announced[0] == (ahead.ANNOUNCED.format(ahead.SECONDS[True]),)


def test_kernels_that_either_process_stores_are_counted(started, announced, tmp_path):
    (tmp_path / "earlier.nbi").touch()
    counted = ahead._Counted(lambda *said: announced.append(said), total=5)
    for name in ("face/one.nbi", "render/two.nbi"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
        counted.tell()
        counted.tell()
    assert announced == [("Compiling", 1, 5), ("Compiling", 2, 5)]


def test_the_cache_is_not_looked_through_for_every_kernel(started, announced, monkeypatch):
    looks = []
    counted = ahead._Counted(lambda *said: announced.append(said), total=5)
    monkeypatch.setattr(ahead, "_PAUSE", 60.0)
    monkeypatch.setattr(counted, "_stored", lambda: looks.append(1) or len(looks))
    for _ in range(9):
        counted.on_end(None)
    assert (len(looks), announced) == (1, [("Compiling", 1, 5)])


def test_kernels_whose_number_is_not_known_are_not_counted(started, announced, monkeypatch, tmp_path):
    monkeypatch.setattr(ahead.shipped, "needed", lambda _: 0)
    with ahead.compiled_ahead("clay", lambda *said: announced.append(said)):
        (tmp_path / "one.nbi").touch()
        ahead.event.broadcast(ahead.event.Event(ahead.shipped.STORED, ahead.event.EventStatus.END))
    assert announced == [(ahead.ANNOUNCED.format(15),)]


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
    monkeypatch.setattr(ahead.processes, "processors", lambda: 1)
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
