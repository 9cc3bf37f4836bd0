"""A session without a server: what is performed, changed, taken back, saved and opened again."""

from __future__ import annotations

import json

import numpy as np
import pytest

from risorius.core.edits import Add, Delete, Keys, Move
from risorius.core.progress import quiet
from risorius.errors import InputError, RisoriusError
from risorius.ports.score.score_json import score_to_json
from risorius.studio.rules_fired import RulesFired, rules_fired
from risorius.studio.session import describe, performer, queries
from risorius.studio.session.session import Session
from risorius.studio.wire import answers, requests, shared

from ..conftest import LINE
from ..sessions import edit, perform, state


@pytest.fixture
def spoken(monkeypatch):
    """Return how often a voice was synthesized, in a list that grows."""
    made, say = [], performer.speak

    def counted(*given):
        made.append(given)
        return say(*given)

    monkeypatch.setattr(performer, "speak", counted)
    return made


WRONG = [
    ({"script": "Hello", "format": "xml"}, "script:1:1"),
    ({"script": "/etc/passwd", "format": "score"}, "not JSON"),
    (
        {"script": '{"risorius": 1, "duration": 1, "movement": []}', "format": "score"},
        "unknown key 'movement'",
    ),
    ({"script": "/etc/passwd", "format": "TextGrid"}, "labels.TextGrid"),
    ({"script": "x" * 200_001}, "longer than 200000 characters"),
    ({"script": "Hello", "recording": "../x.wav"}, "unknown recording '../x.wav'"),
    (
        {"script": "Hello", "emotions": (shared.EmotionSpan("/tmp/x.toml", 1.0),)},
        "unknown emotion '/tmp/x.toml'",
    ),
    ({"script": "Hello", "emotions": (shared.EmotionSpan("joy", 1.0, first=90),)}, "no word stands at"),
]


@pytest.mark.parametrize(("asked", "message"), WRONG)
def test_what_cannot_be_performed_is_named_and_changes_nothing(session, asked, message):
    with pytest.raises(RisoriusError) as caught:
        perform(session, **asked)
    assert message in str(caught.value)
    assert session.current is None


def test_a_take_has_an_end(session):
    score = json.dumps({"risorius": 1, "duration": 20_000, "movements": []})
    with pytest.raises(RisoriusError, match="would have 600001 frames; expected up to 216000"):
        perform(session, score, format="score")
    assert session.history.present is None


def test_before_the_first_take_there_is_nothing_to_change(session):
    for act, asked in (
        (session.edit, Delete("a")),
        (session.choose, requests.Choose()),
        (session.compare, requests.Compare(shared.Choices())),
        (session.undo, requests.Undo()),
    ):
        with pytest.raises(RisoriusError):
            act(asked, quiet)
    assert session.open(requests.Open(), quiet).take is None


def test_a_path_is_spoken_as_words_never_opened(session, tmp_path):
    (tmp_path / "secret.txt").write_text("hidden words")
    take = perform(session, str(tmp_path / "secret.txt"))
    assert "hidden" not in [word.text for word in take.speech.words]


def test_a_score_is_performed_as_it_says_and_may_then_be_chosen_otherwise(session):
    perform(session)
    held = score_to_json(session.current.take.score, session.current.take.utterance)
    held["settings"]["conflict"] = "inhibit"
    take = perform(session, json.dumps(held), format="score", choices=shared.Choices(fps="25"))
    assert (take.made.choices.conflict, take.fps) == ("inhibit", "25")
    assert [word.text for word in take.speech.words][:2] == ["Oh", "really"]
    again = session.choose(requests.Choose(shared.Choices(conflict="sum")), quiet)
    assert again.made.choices.conflict == "sum"
    assert {b.id for b in again.blocks} == {b.id for b in take.blocks}


def test_other_choices_need_no_other_voice(session, spoken):
    perform(session)
    for choices in (shared.Choices(conflict="sum"), shared.Choices(profile="lively"), shared.Choices(seed=3)):
        session.choose(requests.Choose(choices), quiet)
    session.compare(requests.Compare(shared.Choices(lips="lookahead")), quiet)
    assert len(spoken) == 1
    mute = shared.Choices(voice_emotion=False)
    session.choose(requests.Choose(mute), quiet)
    assert len(spoken) == 2
    session.choose(requests.Choose(mute, (shared.EmotionSpan("anger", 1.0),)), quiet)
    assert len(spoken) == 2
    session.choose(requests.Choose(shared.Choices(), (shared.EmotionSpan("anger", 1.0),)), quiet)
    assert len(spoken) == 3


def test_an_emotion_over_characters_lasts_from_word_to_word(session):
    span = shared.EmotionSpan("joy", 0.8, first=13, last=20)
    take = perform(session, emotions=(span,))
    words = [word for word in take.speech.words if word.last > 13 and word.first < 20]
    (block,) = (b for b in take.blocks if b.rule == "emotion.display")
    assert block.start == pytest.approx(words[0].start)
    assert block.end == pytest.approx(words[-1].end)
    assert [word.text for word in words] == ["like", "it"]


def test_what_is_done_and_undone_is_the_take_before(session):
    perform(session)
    blocks = [b for b in session.current.blocks.values() if b.editable]
    edits = (
        Move(blocks[0].id, 0.05),
        Keys("zygomatic_major.left", ((0.5, 0.0), (1.0, 0.7), (1.5, 0.0))),
        Add("signals", 0.4, 1.2, {"AU1": 0.8}),
        Delete(blocks[1].id),
    )
    states = [state(session)]
    for one in edits:
        edit(session, one)
        states.append(state(session))
    assert len({json.dumps(known) for known in states}) == len(states)
    for known in reversed(states[:-1]):
        session.undo(requests.Undo(), quiet)
        assert state(session) == known
    for known in states[1:]:
        session.redo(requests.Redo(), quiet)
        assert state(session) == known


def test_a_change_tells_what_is_other_and_nothing_else(session):
    before = perform(session)
    change = edit(session, Keys("mentalis.left", ((0.5, 0.0), (1.0, 0.7), (1.5, 0.0))))
    assert (change.before, change.whole, change.blocks, change.gone) == (before.take, None, (), ())
    # What stands in the way of a muscle's rivals may be other, too, but nothing far from it.
    assert "mentalis.left" in change.curves
    assert all(name.partition(".")[0] in {"mentalis", "lip_seal", *_RIVALS} for name in change.curves)
    values = [session.takes[n].take.performance.values for n in (before.take, change.take)]
    other = np.flatnonzero((values[0] != values[1]).any(axis=1))
    assert change.from_frame == other[0]
    assert other[-1] < change.to_frame
    for name, curve in session.current.curves.items():
        assert change.curves.get(name, session.takes[before.take].curves.get(name)) == curve


_RIVALS = ("zygomatic_major", "zygomatic_minor", "depressor_labii")


def test_a_preview_says_what_an_edit_would_do_and_does_not_make_it(session):
    take = perform(session)
    block = next(b for b in take.blocks if b.channel == "signals")
    before = state(session)
    _, told = session.preview(Move(block.id, block.start + 0.2))
    assert state(session) == before
    assert told.take == take.take
    made = edit(session, Move(block.id, block.start + 0.2))
    assert told.curves == made.curves
    assert set(block.targets) & set(told.curves)


def test_a_preview_of_several_edits_says_what_they_would_do_together(session):
    take = perform(session)
    edits = [Move(b.id, b.start + 0.2) for b in take.blocks if b.channel == "signals"][:2]
    before = state(session)
    _, told = session.preview(*edits)
    assert state(session) == before
    made = session.edit_all(requests.EditAll(tuple(edits)), quiet)
    assert told.curves == made.curves
    with pytest.raises(InputError, match="0 edits at once"):
        session.preview()


def test_edits_are_made_again_on_another_plan_and_what_does_not_fit_is_named(session):
    take = perform(session)
    block = next(b for b in take.blocks if b.channel == "signals")
    edit(session, Move(block.id, 0.1))
    edit(session, Add("emotion", 0.2, 1.0, {"AU12": 0.5}))
    again = session.choose(requests.Choose(shared.Choices(conflict="inhibit")), quiet)
    moved = {b.id: b for b in again.blocks}
    assert moved[block.id].start == 0.1
    assert moved[block.id].edited
    assert "hand.1" in moved
    assert not again.warnings
    without = session.choose(requests.Choose(shared.Choices(without=("signals",))), quiet)
    (warning,) = without.warnings
    assert warning.startswith('1 of the changes by hand did not fit any more: move brows (signals) on "Oh')
    assert "hand.1" in {b.id for b in without.blocks}
    session.undo(requests.Undo(), quiet)
    assert session.current.blocks[block.id].start == 0.1


def test_explanations_say_by_hand_and_name_the_block(session):
    perform(session, emotions=(shared.EmotionSpan("joy", 1.0),))
    edit(session, Keys("zygomatic_major.left", ((0.5, 0.3), (1.5, 0.3))))
    take = session.current.number
    told = queries.explain(session, requests.Explain(take, 1.0, "zygomatic_major.left"), quiet)
    (reason,) = told.reasons
    assert reason.value == pytest.approx(0.3)
    assert (reason.winner.channel, reason.winner.rule) == ("manual", "by hand")
    assert any(part.movement.startswith("emotion.1") for part in reason.losers)
    assert any("by hand" in line for line in told.sentences)
    rules = rules_fired(session, RulesFired(take), quiet).rules
    named = {block for rule in rules for block in rule.blocks}
    assert named == {b.id for b in session.current.blocks.values() if b.editable}
    detail = queries.channel_curves(session, requests.ChannelCurves(take, "zygomatic_major.left"), quiet)
    assert "emotion" in {channel.channel for channel in detail.channels}


def test_few_takes_are_kept_and_never_the_present_one_lost(session):
    perform(session, "Hm.")
    for seed in range(12):
        session.compare(requests.Compare(shared.Choices(seed=seed)), quiet)
    assert len(session.takes) == 6
    assert session.current.number in session.takes
    with pytest.raises(RisoriusError, match="there is no take 2"):
        session.live(2)


NAMES = ["", "../x", "a/b", "x" * 61, "-x", "a\nb"]


@pytest.mark.parametrize("name", NAMES)
def test_names_are_plain(session, name):
    with pytest.raises(RisoriusError, match="is not a name"):
        session.files.save_pose(name, {"AU1": 1.0})
    with pytest.raises(RisoriusError, match="is not a name"):
        session.files.save_emotion(name, {"AU1": 1.0})


def test_an_emotion_saved_anew_is_the_new_one(session):
    session.files.save_emotion("grin", {"AU12": 1.0})
    one = perform(session, "Hm.", emotions=(shared.EmotionSpan("grin", 1.0),))
    session.files.save_emotion("grin", {"AU12": 0.5})
    two = perform(session, "Hm.", emotions=(shared.EmotionSpan("grin", 1.0),))
    strengths = [
        next(b.targets["zygomatic_major.left"] for b in take.blocks if b.rule == "emotion.display")
        for take in (one, two)
    ]
    assert strengths == [1.0, 0.5]
    with pytest.raises(RisoriusError, match="is the name of an emotion of Risorius"):
        session.files.save_emotion("joy", {"AU12": 0.5})


def prepare(session, script=LINE, emotions=(), **source):
    return session.prepare(
        requests.Prepare(shared.Source(script, **source), shared.Choices(), emotions), quiet
    )


@pytest.mark.parametrize(
    ("script", "source"),
    [("", {}), ("Hello", {"format": "xml"}), ("Hello", {"recording": "x.wav"}), ("No. " * 251, {})],
)
def test_what_is_no_short_text_is_not_prepared_and_nothing_is_said_of_it(session, spoken, script, source):
    assert prepare(session, script, **source) == answers.Done()
    assert spoken == []


def test_what_cannot_be_performed_is_said_when_it_is_asked_for(session):
    span = shared.EmotionSpan("cheese", 1.0)
    assert prepare(session, emotions=(span,)) == answers.Done()
    with pytest.raises(RisoriusError, match="cheese"):
        perform(session, emotions=(span,))


def test_what_is_prepared_changes_nothing_and_is_performed_as_if_it_had_not_been(session, spoken, tmp_path):
    prepare(session)
    assert session.current is None
    assert len(spoken) == 1
    view = perform(session)
    assert len(spoken) == 1
    other = perform(Session("two", tmp_path))
    assert (view.take, view.curves, view.blocks) == (other.take, other.curves, other.blocks)
    prepare(session, "Something else.")
    assert perform(session).curves == view.curves


def test_an_emotion_that_is_saved_anew_is_not_that_which_was_prepared(session):
    def save(value):
        queries.save_pose(session, requests.SavePose("mine", "emotion", {"AU12": value}), quiet)

    span = shared.EmotionSpan("mine", 1.0)
    save(0.2)
    prepare(session, emotions=(span,))
    save(0.9)
    strong = perform(session, emotions=(span,))
    save(0.2)
    assert perform(session, emotions=(span,)).curves != strong.curves


def test_blocks_after_changes_are_those_of_the_score_described_whole(session):
    perform(session)
    held = dict(session.current.blocks)
    block = next(b for b in held.values() if b.channel == "signals")
    for change in (Move(block.id, block.start + 0.05), Add("signals", 0.4, 1.2, {"AU4": 0.5})):
        edit(session, change)
        assert session.current.blocks == describe.blocks(session.current.version.score)
    kept = [name for name, old in held.items() if session.current.blocks[name] is old]
    assert set(kept) == set(held) - {block.id}
    edit(session, Delete(block.id))
    session.undo(requests.Undo(), quiet)
    assert session.current.blocks == describe.blocks(session.current.version.score)
    perform(session, "Something else.")
    assert session.current.blocks == describe.blocks(session.current.version.score)


def test_several_edits_are_one_change_or_none(session):
    take = perform(session)
    blocks = [b for b in take.blocks if b.channel == "signals"][:3]
    before = state(session)
    edits = tuple(Move(b.id, b.start + 0.1) for b in blocks)
    session.edit_all(requests.EditAll(edits), quiet)
    moved = [session.current.blocks[b.id].start for b in blocks]
    assert moved == pytest.approx([b.start + 0.1 for b in blocks], abs=1e-4)
    assert session.history.undoes.endswith("and 2 more")
    session.undo(requests.Undo(), quiet)
    assert state(session) == before
    for wrong in ((*edits, Delete("none")), (), edits * 1000):
        with pytest.raises(RisoriusError):
            session.edit_all(requests.EditAll(wrong), quiet)
        assert state(session) == before


def test_the_take_follows_an_edge_that_is_moved_by_hand(session, spoken):
    before = perform(session)
    k = next(k for k, phone in enumerate(before.speech.phones) if phone.symbol == "V")
    was = before.speech.phones[k].start
    block = next(b for b in before.blocks if b.channel == "signals" and b.start > was)
    edit(session, Move(block.id, block.start + 0.2))
    moved = session.relabel(requests.Relabel(k, was + 0.03), quiet)
    assert moved.speech.phones[k].start == pytest.approx(was + 0.03)
    assert next(b for b in moved.blocks if b.channel == "lips" and b.label == "V").start > was
    assert moved.curves != before.curves
    assert sum(b.edited for b in moved.blocks) == 1
    assert moved.undoes == "move the edge of V in “very”"
    again = session.relabel(requests.Relabel(k, was + 0.04), quiet)
    assert again.speech.phones[k].start == pytest.approx(was + 0.04)
    assert [edge.shift for edge in again.made.source.edges] == [pytest.approx(0.04)]
    other = perform(session, "So I like it very much.", edges=again.made.source.edges)
    assert len(other.made.source.edges) == 1
    perform(session, LINE, edges=again.made.source.edges)
    back = session.relabel(requests.Relabel(k), quiet)
    assert back.speech.phones == before.speech.phones
    assert not back.made.source.edges
    assert len(spoken) == 2  # a voice for each text
    with pytest.raises(RisoriusError, match="there is no edge"):
        session.relabel(requests.Relabel(0, 0.2), quiet)


def test_a_script_without_words_is_performed(session):
    silent = '<SCRIPT duration="4"><LISTEN time="0"/></SCRIPT>'
    answer = perform(session, silent, format="xml")
    assert answer.speech is None
    assert answer.duration == 4.0
