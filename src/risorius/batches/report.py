"""The report of a run: the outcome of each line, as a table, and as a page with the worst first."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from urllib.parse import quote

from ..errors import Place
from ..machine.atomic import replacing
from ..speech.alignment.confidence import DOUBT
from .outcome import LineResult, LineState, Outcome
from .places import is_remote
from .report_page import PageLine, Totals, page
from .scratch import Scratch

COLUMNS = (
    "id", "place", "state", "duration_s", "words", "words_per_s", "doubt", "doubtful", "warnings", "error",
    "text", "outputs", "cpu_s",
)  # fmt: skip
SHOWN = 1_000  # lines in each list of the page
SLOW, USUAL, FAST = 0.7, 2.5, 5.5
"""Words per second: outside, the recording or its transcript is probably wrong."""


class Report(Scratch):
    """Gathers results, on disk if they are many, and writes `report.csv` and `report.html` in a folder."""

    def __init__(self, folder: Path, shard: str = "") -> None:
        name = f"report{shard and '-'}{shard}"
        self.table, self.page = folder / f"{name}.csv", folder / f"{name}.html"
        super().__init__("results (state TEXT, doubt REAL, pace REAL, result TEXT)")

    def add(self, result: LineResult) -> None:
        """Take in the result of a line."""
        about = asdict(result)
        pace = _pace(result.outcome)
        row = (result.state, result.outcome.doubt, pace, json.dumps(about, ensure_ascii=False))
        self._database.execute("INSERT INTO results VALUES (?, ?, ?, ?)", row)

    def write(self) -> None:
        """Write both files; raises OutputError."""
        with replacing(self.table) as path, path.open("w", encoding="utf-8", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(COLUMNS)
            table.writerows(map(_cells, self._ordered("ORDER BY state = 'failed' DESC, doubt DESC, rowid")))
        with replacing(self.page) as path, path.open("w", encoding="utf-8") as file:
            file.writelines(page(self._totals(), *self._lists()))

    def _lists(self) -> tuple[list[PageLine], list[PageLine], list[PageLine], list[PageLine]]:
        """Return the lists of the page: failed, in doubt, of an odd pace, and all others."""
        failed = "state = 'failed'"
        doubtful = f"NOT {failed} AND doubt >= {DOUBT}"
        odd_pace = f"NOT ({doubtful}) AND pace > 0 AND (pace < {SLOW} OR pace > {FAST})"
        rest = f"NOT {failed} AND NOT ({doubtful}) AND NOT ({odd_pace})"
        return (
            self._lines(f"WHERE {failed} ORDER BY rowid"),
            self._lines(f"WHERE {doubtful} ORDER BY doubt DESC, rowid"),
            self._lines(f"WHERE NOT {failed} AND {odd_pace} ORDER BY abs(pace - {USUAL}) DESC, rowid"),
            self._lines(f"WHERE {rest} ORDER BY doubt DESC, rowid"),
        )

    def _lines(self, order: str) -> list[PageLine]:
        return [self._page_line(result) for result in self._ordered(f"{order} LIMIT {SHOWN}")]

    def _page_line(self, result: LineResult) -> PageLine:
        names = [name for name in result.outcome.outputs if name != result.outcome.sheet]
        links = {name.rsplit("/", 1)[-1]: self._link(name) for name in names}
        sound, sheet = (name and self._link(name) for name in (result.outcome.sound, result.outcome.sheet))
        return PageLine(result, _pace(result.outcome), links, sound, sheet)

    def _link(self, name: str) -> str:
        if is_remote(name):
            return name
        path = Path(name).resolve()
        folder = self.page.parent.resolve()
        return quote(path.relative_to(folder).as_posix()) if path.is_relative_to(folder) else path.as_uri()

    def _totals(self) -> Totals:
        duration = "total(json_extract(result, '$.outcome.duration'))"
        query = f"SELECT state, count(*), {duration} FROM results GROUP BY state"
        counts = {state: (count, seconds) for state, count, seconds in self._database.execute(query)}
        made, whole, failed = (counts.get(state, (0, 0.0)) for state in LineState)
        return Totals(made[0], whole[0], failed[0], made[1] + whole[1])

    def _ordered(self, order: str) -> Iterator[LineResult]:
        for (text,) in self._database.execute(f"SELECT result FROM results {order}"):
            data = json.loads(text)
            outcome = Outcome.read(data["outcome"])
            yield LineResult(data["id"], Place(**data["place"]), LineState(data["state"]), outcome)


def _pace(outcome: Outcome) -> float:
    """Return words per second of the performance, 0 if nothing is said."""
    return outcome.words / outcome.duration if outcome.words and outcome.duration else 0.0


def _cells(result: LineResult) -> list[object]:
    o = result.outcome
    return [
        result.id, result.place, result.state, f"{o.duration:.3f}", o.words, f"{_pace(o):.2f}",
        f"{o.doubt:g}", "; ".join(o.doubtful), "; ".join(o.warnings), result.error, o.text,
        "; ".join(o.outputs), f"{o.cpu:.3f}",
    ]  # fmt: skip
