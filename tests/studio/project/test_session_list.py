"""The list of sessions: nothing is in it that cannot be opened, and deleting can be undone."""

from __future__ import annotations

import json

from ..conftest import fetched


def listed(server):
    return json.loads(fetched(server, "/api/sessions")[1])


def act(server, session, what):
    return fetched(server, f"/api/session/{session}/{what}", b"")


def test_sessions_are_listed_named_copied_deleted_and_put_back(server):
    with server.page("first") as page:
        page.ask("open")
        assert listed(server) == []
        page.ask("save_draft", source={"script": "Not yet."})
        page.event("saved")
        page.perform("Hm.")
        page.event("saved")
        (entry,) = listed(server)
        assert (entry["session"], entry["title"], entry["line"], entry["open"]) == ("first", "", "Hm.", True)
        assert act(server, "first", "rename?title=%20My%0Aline%20")[0] == 200
        assert act(server, "first", f"rename?title={'x' * 81}")[0] == 400
        name = json.loads(act(server, "first", "copy")[1])["session"]
        assert act(server, "first", "delete") == (
            400,
            b"the session is open in a tab; expected it to be closed first\n",
        )
    assert [(e["session"], e["title"]) for e in listed(server)] == [
        (name, "My line (copy)"),
        ("first", "My line"),
    ]
    with server.page(name) as page:
        state = page.ask("open")
        assert state["take"]["made"]["source"]["script"] == "Hm."
        assert state["draft"]["source"]["script"] == "Not yet."
    while server.studio.sessions[name].pages:
        pass
    assert act(server, name, "delete")[0] == 200
    assert [e["session"] for e in listed(server)] == ["first"]
    assert not (server.studio.folder / name).exists()
    assert act(server, name, "put-back")[0] == 200
    assert len(listed(server)) == 2
    for what in ("put-back", "delete", "copy", "rename?title=x"):
        for session in ("none", "..", ".deleted", "A"):
            assert act(server, session, what)[0] in (400, 404)
