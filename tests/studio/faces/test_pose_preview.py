"""When faces are sent while dials are turned."""

from __future__ import annotations

import asyncio
import selectors
from concurrent.futures import Executor, Future
from contextlib import nullcontext
from types import SimpleNamespace

from risorius.studio.faces import pose_preview
from risorius.studio.faces.pose_preview import PosePreview
from risorius.studio.session.session_files import SessionFiles
from risorius.studio.wire import requests


class AtOnce(Executor):
    """Does what it is given when it is given."""

    def submit(self, work, /, *arguments, **options):
        done = Future()
        done.set_result(work(*arguments, **options))
        return done


class Leaping(asyncio.SelectorEventLoop):
    """A loop in which waiting takes no time: its clock leaps to when the next work is due."""

    def __init__(self):
        self.now, loop = 100.0, self

        class Selector(selectors.DefaultSelector):
            def select(self, timeout=None):
                ready = super().select(0)
                if not ready and timeout:
                    loop.now += timeout
                return ready

        super().__init__(Selector())

    def time(self):
        return self.now


def test_a_dragged_dial_has_one_face_for_each_turn(monkeypatch, tmp_path):
    turns, sent = 12, []
    dial = SimpleNamespace(still=lambda values: None, moved=lambda values, seconds: None)
    solvers = SimpleNamespace(lent=lambda settings: nullcontext())

    async def send(number):
        sent.append(number)

    async def drag():
        page = PosePreview(AtOnce(), solvers, send)
        for number in range(turns):
            await page.turn(number, requests.Dial(), SessionFiles(tmp_path))
            await asyncio.sleep(0.045)
        dragged = len(sent)
        await page.stop()
        return dragged

    stage = SimpleNamespace(packed=lambda kind, number, first, faces: number)
    monkeypatch.setattr(pose_preview, "stage_of", lambda head, age: stage)
    monkeypatch.setattr(pose_preview, "PoseEditor", lambda solver: dial)
    with asyncio.Runner(loop_factory=Leaping) as runner:
        assert turns - 2 <= runner.run(drag()) <= turns + 4
