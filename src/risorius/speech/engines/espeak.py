"""espeak-ng as a speech engine: it asks a process with `worker.py`, which alone loads the library."""

from __future__ import annotations

import functools
import importlib.util
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...core.directions import DirectedSpan
from ...errors import SpeechError, SpeechWarning, warn
from ...languages import language_of
from ...machine.workers import LastingWorker, WorkerError
from .espeak_events import needs_ipa, read_word, render
from .espeak_text import Encoded, encode, parameters, voice_attribute
from .espeak_tones import tones_of
from .espeak_voices import listed_voices, mean_pitch
from .protocol import Rendition, SpeechRequest, Voice
from .registry import ENGINES
from .voices import find_voice

WORD_CACHE = 20_000
_TASK = f"{Path(__file__).with_name('worker.py')}:answer"

Answer = tuple[dict[str, Any], bytes]


class EspeakEngine:
    """Speaks through one worker, started when first needed.

    A worker that dies, or gives no answer within `seconds` + `seconds_per_character` · (length of the text),
    is replaced once and the request repeated; when that fails too, SpeechError is raised. `task` is what the
    worker does.
    """

    def __init__(
        self,
        task: str = _TASK,
        seconds: float = 10.0,
        seconds_per_character: float = 0.02,
    ) -> None:
        self._task = task
        self._seconds = seconds
        self._seconds_per_character = seconds_per_character
        self._lock = threading.RLock()
        self._worker = LastingWorker()
        self._voices: tuple[Voice, ...] = ()
        self._words: dict[tuple[str, str], tuple[str, ...]] = {}

    def synthesize(self, request: SpeechRequest) -> Rendition:
        """Speak a text. Equal requests give equal bytes."""
        language = language_of(request.voice.language)
        ipa = not _speaks_mnemonics(request.voice)
        encoded = encode(request, language, functools.partial(self._voice_of, request.voice))
        answer, sound = self._speak(request, encoded, ipa)
        if not ipa and needs_ipa(answer["phones"], language):
            answer, sound = self._speak(request, encoded, ipa=True)
        if language.tone_letters:
            names = [name for _, name, _ in answer["phones"]]
            answer["tones"] = tones_of(names, self._with_tones(request), language.tone_letters)
        answer["phones"] = [(start, name, encoded.source(at)) for start, name, at in answer["phones"]]
        samples = np.frombuffer(sound, dtype="<i2").astype(np.int16, copy=False)
        return render(answer, samples, language, parameters(request)["rate"])

    def transcribe(self, words: Sequence[str], voice: Voice) -> tuple[tuple[str, ...], ...]:
        """Return the phones of each word spoken by itself; none for a word that has no sound."""
        with self._lock:
            missing = [word for word in dict.fromkeys(words) if (voice.key, word) not in self._words]
            if missing:
                if len(self._words) > WORD_CACHE:
                    self._words.clear()
                self._transcribe(missing, voice)
            return tuple(self._words[voice.key, word] for word in words)

    def voices(self) -> tuple[Voice, ...]:
        """Return all voices and, as `+name`, the variants that change the timbre of any voice."""
        with self._lock:
            if not self._voices:
                answer, _ = self.request({"op": "voices"}, 0)
                self._voices = listed_voices(answer, data_folder())
            return self._voices

    def mean_pitch(self, voice: Voice) -> float | None:
        """Return the mean pitch of a voice in Hz, None for a language whose tones move it."""
        if language_of(voice.language).tones:
            return None
        return mean_pitch(data_folder(), voice.key)

    def close(self) -> None:
        """End the worker; a later call starts another."""
        self._worker.close()

    def __enter__(self) -> EspeakEngine:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _speak(self, request: SpeechRequest, encoded: Encoded, ipa: bool) -> Answer:
        message = {
            "op": "speak", "text": encoded.text, "voice": request.voice.key, "end_pause": request.end_pause,
            "ipa": ipa, "markup": encoded.markup, "dictated": encoded.markup, **parameters(request),
        }  # fmt: skip
        return self.request(message, len(encoded.text))

    def _voice_of(self, usual: Voice, span: DirectedSpan) -> str:
        """Return the attribute by which SSML names the voice that a span asks for.

        Without a language a name that no voice has, such as another maker's, is that of the usual voice.
        """
        try:
            voice = find_voice(span.voice, span.language, self)
        except SpeechError as error:
            if span.voice is None or span.language is not None:
                raise error.at(span.place) from None
            message = error.message.partition(";")[0]
            warn(f"{span.place}: {message}; the usual voice speaks", SpeechWarning)
            return voice_attribute(usual.key)
        return voice_attribute(voice.key)

    def _with_tones(self, request: SpeechRequest) -> Sequence[str]:
        """Return the mnemonics of a text, those of vowels with the digits of their tones."""
        message = {"op": "transcribe", "texts": [request.text], "voice": request.voice.key, "ipa": False}
        answer, _ = self.request(message, len(request.text))
        names: Sequence[str] = answer["names"][0]
        return names

    def _transcribe(self, words: Sequence[str], voice: Voice) -> None:
        ipa = not _speaks_mnemonics(voice)
        message = {"op": "transcribe", "texts": list(words), "voice": voice.key, "ipa": ipa}
        answer, _ = self.request(message, sum(map(len, words)))
        for word, names in zip(words, answer["names"], strict=True):
            self._words[voice.key, word] = read_word(names, ipa, language_of(voice.language))

    def request(self, message: dict[str, Any], characters: int) -> Answer:
        """Return the worker's answer on a text of `characters`; raise SpeechError if it fails."""
        _package()  # raises an error if it is not there
        seconds = self._seconds + self._seconds_per_character * characters
        try:
            answer, data = self._worker.call(self._task, message, seconds=seconds)
        except WorkerError as error:
            reason = f"the speech worker failed twice in a row; the second time it {error}"
            raise SpeechError(reason) from error
        if "error" in answer:
            raise SpeechError(f"espeak-ng: {answer['error']}")
        return answer, data


def _speaks_mnemonics(voice: Voice) -> bool:
    """Tell whether the mnemonics of a voice's sounds are known, so that their IPA is not needed."""
    table = language_of(voice.language).mnemonics
    return bool(table.voice) and table.voice == voice.language


def _package() -> Path:
    """Return the folder that holds espeakng_loader. It is only located: the worker imports it."""
    spec = importlib.util.find_spec("espeakng_loader")
    if spec is None or spec.origin is None:
        raise SpeechError(
            "speech needs the package 'espeakng-loader', which is not installed (pip install espeakng-loader)"
        )
    return Path(spec.origin).parent.parent


def data_folder() -> Path:
    """Return the folder of espeak-ng's data."""
    return _package() / "espeakng_loader" / "espeak-ng-data"


@ENGINES.register("espeak")
@functools.cache
def shared_engine() -> EspeakEngine:
    """Return the engine that this process shares."""
    return EspeakEngine()
