"""Write the fixtures `messages/*.jsonl`: what speech services send, in the formats that they publish.

Run as `python -m tests.live.record_messages`. The voice is ours, and its words' times are as it says them.

- ElevenLabs, WebSocket `stream-input`: elevenlabs.io/docs/api-reference/websocket
- Cartesia, WebSocket `tts/websocket`: docs.cartesia.ai/api-reference/tts/websocket
- Azure, events `synthesis_word_boundary` and `synthesizing` of its SDK:
  learn.microsoft.com/azure/ai-services/speech-service/how-to-speech-synthesis
"""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from risorius import speak
from risorius.core.arrays import Array
from risorius.core.speech.utterance import Utterance
from risorius.live.pcm import PcmDecoder

TEXT = "Well, that is it. She paid him."
FOLDER = Path(__file__).with_name("messages")
PIECE = 0.3  # seconds of sound in a message
Words = list[tuple[str, float, float]]
Message = dict[str, Any]


def resampled(sound: Array, rate: int, wanted: int) -> Array:
    """Return int16 samples at another rate."""
    from scipy.signal import resample_poly  # takes longer to load than all else that the tests read here

    divisor = int(np.gcd(rate, wanted))
    return np.asarray(resample_poly(sound, wanted // divisor, rate // divisor).clip(-32768, 32767), np.int16)


def encoded(sound: Array, encoding: str) -> bytes:
    """Return samples as bytes: the code whose sample is nearest."""
    if encoding == "pcm_s16le":
        return sound.astype("<i2").tobytes()
    codes = PcmDecoder(encoding).decode(bytes(range(256))).astype(int)
    order = np.argsort(codes)
    middles = (codes[order][1:] + codes[order][:-1]) / 2
    return order[np.searchsorted(middles, sound)].astype(np.uint8).tobytes()


def pieces(sound: Array, rate: int, encoding: str) -> Iterator[tuple[float, float, str]]:
    """Yield start, end and base64 of pieces of sound."""
    step = round(PIECE * rate)
    for start in range(0, len(sound), step):
        piece = sound[start : start + step]
        yield start / rate, (start + len(piece)) / rate, base64.b64encode(encoded(piece, encoding)).decode()


def elevenlabs(words: Words, sound: Array, rate: int, encoding: str) -> Iterator[Message]:
    """Yield an answer of `stream-input`: characters' times count from the start of each message's sound."""
    letters: list[tuple[str, float, float]] = []
    for word, start, end in words:
        step = (end - start) / len(word)
        letters += [(c, start + k * step, step) for k, c in enumerate(word)] + [(" ", end, 0.0)]
    lengths = "charDurationsMs" if encoding == "pcm_s16le" else "charsDurationsMs"
    for start, end, audio in pieces(sound, rate, encoding):
        inside = [(c, at - start, length) for c, at, length in letters if start <= at < end]
        alignment = {
            "chars": [c for c, *_ in inside],
            "charStartTimesMs": [round(1e3 * at) for _, at, _ in inside],
            lengths: [int(1e3 * length) for *_, length in inside],
        }
        times = alignment if inside else None
        yield {"audio": audio, "isFinal": None, "alignment": times, "normalizedAlignment": times}
    yield {"audio": None, "isFinal": True}


def cartesia(words: Words, sound: Array, rate: int, encoding: str) -> Iterator[Message]:
    """Yield an answer of `tts/websocket`: words' times count from the start of the context."""
    common = {"done": False, "status_code": 206, "context_id": "50dc3b5e-5841-4aa1-9f94-60cfb9aead79"}
    for start, end, audio in pieces(sound, rate, encoding):
        yield {"type": "chunk", "data": audio, "step_time": 123.0, **common}
        if inside := [w for w in words if start <= w[1] < end]:
            columns = zip(*inside, strict=True)
            times = {
                name: list(column) for name, column in zip(("words", "start", "end"), columns, strict=True)
            }
            yield {"type": "timestamps", "word_timestamps": times, **common}
    yield {"type": "done", **common, "done": True}


def azure(words: Words, sound: Array, rate: int, encoding: str) -> Iterator[Message]:
    """Yield the events of a synthesis as the SDK names them: offsets in ticks of 100 ns, lengths in s."""

    def boundary(text: str, start: float, seconds: float, kind: str) -> Message:
        where = {"audio_offset": round(start * 1e7), "duration": round(seconds, 4)}
        return {"event": "synthesis_word_boundary", "text": text, "boundary_type": kind, **where}

    yield boundary(TEXT, words[0][1], words[-1][2] - words[0][1], "Sentence")
    for start, end, audio in pieces(sound, rate, encoding):
        for word, first, last in (w for w in words if start <= w[1] < end):
            yield boundary(word.rstrip(",."), first, last - first, "Word")
            if word[-1] in ",.":
                yield boundary(word[-1], last, 0.0, "Punctuation")
        yield {"event": "synthesizing", "audio": audio}
    yield {"event": "synthesis_completed"}


SERVICES = {"elevenlabs": elevenlabs, "cartesia": cartesia, "azure": azure}
FORMATS = (
    ("elevenlabs", "pcm_s16le", 16_000), ("elevenlabs", "pcm_mulaw", 8_000),
    ("cartesia", "pcm_s16le", 24_000), ("cartesia", "pcm_mulaw", 8_000),
    ("azure", "pcm_s16le", 24_000), ("azure", "pcm_mulaw", 8_000),
)  # fmt: skip
"""Service, encoding and rate of each fixture."""


def spoken() -> tuple[Utterance, Words]:
    """Return the text as it is spoken, and its words with their marks and times."""
    utterance = speak(TEXT, text=True).utterance
    assert utterance is not None
    marked = zip(TEXT.split(), utterance.words, strict=True)
    return utterance, [(text, round(word.start, 4), round(word.end, 4)) for text, word in marked]


def main() -> None:
    """Write all files."""
    utterance, words = spoken()
    FOLDER.mkdir(exist_ok=True)
    for service, encoding, rate in FORMATS:
        sound = resampled(utterance.audio.read().astype(float), utterance.audio.sample_rate, rate)
        lines = [json.dumps(m) for m in SERVICES[service](words, sound, rate, encoding)]
        (FOLDER / f"{service}-{encoding}-{rate}.jsonl").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
