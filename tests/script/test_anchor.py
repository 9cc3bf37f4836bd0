import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.speech.utterance import Word
from risorius.errors import InputError, Place
from risorius.script.anchor import Anchor, Base, parse_anchor, parse_number

PLACE = Place("f.xml", 3, 7)
WORDS = (Word("oh", 0.1, 0.4, 0, 1, 0, 2), Word("really", 0.5, 1.0, 1, 5, 3, 9))

NO_TIMES = [
    "",
    " ",
    "soon",
    "1,5",
    "1s",
    "1_0",
    "0x1",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "१",
    "word",
    "word:",
    "word:x",
    "word:-1",
    "word:1.middle",
    "word:1 2",
    "word:1+",
    "end-",
    "end+word:1",
    "end-0.5-0.5",
    "1-0.5",
]


@pytest.mark.parametrize("text", NO_TIMES)
def test_what_is_no_time_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"^f\.xml:3:7: end = '.*' is not a time; expected seconds, word:3"):
        parse_anchor("end", text, PLACE)


@pytest.mark.parametrize("text", ["-1", "-0.001"])
def test_negative_times_are_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"^f\.xml:3:7: time = '-.*' is negative; expected 0 or more"):
        parse_anchor("time", text, PLACE)


@pytest.mark.parametrize("text", ["21601", "word:1+1e6", "end-1e6"])
def test_times_after_the_longest_performance_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="is too long; expected at most 21600 seconds"):
        parse_anchor("time", text, PLACE)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("word:3", "f.xml:3:7: 'word:3': there is no word 3; expected words 1 to 2"),
        ("word:0.end", "f.xml:3:7: 'word:0.end': there is no word 0; expected words 1 to 2"),
        ("word:1-0.5", "f.xml:3:7: 'word:1-0.5' is 0.400 s before the start"),
        ("end-3", "f.xml:3:7: 'end-3' is 1.000 s before the start"),
    ],
)
def test_anchors_without_a_moment_are_refused(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_anchor("time", text, PLACE).resolve(WORDS, 2.0)
    assert str(caught.value) == message


def test_a_word_where_nothing_is_said() -> None:
    with pytest.raises(InputError, match="expected none: the script has no words"):
        parse_anchor("time", "word:1").resolve((), 2.0)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("0", 0.0),
        ("1.25", 1.25),
        (".5", 0.5),
        (" 2. ", 2.0),
        ("1e-1", 0.1),
        ("+1", 1.0),
        ("-0", 0.0),
        ("word:1", 0.1),
        ("word:2", 0.5),
        ("Word:2.End", 1.0),
        ("word:2.start", 0.5),
        ("word:2+0.25", 0.75),
        ("word:2.end - 0.5", 0.5),
        ("end", 2.0),
        ("END-0.5", 1.5),
        ("end+1", 3.0),
    ],
)
def test_times(text: str, seconds: float) -> None:
    assert parse_anchor("time", text).resolve(WORDS, 2.0) == pytest.approx(seconds)


@given(st.sampled_from([Base.START, Base.WORD, Base.WORD_END, Base.END]), st.integers(0, 80_000))
def test_an_anchor_reads_back_as_it_is_shown(base: Base, milliseconds: int) -> None:
    number = 2 if base in (Base.WORD, Base.WORD_END) else 0
    anchor = Anchor(base, milliseconds / 8, number) if milliseconds < 8000 else Anchor(base, 0.5, number)
    assert parse_anchor("time", str(anchor)) == anchor


@given(st.floats(0.0, 100.0), st.floats(0.0, 100.0))
def test_anchors_move(start: float, seconds: float) -> None:
    anchor = Anchor(Base.WORD, start, 1)
    assert anchor.after(seconds).resolve(WORDS, 1.0) == pytest.approx(0.1 + start + seconds)
    assert anchor.same_base(anchor.after(seconds))
    assert not anchor.same_base(Anchor(Base.WORD_END, start, 1))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_read_exactly(number: float) -> None:
    assert parse_number(repr(number)) == number
