"""Phones as the visemes of the field: a table per phone (`data/visemes.toml`), and runs of equal ones."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ...core.arrays import Array
from ...core.lips.closed_lips import closed_lips
from ...core.lips.lip_rig import SEAL
from ...core.parameters import INDEX
from ...core.speech.utterance import Phone, Utterance
from ...errors import OutputError, SpeechWarning, warn
from ...languages.phones import check_phones
from ...languages.phonesets import IPA
from ...reading.frozen import FrozenDict
from ...reading.toml import package_text, parse_rows
from ..export_source import WritableTake

OCULUS = ("sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou")
"""The 15 visemes of OVRLipSync, in its order."""
TABLE = "visemes.toml"
NEAR = 0.08
"""Seconds before and after a bilabial within which its lips are sealed."""
_SEALED = 0.99  # share of a closure from which on lips count as sealed
NEUTRAL = "AH"
"""The phone shown for an unknown one: the lips of a neutral vowel."""


@dataclass(frozen=True, slots=True)
class Viseme:
    """A phone's viseme in each set; two shapes are those of a diphthong's halves. `ipa`: its symbols."""

    rhubarb: tuple[str, ...]
    azure: int
    oculus: tuple[str, ...]
    ipa: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Cue:
    """A shape that is held. Seconds."""

    start: float
    end: float
    shape: str


@lru_cache(maxsize=1)
def viseme_table() -> Mapping[str, Viseme]:
    """Return the table by ARPAbet symbol without stress digit; raise InputError if it lacks a phone."""
    rows = parse_rows(Viseme, package_text(__package__, TABLE), TABLE)
    check_phones(TABLE, rows)
    own = {symbol: (IPA[symbol],) if symbol in IPA else () for symbol in rows}
    return FrozenDict({symbol: replace(row, ipa=own[symbol] + row.ipa) for symbol, row in rows.items()})


def viseme_of(symbol: str) -> Viseme:
    """Return a phone's visemes, ARPAbet or IPA; warn (SpeechWarning) of one that the table does not know."""
    viseme = known_viseme(symbol)
    if viseme is None:
        warn(f"phone '{symbol}' has no viseme; shown as {NEUTRAL}", SpeechWarning)
    return viseme or viseme_table()[NEUTRAL]


@lru_cache(maxsize=512)
def known_viseme(symbol: str) -> Viseme | None:
    """Return a phone's visemes by the longest row that it begins with, else by its next letters, or None."""
    table = viseme_table()
    if symbol in table:
        return table[symbol]
    letters = unicodedata.normalize("NFD", symbol).replace("c\u0327", "ç")
    for at in range(len(letters)):
        tail = letters[at:]
        rows = [(len(start), row) for row in table.values() for start in row.ipa if tail.startswith(start)]
        if rows:
            return max(rows, key=lambda entry: entry[0])[1]
    return None


def cues(utterance: Utterance, shapes: Callable[[Viseme], tuple[str, ...]], silence: str) -> list[Cue]:
    """Return shapes that cover the utterance without a gap; equal neighbours are one."""
    return list(_merged(_each(utterance.phones, shapes, silence)))


def shown_cues(
    take: WritableTake, shapes: Callable[[Viseme], tuple[str, ...]], silence: str, closed: str
) -> list[Cue]:
    """Return the cues of what is said, with the shape `closed` as long as our own lips are sealed.

    Lips close a little before a phone begins, and may open after it has ended; its neighbours are shorter by
    that.
    """
    phones = cues(said(take), shapes, silence)
    edges = np.array([*(cue.start for cue in phones), phones[-1].end])
    first, last = edges[[0, -1]]
    bilabials = [number for number, cue in enumerate(phones) if cue.shape == closed]
    for start, end in _sealed_spans(take) if bilabials else ():
        away = [max(phones[number].start - end, start - phones[number].end) for number in bilabials]
        number = bilabials[int(np.argmin(away))]
        if min(away) < NEAR:
            edges[: number + 1] = np.minimum(edges[: number + 1], start)
            edges[number + 1 :] = np.maximum(edges[number + 1 :], end)
    edges = np.clip(edges, first, last)
    spans = zip(edges.tolist(), edges[1:].tolist(), phones, strict=False)
    return list(_merged(Cue(start, end, cue.shape) for start, end, cue in spans if start < end))


def _sealed_spans(take: WritableTake) -> list[tuple[float, float]]:
    """Return the spans in seconds in which our lips are sealed: half a frame around their frames."""
    frames, half = np.flatnonzero(sealed(take) > _SEALED), 0.5 / float(take.performance.fps)
    runs = np.split(frames, np.flatnonzero(np.diff(frames) > 1) + 1) if len(frames) else []
    times = take.performance.times
    return [(float(times[run[0]]) - half, float(times[run[-1]]) + half) for run in runs]


def sealed(take: WritableTake) -> Array:
    """Return how far our own lips are sealed in each frame (frames,): 1 where they touch by a seal."""
    curves = take.performance.values
    return closed_lips(take.head_lips, curves) if curves[:, INDEX[SEAL]].any() else np.zeros(len(curves))


def said(take: WritableTake) -> Utterance:
    """Return the utterance; raise OutputError if nothing is said."""
    if take.utterance is None:
        raise OutputError("there is no speech to write; expected a performance that speaks")
    return take.utterance


def _each(
    phones: Iterable[Phone], shapes: Callable[[Viseme], tuple[str, ...]], silence: str
) -> Iterator[Cue]:
    for phone in phones:
        parts = shapes(viseme_of(phone.symbol)) if phone.symbol else (silence,)
        step = phone.duration / len(parts)
        for k, shape in enumerate(parts):
            end = phone.end if k == len(parts) - 1 else phone.start + (k + 1) * step
            yield Cue(phone.start + k * step, end, shape)


def _merged(parts: Iterable[Cue]) -> Iterator[Cue]:
    last: Cue | None = None
    for cue in parts:
        if last is not None and last.shape == cue.shape:
            last = Cue(last.start, cue.end, cue.shape)
            continue
        if last is not None:
            yield last
        last = cue
    if last is not None:
        yield last
