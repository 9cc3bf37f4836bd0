"""What a session keeps: projects, its own state, recordings."""

from __future__ import annotations

import base64
import io
import json
import wave

import numpy as np
import pytest
import soundfile

from risorius.core.edits import Add, Keys
from risorius.core.progress import quiet
from risorius.errors import RisoriusError
from risorius.studio.project.autosave import FILE, Autosave
from risorius.studio.project.project import open_project, project_file
from risorius.studio.session.session import Session
from risorius.studio.session.session_files import SessionFiles
from risorius.studio.wire import requests, shared
from risorius.studio.wire.views import PageView

from ..sessions import edit, perform, state


def test_a_project_opens_exactly_elsewhere(session, tmp_path):
    session.files.save_emotion("grin", {"AU12": 1.0})
    session.files.save_pose("smirk", {"zygomatic_major.left": 1.0})
    perform(session, emotions=(shared.EmotionSpan("grin", 0.9, first=3, last=9),))
    edit(session, Add("signals", 0.4, 1.2, {"AU1": 0.8}))
    edit(session, Keys("masseter", ((0.5, 0.0), (1.0, 0.7))))
    session.save_view(requests.SaveView(PageView("rules")), quiet)
    folder = tmp_path / "other"
    folder.mkdir()
    other = Session("two", folder)
    opened = open_project(project_file(session), other.files)
    other.restore(opened.version, opened.view)
    _assert_same(other, session)
    assert other.files.poses() == {"smirk": {"zygomatic_major.left": 1.0}}
    assert state(other) == state(session)
    for _ in range(2):
        other.undo(requests.Undo(), quiet)
        session.undo(requests.Undo(), quiet)
        assert state(other) == state(session)


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
    session.save_view(requests.SaveView(PageView(time=2.0)), quiet)
    autosave.save(session)
    again = Session("one", tmp_path)
    assert Autosave(tmp_path).load(again) == ()
    _assert_same(again, session)
    assert again.current.number > session.current.number
    again.undo(requests.Undo(), quiet)
    session.undo(requests.Undo(), quiet)
    assert state(again) == state(session)


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


def test_marks_in_a_recordings_transcript_follow_the_expression(session, tmp_path):
    """The sound is heard once, but what its marks show is of the settings of each performance."""
    perform(session, "I like it.")
    uploaded = tmp_path / "upload"
    uploaded.write_bytes(session.current.take.utterance.audio.path.read_bytes())
    name = session.files.add_recording("line.wav", uploaded)
    script = '<PHONEME time="0" text="I like it." /><EMOTIONDISPLAY time="0" duration="1.5" Joy="1" />'
    felt = perform(session, script, format="xml", recording=name)
    assert [word.text for word in felt.speech.words] == ["I", "like", "it"]
    posed = session.choose(requests.Choose(shared.Choices(expression="posed")), quiet)

    def rises(take):
        return [b.apex_start - b.start for b in take.blocks if b.channel == "emotion"]

    assert len(rises(felt)) == len(rises(posed)) > 0
    assert all(shown < natural - 0.05 for shown, natural in zip(rises(posed), rises(felt), strict=True))


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


def test_what_is_written_is_kept_until_it_is_performed(session, tmp_path):
    saved = Autosave(tmp_path)
    session.save_draft(
        requests.SaveDraft(shared.Source("Not yet."), emotions=(shared.EmotionSpan("joy", 0.5),)), quiet
    )
    saved.save(session)
    again = Session("one", tmp_path)
    assert Autosave(tmp_path).load(again) == ()
    assert again.draft == session.draft
    perform(again, "Not yet.", emotions=again.draft.emotions)
    assert again.draft is None
    again.save_draft(
        requests.SaveDraft(shared.Source("Not yet."), emotions=(shared.EmotionSpan("joy", 0.5),)), quiet
    )
    assert again.draft is None
    (tmp_path / "draft.json").write_text("{")
    assert "draft-broken.json" in Autosave(tmp_path).load(Session("one", tmp_path))[0]


def test_what_a_project_replaces_can_be_put_back(session, tmp_path):
    perform(session, "Hm.")
    edit(session, Add("signals", 0.4, 1.2, {"AU1": 0.8}))
    own = state(session)
    other = Session("two", tmp_path)
    perform(other, "Oh!")
    edit(other, Keys("masseter", ((0.1, 0.0), (0.2, 0.7))))
    opened = open_project(project_file(other), session.files)
    session.open_version(opened.version, opened.view)
    assert state(session) == state(other)
    assert session.history.undoes == "draw masseter"
    for _ in range(2):
        session.undo(requests.Undo(), quiet)
    assert state(session) == own
    for _ in range(2):
        session.redo(requests.Redo(), quiet)
    session.undo(requests.Undo(opened=True), quiet)
    assert state(session) == own
    assert session.history.redoes == "open the project"
    with pytest.raises(RisoriusError, match="nothing to go back to"):
        session.undo(requests.Undo(opened=True), quiet)


HOSTILE = [
    ({"time": "abc"}, 'view.time = "abc" cannot be used'),
    ({"graphs": {"folded": 7}}, "view.graphs.folded = 7 cannot be used"),
    ({"camera": "junk"}, "view.camera"),
    ({"camera": {"centre": [0, 0], "height": 1, "turn": 0, "tilt": 0}}, "view.camera.centre"),
    ({"graphs": {"chosen": ["x"] * 201}}, "has 201 entries; expected up to 200"),
    ({"graphs": {"sides": {"x" * 61: "left"}}}, "more than 60 characters"),
    ({"notes": "x" * 20_000_000}, "unknown key 'view.notes'"),
]


@pytest.fixture(scope="module")
def small_project(tmp_path_factory):
    session = Session("small", tmp_path_factory.mktemp("small"))
    perform(session, "Hm.")
    return project_file(session)


@pytest.mark.parametrize(("view", "message"), HOSTILE, ids=lambda given: str(given)[:40])
def test_a_view_that_cannot_be_shown_is_refused(session, small_project, view, message):
    document = json.loads(small_project) | {"view": view}
    with pytest.raises(RisoriusError) as caught:
        open_project(json.dumps(document).encode(), session.files)
    assert message in str(caught.value)
    assert len(str(caught.value)) < 300


def test_a_session_whose_view_cannot_be_shown_is_not_lost(session, tmp_path):
    perform(session, "Hm.")
    Autosave(tmp_path).save(session)
    document = json.loads((tmp_path / FILE).read_text()) | {"view": {"playhead": "x"}}
    (tmp_path / FILE).write_text(json.dumps(document))
    again = Session("one", tmp_path)
    assert Autosave(tmp_path).load(again) == ()
    assert (again.view, again.current is not None) == (PageView(), True)


def _flac(seconds, claimed=None):
    buffer = io.BytesIO()
    soundfile.write(
        buffer, np.zeros(int(22_050 * seconds), np.int16), 22_050, format="FLAC", subtype="PCM_16"
    )
    data = bytearray(buffer.getvalue())
    if claimed is not None:
        # STREAMINFO: 36 bits of the number of samples, from bit 4 of byte 21 of the file on.
        data[21] = data[21] & 0xF0 | claimed >> 32
        data[22:26] = (claimed & 0xFFFFFFFF).to_bytes(4, "big")
    return base64.b64encode(bytes(data)).decode()


@pytest.mark.parametrize("sound", [_flac(0.1, 2**36 - 1), _flac(100.0)], ids=["claims", "is long"])
def test_a_sound_is_not_decoded_beyond_its_speech(session, small_project, sound):
    document = json.loads(small_project) | {"sound": sound}
    with pytest.raises(RisoriusError, match="sound") as caught:
        open_project(json.dumps(document).encode(), session.files)
    assert "\n" not in str(caught.value)


def test_messages_name_a_recording_as_the_user_did(tmp_path):
    files = SessionFiles(tmp_path)
    line = f"{tmp_path}/recordings/my-voice-8bbbaea6.wav: is silent; see {tmp_path}/rules.toml"
    assert files.told(line) == "my-voice.wav: is silent; see rules.toml"
