"""Markers, and lanes that are muted, solo or locked: kept, undone, and in force for the whole take."""

from __future__ import annotations

import json

import pytest

from risorius.core.edits import Add, Keys, Move
from risorius.core.key_shapes import KeyShape
from risorius.core.progress import quiet
from risorius.errors import RisoriusError
from risorius.studio.decoding import decode
from risorius.studio.project.autosave import Autosave
from risorius.studio.project.project import open_project, project_file
from risorius.studio.session.session import Session
from risorius.studio.wire import requests
from risorius.studio.wire.marks import Marker
from risorius.studio.wire.messages import encoded

from .sessions import edit, perform, state


def lanes(session, **states):
    return session.set_lanes(_received(do="set_lanes", lanes=states), quiet)


def mark(session, *markers):
    return session.set_markers(
        _received(do="set_markers", markers=[encoded(marker) for marker in markers]), quiet
    )


def _received(**message):
    return decode(json.dumps({"id": 1, **message})).body


def test_a_muted_lane_moves_nothing_and_keeps_its_movements(session):
    take = perform(session)
    before, head = state(session), [b for b in take.blocks if b.channel == "head"]
    assert any(name.startswith("head_") for name in take.curves)
    others = ("head", "signals", "regulators", "gaze")
    change = lanes(session, muted=others)
    assert set(change.lanes.muted) == set(others)
    assert change.gone == ()
    now = session.described(session.current)
    assert [b for b in now.blocks if b.channel == "head"] == head
    assert all(m.channel not in others for m in session.current.take.score.movements)
    assert not any(name.startswith("head_") for name in now.curves)
    assert now.undoes.startswith("mute signals, ")
    # What is muted can still be changed.
    edit(session, Move(head[0].id, head[0].start + 0.1))
    assert not any(name.startswith("head_") for name in session.current.curves)
    session.undo(requests.Undo(), quiet)
    session.undo(requests.Undo(), quiet)
    assert state(session) == before


def test_a_lane_that_is_solo_acts_alone(session):
    perform(session)
    edit(session, Keys("masseter", ((0.1, 0.0), (0.5, 0.9))))
    lanes(session, solo=("signals",), muted=("signals",))
    score = session.current.take.score
    assert {m.channel for m in score.movements} == {"signals"}
    assert (score.lips, score.manual) == ((), ())
    assert len(session.described(session.current).drawn) == 1
    lanes(session, muted=("lips", "manual"))
    score = session.current.take.score
    assert (score.lips, score.manual) == ((), ())
    assert len({m.channel for m in score.movements}) > 1


def test_markers_are_in_order_and_follow_their_words(session):
    perform(session)
    words = {w.text.lower().strip(",.?!"): w for w in session.version().utterance.words}
    mark(session, Marker(words["very"].start, "very"), Marker(words["really"].start, "lift"))
    assert [m.text for m in session.version().markers] == ["lift", "very"]
    perform(session, "Well, to be quite honest with you: I like it very much.")
    very = next(w for w in session.version().utterance.words if w.text == "very")
    lift, later = session.version().markers
    assert later.time == pytest.approx(very.start, abs=1e-3)
    assert 0.0 <= lift.time < later.time
    perform(session, "Hm.")
    assert all(m.time <= session.version().score.duration for m in session.version().markers)


def test_they_are_kept_with_session_and_project(session, tmp_path):
    perform(session)
    shapes = (KeyShape(after=(0.1, 0.0)), KeyShape(hold=True), KeyShape(before=(-0.1, 0.2)))
    edit(session, Keys("masseter", ((0.1, 0.0), (0.5, 0.9), (0.7, 0.0)), shapes=shapes))
    mark(session, Marker(0.5, "here"))
    lanes(session, muted=("gaze",), locked=("head",))
    Autosave(session.folder).save(session)
    again = Session("again", session.folder)
    assert Autosave(session.folder).load(again) == ()
    folder = tmp_path / "other"
    folder.mkdir()
    other = Session("other", folder)
    opened = open_project(project_file(session), other.files)
    other.restore(opened.version, opened.view)
    for one in (again, other):
        assert state(one) == state(session)
        assert (one.version().markers, one.version().lanes) == (
            session.version().markers,
            session.version().lanes,
        )
        assert one.described(one.current).drawn[0].shapes == shapes
        assert (
            one.current.take.performance.values.tobytes() == session.current.take.performance.values.tobytes()
        )


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ({"do": "set_lanes", "lanes": {"muted": ["mouth"]}}, "unknown channel 'mouth'"),
        ({"do": "set_lanes", "lanes": {"quiet": []}}, "unknown key 'lanes.quiet'"),
        ({"do": "set_markers", "markers": [{"text": "x"}]}, r"key 'markers\[0\]\.time' is missing"),
        ({"do": "set_markers", "markers": [{"time": -1}]}, r"markers\[0\]\.time = -1"),
        ({"do": "set_markers", "markers": [{"time": 1}] * 501}, "501 markers"),
        (
            {
                "do": "edit",
                "kind": "keys",
                "parameter": "masseter",
                "keys": [[0, 0]],
                "shapes": [{"hold": 3}],
            },
            r"shapes\[0\]\.hold",
        ),
    ],
)
def test_what_does_not_fit_is_refused_in_one_line(body, message):
    with pytest.raises(RisoriusError, match=message) as caught:
        decode(json.dumps({"id": 1, **body}))
    assert "\n" not in str(caught.value)


def test_a_marker_lies_in_the_clip_and_a_long_note_is_cut(session):
    perform(session)
    with pytest.raises(RisoriusError, match="expected up to"):
        mark(session, Marker(99.0))
    request = decode(json.dumps({"id": 1, "do": "set_markers", "markers": [{"time": 1, "text": "x" * 999}]}))
    assert len(request.body.markers[0].text) == 120


def test_a_copy_of_a_movement_keeps_its_own_priority(session):
    perform(session)
    edit(session, Add("signals", 0.4, 1.2, {"AU1": 0.8}, priority=65))
    assert session.current.blocks["hand.1"].priority == 65
