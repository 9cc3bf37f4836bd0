import threading

import numpy as np
import pytest

from risorius.errors import InputError
from risorius.render.renderer_pool import RendererPool
from risorius.render.software_renderer import SoftwareRenderer

POSES = ({}, {"masseter": 0.6}, {"AU12": 0.8, "head_yaw": 20.0}, {"AU1": 1.0}, {"head_pitch": -15.0})


def inputs(face):
    for pose in POSES:
        yield face(**pose), None


@pytest.mark.parametrize("threads", [1, 2, 4])
@pytest.mark.parametrize("style", ["realistic", "muscles"])
def test_bytes_do_not_depend_on_the_number_of_threads(model, face, threads, style):
    alone = SoftwareRenderer(model, (120, 120), style=style)
    expected = [alone.render(frame).copy() for frame, _ in inputs(face)]
    found = list(RendererPool(SoftwareRenderer(model, (120, 120), style=style), threads).draw(inputs(face)))
    assert len(found) == len(expected)
    assert all(np.array_equal(a, b) for a, b in zip(found, expected, strict=True))


def test_a_frame_may_change_once_the_next_is_taken(model, face):
    frame = face()
    expected = SoftwareRenderer(model, (96, 96)).render(frame).copy()

    def reused():
        for _ in range(4):
            yield frame, None
            np.add(frame.skin, 1.0, out=frame.skin)

    assert np.array_equal(
        next(iter(RendererPool(SoftwareRenderer(model, (96, 96)), 3).draw(reused()))), expected
    )


def test_inputs_are_taken_only_a_little_ahead(model, face):
    asked = []

    def counted():
        for _ in range(20):
            asked.append(threading.current_thread())
            yield face(), None

    pictures = RendererPool(SoftwareRenderer(model, (64, 64)), 2).draw(counted())
    next(pictures)
    assert len(asked) <= 5
    pictures.close()
    assert set(asked) == {threading.current_thread()}
    assert not any(thread.name.startswith("picture") for thread in threading.enumerate())


def test_a_fault_in_a_picture_is_raised_in_its_turn(model, face):
    other = face()
    small = type(other)(**{**{f: getattr(other, f) for f in other.__slots__}, "skin": other.skin[:9]})
    pictures = RendererPool(SoftwareRenderer(model, (64, 64)), 2).draw(
        [(face(), None), (small, None), (face(), None)]
    )
    next(pictures)
    with pytest.raises(InputError, match="skin"):
        next(pictures)


def test_buffers_bound_the_pool(model, monkeypatch):
    renderer = SoftwareRenderer(model, (64, 64))
    monkeypatch.setattr(SoftwareRenderer, "buffer_bytes", 10**12)
    assert RendererPool(renderer).threads == 1


def test_a_single_picture_makes_no_clone(model, face, monkeypatch):
    monkeypatch.setattr(SoftwareRenderer, "clone", lambda self: pytest.fail("a clone was made"))
    assert len(list(RendererPool(SoftwareRenderer(model, (64, 64)), 4).draw([(face(), None)]))) == 1


def test_a_pool_that_is_closed_draws_no_more_and_is_closed_twice_in_peace(model, face):
    with RendererPool(SoftwareRenderer(model, (64, 64)), 2) as pool:
        assert len(list(pool.draw(inputs(face)))) == len(POSES)
    pool.close()
    with pytest.raises(RuntimeError, match="closed"):
        next(pool.draw(inputs(face)))


def test_pictures_under_way_are_finished_though_the_pool_is_closed(model, face):
    pool = RendererPool(SoftwareRenderer(model, (64, 64)), 1)
    pictures = pool.draw([(face(), None)] * 2)
    first = next(pictures)
    pool.close()
    assert np.array_equal(next(pictures), first)
