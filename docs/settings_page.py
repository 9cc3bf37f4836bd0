"""Write docs/settings.md from the table of settings: run after changing a setting."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from risorius.settings import Settings
from risorius.settings.declare import Group, Row, Stage, ValueKind, rows
from risorius.unused_settings import INPUTS, NEEDED, InputKind

PAGE = Path(__file__).parent / "settings.md"
HEAD = """# Settings
Written by `docs/settings_page.py` from the table in `settings/table.py`: do not edit.

In the library a setting is a field of `Settings`, or of its `look` (a `Look`) or `blend` (a `BlendChoices`).
`risorius list` prints the names that a value can have, and `risorius speak --help` the options.
"""

REFUSED = """
## Which inputs take which settings
Each setting is read by one stage. An input that does not go through that stage refuses the setting by name; a
setting that equals its default is never refused.

| input | refuses settings of | because |
|---|---|---|
"""


WRITTEN = """
On the command line, a setting that changes none of the outputs is refused as well.

| output made of | reads settings of |
|---|---|
"""


def page() -> str:
    """Return the page."""
    needs = "".join(f"| {need} | {', '.join(stages)} |\n" for need, stages in NEEDED.items())
    return "".join((HEAD, *map(_section, Group), REFUSED, *map(_refusal, INPUTS), WRITTEN, needs))


def _refusal(source: InputKind) -> str:
    refused = ", ".join(stage for stage in Stage if stage not in source.stages)
    if source.also:
        refused += f", but not {' and '.join(f'`{name}`' for name in source.also)}"
    return f"| {source.what} | {refused} | {source.reason.partition(';')[0]} |\n"


def _section(group: Group) -> str:
    entries = [row for row in rows(Settings).values() if row.entry.group is group]
    return "\n".join(["", f"## {group}", *_lines(entries), ""])


def _lines(entries: list[Row]) -> Iterator[str]:
    yield "| setting | option | value | default | stage | |"
    yield "|---|---|---|---|---|---|"
    for row in entries:
        cells = (f"`{_name(row)}`", _option(row), _value(row), _default(row), row.entry.stage, row.entry.help)
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _name(row: Row) -> str:
    return row.name if row.owner == row.name else f"{row.owner}.{row.name}"


def _option(row: Row) -> str:
    if row.flag is None:
        return ""
    is_flag = row.kind is ValueKind.SWITCH and row.entry.flag
    return f"`{row.flag}`" if is_flag else f"`{row.flag} {row.entry.metavar}`"


def _value(row: Row) -> str:
    names, low, high = row.entry.names, row.entry.low, row.entry.high
    if names is not None and names.known and row.kind in (ValueKind.TEXT, ValueKind.SEVERAL):
        return ", ".join(names.known)
    return str(row.kind) if low is None or high is None else f"{row.kind}, {low:g} to {high:g}"


def _default(row: Row) -> str:
    return row.text(row.usual)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
