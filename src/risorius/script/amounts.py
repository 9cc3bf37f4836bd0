"""Amounts in SSML's attributes: times, factors, semitones, decibels."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ..errors import InputError, ParameterError, unknown
from .anchor import NUMBER
from .elements import Attribute
from .quote import one_line, quoted
from .tree import Unknowns, XmlNode

LONGEST_BREAK = 60.0
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


def factor(node: XmlNode, name: str, words: Mapping[str, float]) -> float:
    """Return a factor: a word of the table, `120%` of the usual, or a change such as `+20%`."""
    attribute = node.get(name)
    if attribute is None:
        return 1.0
    rate = _value_of(attribute, words, ("%", ""), ("120%", "+20%"))
    if not isinstance(rate, _Amount):
        return rate
    share = rate.signed * (0.01 if rate.unit else 1.0)
    result = 1.0 + share if rate.sign else share
    if not 0.1 <= result <= 10.0:
        shown = f"{name} = {quoted(attribute.value.strip())}"
        raise InputError(f"{shown} is out of range; expected 10% to 1000%", attribute.place)
    return result


def semitones(unknowns: Unknowns, node: XmlNode, words: Mapping[str, float]) -> float:
    """Return a pitch in semitones from the usual: a word of the table, `+2st` or `+10%`."""
    attribute = node.get("pitch")
    if attribute is None:
        return 0.0
    pitch = _value_of(attribute, words, ("%", "st", "hz"), ("+2st", "+10%"))
    if not isinstance(pitch, _Amount):
        return pitch
    if pitch.unit == "hz":
        unknowns.tell("pitch in Hz", attribute.place)
        return 0.0
    amount = pitch.signed
    if pitch.unit == "%":
        share = 1.0 + 0.01 * amount if pitch.sign else 0.01 * amount
        amount = 12.0 * math.log2(max(share, 0.01))
    if not -24.0 <= amount <= 24.0:
        shown = f"pitch = {quoted(attribute.value.strip())}"
        raise InputError(f"{shown} is out of range; expected two octaves at most", attribute.place)
    return amount


def decibels(node: XmlNode, words: Mapping[str, float]) -> float:
    """Return a volume in dB from the usual: a word of the table, or `+6dB`."""
    attribute = node.get("volume")
    if attribute is None:
        return 0.0
    volume = _value_of(attribute, words, ("db",), ("+6dB",))
    return max(-60.0, min(volume.signed, 12.0)) if isinstance(volume, _Amount) else volume


def _value_of(
    attribute: Attribute, words: Mapping[str, float], units: Sequence[str], examples: Sequence[str]
) -> float | _Amount:
    """Return the value of a word of the table, or an amount in one of `units`; raise ParameterError else."""
    value = attribute.value.strip()
    if value in words:
        return words[value]
    match = _AMOUNT.fullmatch(value)
    if match is None or (match[3] or "").lower() not in units:
        known = (*words, *examples)
        raise ParameterError(unknown(attribute.name, one_line(attribute.value), known), attribute.place)
    return _Amount(match[1], float(match[2]), (match[3] or "").lower())
