import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from risorius.core.score import Score
from risorius.core.speech.audio import Audio
from risorius.core.speech.utterance import Accent, Syllable, Utterance
from risorius.errors import InputError, RisoriusWarning
from risorius.ports.export_source import WritableTake
from risorius.ports.output_files import check_targets, write_targets
from risorius.ports.score.score_json import read_score_file
from risorius.ports.score.speech_json import SpeechDocument
from risorius.reading.json_text import parse_json
from risorius.reading.schema import placed

SPEECH: dict[str, Any] = {
    "language": "en",
    "phones": [
        {"symbol": "", "start": 0, "end": 0.5},
        {"symbol": "AA", "start": 0.5, "end": 1.0, "stress": 2},
    ],
}
WORD = {
    "text": "a", "start": 0, "end": 1, "first_phone": 0, "last_phone": 1, "source_start": 0, "source_end": 1,
}  # fmt: skip


def speech_from_json(speech: dict[str, Any], folder: Path, duration: float) -> Utterance:
    """Return what is said by the speech of a document, as a score's file is read."""
    document = parse_json(json.dumps(speech), "x")
    with placed(document.source):
        return document.read(SpeechDocument).utterance(folder, duration)


@pytest.mark.parametrize(
    ("change", "at", "message"),
    [
        ({"language": 1}, '"language"', "language = 1 cannot be used; expected a text"),
        (
            {"phones": []},
            '"phones"',
            "the phones do not end within the duration; expected an end up to 1 s",
        ),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 20_000}]},
            '"phones"',
            "the phones do not end within the duration",
        ),
        ({"phones": [{"symbol": "", "start": 0.2, "end": 1}]}, '"phones"', "phones do not cover the sound"),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 1, "stress": 3}]},
            '"stress"',
            "phones[0].stress = 3 is out of range; expected a whole number from -1 to 2",
        ),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 1, "word": 0}]},
            '{"symbol"',
            "refers to a phone, word or syllable that does not exist",
        ),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 1, "wrd": 0}]},
            '"wrd"',
            "unknown key 'phones[0].wrd'; did you mean 'word'?",
        ),
        (
            {"words": [WORD | {"last_phone": 3}]},
            '{"text"',
            "refers to a phone, word or syllable that does not exist",
        ),
        ({"words": [WORD | {"end": -9}]}, '"end": -9', "words[0].end = -9 is out of range"),
        ({"words": [WORD | {"start": 9}]}, '{"text"', "ends at 1 s, before it starts at 9 s"),
        (
            {"words": [WORD | {"source_start": -5}]},
            '"source_start"',
            "words[0].source_start = -5 is out of range",
        ),
        ({"pauses": [{"start": 5, "end": 1, "kind": "comma"}]}, '{"start": 5', "ends at 1 s, before it"),
        (
            {"pauses": [{"start": 0, "end": 1, "kind": "coma"}]},
            '"kind"',
            'pauses[0].kind = "coma" cannot be used; expected one of initial, comma',
        ),
        ({"sample_rate": 0}, '"sample_rate"', "sample_rate = 0 is out of range"),
        ({"audio": "/x.wav"}, '"audio"', "'/x.wav' is an absolute path"),
        (
            {"audio": "none.wav"},
            '"audio"',
            "'none.wav' cannot be read (No such file or directory); expected a 16-bit",
        ),
        ({"audio": "a\0b.wav"}, '"audio"', "'a\ufffdb.wav' cannot be read ("),
        (
            {"audio": "text.wav"},
            '"audio"',
            "'text.wav' cannot be read (file does not start with RIFF id)",
        ),
        ({"audio": "../x.wav"}, '"audio"', "'../x.wav' is outside of the score's folder"),
        ({"audio": "link.wav"}, '"audio"', "'link.wav' is outside of the score's folder"),
        ({"audio": "rate.wav"}, '"audio"', "'rate.wav' is not 16-bit mono"),
        ({"audio": "short.wav"}, '"phones"', "phones do not cover the sound"),
    ],
)
def test_faulty_speech_is_refused_with_its_place(
    tmp_path: Path, sound_of: Callable[..., Audio], change: dict[str, Any], at: str, message: str
) -> None:
    (tmp_path / "text.wav").write_text("not a sound")
    sound = sound_of(np.zeros(100, np.int16))
    short = sound.path.read_bytes()
    (tmp_path / "short.wav").write_bytes(short)
    (tmp_path / "link.wav").symlink_to(sound.path)
    (tmp_path / "rate.wav").write_bytes(short[:24] + bytes(4) + short[28:])
    with pytest.raises(InputError) as caught:
        speech_from_json(SPEECH | change, tmp_path, 1.0)
    column = json.dumps(SPEECH | change).index(at) + 1
    assert str(caught.value).startswith(f"x:1:{column}: {message}")


@pytest.fixture
def spoken(utterance_of: Callable[..., Utterance]) -> Utterance:
    utterance = utterance_of("M AA _ B IY")
    syllable = Syllable(1, 3, 0.5, 0.7, 2, 0)
    return replace(utterance, syllables=(syllable,), accents=(Accent(0.65, 0, 0, "L+H*", True, 0.5),))


def test_speech_is_read_back_with_its_sound(
    tmp_path: Path, take_of: Callable[..., WritableTake], spoken: Utterance
) -> None:
    take = take_of(audio=spoken.audio, utterance=spoken, score=Score(spoken.duration))
    folder = tmp_path / "sub"
    folder.mkdir()
    write_targets(take, check_targets([folder / "x.wav", tmp_path / "x.score.json"]))
    assert json.loads((tmp_path / "x.score.json").read_text())["speech"]["audio"] == "sub/x.wav"
    held = read_score_file(tmp_path / "x.score.json").utterance
    assert held is not None
    assert replace(held, audio=spoken.audio) == spoken
    np.testing.assert_array_equal(held.audio.read(), spoken.audio.read())


def test_a_score_refers_to_no_sound_outside_of_its_folder(
    tmp_path: Path, take_of: Callable[..., WritableTake], spoken: Utterance
) -> None:
    take = take_of(audio=spoken.audio, utterance=spoken, score=Score(spoken.duration))
    (tmp_path / "sub").mkdir()
    targets = check_targets([tmp_path / "x.wav", tmp_path / "sub" / "x.score.json"])
    with pytest.warns(RisoriusWarning, match="outside of the score's folder"):
        write_targets(take, targets)
    assert "audio" not in json.loads((tmp_path / "sub" / "x.score.json").read_text())["speech"]


def test_without_a_sound_file_speech_is_silent_and_as_long(
    tmp_path: Path, take_of: Callable[..., WritableTake], spoken: Utterance
) -> None:
    take = take_of(audio=spoken.audio, utterance=spoken, score=Score(spoken.duration))
    write_targets(take, check_targets([tmp_path / "x.score.json"]))
    held = read_score_file(tmp_path / "x.score.json").utterance
    assert held is not None
    assert replace(held, audio=spoken.audio) == spoken
    assert held.audio.frames == spoken.audio.frames
    assert not held.audio.read().any()


def test_phones_of_any_length_may_be_silent(tmp_path: Path) -> None:
    speech = SPEECH | {"phones": [{"symbol": "", "start": 0, "end": 0.9999}]}
    assert speech_from_json(speech, tmp_path, 1.0).duration == pytest.approx(0.9999, abs=1e-4)
