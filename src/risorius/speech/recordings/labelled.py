"""Make an Utterance of a TextGrid of words and phones and the recording that it labels.

The labels are taken as they are, because their author or aligner knew the recording better. Tiers are found
by name, as Praat's users and aligners spell them. Phones are ARPAbet, with stress digits or without, IPA or
SAMPA. A grid that begins later than 0 labels a part of a longer recording, whose start is time 0 here.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ...core.speech.audio import Audio, silence
from ...core.speech.utterance import SILENCE, Phone, Utterance, Word
from ...errors import InputError, Place, SpeechWarning, warn
from ...languages.labels import is_quiet_phone, is_quiet_word
from ...script.quote import quoted
from ...script.textgrid import INTERVALS, Label, TextGrid, Tier, moved
from ..alignment.lexicon import stresses_of
from ..structure.build import build_utterance
from ..structure.phrases import with_phrases
from ..synthesis import synthesize_line
from .phone_labels import UNSTRESSED, PhoneLabel, read_phones, stops_joined
from .tone_labels import read_tones, tells_accents, tells_boundaries

WORD_TIERS = ("words", "word", "orthography", "ort", "ort-mau", "wrd")
PHONE_TIERS = ("phones", "phone", "phonemes", "phoneme", "segments", "mau", "phn", "sounds")
# Seconds: the largest gap of labels that touch, and the most that the last may reach beyond the recording.
TOUCHING, BEYOND = 0.002, 0.1
SHORTEST = 1e-4
# The language of labels in ARPAbet, and of others.
_ARPABET_LANGUAGE, _UNDETERMINED = "en-us", "und"
NO_WORD = -1
_AROUND_NAMES = " \t\"'\u201c\u201d\u2018\u2019"


def utterance_of_labels(grid: TextGrid, audio: Audio | None = None) -> Utterance:
    """Return the utterance of a TextGrid; without a recording it is silent.

    Tiers `accents`, `boundaries` and `tones` (points with ToBI's labels) give accents and boundaries. Raises
    InputError, with the line, for tiers that are missing, overlaps and labels beyond the recording; warns
    (SpeechWarning) of gaps and unknown phones, which are taken as silence, of labels without length, and of
    words without phones.
    """
    grid = from_start(grid, None if audio is None else audio.duration)
    phone_tier = found_tier(grid, PHONE_TIERS)
    if phone_tier is None:
        raise InputError(f"has no tier 'phones' of intervals; found {_listed(grid)}", Place(grid.source))
    audio = audio or silence(max(grid.end, SHORTEST))
    phone_tier = replace(phone_tier, labels=tuple(stops_joined(phone_tier.labels)))
    labels = _continuous(phone_tier, grid.source, audio.duration)
    arpabet, sounds = read_phones(labels, grid.source)
    word_tier = found_tier(grid, WORD_TIERS)
    words = said_words(word_tier, grid.source) if word_tier else []
    _check_overlaps(words, grid.source)
    phones, timed = _joined(labels, sounds, words, grid.source)
    text = " ".join(word.text for word in timed)
    phones = _stressed(phones, timed, sounds, text if arpabet and words else "")
    code = _ARPABET_LANGUAGE if arpabet else _UNDETERMINED
    utterance = build_utterance(text, code, audio, phones, timed)
    tones = read_tones(grid, utterance.syllables, timed)
    return with_phrases(
        replace(
            utterance,
            accents=tones.accents if tells_accents(grid) else utterance.accents,
            boundaries=tones.boundaries if tells_boundaries(grid) else utterance.boundaries,
        )
    )


def from_start(grid: TextGrid, seconds: float | None = None) -> TextGrid:
    """Return a grid that begins at 0, as its recording of `seconds` does (None: there is none).

    A recording as long as the whole grid from time 0 on keeps the grid's times.
    """
    keeps = seconds is not None and seconds > grid.end - grid.start + BEYOND and seconds >= grid.end - BEYOND
    return grid if grid.start == 0.0 or keeps else moved(grid, -grid.start)


def said_words(tier: Tier, source: str) -> list[Label]:
    """Return the labels of a tier of words that are words, and have a length."""
    return _lasting([label for label in tier.labels if not is_quiet_word(label.text)], source)


def found_tier(grid: TextGrid, names: Sequence[str]) -> Tier | None:
    """Return the tier of intervals with one of these names, alone or after a speaker's ("Anna - words").

    Raises InputError if several speakers have one.
    """
    tiers = [
        t
        for t in grid.tiers
        if t.kind == INTERVALS and t.name.split(" - ")[-1].strip(_AROUND_NAMES).lower() in names
    ]
    if len(tiers) > 1 and any(" - " in tier.name for tier in tiers):
        listed = ", ".join(quoted(tier.name) for tier in tiers)
        message = f"has the tiers of several speakers ({listed}); expected those of one"
        raise InputError(message, Place(grid.source, tiers[1].line))
    return tiers[0] if tiers else None


def _listed(grid: TextGrid) -> str:
    return ", ".join(quoted(tier.name) for tier in grid.tiers) or "no tiers"


def _check_overlaps(labels: Sequence[Label], source: str) -> None:
    for before, after in pairwise(labels):
        if after.start < before.end - TOUCHING:
            raise InputError(
                f"{quoted(after.text)} starts at {after.start:g} s, before {quoted(before.text)} ends at "
                f"{before.end:g} s; expected labels one after another",
                Place(source, after.line),
            )


def _lasting(labels: Sequence[Label], source: str) -> list[Label]:
    """Return the labels that have a length; of two that start at the same time the longer.

    Warns (SpeechWarning) of the others unless they are silence.
    """
    kept: list[Label] = []
    for label in sorted(labels, key=lambda label: label.start):
        fault = "has no length"
        short = label if label.end - label.start <= SHORTEST else None
        if short is None and kept and label.start - kept[-1].start <= SHORTEST:
            short = min(label, kept[-1], key=lambda both: both.end - both.start)
            fault = (
                f"starts at {label.start:g} s, as {quoted((kept[-1] if short is label else label).text)} does"
            )
            if short is not label:
                kept[-1] = label
        elif short is None:
            kept.append(label)
        if short is not None and not is_quiet_phone(short.text):
            warn(f"{Place(source, short.line)}: {quoted(short.text)} {fault}; it is left out", SpeechWarning)
    return kept


def _continuous(tier: Tier, source: str, duration: float) -> list[Label]:
    """Return the labels with silence in the gaps, over [0, duration]."""
    labels = _lasting(tier.labels, source)
    _check_overlaps(labels, source)
    beyond = next((x for x in labels if x.end > duration + BEYOND and not is_quiet_phone(x.text)), None)
    if beyond is not None:
        message = f"{quoted(beyond.text)} ends at {beyond.end:g} s, but the recording lasts {duration:.3f} s"
        raise InputError(f"{message}; expected the recording that was labelled", Place(source, beyond.line))
    filled: list[Label] = []
    reached = 0.0
    for label in labels:
        if label.start > reached + TOUCHING:
            if filled:
                gap = f"nothing is labelled from {reached:g} to {label.start:g} s; taken as silence"
                warn(f"{Place(source, label.line)}: {gap}", SpeechWarning)
            filled.append(Label(reached, label.start, "", label.line))
        start, end = filled[-1].end if filled else 0.0, min(label.end, duration)
        if end > start:
            filled.append(label._replace(start=start, end=end))
            reached = end
    if duration - reached > TOUCHING or not filled:
        filled.append(Label(reached, duration, "", tier.line))
    filled[-1] = filled[-1]._replace(end=duration)
    return filled


def _joined(
    labels: Sequence[Label], sounds: Sequence[PhoneLabel], words: Sequence[Label], source: str
) -> tuple[tuple[Phone, ...], tuple[Word, ...]]:
    """Return phones and the words that they belong to; sounds outside of all words are words of their own."""
    owners = _owners(labels, sounds, words)
    spans: dict[int, list[int]] = {}
    for index, owner in enumerate(owners):
        if owner != NO_WORD:
            spans.setdefault(owner, []).append(index)
    _report_unsaid([word for number, word in enumerate(words) if number not in spans], source)
    numbers = {owner: number for number, owner in enumerate(spans)}
    phones = tuple(
        Phone(sound.symbol, label.start, label.end, _known(sound), numbers.get(owner, NO_WORD), sound.tone)
        for label, sound, owner in zip(labels, sounds, owners, strict=True)
    )
    timed: list[Word] = []
    offset = 0
    for owner, inside in spans.items():
        first, last = inside[0], inside[-1]
        text = words[owner].text.strip() if owner < len(words) else "".join(phones[i].symbol for i in inside)
        end = offset + len(text)
        timed.append(Word(text, phones[first].start, phones[last].end, first, last + 1, offset, end))
        offset = end + 1
    return phones, tuple(timed)


def _owners(labels: Sequence[Label], sounds: Sequence[PhoneLabel], words: Sequence[Label]) -> list[int]:
    """Return the index of each phone's word, from len(words) on for runs of sounds outside of all words."""
    starts = [word.start for word in words]
    owners: list[int] = []
    unnamed = len(words)
    for label, sound in zip(labels, sounds, strict=True):
        middle = 0.5 * (label.start + label.end)
        index = bisect_right(starts, middle) - 1
        if sound.symbol == SILENCE:
            owners.append(NO_WORD)
        elif index >= 0 and middle < words[index].end:
            owners.append(index)
        else:
            unnamed += not (owners and owners[-1] == unnamed)
            owners.append(unnamed)
    return owners


def _report_unsaid(words: Sequence[Label], source: str) -> None:
    for word in words:
        message = f"{quoted(word.text)} has no phones; it is left out"
        warn(f"{Place(source, word.line)}: {message}", SpeechWarning)


def _known(sound: PhoneLabel) -> int:
    return UNSTRESSED if sound.stress is None else sound.stress


def _stressed(
    phones: tuple[Phone, ...], words: Sequence[Word], sounds: Sequence[PhoneLabel], text: str
) -> tuple[Phone, ...]:
    """Return the phones with the stress that espeak-ng gives the words if no label tells it."""
    if not text or all(sound.stress is not None for sound in sounds):
        return phones
    spoken = synthesize_line(text)
    heard = {word.source_start: word for word in spoken.words}
    phone_list = list(phones)
    for word in words:
        engine = heard.get(word.source_start)
        inside = spoken.phones[engine.first_phone : engine.last_phone] if engine else ()
        span = range(word.first_phone, word.last_phone)
        levels = stresses_of([phones[i].symbol for i in span], [p.stress for p in inside if p.stress >= 0])
        for index, level in zip(span, levels, strict=True):
            if sounds[index].stress is None:
                phone_list[index] = replace(phones[index], stress=level)
    return tuple(phone_list)
