"""What is heard: inputs that do not go together, and a recording that is corrected and performed again."""

from __future__ import annotations

import warnings
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

import risorius
from risorius.cli import run
from risorius.core.directions import Directions, ToneMark
from risorius.core.lips.lip_rig import OPENING
from risorius.core.speech.utterance import Utterance
from risorius.errors import Place
from risorius.face.fit.lip_file import load_lip_rig
from risorius.ports.speech.textgrid import utterance_lines
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech.from_recording import hear_words, with_written_tones

TEXT = "Oh, really? My baby brother put the big map by the beam."
HERE = Place("x.xml")


@pytest.fixture
def voice(spoken_line: Utterance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "line.wav").write_bytes(spoken_line.audio.path.read_bytes())
    (tmp_path / "line.txt").write_text(TEXT)
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "nothing to perform; expected a text, a file or --audio"),
        (["Hello.", "--transcript", "Hello."], "a transcript needs its recording; expected --audio"),
        (["--audio", "none.wav"], "none.wav: there is no such file"),
        (
            ["--audio", "line.txt"],
            "line.txt: is not a recording: it is to be spoken; expected risorius speak",
        ),
        (["--audio", "line.wav", "--transcript", "none.txt"], "none.txt: cannot be read"),
        (["--audio", "line.wav", "--transcript", ""], "line.wav: the text is empty"),
        (["--audio", "line.wav", "--transcript", "?"], "line.wav: nothing in '?' can be spoken"),
        (
            ["--audio", "line.wav", "--transcript", "Two grey donkeys."],
            "line.wav: the transcript does not fit",
        ),
        (
            ["x.TextGrid", "--audio", "line.wav", "--transcript", "Oh."],
            "x.TextGrid: a TextGrid has words of its own",
        ),
        (["none.TextGrid", "--audio", "line.wav"], "none.TextGrid: there is no such file"),
    ],
)
def test_what_cannot_be_heard_is_one_line_and_writes_nothing(
    arguments: list[str], message: str, voice: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["speak", *arguments, "-o", "x.muscles.csv"]) == 2
    error = capsys.readouterr().err.strip().splitlines()[-1]
    assert message in error
    assert not (voice / "x.muscles.csv").exists()


def test_align_writes_a_textgrid_that_can_be_corrected_and_performed(voice: Path) -> None:
    assert run(["align", "line.wav", "line.txt", "-o", "x.TextGrid"]) == 0
    grid = (voice / "x.TextGrid").read_text()
    assert '"B"' in grid
    assert '"accents"' in grid
    (voice / "x.TextGrid").write_text(grid.replace('"beam"', '"dream"'))
    assert run(["speak", "x.TextGrid", "--audio", "line.wav", "-o", "x.muscles.csv", "-o", "y.TextGrid"]) == 0
    assert '"dream"' in (voice / "y.TextGrid").read_text()


def test_align_asks_for_an_output_that_it_can_write(voice: Path) -> None:
    assert run(["align", "line.wav", "line.txt"]) == 2
    assert run(["align", "line.wav", "line.txt", "-o", "x.mp4"]) == 2


def test_lips_shut_where_the_recording_says(voice: Path, spoken_line: Utterance) -> None:
    take = risorius.speak(audio="line.wav", transcript=TEXT, settings=Settings(fps=Fraction(100)))
    seal = take.curves["lip_seal"]
    assert take.utterance is not None
    for phone in spoken_line.phones:
        if phone.symbol in ("P", "B", "M"):
            inside = (take.times > phone.start - 0.05) & (take.times < phone.end + 0.02)
            assert seal[inside].max() > 0.9, phone
    # A seal takes up to 8 mm from the gap; what it leaves of the gap is the opening.
    left = load_lip_rig().gap({name: take.curves[name] for name in OPENING}) - 8.0 * seal
    for phone in spoken_line.phones:
        if phone.symbol in ("EY", "AE"):
            inside = (take.times > phone.start) & (take.times < phone.end)
            assert left[inside].max() > 3.0, phone


def test_a_script_keeps_its_marks_with_a_recorded_voice(voice: Path) -> None:
    (voice / "x.xml").write_text(f'<PHONEME time="0" text="{TEXT}" /><BLINK time="word:3" />')
    take = risorius.speak("x.xml", audio="line.wav")
    assert take.utterance is not None
    (blink,) = (m for m in take.score.movements if m.cause.rule == "script")
    assert blink.start == pytest.approx(take.utterance.words[2].start)


def test_tones_written_in_the_script_stand(voice: Path) -> None:
    script = read_script(TEXT, text=True)
    tones = Directions(
        accents=(ToneMark(TEXT.index("map"), "L+H*", HERE),),
        boundaries=(ToneMark(TEXT.index("beam"), "H-H%", HERE),),
    )
    line = replace(script.lines[0], directions=tones)
    found = with_written_tones(hear_words("line.wav", TEXT), replace(script, lines=(line,)))
    assert [a.label for a in found.accents if found.words[a.word].text == "map"] == ["L+H*"]
    assert found.boundaries[-1].label == "H-H%"


def test_a_textgrid_without_phones_is_aligned_by_its_words(voice: Path, spoken_line: Utterance) -> None:
    lines = "\n".join(utterance_lines(spoken_line)).replace('"phones"', '"sounds by ear"')
    (voice / "w.TextGrid").write_text(lines)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        take = risorius.speak("w.TextGrid", audio="line.wav")
    assert take.utterance is not None
    assert [w.text for w in take.utterance.words] == [w.text for w in spoken_line.words]


def test_a_textgrid_alone_is_performed_in_silence(voice: Path, spoken_line: Utterance) -> None:
    (voice / "w.TextGrid").write_text("\n".join(utterance_lines(spoken_line)))
    take = risorius.speak("w.TextGrid")
    assert take.curves["masseter"].max() > 0.1


def test_a_recording_alone_says_that_this_is_weaker(voice: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        assert run(["align", "line.wav", "-o", "x.TextGrid"]) == 0
    assert "risorius: warning: line.wav: there is no transcript" in capsys.readouterr().err
