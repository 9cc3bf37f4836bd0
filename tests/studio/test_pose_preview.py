"""When faces are sent while dials are turned."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

from risorius.studio import pose_preview, wire
from risorius.studio.pose_preview import PosePreview
from risorius.studio.session_files import SessionFiles
from risorius.studio.solvers import Solvers


def test_a_dragged_dial_has_one_face_for_each_turn(monkeypatch, tmp_path):
    turns, sent = 12, []
    dial = SimpleNamespace(still=lambda values: None, moved=lambda values, seconds: None)

    async def send(number):
        sent.append(number)

    async def drag():
        with ThreadPoolExecutor(1) as threads:
            page = PosePreview(threads, Solvers(), send)
            page._dial, page._looks = dial, ("standard", None)
            for number in range(turns):
                asked = wire.Dial()
                await page.turn(number, asked, SessionFiles(tmp_path))
                await asyncio.sleep(0.045)
            dragged = len(sent)
            await page.stop()
            return dragged

    stage = SimpleNamespace(packed=lambda kind, number, first, faces: number)
    monkeypatch.setattr(pose_preview, "stage_of", lambda head, age: stage)
    assert turns - 2 <= asyncio.run(drag()) <= turns + 4
