"""Tones of words: espeak-ng writes them behind the vowels of a transcription, but not in its events."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher

from ...languages.phonesets import strip_stress
from .mnemonics import is_pause


def tones_of(names: Sequence[str], transcribed: Sequence[str], tones: Mapping[str, str]) -> list[str]:
    """Return the tone of each sound of a rendition in letters of the IPA, "" if none is known.

    `names` are the mnemonics of events, `transcribed` those of the same text with tones, `tones` the letters
    of each tone by its digits. Both say the same sounds; if they do not, tones are unknown.
    """
    sounds = [index for index, name in enumerate(names) if _is_sound(name)]
    spoken = [strip_stress(names[index])[0] for index in sounds]
    read = [_divided(strip_stress(name)[0], tones) for name in transcribed if _is_sound(name)]
    tones_by_sound = [""] * len(names)
    matcher = SequenceMatcher(None, spoken, [name for name, _ in read], autojunk=False)
    for first, second, count in matcher.get_matching_blocks():
        for offset in range(count):
            tones_by_sound[sounds[first + offset]] = tones.get(read[second + offset][1], "")
    return tones_by_sound


def _is_sound(name: str) -> bool:
    return not (is_pause(name) or name.startswith("("))


def _divided(name: str, tones: Mapping[str, str]) -> tuple[str, str]:
    """Return a mnemonic without its tone, and the tone's digits."""
    digits = max((tone for tone in tones if name.endswith(tone)), key=len, default="")
    return name.removesuffix(digits), digits
