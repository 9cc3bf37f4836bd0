"""TextGrids as utterances: what others' aligners write, and what is wrong with a grid, with its line."""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import pytest

from risorius.core.speech.audio import silence
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError, SpeechWarning
from risorius.languages import phonesets
from risorius.ports.speech.textgrid import utterance_lines
from risorius.script.textgrid import INTERVALS, POINTS, Label, TextGrid, Tier, parse_textgrid
from risorius.speech.recordings.labelled import utterance_of_labels

Row = tuple[float, float, str]
HELLO: list[Row] = [
    (0.0, 0.1, ""),
    (0.1, 0.2, "HH"),
    (0.2, 0.3, "AH0"),
    (0.3, 0.4, "L"),
    (0.4, 0.6, "OW1"),
    (0.6, 1.0, "sp"),
]
WORDS: list[Row] = [(0.1, 0.6, "hello")]


def tier(name: str, rows: Sequence[Row], kind: str = INTERVALS, line: int = 10) -> Tier:
    return Tier(name, kind, tuple(Label(*row, line + 4 * n) for n, row in enumerate(rows)), line)


def grid(*tiers: Tier) -> TextGrid:
    return TextGrid("x.TextGrid", 0.0, 1.0, tiers)


def refusal(*tiers: Tier, seconds: float = 1.0) -> str:
    with pytest.raises(InputError) as caught:
        utterance_of_labels(grid(*tiers), silence(seconds))
    return str(caught.value)


def changed(index: int, row: Row) -> list[Row]:
    return [*HELLO[:index], row, *HELLO[index + 1 :]]


def test_what_is_wrong_is_refused_with_its_line() -> None:
    words = tier("words", WORDS)
    assert "has no tier 'phones' of intervals; found 'words'" in refusal(words)
    assert "x.TextGrid:18: unknown phone 'AHH0'" in refusal(
        words, tier("phones", changed(2, (0.2, 0.3, "AHH0")))
    )
    assert "x.TextGrid:22: 'L' starts at 0.25 s" in refusal(
        words, tier("phones", changed(3, (0.25, 0.4, "L")))
    )
    assert "x.TextGrid:14: 'b' starts at 0.3 s" in refusal(
        tier("words", [(0.1, 0.4, "a"), (0.3, 0.6, "b")]), tier("phones", HELLO)
    )
    assert "x.TextGrid:26: 'OW1' ends at 0.6 s, but the recording lasts 0.400 s" in refusal(
        words, tier("phones", HELLO), seconds=0.4
    )
    assert "unknown phone 'ʘ'" in refusal(tier("phones", [(0.1, 0.2, "ʘ")]))
    assert "several speakers ('Ann - phones', 'Bob - phones')" in refusal(
        tier("Ann - phones", HELLO), tier("Bob - phones", HELLO)
    )
    assert "x.TextGrid:10: unknown tone 'X*'" in refusal(
        tier("phones", HELLO), tier("accents", [(0.4, 0.4, "X*")], POINTS)
    )


def test_gaps_become_silence_with_a_warning() -> None:
    with pytest.warns(SpeechWarning, match=r"x.TextGrid:18: nothing is labelled from 0.2 to 0.3 s"):
        found = utterance_of_labels(grid(tier("phones", [*HELLO[:2], *HELLO[3:]])), silence(1.0))
    assert [p.symbol for p in found.phones] == ["", "HH", "", "L", "OW", ""]


def test_a_word_without_phones_is_left_out_with_a_warning() -> None:
    with pytest.warns(SpeechWarning, match=r"x.TextGrid:14: 'there' has no phones"):
        found = utterance_of_labels(
            grid(tier("words", [*WORDS, (0.7, 0.9, "there")]), tier("phones", HELLO)), silence(1.0)
        )
    assert [w.text for w in found.words] == ["hello"]


@pytest.mark.parametrize("name", ["phones", "Phones", "phone", "Anna - phones", "MAU", "phonemes"])
@pytest.mark.parametrize("recorded", [True, False])
def test_tiers_are_found_by_their_usual_names(name: str, recorded: bool) -> None:
    found = utterance_of_labels(
        grid(tier("word", WORDS), tier(name, HELLO)), silence(1.0) if recorded else None
    )
    assert [p.symbol for p in found.phones] == ["", "HH", "AH", "L", "OW", ""]
    assert [p.stress for p in found.phones] == [-1, -1, 0, -1, 2, -1]
    assert [(w.text, w.first_phone, w.last_phone) for w in found.words] == [("hello", 1, 5)]
    assert len(found.syllables) == 2
    assert found.duration == pytest.approx(1.0)


def test_stress_that_no_label_tells_is_the_engines() -> None:
    bare = [(a, b, text.rstrip("012")) for a, b, text in HELLO]
    found = utterance_of_labels(grid(tier("words", WORDS), tier("phones", bare)), silence(1.0))
    assert [p.stress for p in found.phones if p.stress >= 0] == [0, 2]


def test_ipa_is_kept_and_its_stress_read() -> None:
    rows = [(0.1, 0.2, "h"), (0.2, 0.3, "ɛ"), (0.3, 0.4, "l"), (0.4, 0.6, "ˈoː")]
    found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones] == ["", "h", "ɛ", "l", "oː", ""]
    assert [p.stress for p in found.phones if p.stress >= 0] == [0, 2]
    assert [w.text for w in found.words] == ["hɛloː"]


def test_the_ipa_of_the_montreal_forced_aligner_is_read() -> None:
    symbols = [
        "tʰ",
        "dʲ",
        "ɫ̩",
        "ɐ",
        "aj",
        "ow",
        "tʃ",
        "ɾ̃",
        "kʷ",
        "ç",
        "ɲ",
        "n̩",
        "ɚ",
        "ʉː",
        "dʒ",
        "vʲ",
        "ɡ",
        "ʎ",
        "cʰ",
        "mʲ",
    ]
    rows = [(0.04 * n, 0.04 * n + 0.04, symbol) for n, symbol in enumerate(symbols)]
    found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones if p.symbol] == symbols


def test_tones_stand_on_their_syllables() -> None:
    tones = tier("tones", [(0.45, 0.45, "L+H*"), (0.6, 0.6, "LH%")], POINTS)
    found = utterance_of_labels(grid(tier("words", WORDS), tier("phones", HELLO), tones), silence(1.0))
    (accent,), (boundary,) = found.accents, found.boundaries
    assert (accent.label, accent.syllable, accent.nuclear, accent.confidence) == ("L+H*", 1, True, 1.0)
    assert (boundary.label, boundary.word) == ("L-H%", 0)


def test_what_we_write_is_read_back(spoken_line: Utterance) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        text = "\n".join(utterance_lines(spoken_line))
        back = utterance_of_labels(parse_textgrid(text), spoken_line.audio)
    assert [p.symbol for p in back.phones] == [p.symbol for p in spoken_line.phones]
    assert [p.stress for p in back.phones] == [p.stress for p in spoken_line.phones]
    assert [p.word for p in back.phones] == [p.word for p in spoken_line.phones]
    assert [p.start for p in back.phones] == pytest.approx([p.start for p in spoken_line.phones], abs=1e-5)
    assert [w.text for w in back.words] == [w.text for w in spoken_line.words]
    assert [(a.syllable, a.label) for a in back.accents] == [
        (a.syllable, a.label) for a in spoken_line.accents
    ]


def test_every_phone_of_english_is_read() -> None:
    for symbols in (sorted(phonesets.ARPABET), [phonesets.IPA[s] for s in sorted(phonesets.ARPABET)]):
        rows = [(0.02 * n, 0.02 * n + 0.02, symbol) for n, symbol in enumerate(symbols)]
        found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
        assert [p.symbol for p in found.phones if p.symbol] == symbols
