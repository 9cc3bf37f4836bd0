"""What every speech engine keeps to, whichever it is; and what a program as a voice may get wrong."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from risorius.core.speech.voice_style import VoiceAdjustment
from risorius.errors import RisoriusError, SpeechWarning
from risorius.rules.articulation import is_known
from risorius.script import read_script
from risorius.speech import synthesize_script
from risorius.speech.engines.protocol import SpeechEngine, SpeechRequest
from risorius.speech.engines.registry import is_voice_file, load_engine, load_voice_file
from risorius.speech.engines.voices import find_voice
from risorius.speech.synthesis import synthesize_line

from . import voices

TEXT = "My baby brother always wanted more lemonade."
ENGINES = ["espeak", "program", "program without times", "piper"]


def program(folder: Path, text: str, name: str = "voice.py") -> str:
    (folder / name).write_text(text)
    return str(folder / name)


def executable(folder: Path, text: str) -> str:
    path = Path(program(folder, f"#!{sys.executable}\n{text}", "piper"))
    path.chmod(0o755)
    return str(path)


def piper_model(folder: Path) -> str:
    model = folder / "en_US-nobody-low.onnx"
    model.write_bytes(b"")
    (folder / "en_US-nobody-low.onnx.json").write_text(json.dumps({"espeak": {"voice": "en-us"}}))
    return str(model)


@pytest.fixture(params=ENGINES)
def any_engine(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[SpeechEngine]:
    if request.param == "espeak":
        yield load_engine()
        return
    if request.param == "piper":
        monkeypatch.setenv("RISORIUS_PIPER", executable(tmp_path, voices.PIPER))
        yield load_voice_file(piper_model(tmp_path))
        return
    source = voices.BEEPER if request.param == "program" else voices.MUTE_OF_TIMES
    yield load_voice_file(program(tmp_path, source))


def test_the_contract(any_engine: SpeechEngine) -> None:
    voice = next(v for v in any_engine.voices() if v.language == "en-us")
    request = SpeechRequest(TEXT, voice)
    said, again = any_engine.synthesize(request), any_engine.synthesize(request)
    assert said.samples.dtype == np.int16
    assert np.array_equal(said.samples, again.samples)
    assert said.phones == again.phones
    assert all(a.start <= b.start for a, b in pairwise(said.phones))
    assert said.phones[0].start >= 0
    assert said.phones[-1].start <= len(said.samples)
    assert all(phone.symbol == "" or is_known(phone.symbol) for phone in said.phones)
    assert all(0 <= phone.position <= len(TEXT) for phone in said.phones)
    assert all((phone.stress >= 0) <= (phone.symbol != "") for phone in said.phones)
    words = any_engine.transcribe(["baby", "lemonade"], voice)
    assert [bool(phones) for phones in words] == [True, True]
    any_engine.close()
    assert any_engine.synthesize(request).phones == said.phones


def test_the_voice_is_heard_word_by_word(any_engine: SpeechEngine) -> None:
    said = synthesize_line(
        TEXT, engine=any_engine, voice=any_engine.voices()[0].name if _is_file(any_engine) else None
    )
    assert [word.text for word in said.words] == TEXT.rstrip(".").split()
    assert len(said.accents) >= 3


def _is_file(engine: SpeechEngine) -> bool:
    return is_voice_file(engine.voices()[0].name)


def test_phone_times_are_found_by_the_reference(tmp_path: Path) -> None:
    engine = load_voice_file(program(tmp_path, voices.MUTE_OF_TIMES))
    found = engine.synthesize(SpeechRequest(TEXT, engine.voices()[0]))
    espeak = load_engine()
    true = espeak.synthesize(SpeechRequest(TEXT, find_voice("en-us+m3", None, espeak), 150))
    assert [p.symbol for p in found.phones] == [p.symbol for p in true.phones]
    errors = [
        abs(a.start - b.start) / found.sample_rate for a, b in zip(found.phones, true.phones, strict=True)
    ]
    assert np.median(errors) < 0.01
    assert max(errors) < 0.06


def test_pipers_pace_follows_the_rate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RISORIUS_PIPER", executable(tmp_path, voices.PIPER))
    engine = load_voice_file(piper_model(tmp_path))
    voice = engine.voices()[0]
    usual, slow = (
        engine.synthesize(SpeechRequest(TEXT, voice, manner=VoiceAdjustment(rate=r))) for r in (1.0, 0.7)
    )
    assert len(slow.samples) > 1.3 * len(usual.samples)


ANSWERS = [
    ("print('hello')", "printed no JSON"),
    ("print('[]')", "printed an object with other keys; expected sample_rate, audio and phones"),
    ("print('{\"sample_rate\": 8000}')", "printed an object with other keys"),
    ('print(\'{"audio": "AAAA"}\')', "sample_rate = None; expected 4000 to 192000"),
    ("print('RIFFraff')", "printed a sound file that cannot be read"),
    ("import sys; sys.exit('no voice today')", "failed with exit code 1: no voice today"),
    ('print(\'{"sample_rate": 0, "audio": "AAAA"}\')', "sample_rate = 0; expected 4000 to 192000"),
    ('print(\'{"sample_rate": 8000, "audio": "%%"}\')', "audio is not base64"),
    ('print(\'{"sample_rate": 8000, "audio": "AAAA"}\')', "audio is not 16-bit samples"),
]
PHONES = [
    ("3", "phones is not a list"),
    ('[["B"]]', r"phones\[0\] = \['B'\]; expected \[symbol, start in seconds"),
    ('[["B", "x"]]', "expected numbers of at least 0"),
    ('[["B", -1]]', "expected numbers of at least 0"),
    ('[["QX", 0]]', r"phones\[0\]: unknown phone 'QX'; expected ARPAbet or IPA"),
    ('[["B", 0.2], ["AA1", 0.1]]', r"phones\[1\] starts before the one before it"),
    ('[["B", 9]]', r"phones\[0\] starts before the one before it, or after the sound"),
]


@pytest.mark.parametrize(("source", "message"), ANSWERS)
def test_answers_that_are_none(source: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(RisoriusError, match=message):
        synthesize_line("Hello.", voice=program(tmp_path, source))


@pytest.mark.parametrize(("phones", "message"), PHONES)
def test_phones_that_are_none(phones: str, message: str, tmp_path: Path) -> None:
    source = f"""
import base64
audio = base64.b64encode(bytes(16000)).decode()
print('{{"sample_rate": 8000, "audio": "' + audio + '", "phones": {phones}}}')
"""
    with pytest.raises(RisoriusError, match=message):
        synthesize_line("Hello.", voice=program(tmp_path, source))


def test_voices_that_are_no_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    text = tmp_path / "voice.txt"
    text.write_text("hello")
    for name, message in (
        (str(tmp_path / "none.onnx"), "there is no voice"),
        (str(text), "is not a program; expected an executable file"),
        (piper_model(tmp_path), "needs the program piper"),
    ):
        with pytest.raises(RisoriusError, match=message):
            synthesize_line("Hello.", voice=name)


@pytest.mark.parametrize(
    ("content", "message"), [(None, "expected it beside the model"), ("{}", "has no espeak.voice")]
)
def test_a_piper_model_without_its_description(
    content: str | None, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RISORIUS_PIPER", sys.executable)
    model = tmp_path / "x.onnx"
    model.write_bytes(b"")
    if content is not None:
        (tmp_path / "x.onnx.json").write_text(content)
    with pytest.raises(RisoriusError, match=message):
        synthesize_line("Hello.", voice=str(model))


def test_what_a_program_cannot_do_is_said_once(tmp_path: Path) -> None:
    emphasised = read_script("I like *this*. And *that*.", text=True)
    with pytest.warns(SpeechWarning, match="does not follow breaks, emphasis and the like") as caught:
        synthesize_script(emphasised, voice=program(tmp_path, voices.BEEPER))
    assert len(caught) == 1


def test_espeaks_own_names_are_no_files() -> None:
    assert not is_voice_file("gmw/en-US")
    assert synthesize_line("Hello.", voice="gmw/en-US").language == "en-us"
