import threading

import numpy as np
import pytest

from risorius.errors import InputError
from risorius.render import Crew, Renderer

POSES = ({}, {"masseter": 0.6}, {"AU12": 0.8, "head_yaw": 20.0}, {"AU1": 1.0}, {"head_pitch": -15.0})


def jobs(face):
    for pose in POSES:
        yield face(**pose), None


@pytest.mark.parametrize("threads", [1, 2, 4])
@pytest.mark.parametrize("style", ["realistic", "muscles"])
def test_bytes_do_not_depend_on_the_number_of_threads(head, face, threads, style):
    alone = Renderer(head, (120, 120), style=style)
    expected = [alone.render(frame).copy() for frame, _ in jobs(face)]
    found = list(Crew(Renderer(head, (120, 120), style=style), threads).draw(jobs(face)))
    assert len(found) == len(expected)
    assert all(np.array_equal(a, b) for a, b in zip(found, expected, strict=True))


def test_a_frame_may_change_once_the_next_is_asked_for(head, face):
    frame = face()
    expected = Renderer(head, (96, 96)).render(frame).copy()

    def reused():
        for _ in range(4):
            yield frame, None
            np.add(frame.skin, 1.0, out=frame.skin)

    assert np.array_equal(next(iter(Crew(Renderer(head, (96, 96)), 3).draw(reused()))), expected)


def test_jobs_are_asked_for_only_a_little_ahead(head, face):
    asked = []

    def counted():
        for _ in range(20):
            asked.append(threading.current_thread())
            yield face(), None

    pictures = Crew(Renderer(head, (64, 64)), 2).draw(counted())
    next(pictures)
    assert len(asked) <= 3
    pictures.close()
    assert set(asked) == {threading.current_thread()}
    assert not any(thread.name.startswith("picture") for thread in threading.enumerate())


def test_a_fault_in_a_picture_is_raised_in_its_turn(head, face):
    other = face()
    small = type(other)(**{**{f: getattr(other, f) for f in other.__slots__}, "skin": other.skin[:9]})
    pictures = Crew(Renderer(head, (64, 64)), 2).draw([(face(), None), (small, None), (face(), None)])
    next(pictures)
    with pytest.raises(InputError, match="skin"):
        next(pictures)


def test_buffers_bound_the_crew(head, monkeypatch):
    renderer = Renderer(head, (64, 64))
    monkeypatch.setattr(Renderer, "buffer_bytes", 10**12)
    assert Crew(renderer).threads == 1


def test_a_single_picture_makes_no_twin(head, face, monkeypatch):
    monkeypatch.setattr(Renderer, "twin", lambda self: pytest.fail("a twin was made"))
    assert len(list(Crew(Renderer(head, (64, 64)), 4).draw([(face(), None)]))) == 1
