"""The meaning of a phone tier's labels: ARPAbet with or without stress digits, IPA, SAMPA, or silence."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from typing import NamedTuple

from ...core.speech.utterance import SILENCE
from ...errors import InputError, Place, SpeechWarning, unknown, warn
from ...languages import phonesets
from ...languages.labels import is_quiet_phone, label_table, without_position
from ...rules.articulation import is_known
from ...script.quote import quoted
from ...script.textgrid import Label

_ARPABET = re.compile(r"([A-Za-z-]{1,4}?)([0-2]?)")
_CAPITAL = re.compile(r"[A-Z]")
# The share of labels, none of them with letters that only IPA has, that are ARPAbet in a tier of it.
_MOST = 0.8
# ARPAbet's digits to core's levels.
_LEVEL = {"0": 0, "1": 2, "2": 1}
UNSTRESSED = 0
TONE_LETTERS = "˥˦˧˨˩ˀ"
# In TIMIT and Buckeye a stop of the glottis, and in German SAMPA, where before other sounds it is a vowel.
GLOTTAL, SAMPA_GLOTTAL = "q", "Q"


class PhoneLabel(NamedTuple):
    """A phone as core has it; `stress` None if the label does not tell."""

    symbol: str
    stress: int | None
    tone: str = ""


LabelReader = Callable[[str], PhoneLabel | None]


def read_phones(labels: Sequence[Label], source: str) -> tuple[bool, list[PhoneLabel]]:
    """Return whether the labels are ARPAbet (else IPA), and the meaning of each.

    An unknown label is silence, with a warning (SpeechWarning) that has its line. Raises
    InputError, with the line of the first, if most labels are unknown.
    """
    spoken = [label for label in labels if not is_quiet_phone(label.text)]
    read = _reader_of(spoken)
    phones: list[PhoneLabel] = []
    unknown_labels: list[Label] = []
    for label in labels:
        phone = PhoneLabel(SILENCE, -1) if is_quiet_phone(label.text) else read(label.text)
        if phone is None:
            unknown_labels.append(label)
        phones.append(phone or PhoneLabel(SILENCE, -1))
    if 2 * len(unknown_labels) > len(spoken):
        message = f"unknown phone {quoted(unknown_labels[0].text)}; expected ARPAbet, IPA or SAMPA"
        raise InputError(message, Place(source, unknown_labels[0].line))
    _report(unknown_labels, source, arpabet=read is _arpabet)
    return read is _arpabet, _with_glottal_stops(labels, phones) if read is _sampa else phones


def stops_joined(labels: Sequence[Label]) -> list[Label]:
    """Return labels as `read_phones` takes them: in ARPAbet each sound is one label, as in TIMIT it is not.

    A closure and the burst after it become one stop, a closure alone is a stop as well. A stop of the glottis
    belongs to the sound after it, or before a silence to the one before.
    """
    if _reader_of([label for label in labels if not is_quiet_phone(label.text)]) is not _arpabet:
        return list(labels)
    closures = label_table().closure
    joined: list[Label] = []
    for index, label in enumerate(labels):
        before, after = joined[-1] if joined else None, labels[index + 1] if index + 1 < len(labels) else None
        if label.text.strip() == GLOTTAL and after is not None and not is_quiet_phone(after.text):
            joined.append(label)
        elif label.text.strip() == GLOTTAL:
            if before is not None:
                joined[-1] = before._replace(end=label.end)
        elif before is not None and _continues(before.text.strip(), label.text.strip().upper()):
            joined[-1] = label._replace(start=before.start)
        else:
            joined.append(label)
    return [label._replace(text=closures.get(label.text.strip().upper(), label.text)) for label in joined]


def _continues(before: str, symbol: str) -> bool:
    """Tell whether a label is the rest of the sound that the one before it begins."""
    stop = label_table().closure.get(before.upper())
    return before == GLOTTAL or symbol == stop or (stop in ("T", "D") and symbol in ("CH", "JH"))


def _reader_of(labels: Sequence[Label]) -> LabelReader:
    """Return the reader of the alphabet that most labels are written in."""
    texts = Counter(label.text.strip() for label in labels)
    as_arpabet = sum(count for text, count in texts.items() if _arpabet(text) is not None)
    capitals = sum(
        count for text, count in texts.items() if _arpabet(text) is not None and text[:1].isupper()
    )
    plain = all(text.isascii() for text in texts)
    # Letters by themselves are IPA, too: all of "ih" but its sound.
    if 2 * capitals > len(labels) or (plain and as_arpabet >= _MOST * len(labels)):
        return _arpabet
    as_ipa = sum(n for text, n in texts.items() if _ipa(text) is not None and not _CAPITAL.search(text))
    as_sampa = sum(count for text, count in texts.items() if _sampa(text) is not None)
    return _sampa if as_sampa > as_ipa else _ipa


def _report(labels: Sequence[Label], source: str, *, arpabet: bool) -> None:
    """Warn of each label that is unknown, at its first place."""
    counts = Counter(label.text for label in labels)
    first = {label.text: label for label in reversed(labels)}
    for text, label in reversed(first.items()):
        again = f" ({counts[text]} times)" if counts[text] > 1 else ""
        known = (
            unknown("phone", text, sorted(phonesets.ARPABET)) if arpabet else f"unknown phone {quoted(text)}"
        )
        warn(f"{Place(source, label.line)}: taken as silence{again}: {known}", SpeechWarning)


def _arpabet(text: str) -> PhoneLabel | None:
    match = _ARPABET.fullmatch(without_position(text))
    if match is None:
        return None
    name = match[1].upper()
    symbol = label_table().arpabet.get(name) or label_table().closure.get(name) or name
    if text.strip() == GLOTTAL:
        return PhoneLabel(SILENCE, -1)
    if symbol not in phonesets.ARPABET:
        return None
    if not phonesets.is_vowel(symbol):
        return PhoneLabel(symbol, -1)
    return PhoneLabel(symbol, _LEVEL[match[2]] if match[2] else None)


def _ipa(text: str) -> PhoneLabel | None:
    toned, stress = phonesets.strip_stress(without_position(text))
    bare = toned.rstrip(TONE_LETTERS)
    if not bare or not is_known(bare):
        return None
    marked, tone = toned != text.strip(), toned[len(bare) :]
    if not phonesets.is_vowel(bare):
        return PhoneLabel(bare, -1)
    return PhoneLabel(bare, stress if marked else None, tone)


def _sampa(text: str) -> PhoneLabel | None:
    ipa = label_table().ipa_of_sampa(text.strip())
    return None if ipa is None else _ipa(ipa)


def _with_glottal_stops(labels: Sequence[Label], phones: Sequence[PhoneLabel]) -> list[PhoneLabel]:
    """Return phones in which SAMPA's Q before a vowel is the stop of the glottis, as in German."""
    read = list(phones)
    for index, (label, after) in enumerate(zip(labels, phones[1:], strict=False)):
        if label.text.strip() == SAMPA_GLOTTAL and after.symbol and phonesets.is_vowel(after.symbol):
            read[index] = PhoneLabel("ʔ", -1)
    return read
