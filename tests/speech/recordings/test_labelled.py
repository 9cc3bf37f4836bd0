"""TextGrids as utterances: what others' aligners write, and what is wrong with a grid, with its line."""

from __future__ import annotations

import unicodedata
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
    assert "x.TextGrid:22: 'L' starts at 0.25 s" in refusal(
        words, tier("phones", changed(3, (0.25, 0.4, "L")))
    )
    assert "x.TextGrid:14: 'b' starts at 0.3 s" in refusal(
        tier("words", [(0.1, 0.4, "a"), (0.3, 0.6, "b")]), tier("phones", HELLO)
    )
    assert "x.TextGrid:26: 'OW1' ends at 0.6 s, but the recording lasts 0.400 s" in refusal(
        words, tier("phones", HELLO), seconds=0.4
    )
    assert "x.TextGrid:10: unknown phone 'ʘ'; expected ARPAbet, IPA or SAMPA" in refusal(
        tier("phones", [(0.1, 0.2, "ʘ")])
    )
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


def test_single_unknown_labels_are_silence_with_a_warning() -> None:
    rows = [*changed(2, (0.2, 0.3, "AHH0"))[:5], (0.6, 0.7, "AHH0")]
    with pytest.warns(
        SpeechWarning, match=r"x.TextGrid:18: taken as silence \(2 times\): unknown phone 'AHH0'"
    ):
        found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones if p.symbol] == ["HH", "L", "OW"]


@pytest.mark.parametrize(
    "label",
    [
        *(
            "ns",
            "NS",
            "<nib>",
            "<usb>",
            "<p>",
            "<p:>",
            "LG",
            "{LG}",
            "CG",
            "UNK",
            "laugh",
            "breath",
            "cough",
            "xxx",
        ),
        *(
            "epi",
            "h#",
            "sil_S",
            "SPN_S",
            "spn",
            "nsn",
            "{B_TRANS}",
            "VOCNOISE",
            "IVER",
            "<LAUGH>",
            "[noise]",
            "oov",
        ),
        *("<eps>", "!SIL", "noise_S", "#", "ssil", "{SL}", "pau"),
    ],
)
def test_labels_of_silence_and_noise_are_silence(label: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = utterance_of_labels(
            grid(tier("words", WORDS), tier("phones", [*HELLO[:5], (0.6, 1.0, label)])), silence(1.0)
        )
    assert [p.symbol for p in found.phones] == ["", "HH", "AH", "L", "OW", ""]


@pytest.mark.parametrize("word", ["laugh", "noise", "silence", "breath", "cough", "unknown"])
def test_words_that_name_a_noise_are_words(word: str) -> None:
    found = utterance_of_labels(grid(tier("words", [(0.1, 0.6, word)]), tier("phones", HELLO)), silence(1.0))
    assert [w.text for w in found.words] == [word]


@pytest.mark.parametrize("word", ["<unk>", "{LG}", "[laughter]", "<eps>", "sp", "<SIL>", "spn", "xxx"])
def test_labels_of_noise_are_no_words(word: str) -> None:
    rows = [*HELLO[:5], (0.6, 1.0, "spn")]
    found = utterance_of_labels(
        grid(tier("words", [*WORDS, (0.6, 1.0, word)]), tier("phones", rows)), silence(1.0)
    )
    assert [w.text for w in found.words] == ["hello"]


def test_kaldis_phones_tell_their_place_in_the_word() -> None:
    rows = [
        (0.1, 0.2, "HH_B"),
        (0.2, 0.3, "AH0_I"),
        (0.3, 0.4, "L_I"),
        (0.4, 0.6, "OW1_E"),
        (0.6, 1.0, "SIL_S"),
    ]
    found = utterance_of_labels(grid(tier("words", WORDS), tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones] == ["", "HH", "AH", "L", "OW", ""]
    assert [p.stress for p in found.phones if p.stress >= 0] == [0, 2]
    small = [
        (0.1, 0.2, "hh_B"),
        (0.2, 0.3, "ah_I"),
        (0.3, 0.4, "l_I"),
        (0.4, 0.6, "ow_E"),
        (0.6, 1.0, "sil_S"),
    ]
    found = utterance_of_labels(grid(tier("words", WORDS), tier("phones", small)), silence(1.0))
    assert [p.symbol for p in found.phones] == ["", "HH", "AH", "L", "OW", ""]


@pytest.mark.parametrize(
    ("sampa", "ipa"),
    [
        ("g u: t @ n Q a b @ n t", "ɡ uː t ə n ʔ a b ə n t"),
        ("S 2: n 6 ts aI t OY C 9 pf", "ʃ øː n ɐ ts aɪ t ɔʏ ç œ pf"),
        ("b o~ Z u R 9~ s H i J", "b õ ʒ u ʁ œ̃ s ɥ i ɲ"),
        ("t_h { k @U I N D e@", "tʰ æ k əʊ ɪ ŋ ð eə"),
        ("r\\ 3: s` n= l= ?", "ɹ ɜː ʂ n̩ l̩ ʔ"),
    ],
)
def test_sampa_is_read_as_ipa(sampa: str, ipa: str) -> None:
    rows = [(0.05 * n, 0.05 * n + 0.05, label) for n, label in enumerate(sampa.split())]
    found = utterance_of_labels(grid(tier("MAU", rows)), silence(1.0))
    symbols = " ".join(p.symbol for p in found.phones if p.symbol)
    assert unicodedata.normalize("NFC", symbols) == unicodedata.normalize("NFC", ipa)


def test_stress_in_sampa_is_read() -> None:
    rows = [(0.1, 0.2, "n"), (0.2, 0.3, "%a"), (0.3, 0.4, "t"), (0.4, 0.6, '"u:')]
    found = utterance_of_labels(grid(tier("MAU", rows)), silence(1.0))
    assert [p.stress for p in found.phones if p.stress >= 0] == [1, 2]


def test_timits_closures_and_glottal_stops_belong_to_sounds() -> None:
    rows = [
        (0.0, 0.1, "h#"), (0.1, 0.2, "q"), (0.2, 0.3, "ae"), (0.3, 0.35, "tcl"), (0.35, 0.4, "t"),
        (0.4, 0.5, "ax-h"), (0.5, 0.55, "pcl"), (0.55, 0.6, "s"), (0.6, 0.7, "dcl"), (0.7, 0.75, "jh"),
        (0.75, 0.8, "eng"), (0.8, 0.85, "q"), (0.85, 1.0, "h#"),
    ]  # fmt: skip
    found = utterance_of_labels(grid(tier("phn", rows)), silence(1.0))
    spoken = [(p.symbol, round(p.start, 2), round(p.end, 2)) for p in found.phones if p.symbol]
    assert spoken == [
        ("AE", 0.1, 0.3), ("T", 0.3, 0.4), ("AH", 0.4, 0.5), ("P", 0.5, 0.55), ("S", 0.55, 0.6),
        ("JH", 0.6, 0.75), ("NG", 0.75, 0.85),
    ]  # fmt: skip


def test_buckeyes_nasal_vowels_are_vowels() -> None:
    rows = [(0.1, 0.2, "ehn"), (0.2, 0.3, "tq"), (0.3, 0.4, "nx"), (0.4, 0.5, "ihn"), (0.5, 0.6, "el")]
    found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones if p.symbol] == ["EH", "T", "N", "IH", "L"]


@pytest.mark.parametrize("start", [100.0, 1358.9, -0.5])
@pytest.mark.parametrize("recorded", [True, False])
def test_a_grid_begins_where_its_recording_does(start: float, recorded: bool) -> None:
    rows = [(a + start, b + start, text) for a, b, text in HELLO]
    words = [(a + start, b + start, text) for a, b, text in WORDS]
    later = TextGrid("x.TextGrid", start, start + 1.0, (tier("words", words), tier("phones", rows)))
    found = utterance_of_labels(later, silence(1.0) if recorded else None)
    assert found.words[0].start == pytest.approx(0.1)
    assert found.duration == pytest.approx(1.0)


def test_a_part_of_a_whole_recordings_grid_keeps_its_times() -> None:
    later = TextGrid("x.TextGrid", 2.0, 3.0, (tier("phones", [(a + 2.0, b + 2.0, t) for a, b, t in HELLO]),))
    with pytest.warns(SpeechWarning, match="nothing is labelled"):
        pass_through = utterance_of_labels(
            TextGrid("x", 2.0, 3.0, (tier("phones", [(2.1, 2.2, "M"), (2.4, 2.5, "IY1")]),)), silence(3.5)
        )
    assert [p.start for p in pass_through.phones if p.symbol] == pytest.approx([2.1, 2.4])
    assert utterance_of_labels(later, silence(3.5)).words[0].start == pytest.approx(2.1)


def test_labels_without_length_and_equal_starts_are_told_with_their_line() -> None:
    rows = [*HELLO[:2], (0.2, 0.2, "IH0"), *HELLO[2:]]
    with pytest.warns(SpeechWarning, match=r"x.TextGrid:18: 'IH0' has no length; it is left out"):
        found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones] == ["", "HH", "AH", "L", "OW", ""]
    rows = [*HELLO[:2], (0.2, 0.25, "IH0"), *HELLO[2:]]
    with pytest.warns(
        SpeechWarning, match=r"x.TextGrid:18: 'IH0' starts at 0.2 s, as 'AH0' does; it is left"
    ):
        found = utterance_of_labels(grid(tier("phones", rows)), silence(1.0))
    assert [p.symbol for p in found.phones] == ["", "HH", "AH", "L", "OW", ""]
    with pytest.warns(SpeechWarning, match=r"x.TextGrid:14: 'oh' has no length"):
        found = utterance_of_labels(
            grid(tier("words", [*WORDS, (0.6, 0.6, "oh")]), tier("phones", HELLO)), silence(1.0)
        )
    assert [w.text for w in found.words] == ["hello"]


@pytest.mark.parametrize("name", ['"word"', "'words'", "\u201cWord\u201d", ' "word" ', 'Anna - "word"'])
def test_names_of_tiers_may_stand_in_quotes(name: str) -> None:
    found = utterance_of_labels(grid(tier(name, WORDS), tier('"phone"', HELLO)), silence(1.0))
    assert [w.text for w in found.words] == ["hello"]
