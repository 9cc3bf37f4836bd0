"""The aligner's process: it is replaced once, and given up after that."""

from __future__ import annotations

import importlib.util
import os
import signal
import sys
from pathlib import Path
from typing import Any

import pytest

from risorius.cli import run
from risorius.core.speech.utterance import Utterance
from risorius.errors import SpeechError
from risorius.machine.workers import Worker
from risorius.speech.alignment import align, decoder
from risorius.speech.alignment.lexicon import read_transcript
from risorius.speech.resampled import Resampled


def failing(monkeypatch: pytest.MonkeyPatch, times: int) -> list[int]:
    """Kill the aligner as it is asked for the first `times` times; return their process ids."""
    hit: list[int] = []

    class Failing(Worker):
        def call(self, task: str, *arguments: object, **options: Any) -> Any:
            if len(hit) < times:
                hit.append(self.pid)
                os.kill(self.pid, signal.SIGKILL)
            return super().call(task, *arguments, **options)

    monkeypatch.setattr(decoder, "Worker", Failing)
    return hit


def test_an_aligner_that_fails_twice_is_given_up(spoken: Utterance, monkeypatch: pytest.MonkeyPatch) -> None:
    hit = failing(monkeypatch, 2)
    with pytest.raises(SpeechError, match=r"^the aligner failed twice in a row; the second time it ended"):
        align(spoken.audio, spoken.text)
    assert len(set(hit)) == 2


def test_a_package_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decoder.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(SpeechError, match="'pocketsphinx', which is not installed"):
        decoder.dictionary_path()


def test_without_the_package_all_but_alignment_works(
    spoken: Utterance, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(
        decoder.importlib.util, "find_spec", lambda name: None if name == "pocketsphinx" else find(name)
    )
    monkeypatch.setitem(sys.modules, "pocketsphinx", None)
    labels, sound = str(tmp_path / "x.TextGrid"), str(tmp_path / "x.wav")
    assert run(["speak", "Hi.", "-o", labels, "-o", sound]) == 0
    assert run(["speak", labels, "--audio", sound, "-o", str(tmp_path / "y.muscles.csv")]) == 0
    capsys.readouterr()
    assert run(["speak", "Hi.", "--audio", sound, "-o", str(tmp_path / "z.muscles.csv")]) == 2
    assert "or a TextGrid with words" in capsys.readouterr().err
    assert run(["align", sound, "-o", str(tmp_path / "z.TextGrid")]) == 2
    assert "'pocketsphinx', which is not installed" in capsys.readouterr().err


def test_one_that_dies_is_replaced(spoken: Utterance, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = align(spoken.audio, spoken.text)
    hit = failing(monkeypatch, 1)
    assert align(spoken.audio, spoken.text) == expected
    assert hit
    if Path("/proc").is_dir():
        assert not Path(f"/proc/{hit[0]}").exists()


def test_sounds_aligned_in_turn_are_found_as_by_one_process(spoken: Utterance) -> None:
    resampled = Resampled(spoken.audio)
    whole = resampled.read(0.0, resampled.audio.duration)
    _, words = read_transcript(spoken.text, None)
    readings = [word.readings for word in words]
    sounds = [whole, 0.5 * whole, whole]
    with decoder.Decoders() as decoders:
        alone = [decoders.align_words(sound, readings) for sound in sounds]
    with decoder.Decoders() as decoders:
        begun = [decoders.align_in_turn(sound, readings, last=n == 2) for n, sound in enumerate(sounds)]
        assert [alignment.result() for alignment in begun] == alone
    # What a decoder has heard before matters: else this test would prove nothing.
    assert alone[2] != alone[0]
