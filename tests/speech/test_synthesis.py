"""Synthesis as a whole: bad input, laws over many texts, and sentences checked by ear and eye."""

from __future__ import annotations

import math
import subprocess
import sys
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.speech.utterance import PauseKind, Utterance
from risorius.errors import InputError, ParameterError
from risorius.languages import phonesets
from risorius.machine.workers import Worker
from risorius.speech.engines.espeak import EspeakEngine
from risorius.speech.synthesis import synthesize_line

PIECES = """Oh, the of map really? I've $5.50 café “quoted” 12,345 in a.m. — Dr. Bob twelve e.g. wait...
😀 up! so over-the-top www.a.com C++ (so) end; hour & 50% UPPER naïve привет"""
WORDS = st.sampled_from([*PIECES.split(), "\n\n"])
TEXTS = (
    st.lists(WORDS, min_size=1, max_size=12).map(" ".join).filter(lambda text: any(map(str.isalnum, text)))
)


def words(said: Utterance) -> dict[str, str]:
    return {
        word.text: " ".join(phone.symbol for phone in said.phones[word.first_phone : word.last_phone])
        for word in said.words
    }


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the text is empty"),
        (" \n\t", "the text is empty"),
        ("...!?", r"nothing in '\.\.\.!\?' can be spoken"),
        ("😀 — “”", "can be spoken"),
        ("\ud800", "can be spoken"),
        ("x" * 100_001, "100,001 characters; at most 100,000"),
    ],
)
def test_text_that_cannot_be_spoken(text, message) -> None:
    with pytest.raises(InputError, match=message):
        synthesize_line(text)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rate": 79}, "rate 79 is out of range; expected 80 to 440"),
        ({"rate": 441}, "rate 441 is out of range"),
        ({"pitch": 100}, "pitch 100 is out of range; expected 0 to 99"),
        ({"pitch": -1}, "pitch -1 is out of range"),
        ({"lead": -0.1}, "lead -0.1 is out of range"),
        ({"tail": math.nan}, "tail nan is out of range"),
        ({"tail": math.inf}, "tail inf is out of range"),
    ],
)
def test_numbers_out_of_range(options, message) -> None:
    with pytest.raises(ParameterError, match=message):
        synthesize_line("Hello.", **options)


@given(TEXTS)
def test_the_laws_of_an_utterance(text) -> None:
    said = synthesize_line(text, lead=0.2, tail=0.1)
    assert said.phones[0].start == 0.0
    assert said.phones[-1].end == said.audio.frames / said.audio.sample_rate
    assert all(a.end == b.start and a.start < a.end for a, b in pairwise(said.phones))
    for number, word in enumerate(said.words):
        assert text[word.source_start : word.source_end] == word.text
        inside = said.phones[word.first_phone : word.last_phone]
        assert inside[0].start == word.start
        assert inside[-1].end == word.end
        assert {phone.word for phone in inside if phone.symbol} == {number}
    assert all(
        a.source_end <= b.source_start and a.last_phone <= b.first_phone for a, b in pairwise(said.words)
    )
    assert all((phone.symbol == "") == (phone.word == -1) for phone in said.phones)
    assert all((phone.stress >= 0) == phonesets.is_vowel(phone.symbol) for phone in said.phones)
    assert sum(phonesets.is_vowel(phone.symbol) for phone in said.phones) == len(said.syllables)
    silences = {(phone.start, phone.end) for phone in said.phones if not phone.symbol}
    assert {(p.start, p.end) for p in said.pauses} <= silences
    assert said.pauses[0].kind is PauseKind.INITIAL
    assert (said.pauses[-1].start, said.pauses[-1].end) == (said.words[-1].end, said.duration)


@pytest.mark.parametrize("voice", ["en-gb", "de", "fr", "cmn", "hi", "ja", "ru", "ar", "en-us+f2"])
def test_other_voices_obey_them_too(voice, engine) -> None:
    text = "Hello 你好 नमस्ते привет مرحبا schön, ça va? 12 kg."
    said = synthesize_line(text, voice=voice, engine=engine)
    assert all(text[word.source_start : word.source_end] == word.text for word in said.words)
    english = voice.startswith("en")
    assert all(phone.symbol in phonesets.ARPABET or not english for phone in said.phones if phone.symbol)
    assert all(phonesets.to_arpabet(phone.symbol) for phone in said.phones if phone.symbol)


def test_paper_a_demonstration(engine) -> None:
    said = synthesize_line("Oh, really? I like it very much.", engine=engine)
    assert words(said) == {
        "Oh": "OW",
        "really": "R IY AH L IY",
        "I": "AY",
        "like": "L AY K",
        "it": "IH T",
        "very": "V EH R IY",
        "much": "M AH CH",
    }
    assert [p.kind for p in said.pauses] == [PauseKind.COMMA, PauseKind.QUESTION]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("of the beam in the end", {"of": "AH V", "beam": "B IY M", "in": "IH N", "end": "EH N D"}),
        ("have been there", {"have": "HH AH V", "been": "B IH N", "there": "DH EH R"}),
        ("Is that the one", {"that": "DH AE T", "the": "DH AH"}),
        ("twelve bottles", {"twelve": "T W EH L V", "bottles": "B AA D AH L Z"}),
        ("Dr. Bob", {"Dr": "D AA K T ER", "Bob": "B AA B"}),
        ("$2", {"$2": "T UW D AA L ER Z"}),
        ("it’s naïve", {"it’s": "IH T S", "naïve": "N AY IY V"}),
        ("earring hour fire", {"earring": "IH R IH NG", "hour": "AW ER", "fire": "F AY ER"}),
        ("e.g. C++", {"e.g": "F AO R EH G Z AE M P AH L", "C++": "S IY P L AH S P L AH S"}),
    ],
)
def test_words_and_their_phones(text, expected, engine) -> None:
    found = words(synthesize_line(text, engine=engine))
    assert {word: found.get(word) for word in expected} == expected


def test_stress(engine) -> None:
    said = synthesize_line("banana understand", engine=engine)
    assert [phone.stress for phone in said.phones if phone.stress >= 0] == [0, 2, 0, 1, 0, 2]


def test_a_full_stop_of_an_abbreviation_makes_no_pause(engine) -> None:
    said = synthesize_line("Mr. Smith met Dr. Jones on Jan. 5 at 5 p.m. by car", engine=engine)
    assert said.pauses == ()


def test_kinds_of_pauses_in_order(engine) -> None:
    said = synthesize_line("Well, um, yes... No! Why? Because.\n\nSo", engine=engine, lead=0.2, tail=0.5)
    assert [p.kind.value for p in said.pauses] == [
        "initial", "comma", "hesitation", "hesitation", "exclamation", "question", "full_stop", "final",
    ]  # fmt: skip


@pytest.mark.parametrize("rate", [None, 120, 350])
def test_voiceless_stops_begin_with_their_silent_closure(rate, engine) -> None:
    said = synthesize_line("A cat, a map, a puppet, a chicken, a rocket, a teapot.", rate=rate, engine=engine)
    stops = [
        (before, phone)
        for before, phone in pairwise(said.phones)
        if phone.symbol in phonesets.VOICELESS_STOPS and phonesets.is_vowel(before.symbol)
    ]
    assert len(stops) > 8
    scale = min(1.0, 175 / (rate or 175))
    for before, phone in stops:
        quiet = longest_silence(said, phone.start, phone.end)
        # Closed for 39 to 49 ms at the usual rate, unless the vowel before is too short to give so much.
        assert quiet >= 0.035 * scale or before.duration < 0.03
        assert before.duration > 0.015
        assert abs(first_sound(said, phone.start) - phone.start - quiet) < 0.003


def test_vowels_after_nasals_begin_where_the_mouth_opens(engine) -> None:
    said = synthesize_line("A map, a man, a mummy, my mother, mean mums, no one, nine names.", engine=engine)
    ratios = [
        loudness(said, vowel.start + 0.003) / loudness(said, vowel.start - 0.013)
        for nasal, vowel in pairwise(said.phones)
        if nasal.symbol in ("M", "N") and vowel.stress == 2
    ]
    assert len(ratios) > 8
    assert min(ratios) > 1.2
    assert np.median(ratios) > 4


def test_lead_and_tail_shift_and_add_nothing_else(engine) -> None:
    plain = synthesize_line("Hello there.", engine=engine)
    padded = synthesize_line("Hello there.", lead=0.5, tail=0.7, engine=engine)
    lead = round(0.5 * plain.audio.sample_rate)
    assert padded.audio.frames == plain.audio.frames + lead + round(0.7 * plain.audio.sample_rate)
    assert np.array_equal(padded.audio.read(lead, plain.audio.frames), plain.audio.read())
    shifts = [b.end - a.end for a, b in zip(plain.phones[:-1], padded.phones[1:-2], strict=True)]
    assert shifts == pytest.approx([0.5] * len(shifts), abs=1e-4)


def test_long_text_is_joined_without_a_seam(engine) -> None:
    sentence = (
        "The quick brown fox jumps over the lazy dog, and Bob's mother puts the map by the big blue box. "
    )
    text = (sentence * 31)[:3000]
    said = synthesize_line(text, engine=engine)
    assert len(said.words) == len(text.split())
    samples = said.audio.read().astype(int)
    steps = np.abs(np.diff(samples))
    one = np.abs(np.diff(synthesize_line(sentence, engine=engine).audio.read().astype(int)))
    assert steps.max() <= one.max() * 1.05
    ends = [p for p in said.pauses if p.kind is PauseKind.FULL_STOP]
    assert len(ends) == 30
    for pause in ends:
        at = round(pause.end * said.audio.sample_rate)
        # Sentences meet inside their pause, in digital silence.
        assert not samples[at - 2000 : at - 1100].any()
        assert 0.2 < pause.end - pause.start < 0.5
    starts = [word.start for word in said.words if word.text == "The"]
    assert np.ptp(np.diff(starts)[1:]) < 0.001


def test_a_long_sentence_is_spoken_too(engine) -> None:
    text = "and then " * 150
    said = synthesize_line(text, engine=engine)
    assert len(said.words) == 300


def test_progress_is_told(engine) -> None:
    told: list[float] = []
    synthesize_line("One. Two. Three. Four.", engine=engine, progress=told.append)
    assert told == [0.25, 0.5, 0.75, 1.0]


def test_same_arguments_same_bytes_in_every_process() -> None:
    program = (
        "import hashlib; from risorius.speech.synthesis import synthesize_line;"
        "u = synthesize_line('Oh, really? I like it very much. In the end, $5.50.', lead=0.5);"
        "said = repr((u.phones, u.words, u.pauses)).encode();"
        "print(hashlib.sha256(u.audio.read().tobytes() + said).hexdigest())"
    )
    runs = [
        subprocess.run(
            [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=30
        )
        for _ in range(2)
    ]
    assert runs[0].stdout == runs[1].stdout


def test_a_first_text_starts_one_worker_and_asks_it_once_for_the_voices_and_for_each_sentence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[int, str]] = []
    call = Worker.call

    def noted(worker: Worker, task: str, message: dict[str, Any], **options: Any) -> Any:
        asked.append((worker.pid, message["op"]))
        return call(worker, task, message, **options)

    monkeypatch.setattr(Worker, "call", noted)
    with EspeakEngine() as engine:
        synthesize_line("Oh, really? I like it very much.", engine=engine)
    assert [op for _, op in asked] == ["voices", "speak", "speak"]
    assert len({pid for pid, _ in asked}) == 1


def span(said: Utterance, start: float, end: float) -> np.ndarray:
    rate = said.audio.sample_rate
    return said.audio.read(round(start * rate), round((end - start) * rate)).astype(float)


def longest_silence(said: Utterance, start: float, end: float) -> float:
    silent = np.concatenate(([0], span(said, start, end) == 0, [0])).astype(int)
    edges = np.flatnonzero(np.diff(silent))
    return (
        max((b - a for a, b in zip(edges[::2], edges[1::2], strict=True)), default=0) / said.audio.sample_rate
    )


def first_sound(said: Utterance, start: float) -> float:
    sounding = np.flatnonzero(span(said, start, start + 0.2))
    return start + (int(sounding[0]) if sounding.size else 0) / said.audio.sample_rate


def loudness(said: Utterance, at: float) -> float:
    return float(np.sqrt(np.mean(np.diff(span(said, at, at + 0.010)) ** 2)))
