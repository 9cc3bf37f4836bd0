"""Markdown, as language models write it, into plain text: each character stays at its place.

Marks become `HIDDEN` characters, emphasis is that of plain text (`*words*`, `**words**`), and blocks end
with a paragraph separator, where a sentence ends. So a place in the result is the same place in the source.
"""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

from ..core.speech.characters import BLOCK_END, HIDDEN

_FENCE = re.compile(r"[ \t]{0,12}(?P<fence>`{3,}|~{3,})(?P<rest>.*)")
_HEADING = re.compile(r" {0,3}(?P<marks>#{1,6})(?=[ \t]|$)")
_UNDERLINE = re.compile(r"\A {0,3}(?:=++|-{2,}+)[ \t]*+$")
_RULE = re.compile(r"\A {0,3}(?:(?:\*[ \t]*+){3,}+|(?:-[ \t]*+){3,}+|(?:_[ \t]*+){3,}+)$")
_QUOTE = re.compile(r" {0,3}(?:>[ \t]?)+")
_BULLET = re.compile(r"[ \t]{0,12}(?P<mark>[-*+\u2022])[ \t]+(?P<task>\[[ xX]\][ \t]+)?(?=\S)")
_NUMBER = re.compile(r"[ \t]{0,12}\d{1,9}(?P<mark>[.)])[ \t]+(?=\S)")
_ROW = re.compile(r"\A[ \t]*+\|.*\|[ \t]*+$")
_CELL = r":?-++:?[ \t]*+"
_DIVIDER = re.compile(rf"\A[ \t]*+(?:\|[ \t]*+)?{_CELL}(?:\|[ \t]*+{_CELL})*+(?:\|[ \t]*+)?$")
_DEFINITION = re.compile(r" {0,3}\[(?P<name>[^\]\n]{1,200})\]:[ \t]*\S.*$")

_CODE = re.compile(r"(?P<open>`+)(?P<code>[^`\n](?:[^\n]{0,300}?[^`\n])?)(?P=open)(?!`)")
_IMAGE = re.compile(
    r"!\[(?P<text>[^\]\n]{0,300})\](?:\([^()\n]{0,1000}(?:\([^()\n]{0,200}\)[^()\n]{0,200}){0,3}\)|\[[^\]\n]*\])"
)
_LINK = re.compile(
    r"(?P<open>\[)(?P<text>[^\[\]\n]{1,300})(?P<close>\]\([^()\n]{0,1000}(?:\([^()\n]{0,200}\)[^()\n]{0,200}){0,3}\)|\]\[[^\]\n]*\])"
)
_OPEN_LINK = re.compile(r"(?P<open>\[)(?P<text>[^\[\]\n]{1,300})(?P<close>\]\([^)\s]*)\Z")
_FOOTNOTE = re.compile(r"\[\^[^\]\s]{1,40}\]")
_AUTOLINK = re.compile(r"(?P<open><)(?P<text>(?:https?://|mailto:)[^<>\s]+)(?P<close>>)")
_TAG = re.compile(r"</?[A-Za-z][A-Za-z0-9-]*(?:\s[^<>\n]*)?/?>|<!--[^\n]{0,1000}?-->")
_STRUCK = re.compile(r"~~(?=\S)[^~\n]+(?<=\S)~~")
_ENTITY = re.compile(r"&(?:[A-Za-z]{2,12}|#\d{1,6}|#[xX][0-9a-fA-F]{1,5});")
_ESCAPE = re.compile(r"\\[!-/:-@\[-`{-~]")
_BOTH = re.compile(r"(?<![*\w])(\*\*\*)(?=\S)([^*\n]+)(?<=\S)\*\*\*(?!\*)")
_LOW = re.compile(r"(?<![\w_])(?P<mark>_{1,3})(?=[^\s_])(?P<text>[^_\n]*[^\s_])(?P=mark)(?![\w_])")
_STRONG = r"(?<!\*)\*\*(?=[^\s*])(?:[^*\n]|(?<!\*)\*(?!\*))*[^\s*]\*\*(?!\*)"
_STRAY = re.compile(rf"(?P<strong>{_STRONG})|\*{{2,}}")

# Kinds of marks; two of them tell that a text is Markdown.
_KINDS: dict[str, re.Pattern[str]] = {
    "heading": re.compile(r"^ {0,3}#{1,6}[ \t]+\S", re.MULTILINE),
    "strong": re.compile(r"(?<![\w*])\*\*[^\s*][^\n]*?\*\*|(?<![\w_])__[^\s_][^\n]{0,300}?__(?![\w_])"),
    "emphasis": re.compile(r"(?<![\w*])\*[^\s*][^*\n]*\*(?![\w*])|(?<![\w_])_[^\s_][^_\n]*_(?![\w_])"),
    "list": re.compile(r"^[ \t]{0,12}[-*+][ \t]+\S", re.MULTILINE),
    "numbered list": re.compile(r"^[ \t]{0,12}\d{1,3}[.)][ \t]+\S", re.MULTILINE),
    "link": re.compile(r"\[[^\[\]\n]{1,300}\]\([^()\s]+"),
    "code": re.compile(r"(?<!`)`[^`\n]+`(?!`)"),
    "fence": re.compile(r"^[ \t]{0,12}(?:```|~~~)", re.MULTILINE),
    "table": re.compile(r"^[ \t]*+(?:\|[ \t]*+)?:?-{2,}+:?[ \t]*+\|[ \t|:-]*+$", re.MULTILINE),
    "quote": re.compile(r"^ {0,3}>[ \t]?\S", re.MULTILINE),
    "rule": re.compile(r"^ {0,3}(?:-{3,}|\*{3,}|_{3,})[ \t]*$", re.MULTILINE),
    "struck": _STRUCK,
}


UNMISTAKABLE = frozenset({"heading", "strong", "link", "fence", "table"})
"""Kinds of marks that hardly occur in plain text."""


class LeftOut(NamedTuple):
    """Something of the text that is not said: its name, and its first character."""

    name: str
    at: int


class PlainText(NamedTuple):
    """A text of the same length without the marks, and what is left out of it."""

    text: str
    left_out: tuple[LeftOut, ...]


def kinds_of_marks(text: str) -> frozenset[str]:
    """Return the kinds of Markdown's marks that occur in a text."""
    return frozenset(kind for kind, pattern in _KINDS.items() if pattern.search(text))


def is_markdown(text: str) -> bool:
    """Tell whether two kinds of Markdown's marks occur in a text."""
    return len(kinds_of_marks(text)) > 1


def without_marks(text: str, *, at_line_start: bool = True) -> PlainText:
    """Return Markdown as plain text; unless `at_line_start`, the text begins within a line."""
    page = _Page(text)
    page.blocks(at_line_start)
    for start, end in page.inline:
        _inline(page, start, end)
    return PlainText("".join(page.characters), tuple(sorted(page.left_out, key=lambda part: part.at)))


class _Page:
    """The characters of a text while its marks are taken away."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.characters = list(text)
        self.left_out: list[LeftOut] = []
        # Stretches with marks inside lines.
        self.inline: list[tuple[int, int]] = []
        self._in_table = False

    def hide(self, start: int, end: int) -> None:
        """Hide characters [start, end) but line ends."""
        for at in range(start, end):
            if self.characters[at] != "\n":
                self.characters[at] = HIDDEN

    def leave_out(self, name: str, start: int, end: int) -> None:
        """Hide characters that would be words, and name them."""
        self.hide(start, end)
        self.left_out.append(LeftOut(name, start))

    def end_block(self, at: int) -> None:
        """End a sentence with the line that ends at a character."""
        if at < len(self.characters):
            self.characters[at] = BLOCK_END

    def blocks(self, at_line_start: bool) -> None:
        """Take away the marks of blocks, line by line."""
        lines = list(_lines(self.text))
        number = 0 if at_line_start else 1
        if not at_line_start and lines:
            self.inline.append(lines[0])
        if at_line_start and lines and self.text[slice(*lines[0])].rstrip() == "---":
            number = self._front_matter(lines)
        while number < len(lines):
            number = self._block(lines, number)

    def _front_matter(self, lines: list[tuple[int, int]]) -> int:
        for number, line in enumerate(lines[1:40], 1):
            if self.text[slice(*line)].rstrip() in ("---", "..."):
                self.leave_out("the front matter", 0, line[1])
                return number + 1
        return 0

    def _block(self, lines: list[tuple[int, int]], number: int) -> int:
        """Read the line with this number, or the code that begins with it; return the number of the next."""
        start, end = lines[number]
        line = self.text[start:end]
        fence = _FENCE.fullmatch(line)
        if fence is not None:
            return self._code(lines, number, fence)
        if _DEFINITION.fullmatch(line) and not line.lstrip().startswith("[^"):
            self.leave_out("the address of a link", start, end)
            return number + 1
        following = self.text[slice(*lines[number + 1])] if number + 1 < len(lines) else ""
        if _RULE.fullmatch(line) or _DIVIDER.fullmatch(line):
            self.hide(start, end)
            self.end_block(end)
            return number + 1
        if line.strip() and _UNDERLINE.fullmatch(following) and not _is_marked(line):
            self.inline.append((start, end))
            self.end_block(end)
            self.hide(*lines[number + 1])
            return number + 2
        self._line(start, end, following)
        return number + 1

    def _code(self, lines: list[tuple[int, int]], number: int, opening: re.Match[str]) -> int:
        last = len(lines)
        for later in range(number + 1, len(lines)):
            closing = _FENCE.fullmatch(self.text[slice(*lines[later])])
            if closing and closing["fence"].startswith(opening["fence"]) and not closing["rest"].strip():
                last = later + 1
                break
        count = max(last - number - 2, 0)
        name = f"a block of code of {count} line{'' if count == 1 else 's'}"
        self.leave_out(name, lines[number][0], lines[last - 1][1])
        self.end_block(lines[last - 1][1])
        return last

    def _line(self, start: int, end: int, following: str) -> None:
        """Take away the marks before a line of text; a heading, an item or a row is a sentence."""
        quote = _QUOTE.match(self.text, start, end)
        if quote is not None:
            self.hide(start, quote.end())
            start = quote.end()
        line = self.text[start:end]
        self._in_table = "|" in line and (self._in_table or _is_divider(following))
        if self._in_table or _ROW.fullmatch(line):
            self._row(start, end)
            return
        heading = _HEADING.match(line)
        if heading is not None:
            self.hide(start + heading.start("marks"), start + heading.end("marks"))
            title = line.rstrip(" \t").rstrip("#")
            if title.endswith((" ", "\t")):
                self.hide(start + len(title), end)
            self.end_block(end)
        bullet = _BULLET.match(line)
        if bullet is not None:
            self.hide(start + bullet.start("mark"), start + bullet.end("mark"))
            if bullet["task"]:
                self.hide(start + bullet.start("task"), start + bullet.end("task"))
        number = _NUMBER.match(line)
        if number is not None:
            # A full stop would end a sentence.
            self.characters[start + number.start("mark")] = ")"
        if _begins_block(following) and not (quote and _QUOTE.match(following)):
            self.end_block(end)
        self.inline.append((start, end))

    def _row(self, start: int, end: int) -> None:
        """Read a row of a table: a comma after each cell but the last."""
        bars = [at for at in range(start, end) if self.text[at] == "|" and self.text[at - 1 : at] != "\\"]
        backwards = range(end - 1, start - 1, -1)
        last = next((at for at in backwards if self.text[at].strip("|").strip()), start)
        for at in bars:
            first = max(self.text.rfind("|", start, at) + 1, start)
            cell = self.text[first:at].rstrip(" \t")
            self.hide(at, at + 1)
            if cell.strip() and at < last:
                comma = first + len(cell)
                self.characters[comma] = "," if comma < at else "\n"
        self.inline.append((start, end))
        self.end_block(end)


def _begins_block(line: str) -> bool:
    """Tell whether a line begins an item, a quote, a heading or code."""
    return any(pattern.match(line) for pattern in (_BULLET, _NUMBER, _QUOTE, _HEADING, _FENCE))


def _is_divider(line: str) -> bool:
    """Tell whether a line divides the head of a table from its rows."""
    return "|" in line and _DIVIDER.fullmatch(line) is not None


def _is_marked(line: str) -> bool:
    """Tell whether a line begins with marks of its own, or is a row of a table."""
    starts = (_BULLET, _NUMBER, _QUOTE, _HEADING)
    return any(pattern.match(line) for pattern in starts) or "|" in line


def _lines(text: str) -> Iterator[tuple[int, int]]:
    """Yield where each line begins and ends, without its line end."""
    start = 0
    while start <= len(text):
        end = text.find("\n", start)
        end = len(text) if end < 0 else end
        yield start, end
        start = end + 1


def _inline(page: _Page, start: int, end: int) -> None:
    """Take away the marks within a line; what stands in code is left alone."""
    in_code = bytearray(end - start)
    for pattern, read in _INLINE:
        for match in pattern.finditer("".join(page.characters[start:end])):
            if not any(in_code[match.start() : match.end()]):
                read(page, match, start)
                if pattern is _CODE:
                    in_code[match.start() : match.end()] = b"\1" * len(match[0])


def _read_code(page: _Page, match: re.Match[str], start: int) -> None:
    page.hide(start + match.start(), start + match.end("open"))
    page.hide(start + match.end("code"), start + match.end())


def _read_image(page: _Page, match: re.Match[str], start: int) -> None:
    name = f"the picture '{match['text'][:40]}'" if match["text"].strip() else "a picture"
    page.leave_out(name, start + match.start(), start + match.end())


def _read_link(page: _Page, match: re.Match[str], start: int) -> None:
    page.hide(start + match.start("open"), start + match.end("open"))
    page.leave_out("the address of a link", start + match.start("close"), start + match.end("close"))


def _read_autolink(page: _Page, match: re.Match[str], start: int) -> None:
    page.hide(start + match.start("open"), start + match.end("open"))
    page.hide(start + match.start("close"), start + match.end("close"))


def _read_footnote(page: _Page, match: re.Match[str], start: int) -> None:
    page.leave_out("the mark of a footnote", start + match.start(), start + match.end())


def _read_tag(page: _Page, match: re.Match[str], start: int) -> None:
    page.leave_out(f"the tag {match[0][:20]}", start + match.start(), start + match.end())


def _read_struck(page: _Page, match: re.Match[str], start: int) -> None:
    page.leave_out("words that are struck out", start + match.start(), start + match.end())


def _read_entity(page: _Page, match: re.Match[str], start: int) -> None:
    character = html.unescape(match[0])
    if len(character) == 1:
        page.hide(start + match.start(), start + match.end())
        page.characters[start + match.start()] = character


def _read_escape(page: _Page, match: re.Match[str], start: int) -> None:
    page.hide(start + match.start(), start + match.start() + 1)
    if match[0][1] in "*_`":
        page.hide(start + match.start(), start + match.end())


def _read_both(page: _Page, match: re.Match[str], start: int) -> None:
    page.hide(start + match.start(), start + match.start() + 1)
    page.hide(start + match.end() - 1, start + match.end())


def _read_low(page: _Page, match: re.Match[str], start: int) -> None:
    marks = len(match["mark"])
    for at in (*range(match.start(), match.start() + marks), *range(match.end() - marks, match.end())):
        page.characters[start + at] = "*"
    if marks > len("__"):
        _read_both(page, match, start)


def _read_stray(page: _Page, match: re.Match[str], start: int) -> None:
    """Hide asterisks that emphasise nothing."""
    if match["strong"] is None:
        page.hide(start + match.start(), start + match.end())


_INLINE: tuple[tuple[re.Pattern[str], Callable[[_Page, re.Match[str], int], None]], ...] = (
    (_CODE, _read_code),
    (_ESCAPE, _read_escape),
    (_IMAGE, _read_image),
    (_LINK, _read_link),
    (_OPEN_LINK, _read_link),
    (_FOOTNOTE, _read_footnote),
    (_AUTOLINK, _read_autolink),
    (_TAG, _read_tag),
    (_STRUCK, _read_struck),
    (_ENTITY, _read_entity),
    (_BOTH, _read_both),
    (_LOW, _read_low),
    (_STRAY, _read_stray),
)
