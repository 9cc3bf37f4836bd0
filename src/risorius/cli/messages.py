"""The forms of messages: lines for people, objects of JSON for programs, or only faults."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextvars import ContextVar
from enum import StrEnum

import click

QUIET, JSON = "--quiet", "--json"


class MessageForm(StrEnum):
    """The form of messages on standard error."""

    LINES = "lines"
    QUIET = "quiet"
    JSON = "json"


_form: ContextVar[MessageForm] = ContextVar("form of messages", default=MessageForm.LINES)


def choose_form(arguments: Sequence[str]) -> None:
    """Speak from now on as the arguments of a command want it; JSON is never quiet."""
    names = {QUIET: MessageForm.QUIET, "-q": MessageForm.QUIET, JSON: MessageForm.JSON}
    chosen = [names[argument] for argument in arguments if argument in names]
    _form.set(max(chosen, key=list(MessageForm).index, default=MessageForm.LINES))


def message_form() -> MessageForm:
    """Return in which form messages are printed."""
    return _form.get()


def send(line: str, /, **parts: object) -> None:
    """Print a message on standard error: `line`, or for programs the `parts` as an object of JSON."""
    if _form.get() is MessageForm.JSON:
        line = json.dumps({name: it for name, it in parts.items() if it is not None}, ensure_ascii=False)
    click.echo(line, err=True)


def print_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table on standard output: its columns two spaces apart, or an object of JSON for each row."""
    if _form.get() is MessageForm.JSON:
        for row in rows:
            click.echo(json.dumps(dict(zip(header, row, strict=True)), ensure_ascii=False))
        return
    for line in table(header, rows):
        click.echo(line)


def is_watched() -> bool:
    """Whether a person may watch a bar on standard error."""
    return _form.get() is MessageForm.LINES and sys.stderr.isatty()


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """Yield the lines of a plain table: columns as wide as their widest cell, two spaces apart."""
    cells = [list(header), *(list(row) for row in rows)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
    for row in cells:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
