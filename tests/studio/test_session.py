"""A session without a server: what is performed, changed, taken back, saved and opened again."""

from __future__ import annotations

import json
import wave

import numpy as np
import pytest

from risorius.core.edits import Add, Delete, Keys, Move
from risorius.core.progress import quiet
from risorius.errors import RisoriusError
from risorius.ports.score_json import score_to_json
from risorius.studio import describe, looking, performer
from risorius.studio.autosave import FILE, Autosave
from risorius.studio.project import open_project, project_file
from risorius.studio.session import Session
from risorius.studio.wire import answers, requests, shared

LINE = "Oh really? I like it very much."


def perform(session, script=LINE, choices=None, emotions=(), **source):
    asked = requests.Perform(shared.Source(script, **source), choices or shared.Choices(), emotions)
    return session.perform(asked, quiet)


def edit(session, asked):
    return session.edit(asked, quiet)


@pytest.fixture
def session(tmp_path):
    return Session("one", tmp_path)


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
    ({"script": "Hello", "emotions": (shared.EmotionSpan("joy", 1.0, first=90),)}, "there is no word in"),
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
    states = [_state(session)]
    for one in edits:
        edit(session, one)
        states.append(_state(session))
    assert len({json.dumps(state) for state in states}) == len(states)
    for state in reversed(states[:-1]):
        session.undo(requests.Undo(), quiet)
        assert _state(session) == state
    for state in states[1:]:
        session.redo(requests.Redo(), quiet)
        assert _state(session) == state


def _state(session):
    """Return what a page sees of a take, its number aside."""
    live = session.current
    return [sorted(live.blocks), [str(b) for b in live.blocks.values()], live.curves]


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
    before = _state(session)
    _, told = session.preview(Move(block.id, block.start + 0.2))
    assert _state(session) == before
    assert told.take == take.take
    made = edit(session, Move(block.id, block.start + 0.2))
    assert told.curves == made.curves
    assert set(block.targets) & set(told.curves)


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
    assert f"an edit could not be applied again (move {block.id}): unknown block" in warning
    assert "hand.1" in {b.id for b in without.blocks}
    session.undo(requests.Undo(), quiet)
    assert session.current.blocks[block.id].start == 0.1


def test_explanations_say_by_hand_and_name_the_block(session):
    perform(session, emotions=(shared.EmotionSpan("joy", 1.0),))
    edit(session, Keys("zygomatic_major.left", ((0.5, 0.3), (1.5, 0.3))))
    take = session.current.number
    told = looking.explain(session, requests.Explain(take, 1.0, "zygomatic_major.left"), quiet)
    (reason,) = told.reasons
    assert reason.value == pytest.approx(0.3)
    assert (reason.winner.channel, reason.winner.rule) == ("manual", "by hand")
    assert any(part.movement.startswith("emotion.1") for part in reason.losers)
    assert any("by hand" in line for line in told.sentences)
    rules = looking.rules_fired(session, requests.RulesFired(take), quiet).rules
    named = {block for rule in rules for block in rule.blocks}
    assert named == {b.id for b in session.current.blocks.values() if b.editable}
    detail = looking.channel_curves(session, requests.ChannelCurves(take, "zygomatic_major.left"), quiet)
    assert "emotion" in {channel.channel for channel in detail.channels}


def test_few_takes_are_kept_and_never_the_present_one_lost(session):
    perform(session, "Hm.")
    for seed in range(12):
        session.compare(requests.Compare(shared.Choices(seed=seed)), quiet)
    assert len(session.takes) == 6
    assert session.current.number in session.takes
    with pytest.raises(RisoriusError, match="there is no take 2"):
        session.live(2)


def test_a_project_opens_exactly_elsewhere(session, tmp_path):
    session.files.save_emotion("grin", {"AU12": 1.0})
    session.files.save_pose("smirk", {"zygomatic_major.left": 1.0})
    perform(session, emotions=(shared.EmotionSpan("grin", 0.9, first=3, last=9),))
    edit(session, Add("signals", 0.4, 1.2, {"AU1": 0.8}))
    edit(session, Keys("masseter", ((0.5, 0.0), (1.0, 0.7))))
    session.keep_view(requests.View({"tab": "rules"}), quiet)
    folder = tmp_path / "other"
    folder.mkdir()
    other = Session("two", folder)
    opened = open_project(project_file(session), other.files)
    other.restore(opened.version, opened.view)
    _assert_same(other, session)
    assert other.files.poses() == {"smirk": {"zygomatic_major.left": 1.0}}
    assert _state(other) == _state(session)
    for _ in range(2):
        other.undo(requests.Undo(), quiet)
        session.undo(requests.Undo(), quiet)
        assert _state(other) == _state(session)


def _assert_same(one, other):
    a, b = one.current.take, other.current.take
    assert a.performance.values.tobytes() == b.performance.values.tobytes()
    assert a.score == b.score
    assert a.settings.blend == b.settings.blend
    assert np.array_equal(a.utterance.audio.read(), b.utterance.audio.read())
    assert a.utterance.words == b.utterance.words
    assert (one.view, one.history.present.inputs) == (other.view, other.history.present.inputs)


BROKEN = [
    (b"", "not JSON"),
    (b"[]", "an object"),
    (b'{"risorius_project": 2, "made": {}, "edits": [], "score": {}}', "version 2 is not known"),
    (b'{"risorius_project": 1, "made": {}, "edits": []}', "key 'score' is missing"),
    (b'{"risorius_project": 1, "made": {}, "edits": [], "score": {}, "x": 1}', "unknown key 'x'"),
    (
        b'{"risorius_project": 1, "made": {"sauce": 1}, "edits": [], "score": {}}',
        "unknown key 'made.sauce'; did you mean 'source'",
    ),
]


@pytest.mark.parametrize(("data", "message"), BROKEN)
def test_what_is_no_project_is_named(session, data, message):
    with pytest.raises(RisoriusError) as caught:
        open_project(data, session.files)
    assert message in str(caught.value)


def test_a_project_s_own_path_to_a_sound_is_not_followed(session, tmp_path):
    perform(session, "Hm.")
    document = json.loads(project_file(session))
    document["score"]["speech"]["audio"] = "../../../../etc/passwd"
    del document["sound"]
    opened = open_project(json.dumps(document).encode(), session.files)
    assert not opened.version.utterance.audio.read().any()
    document["edits"] = [{"kind": "format", "disk": "c"}]
    with pytest.raises(RisoriusError, match="unknown kind of edit"):
        open_project(json.dumps(document).encode(), session.files)
    document["edits"], document["sound"] = [], "AAAA"
    with pytest.raises(RisoriusError, match="sound"):
        open_project(json.dumps(document).encode(), session.files)


def test_a_session_saves_itself_and_goes_on_after_a_crash(session, tmp_path):
    perform(session)
    autosave = Autosave(tmp_path)
    autosave.save(session)
    edit(session, Add("signals", 0.4, 1.2, {"AU1": 0.8}))
    session.keep_view(requests.View({"camera": 2}), quiet)
    autosave.save(session)
    again = Session("one", tmp_path)
    assert Autosave(tmp_path).load(again) == ()
    _assert_same(again, session)
    assert again.current.number > session.current.number
    again.undo(requests.Undo(), quiet)
    session.undo(requests.Undo(), quiet)
    assert _state(again) == _state(session)


def test_what_is_spoilt_is_put_aside_and_said(session, tmp_path):
    perform(session, "Hm.")
    Autosave(tmp_path).save(session)
    (tmp_path / FILE).write_text('{"risorius_project": 1,', encoding="utf-8")
    again = Session("one", tmp_path)
    (note,) = Autosave(tmp_path).load(again)
    assert "renamed to project-broken.json" in note
    assert again.current is None
    assert (tmp_path / "project-broken.json").exists()
    assert Autosave(tmp_path).load(again) == ()


def test_a_sound_that_is_saved_over_is_still_heard_after_an_undo(session, tmp_path):
    perform(session, "Hm.")
    Autosave(tmp_path).save(session)
    again = Session("one", tmp_path)
    autosave = Autosave(tmp_path)
    autosave.load(again)
    perform(again, "Well.")
    autosave.save(again)
    assert len(list(tmp_path.glob("voice-*.wav"))) == 1
    again.undo(requests.Undo(), quiet)
    assert again.current.take.utterance.audio.read().any()


def test_a_recording_is_taken_in_under_a_plain_name_and_performed(session, tmp_path):
    perform(session, "I like it.")
    uploaded = tmp_path / "upload"
    uploaded.write_bytes(session.current.take.utterance.audio.path.read_bytes())
    name = session.files.add_recording("../../my line!.WAV", uploaded)
    assert name.startswith("my-line-")
    assert (tmp_path / "recordings" / name).exists()
    take = perform(session, "I like it.", recording=name)
    assert [word.text for word in take.speech.words] == ["I", "like", "it"]
    project = project_file(session)
    folder = tmp_path / "other"
    folder.mkdir()
    other = Session("two", folder)
    opened = open_project(project, other.files)
    other.restore(opened.version, opened.view)
    assert other.files.recordings() == (name,)
    _assert_same(other, session)


def test_what_is_no_recording_is_refused(session, tmp_path):
    uploaded = tmp_path / "upload"
    uploaded.write_bytes(b"RIFF nothing")
    for name in ("x.wav", "x.exe", "x", ""):
        with pytest.raises(RisoriusError, match="recording"):
            session.files.add_recording(name, uploaded)
    with wave.open(str(uploaded), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(16_000)
        file.writeframes(bytes(32_000))
    with pytest.raises(RisoriusError, match="cannot be used"):
        session.files.add_recording("x.wav", uploaded)
    assert session.files.recordings() == ()


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
        looking.name_pose(session, requests.SavePose("mine", "emotion", {"AU12": value}), quiet)

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
