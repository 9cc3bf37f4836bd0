"""Markdown as language models write it: marks are hidden, words stay at their places."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.directions import Emphasis
from risorius.core.speech.characters import HIDDEN, shown
from risorius.script.markdown import is_markdown, kinds_of_marks, without_marks
from risorius.script.plain import TextForm, parse_plain
from risorius.script.read import parse_script
from risorius.script.tree import ScriptWarning

ANSWER = """# Your order

Thanks! Here is **what happens** next:

- We *pack* your parcel today.
- You get the `tracking code` by mail.

1. Open [our page](https://www.example.com/track?id=42).
2. Type the code.

| item | price |
|------|-------|
| lamp | $20   |
"""
SAID = """
Your order Thanks! Here is what happens next: We pack your parcel today. You get the tracking code by mail.
1) Open our page. 2) Type the code. item, price lamp, $20
"""
PLAIN = [
    "The old man walked his dog.",
    "2 * 3 * 4 is 24, and 2 ** 3 is 8.",
    "- Hello.\n- Hi!",
    "We *pack* your parcel *today*.",
    "# 1 fan of C# and #hashtags",
    "snake_case and another_name_here",
    "[laughs] Yes (really).",
    "1. April 2021 was cold.\n2. Mai auch.",
    "a | b",
    "Really -- really?",
]
INLINE = [
    ("**bold** and *thin*", "**bold** and *thin*"),
    ("__bold__ and _thin_", "**bold** and *thin*"),
    ("***both*** of ___them___", "**both** of **them**"),
    ("snake_case_name", "snake_case_name"),
    ("run `pip install *x*` now", "run pip install *x* now"),
    ("``a ` b``", "a ` b"),
    ("see [the docs](https://x.org/a_b?c=d) now", "see the docs now"),
    ('[a](http://x.y "title (one)")', "a"),
    ("[a][1] and [b]", "a and [b]"),
    ("[cut off](https://exam", "cut off"),
    ("![a chart](chart.png)done", "done"),
    ("<https://x.org>", "https://x.org"),
    ("one<br/>two <b>three</b>", "onetwo three"),
    ("~~old~~ new", " new"),
    ("Tom &amp; Jerry &lt;3 &#233;", "Tom & Jerry <3 é"),
    (r"2 \* 3 \# 4", "2  3 # 4"),
    ("**open and closed", "open and closed"),
    ("a fact[^1]", "a fact"),
]
BLOCKS = [
    ("# Title\nText", " Title\n Text"),
    ("## Title ##", " Title "),
    ("Title\n=====\nText", "Title\n\nText"),
    ("* one\n+ two\n- three", " one\n two\n three"),
    ("- [ ] open\n- [x] done", " open\n done"),
    ("3) three\n4. four", "3) three\n4) four"),
    ("> said\n> so", "said\nso"),
    ("text\n***\nmore", "text\n\nmore"),
    ("a\n```py\nx = 1\n```\nb", "a\n\n\n\nb"),
    ("~~~\nnever closed", "\n"),
    ("a | b\n--|--\n1 | 2", "a, b\n\n1, 2"),
    ("|a|b|\n|-|-|\n|1|2|", "a\nb\n\n1\n2"),
    ("---\ntitle: x\n---\nText", "\n\n\nText"),
    ("[1]: https://x.org\nText", "\nText"),
]


def flat(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines()]


@pytest.mark.parametrize("text", PLAIN)
def test_plain_text_is_not_markdown(text: str) -> None:
    assert not is_markdown(text)


@pytest.mark.parametrize(("text", "plain"), INLINE, ids=[row[0] for row in INLINE])
def test_marks_in_a_line(text: str, plain: str) -> None:
    assert shown(without_marks(text).text) == plain


@pytest.mark.parametrize(("text", "plain"), BLOCKS, ids=[row[0] for row in BLOCKS])
def test_marks_of_blocks(text: str, plain: str) -> None:
    assert flat(shown(without_marks(text).text)) == flat(plain)


@given(st.text(st.sampled_from("ab1 \n#*_`[]()!<>|-~&;.\\:"), max_size=80))
def test_every_character_stays_at_its_place(text: str) -> None:
    plain = without_marks(text)
    assert len(plain.text) == len(text)
    assert all(
        a in (b, "*", ",", ")", "\n", "\u2029", HIDDEN, "&", "<", ">")
        for a, b in zip(plain.text, text, strict=True)
    )


@pytest.mark.parametrize(
    "part",
    ["[a](", "`a ``b ", "**a", "*a **b ", "_a __b ", "<!--", "#" + " " * 40, "|a", "`a` ", "__a ", "[a](b) "],
)
def test_hostile_marks_take_no_time(part: str) -> None:
    text = part * (90_000 // len(part))
    start = time.process_time()
    is_markdown(text)
    without_marks(text)
    without_marks(f"{text}|")
    assert time.process_time() - start < 2.0


def test_an_answer_is_read_and_what_is_left_out_is_named() -> None:
    with pytest.warns(
        ScriptWarning, match=r"^a: read as Markdown; left out: the address of a link \(line 8\)$"
    ):
        script = parse_plain(ANSWER, "a")
    assert shown(script.text).split() == SAID.split()
    spans = script.lines[0].directions.spans
    assert [(script.text[s.start : s.end], s.emphasis) for s in spans] == [
        ("what happens", Emphasis.STRONG),
        ("pack", Emphasis.MODERATE),
    ]
    assert [span.place.line for span in spans] == [3, 5]


def test_the_format_can_be_chosen() -> None:
    text = "# One"
    assert kinds_of_marks(text) == {"heading"}
    assert parse_plain(text).text == text
    assert shown(parse_plain(text, form=TextForm("markdown")).text).strip() == "One"
    assert shown(parse_script(text, ".md").text).strip() == "One"
    assert parse_script(text, ".md", form=TextForm("plain")).text == text
    assert "# Your order" in shown(parse_plain(ANSWER, form=TextForm("plain")).text)


@pytest.mark.parametrize(
    ("text", "caption"),
    [
        ("We *pack* it *today*.", "We pack it today."),
        ("It is **very** late!", "It is very late!"),
        ("2 * 3 * 4", "2 * 3 * 4"),
    ],
)
def test_marks_of_emphasis_are_hidden(text: str, caption: str) -> None:
    assert shown(parse_plain(text).text) == caption
