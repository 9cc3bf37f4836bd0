import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from risorius.core.audio import Audio
from risorius.core.score import Score
from risorius.core.utterance import Accent, Syllable, Utterance
from risorius.errors import InputError
from risorius.ports.node import Node
from risorius.ports.score_json import read_score, read_score_file
from risorius.ports.speech_json import speech_from_json
from risorius.ports.targets import check_targets, write_targets
from risorius.ports.writable import WritableTake

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


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"language": 1}, "language: expected a text, found 1"),
        ({"phones": []}, "phones: the phones do not end within the duration, 1 s"),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 1e9}]},
            "phones: the phones do not end within the duration",
        ),
        ({"phones": [{"symbol": "", "start": 0.2, "end": 1}]}, "phones: phones do not cover the sound"),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 1, "stress": 3}]},
            "phones[0]: stress 3 is out of range",
        ),
        ({"phones": [{"symbol": "", "start": 0, "end": 1, "word": 0}]}, "phones[0]: refers to a phone, word"),
        (
            {"phones": [{"symbol": "", "start": 0, "end": 1, "wrd": 0}]},
            "phones[0].wrd: unknown key 'wrd'; did you",
        ),
        (
            {"words": [WORD | {"last_phone": 3}]},
            "words[0]: refers to a phone, word or syllable that is not there",
        ),
        (
            {"pauses": [{"start": 0, "end": 1, "kind": "coma"}]},
            "pauses[0].kind: unknown value 'coma'; did you mean",
        ),
        ({"sample_rate": 0}, "sample_rate: 0 is out of range"),
        ({"audio": "/x.wav"}, "audio: '/x.wav' is an absolute path"),
        (
            {"audio": "none.wav"},
            "audio: 'none.wav' cannot be read (No such file or directory); expected a 16-bit",
        ),
        ({"audio": "text.wav"}, "audio: 'text.wav' cannot be read (file does not start with RIFF id)"),
        ({"audio": "short.wav"}, "phones: phones do not cover the sound"),
    ],
)
def test_faulty_speech_is_refused_with_its_path(
    tmp_path: Path, sound_of: Callable[..., Audio], change: dict[str, Any], message: str
) -> None:
    (tmp_path / "text.wav").write_text("not a sound")
    short = sound_of(np.zeros(100, np.int16))
    (tmp_path / "short.wav").write_bytes(short.path.read_bytes())
    with pytest.raises(InputError) as caught:
        speech_from_json(Node(SPEECH | change), tmp_path, 1.0)
    assert str(caught.value).startswith(message)


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
    write_targets(take, check_targets([tmp_path / "x.wav", folder / "x.score.json"]))
    assert json.loads((folder / "x.score.json").read_text())["speech"]["audio"] == "../x.wav"
    held = read_score_file(folder / "x.score.json").utterance
    assert held is not None
    assert replace(held, audio=spoken.audio) == spoken
    np.testing.assert_array_equal(held.audio.read(), spoken.audio.read())
    (tmp_path / "x.wav").unlink()
    assert read_score(folder / "x.score.json").duration == spoken.duration


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
    assert speech_from_json(Node(speech), tmp_path, 1.0).duration == pytest.approx(0.9999, abs=1e-4)
