"""What a user names, as a script or a recording; no sound is opened."""

from __future__ import annotations

from pathlib import Path

import pytest

from risorius.errors import InputError
from risorius.script import Script
from risorius.speech import Input, LabelledRecording, Recording, read


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (Input(), "nothing to perform; expected a text, a file or --audio"),
        (Input("Oh.", transcript="Oh."), "a transcript needs its recording; expected --audio as well"),
        (Input("x.TextGrid", "x.wav", "Oh."), "x.TextGrid: a TextGrid has words of its own"),
        (Input("missing.xml"), "missing.xml: there is no such file"),
        (Input(audio="x.wav", transcript="missing.txt"), "missing.txt: "),
    ],
)
def test_what_does_not_fit_together_or_is_not_there_is_refused(given: Input, message: str) -> None:
    with pytest.raises(InputError) as refused:
        read(given)
    assert str(refused.value).startswith(message)


def test_a_text_is_a_script_even_if_it_looks_like_labels() -> None:
    script = read(Input("labels.TextGrid", text=True))
    assert isinstance(script, Script)
    assert script.text == "labels.TextGrid"


@pytest.mark.parametrize(
    ("given", "source"),
    [
        (Input("X.TEXTGRID"), LabelledRecording("X.TEXTGRID")),
        (Input("x.TextGrid", "x.wav"), LabelledRecording("x.TextGrid", "x.wav")),
        (Input(audio="x.wav"), Recording("x.wav")),
        (Input(audio="x.wav", transcript="Oh."), Recording("x.wav", "Oh.")),
    ],
)
def test_labels_and_sound_are_a_recording(given: Input, source: object) -> None:
    assert read(given) == source


def test_a_recording_has_the_script_that_it_says_and_a_transcript_from_its_file(tmp_path: Path) -> None:
    (tmp_path / "x.lab").write_text("Oh really?")
    source = read(Input("Oh.", "x.wav", str(tmp_path / "x.lab")))
    assert isinstance(source, Recording)
    assert source.transcript == "Oh really?"
    assert source.script is not None
    assert source.script.text == "Oh."
