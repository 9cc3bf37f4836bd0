"""Phones and durations that an utterance file writes are the labels of its recording (paper B, 5.1)."""

from pathlib import Path

import pytest

import risorius
from risorius.core.directions import Break, DirectedSpan, Directions
from risorius.core.speech.audio import silence
from risorius.core.speech.utterance import PauseKind
from risorius.errors import InputError, Place, SpeechWarning
from risorius.script import read_script
from risorius.speech import Recording, align_recording, synthesize_script
from risorius.speech.recordings.dictated import utterance_dictated

PLACE = Place("x.utt", 2, 5)
TEXT = "Oh really, now"
SPANS = (
    DirectedSpan(0, 2, PLACE, phones=("OW1",), seconds=(0.2,)),
    DirectedSpan(3, 9, PLACE, phones=("R", "IH1", "L", "IY0"), seconds=(0.1, 0.08, 0.07, 0.15)),
    DirectedSpan(11, 14, PLACE, phones=("N", "AW1"), seconds=(0.1, 0.3)),
)
BREAKS = (Break(0, 0.4, PLACE), Break(11, 0.25, PLACE))


def test_phones_last_as_long_as_they_are_written() -> None:
    said = utterance_dictated(silence(2.0), TEXT, Directions(SPANS, BREAKS))
    spoken = [(p.symbol, round(p.start, 3), round(p.end, 3), p.stress) for p in said.phones]
    assert spoken == [
        ("", 0.0, 0.4, -1), ("OW", 0.4, 0.6, 2), ("R", 0.6, 0.7, -1), ("IH", 0.7, 0.78, 2),
        ("L", 0.78, 0.85, -1), ("IY", 0.85, 1.0, 0), ("", 1.0, 1.25, -1), ("N", 1.25, 1.35, -1),
        ("AW", 1.35, 1.65, 2), ("", 1.65, 2.0, -1),
    ]  # fmt: skip
    assert [w.text for w in said.words] == ["Oh", "really", "now"]
    assert [p.kind for p in said.pauses] == [PauseKind.INITIAL, PauseKind.COMMA, PauseKind.FINAL]
    assert len(said.syllables) == 4


def test_a_recording_that_is_too_short_is_refused() -> None:
    with pytest.raises(
        InputError, match=r"x.utt:2:5: the phonemes end at 1.650 s, but the recording lasts 1.000 s"
    ):
        utterance_dictated(silence(1.0), TEXT, Directions(SPANS, BREAKS))


def test_the_file_s_own_timing_is_kept_with_its_recording(tmp_path: Path) -> None:
    script = read_script("examples/05-timed.utt")
    spoken = synthesize_script(script)
    wav = tmp_path / "x.wav"
    risorius.speak("examples/05-timed.utt").write(wav)
    _, heard = align_recording(Recording(wav, script=script))
    lead = heard.words[0].start - spoken.words[0].start
    assert abs(lead) < 0.15
    ours, theirs = ([p for p in said.phones if p.symbol] for said in (heard, spoken))
    assert [p.symbol for p in ours] == [p.symbol for p in theirs]
    for one, other in zip(ours, theirs, strict=True):
        assert one.start - lead == pytest.approx(other.start, abs=2e-3)
    assert [b.label for b in heard.boundaries] == [b.label for b in spoken.boundaries]
    assert {p.kind for p in heard.pauses} >= {PauseKind.COMMA} or len(heard.pauses) == len(spoken.pauses)


def test_phones_without_durations_are_not_dropped_in_silence(tmp_path: Path) -> None:
    file, wav = tmp_path / "x.utt", tmp_path / "x.wav"
    file.write_text("text: (Oh really)\nphonemes: (ow r'ihliy)\n")
    risorius.speak("Oh really").write(wav)
    with pytest.warns(SpeechWarning, match="phonemes without durations are not used with a recording"):
        align_recording(Recording(wav, script=read_script(str(file))))
