"""TextGrids in all their spellings; faults with their line."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from praatio import textgrid as praatio_textgrid

from risorius.errors import InputError
from risorius.script.textgrid import (
    INTERVALS,
    POINTS,
    Label,
    Tier,
    parse_textgrid,
    read_textgrid,
    textgrid_lines,
)

LONG = """File type = "ooTextFile"
Object class = "TextGrid"

xmin = 0
xmax = 1.5
tiers? <exists>
size = 2
item []:
    item [1]:
        class = "IntervalTier"
        name = "words"
        xmin = 0
        xmax = 1.5
        intervals: size = 2
        intervals [1]:
            xmin = 0
            xmax = 0.5
            text = "say ""hi"" ! [3] 7"
        intervals [2]:
            xmin = 0.5
            xmax = 1.5
            text = ""
    item [2]:
        class = "TextTier"
        name = "accents"
        xmin = 0
        xmax = 1.5
        points: size = 1
        points [1]:
            number = 0.25
            mark = "H*"
"""
SHORT = """"ooTextFile short"
"TextGrid"
0
1.5
<exists>
2
"IntervalTier"
"words"
0
1.5
2
0
0.5
"say ""hi"" ! [3] 7"
0.5
1.5
""
! a comment with 99 and "text"
"TextTier"
"accents"
0
1.5
1
0.25
"H*"
"""


def refusal(text: str) -> str:
    with pytest.raises(InputError) as caught:
        parse_textgrid(text, "x.TextGrid")
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "x.TextGrid:1: the file ends before the header"),
        ("Hello there.", "the file ends before the header"),
        ('"ooTextFile" "Pitch"', "x.TextGrid:1: is not a TextGrid"),
        ('"Something"', "is not a TextGrid"),
        (LONG.replace("<exists>", "<absent>"), "x.TextGrid:6: has no tiers"),
        (LONG.replace("size = 2\nitem", "item"), "stands in place of the number of tiers"),
        (LONG.replace("IntervalTier", "OtherTier"), "x.TextGrid:10: 'OtherTier' is not a class of tiers"),
        (LONG.replace("xmax = 0.5", "xmax = -0.5"), "x.TextGrid:17: the interval ends at -0.5 s"),
        (
            LONG.replace("number = 0.25", 'number = "0.25"'),
            "x.TextGrid:30: '\"0.25\"' stands in place of the label's time",
        ),
        (LONG.replace("0.25", "1e999"), "is too large"),
        (LONG.replace("points: size = 1", "points: size = 1.5"), "the number of labels is 1.5"),
        (LONG[: len(LONG) // 2], "the file ends before"),
        (LONG.replace("size = 2", "size = 3", 1), "x.TextGrid:31: the file ends before the tier's class"),
    ],
)
def test_what_is_no_textgrid_is_refused_with_its_line(text: str, message: str) -> None:
    assert message in refusal(text)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none.TextGrid: there is no such file"):
        read_textgrid(str(tmp_path / "none.TextGrid"))


@pytest.mark.parametrize("text", [LONG, SHORT], ids=["long", "short"])
def test_both_forms_say_the_same(text: str) -> None:
    grid = parse_textgrid(text)
    words, accents = grid.tiers
    assert (grid.start, grid.end) == (0.0, 1.5)
    assert (words.name, words.kind, accents.name, accents.kind) == ("words", INTERVALS, "accents", POINTS)
    assert [label[:3] for label in words.labels] == [(0.0, 0.5, 'say "hi" ! [3] 7'), (0.5, 1.5, "")]
    assert [label[:3] for label in accents.labels] == [(0.25, 0.25, "H*")]


def test_labels_know_their_line() -> None:
    assert parse_textgrid(LONG).tiers[0].labels[1] == Label(0.5, 1.5, "", 20)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_encodings(encoding: str, ends: str, tmp_path: Path) -> None:
    path = tmp_path / "x.TextGrid"
    path.write_bytes(LONG.replace("say", "größe ɔɪ").replace("\n", ends).encode(encoding))
    assert read_textgrid(str(path)).tiers[0].labels[0].text == 'größe ɔɪ ""hi"" ! [3] 7'.replace('""', '"')


@given(st.text(st.characters(codec="utf-8", exclude_characters="\r"), max_size=30))
def test_any_label_survives(label: str) -> None:
    quoted = label.replace('"', '""')
    text = SHORT.replace('say ""hi"" ! [3] 7', quoted)
    assert parse_textgrid(text).tiers[0].labels[0].text == label


@given(st.text(max_size=300))
def test_nothing_but_input_errors(text: str) -> None:
    with pytest.raises(InputError):
        parse_textgrid(text)


def test_gaps_are_filled_and_what_rounding_leaves_nothing_of_is_left_out() -> None:
    labels = (Label(0.25, 0.5, "a"), Label(0.5, 0.5000001, "b"), Label(0.75, 2.0, "c"))
    (tier,) = parse_textgrid("\n".join(textgrid_lines(1.0, [Tier("words", INTERVALS, labels)]))).tiers
    expected = [(0.0, 0.25, ""), (0.25, 0.5, "a"), (0.5, 0.75, ""), (0.75, 1.0, "c")]
    assert [label[:3] for label in tier.labels] == expected


# Without quotes, which praatio does not undo in points; it strips blanks from labels, and has misread "1  1".
_TEXTS = (
    st.text(st.sampled_from("abc ɔ*!<>[]19"), min_size=1, max_size=8)
    .map(lambda text: " ".join(text.split()))
    .filter(bool)
)


@given(st.lists(_TEXTS, min_size=1, max_size=5), st.sampled_from(["long_textgrid", "short_textgrid"]))
def test_praatio_reads_what_we_write_and_we_read_what_praatio_writes(
    tmp_path_factory: pytest.TempPathFactory, texts: list[str], form: str
) -> None:
    path = tmp_path_factory.mktemp("grids") / "x.TextGrid"
    labels = tuple(Label(k * 0.5, k * 0.5 + 0.5, text) for k, text in enumerate(texts))
    points = tuple(Label(label.start, label.start, label.text) for label in labels)
    tiers = (Tier("words", INTERVALS, labels), Tier("accents", POINTS, points))
    path.write_text("\n".join(textgrid_lines(0.5 * len(texts), tiers)) + "\n", encoding="utf-8")
    judged = praatio_textgrid.openTextgrid(str(path), includeEmptyIntervals=True)
    assert [tuple(entry) for entry in judged.getTier("words").entries] == [label[:3] for label in labels]
    assert [tuple(entry) for entry in judged.getTier("accents").entries] == [p[1:3] for p in points]
    judged.save(str(path), format=form, includeBlankSpaces=True)
    read = read_textgrid(str(path)).tiers
    assert [[label[:3] for label in tier.labels] for tier in read] == [
        [label[:3] for label in tier.labels] for tier in tiers
    ]
