"""Amounts in SSML's attributes: times, factors, semitones, decibels."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from ..core.directions import Hertz
from ..core.speech.voice_style import VoiceAdjustment
from ..errors import InputError, ParameterError, RisoriusError, unknown
from ..rules.ssml import SsmlTable
from .anchor import NUMBER
from .elements import Attribute
from .quote import one_line, quoted
from .tree import XmlNode

LONGEST_BREAK = 60.0
MOST_SEMITONES = 24.0
QUIETEST, LOUDEST = -60.0, 12.0
LeaveOut = Callable[[Attribute, RisoriusError], None]
_SECONDS = re.compile(rf"(?<!\d)({NUMBER})(ms|s)", re.ASCII)
_AMOUNT = re.compile(rf"([+-]?)({NUMBER})(%|st|Hz|dB)?", re.ASCII | re.IGNORECASE)


def read_seconds(attribute: Attribute) -> float:
    """Return a time such as `250ms` or `2s`; raise InputError for other text."""
    match = _SECONDS.fullmatch(attribute.value.strip())
    seconds = float(match[1]) * (0.001 if match[2] == "ms" else 1.0) if match else -1.0
    if not 0.0 <= seconds <= LONGEST_BREAK:
        shown = f"{attribute.name} = {quoted(attribute.value)}"
        raise InputError(
            f"{shown} is not a time; expected e.g. 250ms or 2s, {LONGEST_BREAK:g}s at most", attribute.place
        )
    return seconds


class _Amount(NamedTuple):
    """An amount as written: a sign or "", a number without sign, and a unit in lower case or ""."""

    sign: str
    number: float
    unit: str

    @property
    def signed(self) -> float:
        return -self.number if self.sign == "-" else self.number


def adjustment(node: XmlNode, table: SsmlTable, leave_out: LeaveOut) -> VoiceAdjustment:
    """Return how `prosody` changes the voice; values that are not understood are told to `leave_out`."""
    readers: Mapping[str, tuple[float, Callable[[Attribute], float]]] = {
        "rate": (1.0, lambda attribute: _factor(attribute, table.rate)),
        "pitch": (0.0, lambda attribute: _semitones(attribute, table.pitch)),
        "range": (1.0, lambda attribute: _factor(attribute, table.range)),
        "volume": (0.0, lambda attribute: _decibels(attribute, table.volume)),
    }
    values = {name: usual for name, (usual, _) in readers.items()}
    for name, (_, read) in readers.items():
        attribute = node.get(name)
        if attribute is not None:
            try:
                values[name] = read(attribute)
            except RisoriusError as error:
                leave_out(attribute, error)
    return VoiceAdjustment(**values)


def pitch_in_hertz(node: XmlNode) -> Hertz | None:
    """Return the pitch of `prosody` if it is in Hz, as `120Hz` or `+15Hz`."""
    amount = _amount(node.text_of("pitch") or "")
    if amount is None or amount.unit != "hz":
        return None
    return Hertz(amount.signed, added=bool(amount.sign))


def _factor(attribute: Attribute, words: Mapping[str, float]) -> float:
    """Return a factor: a word of the table, `120%` of the usual, or a change such as `+20%`."""
    rate = _value_of(attribute, words, ("%", ""), ("120%", "+20%"))
    if not isinstance(rate, _Amount):
        return rate
    share = rate.signed * (0.01 if rate.unit else 1.0)
    result = 1.0 + share if rate.sign else share
    if not 0.1 <= result <= 10.0:
        raise _out_of_range(attribute, "10% to 1000%")
    return result


def _semitones(attribute: Attribute, words: Mapping[str, float]) -> float:
    """Return a pitch in semitones from the usual: a word of the table, `+2st` or `+10%`; 0 if in Hz."""
    pitch = _value_of(attribute, words, ("%", "st", "hz"), ("+2st", "+10%", "120Hz"))
    if not isinstance(pitch, _Amount):
        return pitch
    if pitch.unit == "hz":
        return 0.0
    amount = pitch.signed
    if pitch.unit == "%":
        share = 1.0 + 0.01 * amount if pitch.sign else 0.01 * amount
        amount = 12.0 * math.log2(max(share, 0.01))
    if not -MOST_SEMITONES <= amount <= MOST_SEMITONES:
        raise _out_of_range(attribute, "two octaves at most")
    return amount


def _decibels(attribute: Attribute, words: Mapping[str, float]) -> float:
    """Return a volume in dB from the usual: a word of the table, `+6dB`, `80` or `80%` of the usual
    amplitude (SSML 1.0 and vendors), or a change of that, `-20` or `+20%`.
    """
    volume = _value_of(attribute, words, ("db", "%", ""), ("+6dB", "80", "+20%"))
    if not isinstance(volume, _Amount):
        return volume
    decibels = volume.signed
    if volume.unit != "db":
        share = 0.01 * volume.signed + (1.0 if volume.sign else 0.0)
        decibels = 20.0 * math.log10(share) if share > 0.0 else QUIETEST
    return max(QUIETEST, min(decibels, LOUDEST))


def _out_of_range(attribute: Attribute, expected: str) -> InputError:
    shown = f"{attribute.name} = {quoted(attribute.value.strip())}"
    return InputError(f"{shown} is out of range; expected {expected}", attribute.place)


def _amount(text: str) -> _Amount | None:
    match = _AMOUNT.fullmatch(text.strip())
    return None if match is None else _Amount(match[1], float(match[2]), (match[3] or "").lower())


def _value_of(
    attribute: Attribute, words: Mapping[str, float], units: Sequence[str], examples: Sequence[str]
) -> float | _Amount:
    """Return the value of a word of the table, or an amount in one of `units`; raise ParameterError else."""
    value = attribute.value.strip()
    if value in words:
        return words[value]
    amount = _amount(value)
    if amount is None or amount.unit not in units:
        known = (*words, *examples)
        raise ParameterError(unknown(attribute.name, one_line(attribute.value), known), attribute.place)
    return amount
