"""Messages of speech services, as recorded in `messages`: played whole, the mouth in time with the words."""

from __future__ import annotations

import base64
import json
from datetime import timedelta
from enum import Enum
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from risorius import Live, Settings, speak
from risorius.core.arrays import Array
from risorius.core.parameters import INDEX
from risorius.errors import InputError
from risorius.live.frame import LiveFrame
from risorius.live.pcm import PcmDecoder
from risorius.live.services import AzureVoice, CartesiaVoice, ElevenLabsVoice

from .record_messages import FOLDER, FORMATS, TEXT, spoken

JAW = INDEX["masseter"]
_NAMES = {"pcm_s16le": "pcm", "pcm_mulaw": "ulaw"}


def messages(service: str, encoding: str, rate: int) -> list[dict[str, Any]]:
    text = (FOLDER / f"{service}-{encoding}-{rate}.jsonl").read_text()
    return [json.loads(line) for line in text.splitlines()]


def sound_in(found: list[dict[str, Any]], encoding: str) -> Array:
    """Return the sound of all messages."""
    pieces = [m.get("audio") or m.get("data") or "" for m in found]
    return PcmDecoder(encoding).decode(b"".join(map(base64.b64decode, pieces)))


def told(service: str, encoding: str, rate: int) -> list[LiveFrame]:
    """Return the frames of a face that is told by a service."""
    face = Live(Settings(lively=False), fps=30)
    found = messages(service, encoding, rate)
    if service == "azure":
        azure = AzureVoice(face, encoding, rate)
        for event in found:
            if event["event"] == "synthesizing":
                azure.sound(base64.b64decode(event["audio"]))
            elif event["event"] == "synthesis_word_boundary":
                del event["event"]
                azure.word(**event)
            else:
                azure.end()
    else:
        voice: CartesiaVoice | ElevenLabsVoice
        if service == "cartesia":
            voice = CartesiaVoice(face, encoding, rate)
        else:
            voice = ElevenLabsVoice(face, f"{_NAMES[encoding]}_{rate}")
        for message in found:
            voice.say(message)
    face.close()
    return list(face.frames())


@pytest.mark.parametrize(("service", "encoding", "rate"), FORMATS)
def test_what_services_send_is_played_whole_with_the_mouth_in_time(
    service: str, encoding: str, rate: int
) -> None:
    frames = told(service, encoding, rate)
    assert {frame.sample_rate for frame in frames} == {rate}
    sound = sound_in(messages(service, encoding, rate), encoding)
    played = np.concatenate([frame.sound for frame in frames])
    np.testing.assert_array_equal(played[: len(sound)], sound)
    assert not played[len(sound) :].any()
    texts = dict.fromkeys(frame.text for frame in frames if frame.text)
    assert " ".join(texts) == TEXT
    assert [text for text, following in pairwise(texts) if text[-1] not in ",."] == []
    utterance, words = spoken()
    reference = Live(Settings(lively=False), fps=30)
    reference.say(audio=utterance.audio.read(), rate=utterance.audio.sample_rate, words=words)
    reference.close()
    jaw, other = ([frame.values[JAW] for frame in some] for some in (frames, reference.frames()))
    shorter = min(len(jaw), len(other))
    assert np.corrcoef(jaw[:shorter], other[:shorter])[0, 1] > 0.9


class Boundary(Enum):
    """As in Azure's SDK."""

    Word = 1
    Punctuation = 2
    Sentence = 3


def test_events_of_the_sdk_may_be_given_as_they_are() -> None:
    utterance = speak("Oh!", text=True).utterance
    assert utterance is not None
    word, face = utterance.words[0], Live(Settings(lively=False))
    voice = AzureVoice(face, rate=utterance.audio.sample_rate)
    lasting = timedelta(seconds=word.end - word.start)
    voice.word("Oh", round(word.start * 1e7), lasting, Boundary.Word)
    voice.word("!", round(word.end * 1e7), timedelta(0), Boundary.Punctuation)
    voice.word("Oh!", round(word.start * 1e7), lasting, Boundary.Sentence)
    voice.sound(utterance.audio.read().tobytes())
    voice.end()
    assert face.interrupt() == "Oh!"


@pytest.mark.parametrize(
    ("make", "message", "fault"),
    [
        (lambda face: ElevenLabsVoice(face, "mp3_44100_128"), {}, "unknown output format 'mp3_44100_128'"),
        (lambda face: ElevenLabsVoice(face, "pcm_16000"), {"audio": "%"}, "not base64"),
        (
            lambda face: ElevenLabsVoice(face, "ulaw_8000"),
            {"audio": "", "alignment": {"chars": ["a"], "charStartTimesMs": [], "charDurationsMs": []}},
            "do not match",
        ),
        (lambda face: CartesiaVoice(face, "mp3", 8_000), {}, "unknown encoding 'mp3'"),
        (lambda face: CartesiaVoice(face, "pcm_s16le", 8_000), {"type": "timestamps"}, "do not match"),
        (
            lambda face: CartesiaVoice(face, "pcm_s16le", 8_000),
            {"type": "error", "title": "Invalid model"},
            "the service failed: Invalid model",
        ),
    ],
)
def test_messages_that_no_service_sends_are_refused(make: Any, message: dict[str, Any], fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        make(Live(Settings(lively=False))).say(message)
