"""Durations given for every phoneme hold exactly, and the sound goes with them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.profiles import examples

from risorius.script.utt import parse_utterance
from risorius.speech import synthesize_script
from risorius.speech.assembly.stretch import stretch

RATE = 22_050
PLAIN = "text: (JUlia) (POPcorn)"
JULIA = "jh<90>'uw<140>l<60>iy<70>ax<70>"
POPCORN = "p<90>'aa<160>p<90>k<70>ao<110>r<60>n<120>"
TIMED = f"{PLAIN}\nphonemes: ({JULIA}) (_<250> {POPCORN})"


def test_durations_hold_exactly() -> None:
    said = synthesize_script(parse_utterance(TIMED))
    words = [said.phones[w.first_phone : w.last_phone] for w in said.words]
    found = [[(p.symbol, round(1000 * p.duration)) for p in word] for word in words]
    assert found == [
        [("JH", 90), ("UW", 140), ("L", 60), ("IY", 70), ("AH", 70)],
        [("P", 90), ("AA", 160), ("P", 90), ("K", 70), ("AO", 110), ("R", 60), ("N", 120)],
    ]
    assert said.words[1].start - said.words[0].end == pytest.approx(0.25, abs=1e-4)
    assert [s.stress for s in said.syllables] == [2, 0, 0, 2, 0]


def test_the_sound_goes_with_the_phones() -> None:
    said = synthesize_script(parse_utterance(TIMED))
    sound = np.concatenate(list(said.audio.blocks())).astype(float)

    def power(symbol: str) -> float:
        phone = next(p for p in said.phones if p.symbol == symbol)
        part = sound[round(phone.start * RATE) : round(phone.end * RATE)]
        return float(np.sqrt((part**2).mean()))

    assert power("AA") > 4.0 * power("P")
    assert power("UW") > 2.0 * power("JH")


def test_without_durations_nothing_is_moved() -> None:
    assert (
        synthesize_script(parse_utterance(PLAIN)).duration
        == synthesize_script(parse_utterance(PLAIN + "\n")).duration
    )


@examples(20)
@given(st.floats(0.4, 2.5), st.floats(100.0, 400.0))
def test_stretching_keeps_pitch_and_power(factor: float, pitch: float) -> None:
    tone = (8000 * np.sin(2 * np.pi * pitch * np.arange(RATE) / RATE)).astype(np.int16)
    out = stretch(tone, np.array([0.0, RATE]), np.array([0.0, factor * RATE]), RATE)
    assert len(out) == round(factor * RATE)
    middle = out[2000:-2000].astype(float)
    spectrum = np.abs(np.fft.rfft(middle * np.hanning(len(middle))))
    assert np.argmax(spectrum) * RATE / len(middle) == pytest.approx(pitch, abs=4.0)
    assert np.sqrt((middle**2).mean()) == pytest.approx(8000 / np.sqrt(2), rel=0.1)


def test_no_change_of_time_changes_next_to_nothing() -> None:
    noise = np.random.default_rng(1).integers(-9000, 9000, RATE).astype(np.int16)
    same = stretch(noise, np.array([0.0, RATE]), np.array([0.0, RATE]), RATE)
    assert np.abs(same[600:-600].astype(int) - noise[600:-600]).max() <= 1
