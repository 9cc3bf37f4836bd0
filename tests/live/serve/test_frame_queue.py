"""The mailbox of a client that reads slowly: what is dropped, what is kept, in which order."""

from __future__ import annotations

import asyncio

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.parameters import NAMES
from risorius.live.frame import LiveFrame
from risorius.live.serve import limits
from risorius.live.serve.frame_queue import FrameQueue
from risorius.live.serve.frames import SentFrame

RATE, FPS = 1_000, 10


def frame(index: int, rate: int = RATE) -> LiveFrame:
    size = rate // FPS
    sound = np.arange(index * size, (index + 1) * size).astype(np.int16)
    return LiveFrame(index, index / FPS, np.zeros(len(NAMES)), sound, rate)


@given(st.integers(1, 5), st.lists(st.sampled_from(["put", "drop", "take"]), max_size=60))
def test_whatever_is_dropped_the_sound_is_whole_and_all_frames_are_counted(
    most: int, steps: list[str]
) -> None:
    async def run() -> list[SentFrame]:
        mailbox, taken, waiting = FrameQueue(most), [], 0
        for index, step in enumerate(steps):
            if step == "put":
                mailbox.put(frame(index))
                waiting = min(waiting + 1, most)
            elif step == "drop":
                mailbox.drop(frame(index))
            elif waiting:
                taken.append(await mailbox.take())
                waiting -= 1
        mailbox.end()
        while (item := await mailbox.take()) is not None:
            taken.append(item)
        return taken  # type: ignore[return-value]

    sent, before = asyncio.run(run()), 0
    indices = [index for index, step in enumerate(steps) if step != "take"]
    for one in sent:
        gone = indices[before : indices.index(one.frame.index) + 1]
        assert one.dropped == len(gone) - 1
        kept = np.concatenate([frame(index).sound for index in gone])[-int(limits.KEPT_SOUND * RATE) :]
        assert np.array_equal(one.sound, kept)
        before += len(gone)


def test_events_go_first_and_the_oldest_are_forgotten() -> None:
    async def run() -> list[object]:
        mailbox = FrameQueue()
        mailbox.put(frame(0))
        for number in range(limits.EVENTS + 1):
            mailbox.tell(str(number))
        return [await mailbox.take() for _ in range(limits.EVENTS + 1)]

    *events, last = asyncio.run(run())
    assert events == [str(number) for number in range(1, limits.EVENTS + 1)]
    assert isinstance(last, SentFrame)


def test_sound_of_another_rate_is_not_joined() -> None:
    async def run() -> object:
        mailbox = FrameQueue()
        mailbox.drop(frame(0))
        mailbox.put(frame(1, 2 * RATE))
        return await mailbox.take()

    sent = asyncio.run(run())
    assert isinstance(sent, SentFrame)
    assert len(sent.sound) == 2 * RATE // FPS
