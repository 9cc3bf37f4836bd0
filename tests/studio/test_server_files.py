"""Files through the server: exports, projects, recordings."""

from __future__ import annotations

import io
import json
import zipfile

import pytest
from websockets.exceptions import ConnectionClosed

from risorius.studio import limits

from .conftest import fetched


def test_files_are_exported_with_progress_and_fetched(server):
    with server.page("export") as page:
        take = page.perform("Hi.")["take"]
        suffixes = [".muscles.csv", ".wav", ".landmarks.csv"]
        page.events.clear()
        job = page.ask("export", take=take, suffixes=suffixes, name="../my line")["job"]
        done = page.event("exported")
        assert (done["job"], done["error"]) == (job, "")
        assert [f["name"] for f in done["files"]] == [f"my line{suffix}" for suffix in suffixes]
        for file in done["files"]:
            status, data = fetched(server, file["path"].replace(" ", "%20"))
            assert status == 200
            assert len(data) > 100
        archive = done["files"][0]["path"].rpartition("/")[0] + "/all.zip"
        with zipfile.ZipFile(io.BytesIO(fetched(server, archive)[1])) as whole:
            assert whole.namelist() == [f["name"] for f in done["files"]]
        assert fetched(server, archive.replace(f"/{job}/", "/99/"))[0] == 404
        steps = [e for e in page.events if e["event"] == "progress" and e["job"] == job]
        assert any(0 < step["done"] <= step["total"] for step in steps)
        for wrong in (
            {"suffixes": [".exe"]},
            {"suffixes": []},
            {"suffixes": [".png"], "background": "/etc/passwd"},
        ):
            assert page.refused("export", take=take, **wrong)
        job = page.ask("export", take=take, suffixes=[".vertices.npz"])["job"]
        page.ask("cancel_export", job=job)
        assert page.event("exported")["error"] == "the export was stopped"
        assert "there is no export 99" in page.refused("cancel_export", job=99)


def test_a_project_is_fetched_and_taken_up_elsewhere(server):
    with server.page("project") as page:
        take = page.perform("Hi there.")
        status, data = fetched(server, page.ask("project")["path"])
        assert status == 200
    with server.page("elsewhere") as page:
        page.ask("open")
        assert fetched(server, "/api/session/elsewhere/project", data)[0] == 200
        page.event("changed")
        assert page.ask("open")["take"]["curves"] == take["curves"]
        status, text = fetched(server, "/api/session/elsewhere/project", b"{}")
        assert (status, text.count(b"\n")) == (400, 1)
        assert page.ask("open")["take"]["curves"] == take["curves"]


def test_a_recording_is_uploaded_and_performed(server):
    with server.page("record") as page:
        sound = fetched(server, page.perform("I like it.")["speech"]["sound"])[1]
        status, answer = fetched(server, "/api/session/record/recording?name=a.wav", sound)
        assert status == 200
        name = json.loads(answer)["recording"]
        take = page.ask("perform", source={"script": "I like it.", "recording": name})
        assert [word["text"] for word in take["speech"]["words"]] == ["I", "like", "it"]
        status, text = fetched(server, "/api/session/record/recording?name=a.wav", b"nothing")
        assert (status, text.count(b"\n")) == (400, 1)


def test_what_is_too_large_is_refused(server, monkeypatch):
    monkeypatch.setattr(limits, "RECORDING", 1000)
    monkeypatch.setattr(limits, "PROJECT", 1000)
    for path in ("recording?name=a.wav", "project"):
        assert fetched(server, f"/api/session/large/{path}", bytes(5000))[0] == 413
    assert not list((server.studio.folder / "large").glob("upload-*"))
    with server.page("large") as page:
        assert "longer than" in page.refused("perform", source={"script": "x" * (limits.SCRIPT + 1)})
        with pytest.raises(ConnectionClosed):
            page.ask("perform", source={"script": "x" * (limits.MESSAGE + 1)})


def test_no_line_to_the_page_tells_where_the_files_of_the_session_lie(server):
    folder = str(server.studio.folder)
    with server.page("told") as page:
        sound = fetched(server, page.perform("I like it.")["speech"]["sound"])[1]
        _, answer = fetched(server, "/api/session/told/recording?name=a.wav", sound)
        name = json.loads(answer)["recording"]
        take = page.ask("perform", source={"script": "", "recording": name})
        assert any("a.wav" in line for line in take["warnings"])
        assert not any(folder in line for line in take["warnings"])
        refused = page.refused(
            "perform", source={"script": "Quite other words than these. " * 9, "recording": name}
        )
        assert folder not in refused
        choices = {"rules_off": ["../../x"]}
        assert folder not in page.refused("perform", source={"script": "Hm."}, choices=choices)
