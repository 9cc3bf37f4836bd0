"""A live face reads Markdown as it comes: marks are not said, and no label shows them."""

from __future__ import annotations

import warnings

import pytest

from risorius.languages import language_of
from risorius.live.sentences import SentenceBuffer
from risorius.live.session import Live
from risorius.script.tree import ScriptWarning
from risorius.settings import Settings

TEXT = """# Your order

Here is **what happens** next, see [the page](https://x.org/a?b=c):

- We *pack* it.
- You get the code.

```python
x = "One. Two."
```

All done. Bye!
"""
SAID = [
    "Your order",
    "Here is what happens next, see the page:",
    "We pack it.",
    "You get the code.",
    "All done.",
    "Bye!",
]


def labels(face: Live) -> list[str]:
    texts = [frame.text for frame in face.frames() if frame.text]
    return list(dict.fromkeys(texts))


@pytest.mark.parametrize("size", [1, 5, 1000])
@pytest.mark.parametrize("format", [None, "markdown"])
def test_it_is_said_without_marks_however_it_is_cut(size: int, format: str | None) -> None:
    face = Live(Settings(format=format, lively=False), fps=10)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ScriptWarning)
        for start in range(0, len(TEXT), size):
            face.say(TEXT[start : start + size])
        face.close()
        assert labels(face) == SAID
    told = [str(w.message) for w in caught if w.category is ScriptWarning]
    assert told == [
        "live: read as Markdown; left out: the address of a link",
        "live: read as Markdown; left out: a block of code of 1 line",
    ]


def test_what_was_not_said_is_returned_without_marks() -> None:
    face = Live(Settings(format="markdown", lively=False), fps=10)
    face.say("One **two** three.\n\n- Four. Five *six*. Seven")
    assert face.interrupt().split() == ["One", "**two**", "three.", "Four.", "Five", "*six*.", "Seven"]


def test_plain_emphasis_has_no_asterisks_in_labels() -> None:
    face = Live(Settings(lively=False), fps=10)
    face.say("We *pack* your parcel *today*.")
    face.close()
    assert labels(face) == ["We pack your parcel today."]


def test_plain_text_keeps_what_looks_like_marks() -> None:
    text = "I am number # 1. And [this] _is_ it. "
    buffer = SentenceBuffer(language_of("en"), "plain")
    assert "".join([*buffer.add(text), *buffer.flush()]).strip() == text.strip()
