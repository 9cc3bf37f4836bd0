"""Any program as a voice: a request in JSON on its input, on its output sound and phone times in JSON, or the
sound alone as a file (WAV, MP3 …).

`docs/voices.md` gives both objects. The program is started for each stretch of text, in a process of its
own; nothing of it is imported.
"""

from __future__ import annotations

import base64
import io
import json
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...core.speech.audio import Samples
from ...core.speech.utterance import SILENCE
from ...errors import SpeechError, SpeechWarning, warn
from ...languages import language_of, phonesets
from ...machine import programs
from ...reading.depth import TOO_DEEP, is_too_deep
from ...rules.articulation import is_known
from .mnemonics import to_arpabet
from .protocol import Rendition, SpeechEngine, SpeechRequest, SpokenPhone, Voice
from .reference import warped
from .registry import VOICE_FILES, load_engine
from .voices import find_voice

SECONDS = 60.0
LONGEST_ANSWER = 400_000_000
_FULL_SCALE = 32_767
_BEGINNINGS = (b"RIFF", b"fLaC", b"OggS", b"ID3")
_KEYS = {"sample_rate", "audio", "phones"}
_RATES = (4_000, 192_000)
_LARGEST_NUMBER = 1e9  # of a time in seconds, or of an index in the text


class ProgramEngine:
    """Speaks through a program. `language` is that of the voice, in BCP 47.

    Without phone times in its answer, those of espeak-ng's voice of that language are warped onto the sound.
    """

    def __init__(self, command: Sequence[str], name: str, language: str = "en-us") -> None:
        self._command = list(command)
        self._name = name
        self._language = language
        self._told = False

    def synthesize(self, request: SpeechRequest) -> Rendition:
        """Speak a text; raise SpeechError if the program fails or gives no answer of the form asked for."""
        self._tell(request)
        return self.rendition_of(self._run(request_of(request, self._language)), request)

    def transcribe(self, words: Sequence[str], voice: Voice) -> tuple[tuple[str, ...], ...]:
        """Return the phones of each word, as espeak-ng reads the language."""
        engine = load_engine()
        return engine.transcribe(words, find_voice(None, self._language, engine))

    def voices(self) -> tuple[Voice, ...]:
        """Return the one voice."""
        return (Voice(self._name, (self._language,), "", f"the program {self._name}", self._name),)

    def mean_pitch(self, voice: Voice) -> float | None:
        """Return None: the properties of a program's voice show only as it speaks."""
        return None

    def close(self) -> None:
        """Do nothing: no process outlives its answer."""

    def _tell(self, request: SpeechRequest) -> None:
        """Warn, once, of directions for parts of the text."""
        if request.directions and not self._told:
            self._told = True
            message = f"the voice '{self._name}' does not follow breaks, emphasis and the like within a text"
            warn(message, SpeechWarning)

    def _run(self, message: Mapping[str, Any]) -> bytes:
        data = json.dumps(message).encode() + b"\n"
        try:
            finished = programs.run(self._command, data, SECONDS, LONGEST_ANSWER)
        except OSError as error:
            raise self._fault(f"cannot be started: {error.strerror}") from None
        except programs.ProgramError as error:
            raise self._fault(str(error)) from None
        if finished.status:
            raise self._fault(f"failed with exit code {finished.status}: {finished.complaint}".rstrip(": "))
        return finished.output

    def rendition_of(self, output: bytes, request: SpeechRequest) -> Rendition:
        """Return what a program's answer to a request holds; raise SpeechError if that is wrong."""
        if is_sound_file(output):
            return self._timed(*self._decoded(output), request)
        try:
            answer = json.loads(output)
        except (ValueError, RecursionError) as error:
            raise self._fault(f"printed no JSON ({error}); expected one object") from None
        if is_too_deep(answer):
            raise self._fault(f"printed JSON that {TOO_DEEP}")
        if not isinstance(answer, dict) or not {"audio"} <= set(answer) <= _KEYS:
            raise self._fault("printed an object with other keys; expected sample_rate, audio and phones")
        samples, rate = self._sound(answer)
        if answer.get("phones") is None:
            return self._timed(samples, rate, request)
        return Rendition(samples, rate, self._phones(answer["phones"], rate, len(samples), len(request.text)))

    def _timed(self, samples: Samples, rate: int, request: SpeechRequest) -> Rendition:
        """Return sound with the phone times of espeak-ng's voice, warped onto it."""
        reference = referred(request, self._language)
        return Rendition(samples, rate, warped(reference, samples, rate), reference.guessed)

    def _sound(self, answer: Mapping[str, Any]) -> tuple[Samples, int]:
        """Return the samples of an answer, and how many there are in a second."""
        try:
            data = base64.b64decode(str(answer["audio"]), validate=True)
        except ValueError:
            raise self._fault("audio is not base64") from None
        if "sample_rate" not in answer and is_sound_file(data):
            return self._decoded(data)
        rate = answer.get("sample_rate")
        if type(rate) is not int or not _RATES[0] <= rate <= _RATES[1]:
            raise self._fault(f"sample_rate = {rate!r}; expected {_RATES[0]} to {_RATES[1]}")
        if len(data) % 2 or not data:
            raise self._fault("audio is not 16-bit samples")
        return np.frombuffer(data, "<i2").astype(np.int16), rate

    def _decoded(self, data: bytes) -> tuple[Samples, int]:
        """Return the samples of a sound file, its channels averaged, and how many there are in a second."""
        import soundfile

        try:
            channels, rate = soundfile.read(io.BytesIO(data), dtype="float32", always_2d=True)
        except (soundfile.LibsndfileError, RuntimeError, ValueError) as error:
            raise self._fault(f"printed a sound file that cannot be read: {error}") from None
        if not len(channels) or not _RATES[0] <= rate <= _RATES[1]:
            raise self._fault(f"printed a sound file of {len(channels)} samples at {rate} Hz")
        mono = np.clip(np.nan_to_num(channels.mean(axis=1)), -1.0, 1.0)
        return np.round(mono * _FULL_SCALE).astype(np.int16), int(rate)

    def _phones(self, rows: object, rate: int, frames: int, characters: int) -> tuple[SpokenPhone, ...]:
        if not isinstance(rows, list):
            raise self._fault("phones is not a list")
        phones: list[SpokenPhone] = []
        for number, row in enumerate(rows):
            phone = self._phone(row, rate, characters, f"phones[{number}]")
            if phone.start >= frames or (phones and phone.start < phones[-1].start):
                raise self._fault(f"phones[{number}] starts before the one before it, or after the sound")
            phones.append(phone)
        return tuple(phones)

    def _phone(self, row: object, rate: int, characters: int, where: str) -> SpokenPhone:
        if not isinstance(row, list) or len(row) not in (2, 3) or not isinstance(row[0], str):
            raise self._fault(f"{where} = {row!r}; expected [symbol, start in seconds, index in the text]")
        if not all(type(n) in (int, float) and 0 <= n <= _LARGEST_NUMBER for n in row[1:]):
            raise self._fault(f"{where} = {row!r}; expected numbers of at least 0")
        symbol, stress = self._symbol(row[0], where)
        position = min(int(row[2]), max(characters - 1, 0)) if len(row) == 3 else 0
        return SpokenPhone(symbol, round(row[1] * rate), stress, 0, position)

    def _symbol(self, written: str, where: str) -> tuple[str, int]:
        """Return a phone as the language's are written, and its stress."""
        if written == SILENCE:
            return SILENCE, -1
        bare, stress = phonesets.strip_stress(written)
        if bare[:-1] in phonesets.VOWELS and bare[-1] in "012":
            stress = {"1": 2, "2": 1, "0": 0}[bare[-1]]
            bare = bare[:-1]
        if not is_known(bare):
            raise self._fault(f"{where}: unknown phone '{written}'; expected ARPAbet or IPA")
        if language_of(self._language).arpabet and bare not in phonesets.ARPABET:
            bare = to_arpabet(bare)[0].rstrip("012")
        return bare, stress if phonesets.is_vowel(bare) else -1

    def _fault(self, message: str) -> SpeechError:
        return SpeechError(f"the voice '{self._name}': {message}")


def is_sound_file(data: bytes) -> bool:
    """Whether bytes begin as a WAV, FLAC, OGG or MP3 file does."""
    mp3 = len(data) > 1 and data[0] == 0xFF and data[1] & 0xE0 == 0xE0
    return mp3 or data.startswith(_BEGINNINGS)


def request_of(request: SpeechRequest, language: str) -> dict[str, Any]:
    """Return a request as the program reads it."""
    manner = request.manner
    return {
        "text": request.text,
        "language": language,
        "rate": request.rate,
        "pitch": request.pitch,
        "manner": {
            "rate": manner.rate, "pitch": manner.pitch, "range": manner.range, "volume": manner.volume,
        },
    }  # fmt: skip


def referred(request: SpeechRequest, language: str) -> Rendition:
    """Return a request as espeak-ng speaks it."""
    engine = load_engine()
    voice = find_voice(None, language, engine)
    return engine.synthesize(SpeechRequest(request.text, voice, request.rate))


@VOICE_FILES.register(".py")
def python_voice(path: Path, language: str | None) -> SpeechEngine:
    """Return the voice that a Python program is."""
    return ProgramEngine([sys.executable, str(path)], str(path), language or "en-us")


@VOICE_FILES.register("")
def program_voice(path: Path, language: str | None) -> SpeechEngine:
    """Return the voice that an executable file is."""
    if not os.access(path, os.X_OK):
        raise SpeechError(f"the voice '{path}' is not a program; expected an executable file, .py or .onnx")
    return ProgramEngine([str(path.resolve())], str(path), language or "en-us")
