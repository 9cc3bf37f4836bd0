"""A Piper voice, given by its `.onnx` file, spoken by the program `piper` if it is installed.

Recent releases of Piper are GPL-3 and older ones MIT; it runs in a process of its own, and none is a
dependency. Its command line gives no phone times, so they come from espeak-ng's voice of the language,
warped onto the sound.
"""

from __future__ import annotations

import os
import shutil
import tempfile
import wave
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError, Place, SpeechError
from ...machine import programs
from ...machine.paths import is_file
from ...reading.json_text import load_json
from .program import LONGEST_ANSWER, ProgramEngine, referred
from .protocol import Rendition, SpeechEngine, SpeechRequest
from .reference import warped
from .registry import VOICE_FILES

PROGRAM_VARIABLE = "RISORIUS_PIPER"
"""The environment variable that names the program if it is not on the path."""
SECONDS = 120.0


class PiperEngine(ProgramEngine):
    """Speaks through Piper; raises SpeechError if it fails."""

    def __init__(self, program: str, model: Path, language: str) -> None:
        super().__init__([program, "--model", str(model)], str(model), language)

    def synthesize(self, request: SpeechRequest) -> Rendition:
        """Speak a text. Its manner's rate is Piper's length scale; pitch and range stay the voice's own."""
        self._tell(request)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "voice.wav"
            pace = (request.rate or 175) / 175 * request.manner.rate
            options = ["--output_file", str(file), "--length_scale", f"{1.0 / pace:.4f}"]
            self._say([*self._command, *options], request.text)
            samples, rate = _wave(file, self._name)
        loud = samples * 10.0 ** (request.manner.volume / 20.0)
        samples = np.clip(np.round(loud), -32768, 32767).astype(np.int16)
        reference = referred(request, self._language)
        return Rendition(samples, rate, warped(reference, samples, rate), reference.guessed)

    def _say(self, command: list[str], text: str) -> None:
        try:
            finished = programs.run(command, text.encode() + b"\n", SECONDS, LONGEST_ANSWER)
        except (OSError, programs.ProgramError) as error:
            raise self._fault(f"Piper failed: {error}") from None
        if finished.status:
            raise self._fault(f"Piper failed with exit code {finished.status}: {finished.complaint}")


def _wave(file: Path, name: str) -> tuple[np.ndarray[tuple[int], np.dtype[np.int16]], int]:
    try:
        with wave.open(str(file), "rb") as sound:
            data = sound.readframes(sound.getnframes())
            if (sound.getnchannels(), sound.getsampwidth()) != (1, 2) or not data:
                raise SpeechError(f"the voice '{name}': Piper did not write 16-bit mono sound")
            return np.frombuffer(data, "<i2"), sound.getframerate()
    except (OSError, EOFError, wave.Error):
        raise SpeechError(f"the voice '{name}': Piper did not write a sound file") from None


@VOICE_FILES.register(".onnx")
def piper_voice(path: Path, language: str | None) -> SpeechEngine:
    """Return the voice of a Piper model; raise SpeechError if Piper is not there."""
    program = os.environ.get(PROGRAM_VARIABLE) or shutil.which("piper")
    if program is None:
        needed = f"the program piper, on the path or named by {PROGRAM_VARIABLE}"
        raise SpeechError(f"the voice '{path}' needs {needed}; expected it to be installed")
    return PiperEngine(program, path, language or _language(path))


def _language(path: Path) -> str:
    """Return the language of a model, as espeak-ng calls it, from the file beside it."""
    beside = path.with_name(path.name + ".json")
    if not is_file(beside):
        message = "cannot be read: there is no such file; expected it beside the model"
        raise InputError(message, Place(str(beside)))
    about: Any = load_json(beside).data
    try:
        voice = about["espeak"]["voice"]
    except (KeyError, TypeError):
        message = "has no espeak.voice; expected the file that comes with the model"
        raise InputError(message, Place(str(beside))) from None
    return str(voice).lower()
