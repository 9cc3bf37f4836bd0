"""Phrases and tones in brackets."""

import pytest

from risorius.errors import InputError, Place
from risorius.script.markup import parse_markup
from risorius.script.notation import read_brackets, read_tune, write_out

HERE = Place("x.utt", 3, 7)
BAD = [
    ("(JUlia prefers (POPcorn)", "x.utt:3:22: '(' opens inside another"),
    ("(JUlia) prefers)", "x.utt:3:13: 'prefers' stands outside brackets"),
    ("(JUlia))", "x.utt:3:14: ')' closes nothing"),
    ("(JUlia", "x.utt:3:7: '(' is not closed; expected ')'"),
    ("JUlia (prefers)", "x.utt:3:7: 'JUlia' stands outside brackets"),
    ("(JUlia) ()", "x.utt:3:15: empty brackets"),
]
BAD_TONES = [
    ("(L+K* LH%)", "x.utt:3:8: unknown pitch accent 'L+K*'; did you mean 'L+H*'"),
    ("(H* X%)", "x.utt:3:11: unknown boundary tone 'X%'"),
    ("(H* LL% H*)", "x.utt:3:15: 'H*' comes after the boundary"),
]


@pytest.mark.parametrize(("text", "message"), BAD)
def test_brackets_that_do_not_balance(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read_brackets(text, HERE)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(("text", "message"), BAD_TONES)
def test_unknown_tones(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        [read_tune(bracket) for bracket in read_brackets(text, HERE)]
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    ("words", "tones", "message"),
    [
        ("(JUlia) (POPcorn)", "(H* LL%)", "1 brackets of tones for 2 of words"),
        ("(JUlia)", "(H* LL%) (H* LL%)", "2 brackets of tones for 1 of words"),
        ("(JUlia PREfers)", "(H* LL%)", "1 accents for 2 accented words"),
        ("(JUlia prefers)", "(H* H* LL%)", "2 accents for 1 accented words"),
        ("(…)", "(LL%)", "no word in these brackets"),
    ],
)
def test_tones_and_words_must_pair(words: str, tones: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        written(words, tones)


def written(words: str, tones: str = ""):
    tunes = [read_tune(bracket) for bracket in read_brackets(tones, HERE)]
    return write_out(read_brackets(words, HERE), tunes)


@pytest.mark.parametrize(
    ("words", "tones", "text", "accents", "boundaries"),
    [
        (
            "(JUlia prefers) (POPcorn)",
            "(L+H* LH%) (H* LL%)",
            "Julia prefers, popcorn.",
            ["Julia L+H*", "popcorn H*"],
            ["prefers L-H%", "popcorn L-L%"],
        ),
        ("(Do YOU like it)", "(L* HH%)", "Do you like it?", ["you L*"], ["it H-H%"]),
        ("(it was good)!", "(H* LL%)", "it was good!", ["good H*"], ["good L-L%"]),
        ("(I saw A cat)", "(L-)", "I saw A cat", [], ["cat L-"]),
        ("(red and GREEN)", "", "red and green", [], []),
    ],
)
def test_words_and_tones_pair(words, tones, text, accents, boundaries) -> None:
    found = written(words, tones)

    def word(at: int) -> str:
        return found.text[at:].split()[0].strip(".,?!")

    assert found.text == text
    assert [f"{word(tone.at)} {tone.label}" for tone in found.directions.accents] == accents
    assert [f"{word(tone.at)} {tone.label}" for tone in found.directions.boundaries] == boundaries


def test_markup_takes_tones() -> None:
    line = parse_markup('<PHONEME text="(JUlia prefers)" accents="(L+H* LH%)" />').lines[0]
    assert line.text == "Julia prefers,"
    assert [tone.label for tone in line.directions.accents] == ["L+H*"]


def test_markup_says_where_a_tone_is_unknown() -> None:
    with pytest.raises(InputError, match=r"x\.xml:2:25: unknown pitch accent 'K\*'"):
        parse_markup('<PHONEME\n text="(A b)" accents="(K*)" />', "x.xml")
