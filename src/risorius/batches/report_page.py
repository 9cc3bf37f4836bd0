"""The page of a report: one HTML file without scripts; pictures load as they come into view."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from ..core.units import clock
from .outcome import LineResult

_STYLE = """
:root { color-scheme: light dark; --line: color-mix(in srgb, currentColor 18%, transparent); }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1.2rem; }
h1 { font-size: 1.5rem; margin: 0 0 .2rem } h2 { font-size: 1.1rem; margin: 2.2rem 0 .4rem }
p { margin: .2rem 0 .8rem } .quiet { opacity: .65 }
dl { display: flex; flex-wrap: wrap; gap: .4rem 2.4rem; margin: 1rem 0 }
dt { font-size: .8rem; opacity: .65 } dd { margin: 0; font-size: 1.35rem; font-variant-numeric: tabular-nums }
table { border-collapse: collapse; width: 100% }
th { text-align: left; font-size: .8rem; font-weight: 600; opacity: .65 }
th, td { padding: .3rem .9rem .3rem 0; border-bottom: 1px solid var(--line); vertical-align: top }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap }
td.id { font-weight: 600; white-space: nowrap } .bad { color: #c0392b }
td p { margin: .15rem 0; font-size: .85rem }
audio { height: 1.9rem; width: 15rem; display: block }
img { display: block; max-width: 34rem; border-radius: 4px; margin-top: .3rem }
a { color: inherit }
@media (prefers-color-scheme: dark) { .bad { color: #ff8a75 } }
"""


@dataclass(frozen=True, slots=True)
class Totals:
    """Counts of lines made, already complete and failed; the seconds of all performances."""

    made: int
    whole: int
    failed: int
    seconds: float


@dataclass(frozen=True, slots=True)
class PageLine:
    """A line on the page: its result, words per second, the links to its outputs by their names, and those to
    its sound and its pictures, empty if it has none.
    """

    result: LineResult
    pace: float
    links: Mapping[str, str]
    sound: str
    sheet: str


def page(
    totals: Totals,
    failed: Sequence[PageLine],
    doubtful: Sequence[PageLine],
    odd: Sequence[PageLine],
    others: Sequence[PageLine],
) -> Iterator[str]:
    """Yield the page in pieces."""
    lines = totals.made + totals.whole + totals.failed
    yield f"<!doctype html><html lang=en><meta charset=utf-8><title>{lines:,} lines</title>"
    yield f"<meta name=viewport content='width=device-width'><style>{_STYLE}</style>"
    yield f"<h1>{lines:,} lines</h1>"
    yield "<p class=quiet>Worst first. All lines stand in the table beside this page.</p><dl>"
    for name, value in (
        ("made", f"{totals.made:,}"),
        ("whole before", f"{totals.whole:,}"),
        ("failed", f"{totals.failed:,}"),
        ("in doubt", f"{len(doubtful):,}"),
        ("played in all", clock(totals.seconds)),
    ):
        yield f"<div><dt>{name}</dt><dd>{value}</dd></div>"
    yield "</dl>"
    yield from _failures(failed)
    yield from _section(
        "Doubtful alignments", doubtful,
        "Words that the recording may not say: listen, then correct the transcript or record the line anew.",
    )  # fmt: skip
    yield from _section(
        "Unusually fast or slow", odd, "Words per second unlike speech: a wrong transcript, or much silence."
    )
    yield from _section("Other lines", others, "")


def _failures(lines: Sequence[PageLine]) -> Iterator[str]:
    if lines:
        yield "<h2>Failed</h2><table><tr><th>line<th>what is wrong"
        for line in lines:
            yield f"<tr><td class=id>{escape(line.result.id or '–')}<td class=bad>{escape(line.result.error)}"
        yield "</table>"


def _section(title: str, lines: Sequence[PageLine], about: str) -> Iterator[str]:
    if not lines:
        return
    yield f"<h2>{title}</h2><p class=quiet>{about}</p><table><tr><th>line<th class=number>seconds"
    yield "<th class=number>words/s<th class=number>doubt<th>what is said<th>"
    for line in lines:
        yield from _row(line)
    yield "</table>"


def _row(line: PageLine) -> Iterator[str]:
    outcome = line.result.outcome
    doubt = f"{outcome.doubt:.0f}" if outcome.doubt else ""
    yield f"<tr><td class=id>{escape(line.result.id)}<td class=number>{outcome.duration:.2f}"
    yield f"<td class=number>{line.pace:.1f}<td class=number>{doubt}<td>{escape(outcome.text)}"
    remarks = outcome.doubtful or outcome.warnings
    if remarks:
        yield f"<p class=bad>{escape('; '.join(remarks))}</p>"
    names = [f"<a href='{escape(link)}'>{escape(name)}</a>" for name, link in line.links.items()]
    yield f"<p class=quiet>{' · '.join(names)}</p><td>"
    if line.sound:
        yield f"<audio controls preload=none src='{escape(line.sound)}'></audio>"
    if line.sheet:
        yield f"<img loading=lazy alt='' src='{escape(line.sheet)}'>"
