"""The task that speaks: espeak-ng, in a worker (`machine.workers`).

It needs the standard library alone, so that it starts fast, and imports nothing of Risorius: espeak-ng is GPL
and must share no process with the rest.

Requests, by `op`: `speak` (text, voice, rate, pitch, range, volume, ipa, end_pause, markup, dictated),
`transcribe` (texts, voice, ipa), `voices`. `markup`: the text is SSML. `dictated`: what stands in `[[ ]]` are
mnemonics of phonemes.
"""

from __future__ import annotations

import _ctypes
import ctypes
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

SYNCHRONOUS = 2
PHONEME_EVENTS, IPA_NAMES, NO_EXIT = 0x1, 0x2, 0x8000
UTF8 = 0x1
# espeak-ng's flags of synthesis, by the names they have in requests.
FLAGS = {"markup": 0x10, "dictated": 0x100, "end_pause": 0x1000}
# espeak-ng's numbers of its parameters, by the names they have in requests.
PARAMETERS = {"rate": 1, "volume": 2, "pitch": 3, "range": 4}
PHONEME = 7
NAME_BYTES = 8
# Between the phonemes of a transcription; a character that no phoneme name contains.
SEPARATOR = "\x1f"
GENDERS = {1: "male", 2: "female"}


class _EventId(ctypes.Union):
    _fields_ = [("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * NAME_BYTES)]


class _Event(ctypes.Structure):
    _fields_ = [
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _EventId),
    ]


class _Voice(ctypes.Structure):
    # `languages` is a list of (priority byte, name, NUL), so it must not be read as one C string.
    _fields_ = [
        ("name", ctypes.c_char_p),
        ("languages", ctypes.c_void_p),
        ("identifier", ctypes.c_char_p),
        ("gender", ctypes.c_ubyte),
        ("age", ctypes.c_ubyte),
        ("variant", ctypes.c_ubyte),
        ("unused", ctypes.c_ubyte),
        ("score", ctypes.c_int),
        ("spare", ctypes.c_void_p),
    ]


_Callback = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event)
)
_unload: Callable[[int], Any] = getattr(_ctypes, "dlclose" if os.name == "posix" else "FreeLibrary")


class RequestError(Exception):
    """A request that cannot be met; the worker goes on."""


class Espeak:
    """The library, loaded afresh. Between two utterances of one load the sound varies by some samples."""

    def __init__(self, library: str, data: str, ipa: bool = False) -> None:
        self._lib = ctypes.CDLL(library)
        self._lib.espeak_TextToPhonemes.restype = ctypes.c_char_p
        self._lib.espeak_ListVoices.restype = ctypes.POINTER(ctypes.POINTER(_Voice))
        options = PHONEME_EVENTS | NO_EXIT | (IPA_NAMES if ipa else 0)
        self.sample_rate: int = self._lib.espeak_Initialize(SYNCHRONOUS, 0, os.fsencode(data), options)
        if self.sample_rate <= 0:
            raise RequestError(f"espeak-ng found no data in {data}")
        self._sound: list[bytes] = []
        self._phones: list[tuple[int, str, int]] = []
        self._callback = _Callback(self._collect)
        self._lib.espeak_SetSynthCallback(self._callback)

    def close(self) -> None:
        """Unload the library."""
        self._lib.espeak_Terminate()
        _unload(self._lib._handle)

    def set_voice(self, name: str) -> None:
        """Choose a voice by name or identifier, with an optional `+variant`."""
        if self._lib.espeak_SetVoiceByName(name.encode()):
            raise RequestError(f"espeak-ng does not know the voice '{name}'")

    def set_parameter(self, number: int, value: int | None) -> None:
        """Set a parameter by its number; None leaves the voice's own."""
        if value is not None:
            self._lib.espeak_SetParameter(number, int(value), 0)

    def _collect(self, sound: Any, count: int, events: Any) -> int:
        if sound and count > 0:
            self._sound.append(ctypes.string_at(sound, 2 * count))
        for event in _until_end(events):
            if event.type == PHONEME:
                name = ctypes.string_at(ctypes.addressof(event.id), NAME_BYTES).split(b"\0")[0]
                # Positions are those of the phoneme's word, counted from 1, in characters.
                position = event.text_position - 1
                self._phones.append((event.sample, name.decode("utf-8", "ignore"), position))
        return 0

    def speak(self, text: str, flags: int) -> tuple[bytes, list[tuple[int, str, int]]]:
        """Return the sound and the phonemes: sample, name, position of the word in the text."""
        data = text.encode()
        code = self._lib.espeak_Synth(
            data, ctypes.c_size_t(len(data) + 1), ctypes.c_uint(0), ctypes.c_int(1), ctypes.c_uint(0),
            ctypes.c_uint(UTF8 | flags), None, None,
        )  # fmt: skip
        if code:
            raise RequestError(f"espeak-ng could not speak (code {code})")
        self._lib.espeak_Synchronize()
        return b"".join(self._sound), self._phones

    def transcribe(self, text: str, ipa: bool) -> list[str]:
        """Return the phoneme names of `text`, in order."""
        buffer = ctypes.create_string_buffer(text.encode())
        pointer = ctypes.c_void_p(ctypes.addressof(buffer))
        mode = (ord(SEPARATOR) << 8) | (IPA_NAMES if ipa else 0)
        names: list[str] = []
        while pointer.value:
            clause = self._lib.espeak_TextToPhonemes(ctypes.byref(pointer), UTF8, mode)
            names += (clause or b"").decode("utf-8", "replace").replace(" ", SEPARATOR).split(SEPARATOR)
        return [name for name in names if name]

    def voices(self, variants: bool) -> list[dict[str, Any]]:
        """Return name, identifier, languages and gender of each voice, or of each variant."""
        pattern = _Voice()
        languages = ctypes.create_string_buffer(b"variant" if variants else b"")
        pattern.languages = ctypes.addressof(languages) if variants else None
        listed = self._lib.espeak_ListVoices(ctypes.byref(pattern) if variants else None)
        events: list[dict[str, Any]] = []
        while listed[len(events)]:
            voice = listed[len(events)].contents
            events.append(
                {
                    "name": voice.name.decode(),
                    "identifier": voice.identifier.decode(),
                    "languages": _languages(voice.languages),
                    "gender": GENDERS.get(voice.gender, ""),
                }
            )
        return events


def _until_end(events: Any) -> Iterator[_Event]:
    index = 0
    while events[index].type:
        yield events[index]
        index += 1


def _languages(address: int) -> list[str]:
    voices = []
    while ctypes.string_at(address, 1) != b"\0":
        name = ctypes.string_at(address + 1)
        voices.append(name.decode())
        address += len(name) + 2
    return voices


class EspeakWorker:
    """Answers requests with a library loaded anew for each, so that equal requests give equal bytes."""

    def __init__(self, library: str, data: str) -> None:
        self._library = library
        self._data = data

    @contextmanager
    def _espeak(self, ipa: bool = False) -> Iterator[Espeak]:
        espeak = Espeak(self._library, self._data, ipa)
        try:
            yield espeak
        finally:
            espeak.close()

    def answer(self, request: dict[str, Any]) -> tuple[dict[str, Any], bytes]:
        """Return the answer and its sound; raise RequestError where it cannot be met."""
        op = request.get("op")
        if op == "speak":
            return self._speak(request)
        if op == "transcribe":
            with self._espeak() as espeak:
                espeak.set_voice(request["voice"])
                ipa = bool(request.get("ipa"))
                return {"names": [espeak.transcribe(text, ipa) for text in request["texts"]]}, b""
        if op == "voices":
            with self._espeak() as espeak:
                return {"voices": espeak.voices(False), "variants": espeak.voices(True)}, b""
        raise RequestError(f"unknown request '{op}'")

    def _speak(self, request: dict[str, Any]) -> tuple[dict[str, Any], bytes]:
        sample_rate, sound, phones = self._run(request, ipa=False)
        answer: dict[str, Any] = {"sample_rate": sample_rate, "phones": phones}
        if request.get("ipa"):
            # The names are all that changes, so the second run gives the IPA of the first one's phonemes.
            answer["ipa"] = [name for _, name, _ in self._run(request, ipa=True)[2]]
        return answer, sound

    def _run(self, request: dict[str, Any], ipa: bool) -> tuple[int, bytes, list[tuple[int, str, int]]]:
        with self._espeak(ipa) as espeak:
            espeak.set_voice(request["voice"])
            for name, number in PARAMETERS.items():
                espeak.set_parameter(number, request.get(name))
            flags = sum(flag for name, flag in FLAGS.items() if request.get(name))
            return espeak.sample_rate, *espeak.speak(request["text"], flags)


def answer(request: dict[str, Any]) -> tuple[dict[str, Any], bytes]:
    """Return the answer to a request and its sound (16-bit little-endian), or the `error` that it meets."""
    try:
        return _worker().answer(request)
    except RequestError as error:
        return {"error": str(error)}, b""
    except Exception as error:
        # Whatever a request breaks, the next one may be sound.
        return {"error": f"{type(error).__name__}: {error}"}, b""


@cache
def _worker() -> EspeakWorker:
    import espeakng_loader

    return EspeakWorker(espeakng_loader.get_library_path(), espeakng_loader.get_data_path())
