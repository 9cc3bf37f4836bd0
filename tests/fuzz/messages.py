"""What pages, clients and services send, what a studio saves, and what is written in a notebook or an option.

A file of messages has one on each line; all are done, and what was wrong with the first wrong one is raised.
"""

from __future__ import annotations

import base64
import json
import shutil
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

from starlette.datastructures import Headers
from starlette.requests import Request

from risorius.batches.journal import NAME as JOURNAL
from risorius.batches.journal import Journal
from risorius.core.progress import quiet
from risorius.errors import InputError, OutputError, RisoriusError
from risorius.live.serve.choices import settings_from
from risorius.live.serve.client import follow
from risorius.live.serve.frames import FrameLayout
from risorius.live.serve.guard import Guard
from risorius.live.serve.messages import Interrupt, Output, StartFace
from risorius.live.serve.messages import decode as decode_live
from risorius.live.services import AzureVoice, CartesiaVoice, ElevenLabsVoice
from risorius.live.session import Live
from risorius.settings import Settings
from risorius.settings.presets import load_settings
from risorius.studio.app import looks_of
from risorius.studio.decoding import decode
from risorius.studio.project import session_list
from risorius.studio.project.autosave import DRAFT, FILE, Autosave
from risorius.studio.project.project import VERSION, open_project
from risorius.studio.request_table import ROWS
from risorius.studio.session.session import Session
from risorius.studio.session.session_files import SessionFiles
from risorius.studio.wire import requests, shared
from risorius.studio.wire.messages import encoded

from .registry import register
from .scores import MINIMAL, SCORE, as_json

SILENCE = base64.b64encode(bytes(64)).decode()


def _each(lines: Iterable[str], do: Callable[[str], object]) -> None:
    """Do all lines; raise what was wrong with the first wrong one."""
    faults: list[RisoriusError] = []
    for line in lines:
        try:
            do(line)
        except RisoriusError as error:
            faults.append(error)
    if faults:
        raise faults[0]


def _lines(path: Path) -> list[str]:
    return path.read_bytes().decode("utf-8", "replace").split("\n")[:200]


def _face() -> Live:
    return Live(Settings(fps=Fraction(5)))


def _client(path: Path) -> None:
    face = _face()

    def do(line: str) -> None:
        message = decode_live(line)
        if isinstance(message, StartFace):
            settings_from(message)
            FrameLayout([output for output in message.outputs if output is not Output.RIG])
        elif isinstance(message, Interrupt):
            face.interrupt()
        else:
            follow(face, message)

    try:
        _each(_lines(path), do)
    finally:
        face.interrupt()


def _service(make: Callable[[Live], Callable[[Any], None]]) -> Callable[[Path], None]:
    """Return what says the messages of a service, which its own library has parsed."""

    def read(path: Path) -> None:
        face = _face()
        say = make(face)

        def do(line: str) -> None:
            try:
                message = json.loads(line)
            except (ValueError, RecursionError):
                raise InputError("is not JSON; expected a message") from None
            say(message)

        try:
            _each(_lines(path), do)
        finally:
            face.interrupt()

    return read


def _azure(face: Live) -> Callable[[Any], None]:
    voice = AzureVoice(face)

    def say(message: Any) -> None:
        if isinstance(message, list):
            voice.word(*(message[:4] if len(message) > 2 else ("", 0, 0)))
        elif isinstance(message, str):
            voice.sound(message.encode("utf-8", "replace"))
        else:
            voice.end()

    return say


def _emptied(path: Path) -> Path:
    """Return an empty folder beside a file."""
    folder = path.parent / "session"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder


def _project(path: Path) -> object:
    return open_project(path.read_bytes(), SessionFiles(_emptied(path)))


def _saved_session(path: Path) -> object:
    """Open a session whose file, or one of the others in its folder, is spoilt."""
    folder = _emptied(path)
    (folder / "score-1.json").write_bytes(as_json(MINIMAL))
    for name in (FILE, "emotions.json", "poses.json", session_list.ABOUT):
        (folder / name).write_bytes(path.read_bytes())
    session = Session("s", folder)
    notes = Autosave(folder).load(session)
    session_list.listed(folder.parent, set())
    session.open(requests.Open(), quiet)
    (folder / DRAFT).write_bytes(path.read_bytes())
    (folder / FILE).unlink(missing_ok=True)
    Autosave(folder).load(session)
    if notes:
        raise InputError(notes[0][:200])
    return session


def _page(path: Path) -> None:
    """Do what a page asks for in a session that performs a score."""
    session = Session("s", _emptied(path))
    source = shared.Source(as_json(MINIMAL).decode(), "score")
    session.perform(requests.Perform(source, shared.Choices(fps=Fraction(2))), quiet)

    def do(line: str) -> None:
        body = decode(line).body
        if isinstance(body, requests.Preview):
            session.preview(body.edit)
        elif not ROWS[type(body)].of_page:
            ROWS[type(body)].handler(session, body, quiet)

    _each(_lines(path), do)


def _query(path: Path) -> object:
    scope = {"type": "http", "method": "GET", "headers": [], "query_string": path.read_bytes()}
    return looks_of(Request(scope))


def _headers(path: Path) -> object:
    lines = path.read_bytes().split(b"\n")
    pairs = [(name.strip().lower(), value.strip()) for name, _, value in (x.partition(b":") for x in lines)]
    return Guard(None).allows(Headers(raw=pairs))  # type: ignore[arg-type]


def _journal(path: Path) -> None:
    folder = _emptied(path)
    (folder / f"{JOURNAL}.jsonl").write_bytes(path.read_bytes())
    journal = Journal(folder)
    try:
        journal.entry("a")
    except OutputError as error:
        raise InputError(error.message) from None
    finally:
        journal.close()


@cache
def _made() -> dict[str, Any]:
    source = shared.Source(as_json(MINIMAL).decode(), "score")
    inputs = encoded(shared.TakeInputs(source, shared.Choices(), ()))
    edits = [{"kind": "keys", "parameter": "jaw_open", "keys": [[0.1, 0.2], [0.5, 0.0]]}]
    return {"risorius_project": VERSION, "made": inputs, "edits": edits, "view": {"time": 0.5}}


def _project_file() -> bytes:
    lost = [{"text": "x", "edit": {"kind": "add", "channel": "head", "start": 0, "end": 1, "targets": {}}}]
    names = {"emotions": {"mine": {"AU12": 0.5}}, "poses": {"mine": {"jaw_open": 0.3}}}
    return as_json({**_made(), "score": SCORE, "lost": lost, **names})


def _messages(*messages: dict[str, Any]) -> bytes:
    numbered = [{"id": n, **message} for n, message in enumerate(messages)]
    return "\n".join(map(json.dumps, numbered)).encode()


def _lines_of(*messages: Any) -> bytes:
    return "\n".join(map(json.dumps, messages)).encode()


SOURCE = {"script": as_json(SCORE).decode(), "format": "score"}
WORDS = {"words": ["Hi", "there."], "start": [0.0, 0.002], "end": [0.002, 0.003]}
LETTERS = {"chars": ["H", "i", " "], "charStartTimesMs": [0, 1, 2], "charDurationsMs": [1, 1, 1]}
register(
    ".client",
    _client,
    _lines_of(
        {"do": "start", "version": 1, "fps": "25", "settings": {"head": "mei", "seed": 3}, "token": "x" * 16},
        {"do": "say", "text": "Hello there. How are you?"},
        {"do": "say", "audio": SILENCE, "rate": 16_000, "words": [["Hi", 0.0, 0.001]]},
        {"do": "feel", "emotion": "happiness", "intensity": 0.5},
        {"do": "look", "pitch": 5, "yaw": -10},
        {"do": "look", "target": "listener"},
        {"do": "listen", "audio": SILENCE, "rate": 16_000},
        {"do": "flush"},
        {"do": "interrupt"},
        {"do": "close"},
    ),
)
register(
    ".elevenlabs",
    _service(lambda face: ElevenLabsVoice(face, "pcm_16000").say),
    _lines_of(
        {"audio": SILENCE, "alignment": LETTERS},
        {"audio_base64": SILENCE, "alignment": {
            "characters": ["a"], "character_start_times_seconds": [0], "character_end_times_seconds": [0.001],
        }},
        {"isFinal": True},
    ),
)  # fmt: skip
register(
    ".cartesia",
    _service(lambda face: CartesiaVoice(face, "pcm_f32le", 16_000).say),
    _lines_of(
        {"type": "chunk", "data": SILENCE}, {"type": "timestamps", "word_timestamps": WORDS}, {"type": "done"}
    ),
)
register(
    ".azure",
    _service(_azure),
    _lines_of(["Hi", 0, 0.001, "Word"], [".", 10_000, 0.0, "Punctuation"], "ab" * 50, {}),
)
register(
    ".config.toml",
    lambda path: load_settings(str(path)),
    b'description = "x"\nsize = "320x240"\nfps = 24\nemotion = "no"\nwithout = ["gaze"]\n'.replace(
        b'emotion = "no"\n', b""
    ),
    b'seed = 3\nshape = "nose_width:0.5"\ncamera = "close-up:85"\nstill = "on"\n'.replace(
        b'still = "on"\n', b""
    ),
)
register(".project.json", _project, _project_file, share=0.2)
register(".saved.json", _saved_session, lambda: as_json({**_made(), "score": "score-1.json"}), share=0.1)
register(
    ".page",
    _page,
    lambda: _messages(
        {"do": "open"},
        {
            "do": "edit",
            "kind": "add",
            "channel": "head",
            "start": 0.1,
            "end": 0.6,
            "targets": {"head_yaw": 5},
        },
        {"do": "edit", "kind": "stretch", "movement": "hand.1", "start": 0.2, "end": 0.9, "onset": 0.1},
        {"do": "edit", "kind": "retarget", "movement": "hand.1", "targets": {"AU1": 0.5}, "priority": 30},
        {
            "do": "preview",
            "kind": "keys",
            "parameter": "zygomatic_major",
            "keys": [[0, 0.1], [1, 0.2]],
            "face": 0.5,
        },
        {"do": "edit_all", "edits": [{"kind": "move", "movement": "hand.1", "start": 0.3}]},
        {"do": "preview_all", "edits": [{"kind": "move", "movement": "hand.1", "start": 0.3}], "face": 0.2},
        {"do": "explain", "take": 1, "time": 0.5},
        {"do": "channel_curves", "take": 1, "parameter": "head_yaw"},
        {"do": "rules_fired", "take": 1},
        {"do": "profile_text", "base": "lively", "name": "mine", "numbers": {"blinks.wait": 1.0}},
        {"do": "save_pose", "name": "mine", "kind": "pose", "values": {"AU12": 0.5}},
        {"do": "save_view", "view": {"tab": "curves", "time": 0.1, "graphs": {"chosen": ["AU12"]}}},
        {"do": "undo"},
        {"do": "redo"},
        {"do": "choose", "choices": {"conflict": "inhibit"}},
    ),
    lambda: _messages(
        {"do": "perform", "source": SOURCE, "choices": {"fps": "2"}},
        {"do": "prepare", "source": SOURCE},
        {
            "do": "save_draft",
            "source": SOURCE,
            "emotions": [{"emotion": "joy", "intensity": 0.5, "first": 0}],
        },
        {"do": "edit", "kind": "keys", "parameter": "head_yaw", "keys": [[0, 0.1]]},
        {"do": "edit", "kind": "clear_keys", "parameter": "head_yaw"},
        {"do": "edit", "kind": "delete", "movement": "emotion@0.200"},
        {"do": "compare", "choices": {"conflict": "graded"}},
        {"do": "let_go"},
        {"do": "set_markers", "markers": [{"time": 0.5, "text": "here"}]},
        {"do": "set_lanes", "lanes": {"muted": ["gaze"], "solo": [], "locked": ["head"]}},
        {"do": "stop", "request": 3},
        {"do": "faces", "take": 1, "first": 0, "last": 5, "pace": 30},
        {"do": "face_at", "take": 1, "time": 0.5, "still": True},
        {"do": "cancel", "take": 1},
        {"do": "dial", "values": {"AU12": 0.5}, "emotions": {"joy": 0.5}, "age": 40},
        {"do": "export", "take": 1, "suffixes": [".muscles.csv"]},
        {"do": "cancel_export", "job": 1},
        {"do": "project"},
    ),
    share=0.1,
)
register(".query", _query, b"head=mei&age=40&hair=short&complexion=0.5", b"head=standard&age=&hair=")
register(
    ".headers",
    _headers,
    b"host: 127.0.0.1:8000\norigin: http://127.0.0.1:8000\nsec-fetch-site: same-origin",
    b"host: [::1]:80",
)
register(
    ".journal.jsonl",
    _journal,
    _lines_of({"id": "a", "digest": "0" * 32, "files": {}, "outcome": {}}, {"id": "b", "digest": "1"}),
)
