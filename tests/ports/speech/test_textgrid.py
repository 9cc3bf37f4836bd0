from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from praatio import textgrid as praatio_textgrid

from risorius.core.speech.utterance import Accent, Boundary, NamedTime, Phone, Utterance
from risorius.errors import OutputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.speech.textgrid import phone_label, write_textgrid
from risorius.script.textgrid import read_textgrid
from risorius.speech.recordings.labelled import utterance_of_labels
from risorius.speech.synthesis import synthesize_line

UtteranceMaker = Callable[..., Utterance]


def _read(path: Path) -> Any:
    return praatio_textgrid.openTextgrid(str(path), includeEmptyIntervals=True, reportingMode="error")


def _written(utterance: Utterance, take_of: Callable[..., WritableTake], path: Path) -> Any:
    write_textgrid(take_of(utterance=utterance), path, WriteOptions())
    return _read(path)


def test_nothing_said_is_an_error(tmp_path: Path, take_of: Callable[..., WritableTake]) -> None:
    with pytest.raises(OutputError, match="there is no speech"):
        write_textgrid(take_of(), tmp_path / "x.TextGrid", WriteOptions())


def test_marks_are_a_tier_of_their_own(
    tmp_path: Path, take_of: Callable[..., WritableTake], utterance_of: UtteranceMaker
) -> None:
    marks = (NamedTime("b", 0.8), NamedTime("c", 0.8), NamedTime("a", 0.25))
    utterance = replace(utterance_of("M AA _ B IY"), marks=marks)
    grid = _written(utterance, take_of, tmp_path / "x.TextGrid")
    entries = [(entry.time, entry.label) for entry in grid.getTier("marks").entries]
    assert entries == [(pytest.approx(0.25), "a"), (pytest.approx(0.8), "b, c")]


def test_praatio_reads_all_tiers_without_gaps(
    tmp_path: Path, take_of: Callable[..., WritableTake], utterance_of: UtteranceMaker
) -> None:
    utterance = replace(utterance_of("M AA _ B IY"), accents=(Accent(0.65, 0, 0, "H*"), Accent(1.0, 1, 1)))
    utterance = replace(utterance, boundaries=(Boundary(0.8, 0, "L-H%"),))
    grid = _written(utterance, take_of, tmp_path / "x.TextGrid")
    assert grid.tierNames == ("words", "phones", "accents", "boundaries")
    for name in ("words", "phones"):
        entries = grid.getTier(name).entries
        assert entries[0].start == 0.0
        assert entries[-1].end == pytest.approx(utterance.duration, abs=1e-6)
        assert all(a.end == b.start for a, b in pairwise(entries))
    phones = [(p.symbol, p.start, p.end) for p in utterance.phones]
    read = grid.getTier("phones").entries
    assert [entry.label for entry in read] == ["", "M", "AA1", "", "B", "IY1", ""]
    for entry, (_, start, end) in zip(read, phones, strict=True):
        assert (entry.start, entry.end) == pytest.approx((start, end), abs=1e-6)
    assert [entry.label for entry in grid.getTier("words").entries] == ["", "m", "aa", "", "b", "iy", ""]
    assert [tuple(entry) for entry in grid.getTier("accents").entries] == [(0.65, "H*"), (1.0, "*")]
    assert [tuple(entry) for entry in grid.getTier("boundaries").entries] == [(0.8, "L-H%")]


def test_lines_end_as_praat_ends_them(
    tmp_path: Path, take_of: Callable[..., WritableTake], utterance_of: UtteranceMaker
) -> None:
    """Praat 6.1 saves this file byte for byte the same; mytextgrid cuts at the blanks."""
    utterance = replace(utterance_of("AA", seconds=0.2), accents=(Accent(0.6, 0, 0, "H*"),))
    write_textgrid(take_of(utterance=utterance), tmp_path / "x.TextGrid", WriteOptions())
    head, tiers = (tmp_path / "x.TextGrid").read_text().split("tiers?")
    assert head == 'File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0 \nxmax = 1.2 \n'
    assert tiers.startswith(
        ' <exists> \nsize = 4 \nitem []: \n    item [1]:\n        class = "IntervalTier" \n'
        '        name = "words" \n        xmin = 0 \n        xmax = 1.2 \n        intervals: size = 3 \n'
        '        intervals [1]:\n            xmin = 0 \n            xmax = 0.5 \n            text = "" \n'
    )
    assert tiers.endswith("        points: size = 0 \n")
    assert '        points [1]:\n            number = 0.6 \n            mark = "H*" \n' in tiers


def test_tones_stand_behind_their_vowels_and_are_read_back(
    tmp_path: Path, take_of: Callable[..., WritableTake]
) -> None:
    said = synthesize_line("妈骂。", language="cmn")
    write_textgrid(take_of(utterance=said), tmp_path / "x.TextGrid", WriteOptions())
    grid = _read(tmp_path / "x.TextGrid")
    labels = [entry.label for entry in grid.getTier("phones").entries]
    assert [label for label in labels if label] == ["m", "ɑ˥", "m", "ɑ˥˩"]
    back = utterance_of_labels(read_textgrid(str(tmp_path / "x.TextGrid")))
    assert [(p.symbol, p.tone) for p in back.phones] == [(p.symbol, p.tone) for p in said.phones]


def test_quotes_lines_and_other_alphabets_survive(
    tmp_path: Path, take_of: Callable[..., WritableTake], utterance_of: UtteranceMaker
) -> None:
    utterance = utterance_of("M")
    word = replace(utterance.words[0], text='“ü\n"x"')
    grid = _written(replace(utterance, words=(word,)), take_of, tmp_path / "x.TextGrid")
    assert grid.getTier("words").entries[1].label == '“ü "x"'


def test_words_that_meet_inexactly_leave_no_sliver(
    tmp_path: Path, take_of: Callable[..., WritableTake], utterance_of: UtteranceMaker
) -> None:
    utterance = utterance_of("M AA")
    first, second = utterance.words
    words = (replace(first, end=first.end - 1e-9), second)
    grid = _written(replace(utterance, words=words), take_of, tmp_path / "x.TextGrid")
    assert [entry.label for entry in grid.getTier("words").entries] == ["", "m", "aa", ""]


@pytest.mark.parametrize(
    ("symbol", "stress", "language", "label"),
    [
        ("AA", 2, "en", "AA1"),
        ("AA", 1, "en-us", "AA2"),
        ("AH", 0, "en_GB", "AH0"),
        ("M", -1, "en", "M"),
        ("", -1, "en", ""),
        ("aː", 2, "de", "aː"),
    ],
)
def test_stress_digits_are_those_of_arpabet(symbol: str, stress: int, language: str, label: str) -> None:
    assert phone_label(Phone(symbol, 0.0, 1.0, stress), language) == label
