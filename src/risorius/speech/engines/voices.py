"""Voices: their list, and finding one by name or language."""

from __future__ import annotations

import re
from dataclasses import replace

from ...errors import SpeechError, unknown
from ...languages import language_of
from .protocol import SpeechEngine, Voice
from .registry import load_engine

DEFAULT_VOICE = "en-us"
_USUAL = ("en", "de", "fr", "es", "cmn")
_LONG_CODE = 3  # letters of the codes of ISO 639-2
_LONGEST = 40  # letters of a name that is shown
_PLAIN_CHANGE = re.compile(r"\+[fm]\d")


def voices(engine: SpeechEngine | None = None) -> tuple[Voice, ...]:
    """Return all voices in the order in which they are looked for.

    The default comes first, then the others of its language, then languages of whose words we know most,
    then the other languages, each by its name. At the end stand those named `+name`, which change the timbre
    of any other: plain women and men before the rest.
    """
    listed = (engine or load_engine()).voices()
    return tuple(sorted(listed, key=_place))


def _place(voice: Voice) -> tuple[bool, bool, bool, bool, str]:
    code, usual = voice.language.split("-")[0], DEFAULT_VOICE.split("-")[0]
    is_change = voice.name.startswith("+")
    if is_change:
        best = _PLAIN_CHANGE.fullmatch(voice.name) is not None
    else:
        best = voice.language != "" and bool(language_of(code).function_words)
    called = voice.name if is_change else f"{voice.description} {voice.name}"
    return is_change, voice.name != DEFAULT_VOICE, code != usual, not best, called.lower()


def speaking() -> dict[str, Voice]:
    """Return the voices that speak by their names: those named `+name` only change the timbre of another."""
    return {voice.name: voice for voice in voices() if not voice.name.startswith("+")}


def languages() -> dict[str, str]:
    """Return the languages of all voices that speak, sorted, each with its first voice's name for it."""
    names: dict[str, str] = {}
    for voice in speaking().values():
        names.setdefault(voice.language, voice.description)
    return dict(sorted(names.items()))


def find_voice(name: str | None, language: str | None = None, engine: SpeechEngine | None = None) -> Voice:
    """Return the voice called `name` (`en-us`, or with a variant `en-us+f3`), or the first of `language`.

    Raises SpeechError, with the nearest name, for an unknown voice, and for one that speaks another language.
    """
    listed = (engine or load_engine()).voices()
    if name is None:
        return _by_language(language, listed) if language is not None else _by_name(DEFAULT_VOICE, listed)
    base, plus, variant = name.partition("+")
    voice = _by_name(base, listed)
    if language is not None and _plain(language).split("-")[0] != voice.language.split("-")[0]:
        raise SpeechError(f"voice '{name}' speaks '{voice.language}', not '{language}'")
    return _varied(voice, _by_name(plus + variant, listed)) if plus else voice


def _plain(code: str) -> str:
    return code.strip().lower().replace("_", "-")


def _by_name(name: str, listed: tuple[Voice, ...]) -> Voice:
    plain = _plain(name)
    for voice in listed:
        if plain == voice.name.lower() or name == voice.key:
            return voice
    speaking = _speaking(plain, listed)
    if speaking is not None:
        return speaking
    varies = name.startswith("+")
    in_order = sorted(listed, key=_place)
    named = [voice.name for voice in in_order if voice.description.lower() == plain]
    if named:
        raise SpeechError(f"unknown voice '{name}'; did you mean '{named[0]}'?")
    names = [voice.name for voice in in_order if voice.name.startswith("+") == varies]
    message = unknown("variant" if varies else "voice", name, names)
    raise SpeechError(message if message.endswith("?") else f"{message}; 'risorius list voices' shows all")


def _by_language(language: str, listed: tuple[Voice, ...]) -> Voice:
    code = _plain(language)
    voice = _speaking(code, listed) or _speaking(code.split("-")[0], listed)
    if voice is None:
        raise SpeechError(_unknown_language(language, listed))
    return voice


def _unknown_language(language: str, listed: tuple[Voice, ...]) -> str:
    """Return the message for a language without a voice.

    A code that only looks alike (`xx`, `xex`) does not help: suggest one that begins in the same way (`deu`),
    or whose voice has this name (`german`).
    """
    plain = _plain(language)
    for voice in sorted(listed, key=_place):
        code = voice.language.split("-")[0]
        begins = len(plain) == _LONG_CODE and 0 < len(code) < _LONG_CODE and plain.startswith(code)
        if begins or (code and voice.description.lower() == plain):
            return f"unknown language '{language}'; did you mean '{code}'?"
    expected = f"expected a code such as {', '.join(_USUAL)}; 'risorius list languages' shows more"
    return f"unknown language '{language[:_LONGEST]}'; {expected}"


def _speaking(code: str, listed: tuple[Voice, ...]) -> Voice | None:
    """Return the voice that speaks a language most plainly: as its own, and not in a region's manner."""
    if code == DEFAULT_VOICE.split("-")[0]:
        code = DEFAULT_VOICE
    speaking = [voice for voice in listed if code in voice.languages]
    speaking = speaking or [voice for voice in listed if voice.language.startswith(f"{code}-")]
    return min(
        speaking,
        key=lambda voice: (voice.language != code, not voice.key.endswith(f"/{code}"), voice.name),
        default=None,
    )


def _varied(voice: Voice, variant: Voice) -> Voice:
    return replace(
        voice,
        name=voice.name + variant.name,
        gender=variant.gender or voice.gender,
        key=voice.key + variant.key,
    )
