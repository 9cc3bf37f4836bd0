"""A take as the page sees it: words, blocks, curves and the sound's outline."""

from __future__ import annotations

import base64
from collections.abc import Mapping

import numpy as np

from ...core.arrays import Array, Int16Array
from ...core.channels import CHANNELS
from ...core.edits import is_edited
from ...core.movement import Cause, LipSegment, ManualCurve, Movement, fitted
from ...core.parameters import NAMES, NEUTRAL
from ...core.score import Score
from ...core.speech.audio import Audio
from ...core.speech.utterance import Utterance
from ..wire import takes

# Seconds of sound to a bucket of the waveform, coarse to fine; none has more buckets than MOST_BUCKETS.
ZOOMS = (0.064, 0.016, 0.004)
MOST_BUCKETS = 200_000

Blocks = dict[str, takes.Block]


def spoken(utterance: Utterance, sound: str) -> takes.SpeechView:
    """Return the speech; `sound` is the path from which the page loads it."""
    words = tuple(
        takes.WordView(w.text, w.start, w.end, w.source_start, w.source_end) for w in utterance.words
    )
    phones = tuple(takes.PhoneView(p.symbol, p.start, p.end, p.stress, p.word) for p in utterance.phones)
    accents = [takes.Tone(a.time, a.label, a.word, True, a.nuclear) for a in utterance.accents]
    ends = [takes.Tone(b.time, b.label, b.word, False, False) for b in utterance.boundaries]
    tones = tuple(sorted((*accents, *ends), key=lambda tone: tone.time))
    pauses = tuple(takes.PauseView(p.start, p.end, str(p.kind)) for p in utterance.pauses)
    return takes.SpeechView(
        utterance.text, utterance.language, sound, words, phones, tones, pauses, waves(utterance.audio)
    )


def waves(audio: Audio) -> tuple[takes.Wave, ...]:
    """Return the sound's peaks, coarse to fine."""
    samples = audio.read()
    zooms = [z for z in ZOOMS if audio.duration / z <= MOST_BUCKETS] or [audio.duration / MOST_BUCKETS]
    return tuple(_wave(samples, round(zoom * audio.sample_rate), audio.sample_rate) for zoom in zooms)


def _wave(samples: Int16Array, size: int, rate: int) -> takes.Wave:
    edges = np.arange(0, max(len(samples), 1), size)
    padded = samples if len(samples) else np.zeros(1, np.int16)
    low, high = np.minimum.reduceat(padded, edges), np.maximum.reduceat(padded, edges)
    pairs = (np.stack([low, high], axis=1) >> 8).astype(np.int8)
    return takes.Wave(size / rate, base64.b64encode(pairs.tobytes()).decode())


def blocks(score: Score, like: tuple[Score, Blocks] | None = None) -> Blocks:
    """Return all movements and lip segments as blocks by id; those that `like` has too stay the same."""
    earlier_by_id: dict[int, takes.Block] = {}
    if like is not None:
        before, earlier_blocks = like
        earlier_by_id = {id(m): earlier_blocks[m.id] for m in before.movements}
        earlier_by_id |= {id(s): earlier_blocks[f"lips.{n}"] for n, s in enumerate(before.lips)}
    by_id = {m.id: earlier_by_id.get(id(m)) or _block(m) for m in score.movements}
    # A segment is named by its index, which may have changed.
    for n, s in enumerate(score.lips):
        block = earlier_by_id.get(id(s))
        by_id[f"lips.{n}"] = block if block and block.id == f"lips.{n}" else _segment(f"lips.{n}", s)
    return by_id


def _block(m: Movement) -> takes.Block:
    onset, offset = fitted(m.onset, m.offset, m.end - m.start)
    priority = CHANNELS.get(m.channel).priority if m.priority is None else m.priority
    return takes.Block(
        id=m.id,
        channel=m.channel,
        layer=m.layer,
        label=m.cause.trigger or m.label,
        start=m.start,
        apex_start=m.start + onset,
        apex_end=m.end - offset,
        end=m.end,
        targets=dict(m.parameters),
        priority=priority,
        function=m.function,
        cause=sentence(m.cause),
        rule=m.cause.rule,
        edited=is_edited(m),
    )


def _segment(name: str, s: LipSegment) -> takes.Block:
    return takes.Block(
        id=name,
        channel="lips",
        layer="",
        label=s.phone,
        start=s.start,
        apex_start=s.start,
        apex_end=s.end,
        end=s.end,
        targets=dict(s.targets),
        priority=CHANNELS.get("lips").priority,
        function="",
        cause=sentence(s.cause),
        rule=s.cause.rule,
        editable=False,
    )


def sentence(cause: Cause) -> str:
    """Return a cause in words: its trigger, its rule and its mark."""
    by = ", ".join(part for part in (cause.rule, cause.place) if part)
    return f"{cause.trigger} ({by})" if cause.trigger and by else cause.trigger or by


def drawn(score: Score) -> tuple[takes.DrawnCurve, ...]:
    """Return the curves drawn by hand, one for each parameter."""
    return tuple(_drawn(name, curve) for curve in score.manual for name in curve.keys)


def _drawn(name: str, curve: ManualCurve) -> takes.DrawnCurve:
    return takes.DrawnCurve(
        name, tuple(curve.keys[name]), sentence(curve.cause), curve.replaces, curve.shapes.get(name, ())
    )


def curves(values: Array) -> dict[str, str]:
    """Return the curves of (frames, 46) values that are not always neutral, by name."""
    moving = np.flatnonzero((values != NEUTRAL).any(axis=0))
    return {NAMES[column]: packed(values[:, column]) for column in moving}


def changed_curves(before: Mapping[str, str], after: Mapping[str, str]) -> dict[str, str]:
    """Return the curves that have changed; "" for a parameter that no longer moves."""
    names = sorted({*before, *after}, key=NAMES.index)
    return {name: after.get(name, "") for name in names if before.get(name, "") != after.get(name, "")}


def packed(values: Array) -> str:
    """Return numbers as base64 of little-endian float32."""
    return base64.b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode()
