"""A real server: what a page does from the first line to the exported file, and what must do no harm."""

from __future__ import annotations

import json
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from websockets.exceptions import InvalidStatus

from risorius import solvers
from risorius.errors import OutputError
from risorius.studio import limits
from risorius.studio.faces import streaming
from risorius.studio.faces.solvers import stage_of
from risorius.studio.server import serve

from .conftest import LINE, fetched, header, serving

KEYS = [[0.2, 0], [0.8, 0.6], [1.4, 0]]


def test_the_server_says_when_it_is_warm(server):
    with server.page("warm") as page:
        page.ask("open")
        if any(event["event"] == "ready" for event in page.events):
            assert [page.event("ready")["what"] for _ in range(2)] == ["warming", "warm"]
        assert server.studio.warm.is_set()


def test_sessions_without_a_page_give_way_and_nothing_is_made_by_asking(tmp_path, monkeypatch):
    monkeypatch.setattr(limits, "SESSIONS", 2)
    with serving(tmp_path) as server:
        assert fetched(server, "/api/session/none/project")[0] == 404
        assert not (tmp_path / "none").exists()
        with server.page("one") as one:
            one.perform("Hm.")
            one.event("saved")
            for name in ("two", "three", "four"):
                with server.page(name) as page:
                    page.ask("open")
            assert one.ask("open")["take"] is not None
            assert len(server.studio.sessions) == 2
            with server.page("five") as page:
                page.ask("open")
                with pytest.raises(InvalidStatus), server.page("six"):
                    pass


def test_a_line_is_performed_seen_and_heard(server):
    with server.page("perform") as page:
        assert page.ask("open")["take"] is None
        take = page.perform(emotions=[{"emotion": "joy", "intensity": 0.7}])
        assert [word["text"] for word in take["speech"]["words"]] == LINE.rstrip(".").replace("?", "").split()
        status, sound = fetched(server, take["speech"]["sound"])
        assert (status, sound[:4]) == (200, b"RIFF")
        assert page.ask("faces", take=take["take"], first=3, last=9)["sent"] == 6
        heads = [header(message) for message in page.faces]
        assert [(kind, number) for kind, number, *_ in heads] == [(1, take["take"])] * len(heads)
        assert heads[0][2] == 3
        assert sum(count for _, _, _, count, _, _ in heads) == 6
        folds = stage_of("standard").folds.described().count
        sizes = [24 + h[3] * (4 * h[5] + 6 * h[4] + folds) for h in heads]
        assert [len(message) for message in page.faces] == sizes
        page.faces.clear()
        page.ask("face_at", take=take["take"], time=1.0)
        assert header(page.faces[0])[:4] == (3, take["take"], 30, 1)
        page.faces.clear()
        page.ask("face_at", take=take["take"], time=10.0**4, still=True)
        assert header(page.faces[0])[:4] == (3, take["take"], take["frames"] - 1, 1)
        assert page.ask("faces", take=take["take"], first=0, last=0)["sent"] == 0
        assert page.ask("faces", take=take["take"], first=10**6, last=10**7)["sent"] == 0


def test_performing_tells_how_far_it_is_and_can_be_stopped(server, halted):
    with server.page("stop") as page:
        number = page.begin("perform", source={"script": LINE})
        assert halted.begun.wait(60)
        page.ask("stop", request=10**9)
        page.ask("stop", request=number)
        halted.go.set()
        assert page.answer(number)["error"] == "stopped"
        shares = [(e["stage"], e["done"], e["total"]) for e in page.events if e["event"] == "progress"]
        assert ("Speaking …", 2, 5) in shares
        assert page.ask("open")["take"] is None
        take = page.perform()
        assert page.ask("stop", request=number) == {}
        assert page.ask("open")["take"]["take"] == take["take"]


def test_a_window_shows_what_the_whole_would(server):
    with server.page("window") as page:
        take = page.perform("Hello there.")
        held = {}
        for first, last in ((0, take["frames"]), (20, 24)):
            page.ask("faces", take=take["take"], first=first, last=last)
            for message in page.faces:
                _, _, start, count, vertices, pose = header(message)
                points = np.frombuffer(message, "<i2", 3 * vertices * count, 24 + 4 * pose * count)
                points = points.reshape(count, vertices, 3)
                held |= {(first, start + k): points[k] for k in range(count)}
            page.faces.clear()
        for frame in range(20, 24):
            assert np.abs(held[0, frame].astype(int) - held[20, frame]).max() <= 1


def test_faces_can_be_asked_for_at_a_pace_but_for_the_first_second_of_them(server, monkeypatch):
    with server.page("pace") as page:
        take = page.perform("Hello there, all of you who are here.")
        due = []

        async def until(time):
            due.append(time)

        monkeypatch.setattr(streaming, "until", until)
        assert page.ask("faces", take=take["take"], first=0, last=36, pace=12)["sent"] == 36
        assert due[-1] - due[0] == pytest.approx((36 - 1) / 12)
        assert [header(message)[3] for message in page.faces][:2] == [1, 4]
        assert page.refused("faces", take=take["take"], first=0, last=36, pace=0)


def test_what_is_begun_is_done_and_saved_though_the_page_goes(server):
    with server.page("gone") as page:
        page.socket.send(json.dumps({"id": 1, "do": "perform", "source": {"script": LINE}}))
        page.event("progress")
    saved = server.studio.folder / "gone" / "project.json"
    end = time.monotonic() + 60.0
    while not saved.exists():
        assert time.monotonic() < end
        time.sleep(0.05)
    with server.page("gone") as page:
        assert page.ask("open")["take"]["made"]["source"]["script"] == LINE


def test_what_is_begun_is_done_and_saved_though_the_server_ends(tmp_path):
    with serving(tmp_path) as server, server.page("ended") as page:
        page.socket.send(json.dumps({"id": 1, "do": "perform", "source": {"script": LINE}}))
        page.event("progress")
    saved = json.loads((tmp_path / "ended" / "project.json").read_text())
    assert saved["made"]["source"]["script"] == LINE


def _held(page, number, time):
    page.faces.clear()
    page.ask("face_at", take=number, time=time, still=True)
    return page.faces[0][24:]


def test_the_face_of_a_preview_is_that_of_the_edit_when_it_is_made(server):
    with server.page("preview") as page:
        take = page.perform()
        block = next(b for b in take["blocks"] if b["channel"] == "signals")
        edit = {"kind": "move", "movement": block["id"], "start": block["start"] + 0.4}
        at = 0.5 * (block["apex_start"] + block["apex_end"])
        before = _held(page, take["take"], at)
        page.faces.clear()
        page.ask("preview", **edit)
        assert page.faces == []
        page.ask("preview", **edit, face=at)
        (previewed,) = page.faces
        assert header(previewed)[:2] == (3, take["take"])
        assert previewed[24:] != before
        assert _held(page, take["take"], at) == before
        changed = page.ask("edit", **edit)
        assert _held(page, changed["take"], at) == previewed[24:]


def test_who_waits_for_a_solver_holds_up_nobody_else(server, monkeypatch):
    began, go_on = threading.Event(), threading.Event()

    make = solvers.make_solver

    def slow(settings):
        began.set()
        assert go_on.wait(30)
        return make(settings)

    with server.page("waits") as page, server.page("other") as other:
        take = page.perform("Hello.", choices={"age": 70.0})
        monkeypatch.setattr(solvers, "make_solver", slow)
        page.socket.send(json.dumps({"id": 900, "do": "faces", "take": take["take"], "first": 0, "last": 4}))
        assert began.wait(30)
        try:
            assert other.ask("open")["take"] is None
        finally:
            go_on.set()
        assert page.answer(900)["ok"]["sent"] == 4


def test_an_edit_is_told_explained_undone_and_there_after_a_reload(server):
    with server.page("edit") as page:
        take = page.perform()
        block = next(b for b in take["blocks"] if b["channel"] == "signals")
        change = page.ask("edit", kind="move", movement=block["id"], start=0.1)
        (moved,) = change["blocks"]
        assert (moved["id"], moved["start"], moved["edited"]) == (block["id"], 0.1, True)
        assert change["curves"]
        drawn = page.ask(
            "edit", kind="keys", parameter="mentalis.left", keys=[[0.2, 0], [0.8, 0.6], [1.4, 0]]
        )
        why = page.ask("explain", take=drawn["take"], time=0.8, parameter="mentalis.left")
        assert why["reasons"][0]["winner"]["rule"] == "by hand"
        assert "spk" not in why["sentences"]
        back = page.ask("undo")
        assert back["take"] == change["take"]
        assert back["redoes"]
        assert "nothing to redo" in (page.ask("redo") and page.refused("redo"))
        assert "unknown block 'x'" in page.refused("edit", kind="delete", movement="x")
        page.ask("save_view", view={"time": 1.5})
    with server.page("edit") as page:
        state = page.ask("open")
        assert state["take"]["take"] == drawn["take"]
        assert state["view"]["time"] == 1.5
        assert [d["parameter"] for d in state["take"]["drawn"]] == ["mentalis.left"]


def test_a_session_goes_on_after_the_server_has_died(tmp_path):
    with serving(tmp_path) as server, server.page("one") as page:
        page.perform()
        drawn = page.ask("edit", kind="keys", parameter="masseter", keys=[[0.2, 0], [0.8, 0.6]])
        page.event("saved")
        page.event("saved")
        before = page.ask("open")["take"]
    with serving(tmp_path) as server, server.page("one") as page:
        after = page.ask("open")["take"]
        assert after["take"] > drawn["take"]
        assert after["curves"] == before["curves"]
        assert page.ask("undo")["gone"] == []
        assert fetched(server, after["speech"]["sound"])[0] == 200


def test_dials_are_followed_until_the_skin_lies_still(server):
    with server.page("dial") as page:
        page.ask("dial", values={})
        state = page.ask("dial", values={"AU12": 0.5}, emotions={"surprise": 0.4})
        assert state["values"]["zygomatic_major.left"] == 0.5
        assert state["values"]["masseter"] > 0.0
        assert "unknown" in page.refused("dial", values={"AU99": 1.0})
        assert "unknown emotion '/etc/x.toml'" in page.refused("dial", emotions={"/etc/x.toml": 1.0})
        page.ask("dial", values={"AU12": 0.5}, live=False)
        while not (page.faces and header(page.faces[-1])[1] == page.number):
            page.heard()
        assert {header(message)[0] for message in page.faces} == {2}
        at_rest = page.faces[-1]
        page.ask("dial", values={"AU12": 0.5})
        while header(page.faces[-1])[1] != page.number:
            page.heard()
        # Turned to where it was: the skin does not move.
        assert page.faces[-1][24:] == at_rest[24:]
        saved = page.ask("save_pose", name="grin", kind="emotion", values={"AU12": 0.5})
        assert saved["file"] == "grin.toml"
        assert page.ask("dial", emotions={"grin": 1.0})["values"]["zygomatic_major.left"] == 0.5
        assert page.ask("open")["emotions"] == ["grin"]


def test_two_takes_stand_side_by_side(server):
    with server.page("compare") as page:
        take = page.perform(emotions=[{"emotion": "joy", "intensity": 1.0}])
        other = page.ask("compare", choices={"conflict": "sum"})
        assert other["frames"] == take["frames"]
        assert other["curves"] != take["curves"]
        for number in (take["take"], other["take"]):
            assert page.ask("faces", take=number, first=0, last=2)["sent"] == 2
        assert page.ask("open")["take"]["take"] == take["take"]
        fired = page.ask("rules_fired", take=take["take"])["rules"]
        assert {"emotion.display"} <= {rule["rule"] for rule in fired}
        rule = next(r["rule"] for r in fired if r["rule"].startswith("signals."))
        without = page.ask("choose", choices={"rules_off": [rule]})
        assert rule not in {b["rule"] for b in without["blocks"]}


BAD = [
    "",
    "{",
    "[]",
    "null",
    '{"id": 1}',
    '{"id": 2, "do": "perform"}',
    '{"id": 3, "do": "edit", "kind": "x"}',
]


def test_a_hundred_bad_messages_at_once_do_no_harm(server):
    with server.page("good") as good, server.page("bad") as bad:
        before = good.perform("Hm.")

        def shout(number):
            with server.page("bad") as page:
                page.socket.send(BAD[number % len(BAD)] if number % 2 else b"\x00\xff")
                return page.heard()["error"]

        with ThreadPoolExecutor(20) as pool:
            assert all(pool.map(shout, range(100)))
        for text in BAD * 20:
            bad.socket.send(text)
        for _ in range(limits.PENDING):
            assert "error" in bad.heard()
        assert good.ask("open")["take"]["curves"] == before["curves"]
        assert good.perform("Hm.")["curves"] == before["curves"]


def window(number, take):
    """Return a request for all faces of a take."""
    return json.dumps({"id": number, "do": "faces", "take": take["take"], "first": 0, "last": 999})


def test_a_slow_page_holds_up_only_itself(server):
    with server.page("slow", max_queue=1) as slow, server.page("quick") as quick:
        take = slow.perform(LINE * 4)
        for _ in range(3):
            slow.socket.send(window(99, take))
        while not slow.faces:  # the server is at work, and this page reads no more
            slow.heard()
        number = quick.perform("Hm.")["take"]
        assert quick.ask("faces", take=number, first=0, last=8)["sent"] == 8
        running = threading.active_count()
        assert running < 100
    with server.page("slow") as slow:
        assert slow.ask("open")["take"]["take"] == take["take"]


def test_a_window_gives_way_to_the_next(server):
    with server.page("scrub") as page:
        take = page.perform(LINE * 4)
        for number in (900, 901):
            page.socket.send(window(number, take))
        first = page.answer(900)["ok"]["sent"]
        assert first < take["frames"]
        page.ask("cancel", take=take["take"])
        assert page.answer(901)["ok"]["sent"] < take["frames"]


def test_other_pages_of_a_session_hear_of_a_change(server):
    with server.page("both") as one, server.page("both") as other:
        other.ask("open")
        take = one.perform("Hm.")
        assert other.event("changed")["take"] == take["take"]


def test_a_folder_that_cannot_be_made_is_told_before_anything_is_served(tmp_path):
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(OutputError, match="cannot keep sessions: Not a directory"):
        serve(0, folder=tmp_path / "file" / "x", browser=False)
