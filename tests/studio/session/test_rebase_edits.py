"""Changes by hand follow the text when it changes: by word and by phone, and nothing is dropped unsaid."""

from __future__ import annotations

import pytest

from risorius.core.edits import Add, Delete, Keys, Move, Retarget, Stretch
from risorius.core.progress import quiet
from risorius.errors import RisoriusError
from risorius.studio.project.autosave import Autosave
from risorius.studio.session.session import Session
from risorius.studio.session.word_times import Fit, WordTimes
from risorius.studio.wire import requests, shared

from ..sessions import edit, perform, state

LINE = "Oh really? I like it very much."


def word(session, text):
    return next(w for w in session.version().utterance.words if w.text.lower().strip(",.?!") == text)


def movement(take, channel, layer):
    return next(b for b in take.blocks if (b.channel, b.layer) == (channel, layer))


def by_hand(take):
    return [b for b in take.blocks if b.edited]


def test_a_changed_mark_keeps_every_change(session):
    take = perform(session)
    brow = movement(take, "signals", "brows")
    edit(session, Move(brow.id, brow.start + 0.1))
    edit(session, Retarget(brow.id, {"AU1": 0.9}))
    again = perform(session, LINE.replace(".", "!"))
    (moved,) = by_hand(again)
    assert moved.start == pytest.approx(brow.start + 0.1, abs=0.02)
    assert set(moved.targets.values()) == {0.9}
    assert (again.lost, again.warnings) == ((), ())


def test_words_before_it_move_a_change_with_its_word_and_its_phone(session):
    perform(session)
    very = word(session, "very")
    edit(session, Add("signals", very.start, very.end, {"AU1": 0.8}))
    edit(session, Keys("masseter", ((very.start, 0.0), (very.end, 0.5))))
    again = perform(session, "Well, to be quite honest with you: I like it very much.")
    now = word(session, "very")
    assert now.start > very.start + 0.3
    added = next(b for b in again.blocks if b.id == "hand.1")
    assert (added.start, added.end) == pytest.approx((now.start, now.end), abs=1e-3)
    assert again.drawn[0].keys[0][0] == pytest.approx(now.start, abs=1e-3)
    assert again.lost == ()


def test_what_is_on_a_word_that_is_gone_is_named_kept_and_can_be_brought_back(session, tmp_path):
    take = perform(session)
    really = word(session, "really")
    edit(session, Add("signals", really.start + 0.01, really.end, {"AU1": 0.8}))
    edit(session, Stretch("hand.1", onset=0.05))
    last = next(b for b in take.blocks if b.channel == "punctuators" and b.start > 2.0)
    edit(session, Delete(last.id))
    kept = state(session)
    again = perform(session, "I like it very much.")
    assert [text.split(" at ")[0] for text in again.lost] == ["add a movement of signals"]
    assert "did not fit" in again.warnings[0]
    assert not by_hand(again)
    # It outlasts a restart, and comes back in one step that can be undone.
    Autosave(tmp_path).save(session)
    other = Session("one", tmp_path)
    assert Autosave(tmp_path).load(other) == ()
    for one in (session, other):
        change = one.bring_back(requests.BringBack(0), quiet)
        assert [b.targets["frontalis_medialis.left"] for b in change.blocks if b.edited] == [0.8]
        assert change.lost == ()
        assert one.undo(requests.Undo(), quiet).lost == again.lost
        assert one.let_go(requests.LetGo(), quiet).lost == ()
        with pytest.raises(RisoriusError, match="there is no number 0"):
            one.bring_back(requests.BringBack(0), quiet)
    while state(session) != kept:
        session.undo(requests.Undo(), quiet)


def test_what_was_lost_is_there_again_with_its_words(session):
    take = perform(session)
    edit(session, Move(movement(take, "signals", "brows").id, 0.55))
    last = next(b for b in take.blocks if b.channel == "punctuators" and b.start > 2.0)
    edit(session, Delete(last.id))
    before = state(session)
    assert len(perform(session, "I like it very much.").lost) == 1
    assert perform(session).lost == ()
    assert state(session) == before


def test_a_slower_voice_keeps_changes_at_their_words(session):
    take = perform(session)
    brow = movement(take, "signals", "brows")
    edit(session, Stretch(brow.id, end=word(session, "really").end))
    again = perform(session, choices=shared.Choices(rate=120))
    (moved,) = by_hand(again)
    assert moved.end == pytest.approx(word(session, "really").end, abs=1e-3)


def test_where_times_lie_in_another_line(session):
    perform(session)
    before = session.version().utterance
    perform(session, "Oh really? You like it, much.")
    after = session.version().utterance
    times = WordTimes(before, after)
    assert times.at(0.0) == (0.0, Fit.SAME)
    for old, new, fit in ((1, 1, Fit.SAME), (2, 2, Fit.REPLACED), (3, 3, Fit.SAME), (6, 5, Fit.SAME)):
        found, how = times.at(before.words[old].start)
        assert (found, how) == (pytest.approx(after.words[new].start, abs=1e-3), fit)
    assert times.at(before.words[5].start + 0.01) == (pytest.approx(after.words[4].end, abs=1e-3), Fit.GONE)
    assert times.at(before.duration)[0] == pytest.approx(after.duration)
    assert WordTimes(None, after).at(1.5) == (1.5, Fit.SAME)
