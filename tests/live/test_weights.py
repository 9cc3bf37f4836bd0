"""Weights of a live face: those of `speak`, whatever was left out, made once for a head."""

from __future__ import annotations

import os
import threading
import time
from itertools import islice

import numpy as np
import pytest

from risorius import Live, Settings, speak
from risorius.errors import HeadError
from risorius.live.crossfade import CROSSFADE
from risorius.live.turn import TAIL
from risorius.live.weights import LiveSolvers, LiveWeights


def test_weights_are_those_of_the_performance() -> None:
    live = Live(fps=30, arkit=True)
    live.say("Oh, wow.")
    live.close()
    frames = list(live.frames())
    track = speak("Oh, wow.", settings=Settings(lead=CROSSFADE, tail=TAIL)).arkit
    weights = np.array([frame.arkit for frame in frames])
    for frame, row in zip(frames, weights, strict=True):
        assert frame.arkit is not None
        assert frame.arkit["jawOpen"] == row[track.names.index("jawOpen")]
    # Between frames the curves are straight lines, since what comes next is not known.
    assert np.abs(weights - track.weights[: len(weights)]).max() < 0.03
    rotations = np.array([frame.rotations for frame in frames])
    np.testing.assert_allclose(rotations, track.rotations[: len(rotations)], atol=1e-9)


def test_frames_may_be_left_out() -> None:
    live = Live(fps=30)
    live.say("Oh, wow.")
    frames = list(islice(live.frames(), 45))
    whole, some = LiveWeights(Settings()), LiveWeights(Settings())
    every = [whole.added(frame).arkit for frame in frames]
    few = [some.added(frame).arkit for frame in frames[::3]]
    assert np.abs(np.array(every[::3]) - np.array(few)).max() < 0.2


def test_who_has_waited_longest_for_a_solver_is_next(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 1)
    solvers, order, waiting = LiveSolvers(Settings()), [], []

    def solve(name: int) -> None:
        with solvers.one():
            order.append(name)

    with solvers.one():
        for name in range(4):
            waiting.append(threading.Thread(target=solve, args=(name,)))
            waiting[-1].start()
            while len(solvers) <= name:
                time.sleep(0.001)
    # Who asks again at once comes after them.
    solve(4)
    for thread in waiting:
        thread.join()
    assert order == [0, 1, 2, 3, 4]


def test_a_head_that_is_not_there_is_said_at_once() -> None:
    with pytest.raises(HeadError):
        Live(Settings(head="/nowhere"), arkit=True)
