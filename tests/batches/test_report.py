import csv
from html.parser import HTMLParser
from pathlib import Path

import pytest

from risorius.batches.outcome import LineResult, LineState, Outcome
from risorius.batches.report import COLUMNS, Report
from risorius.errors import Place


def result(name: str, error: str = "", **outcome: object) -> LineResult:
    state = LineState.FAILED if error else LineState.MADE
    return LineResult(name, Place("m.csv", 3), state, Outcome(error=error, **outcome))  # type: ignore[arg-type]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    outputs = {str(tmp_path / "a b" / "x&y.wav"): 3, "s3://bucket/x.glb": 4}
    sound = str(tmp_path / "a b" / "x&y.wav")
    with Report(tmp_path) as report:
        for line in (
            result(
                "good",
                duration=3661.0,
                words=9000,
                outputs=outputs,
                sound=sound,
                sheet=str(tmp_path / "s.png"),
            ),
            result("slow", duration=30.0, words=2),
            result("poor", duration=2.0, words=5, doubt=55.0, doubtful=("'mat' at 1.00 s",)),
            result("worst", duration=2.0, words=5, doubt=91.0, text="<b>said</b>"),
            result("failed", "<script>alert(1)</script> is wrong"),
        ):
            report.add(line)
        report.write()
    return tmp_path


class Page(HTMLParser):
    """The texts and links of a page, and the elements that it opens."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.texts, self.links, self.elements = [], [], set()  # type: ignore[var-annotated]
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.elements.add(tag)
        self.links += [value for name, value in attributes if name in ("href", "src")]

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


def test_the_table_has_all_lines_the_worst_first(folder: Path) -> None:
    with (folder / "report.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == COLUMNS
    assert [row["id"] for row in rows] == ["failed", "worst", "poor", "good", "slow"]
    assert rows[0]["error"] == "m.csv:3: <script>alert(1)</script> is wrong"
    assert rows[2]["doubtful"] == "'mat' at 1.00 s"


def test_the_page_lists_failures_doubts_and_odd_paces_first_and_escapes_what_it_shows(folder: Path) -> None:
    page = Page((folder / "report.html").read_text())
    assert not {"script", "b"} & page.elements
    names = [text for text in page.texts if text in ("good", "slow", "poor", "worst")]
    assert names == ["worst", "poor", "slow", "good"]
    assert "1:01:35" in page.texts
    assert page.links == ["a%20b/x%26y.wav", "s3://bucket/x.glb", "a%20b/x%26y.wav", "s.png"]


def test_a_report_of_nothing_is_a_page(tmp_path: Path) -> None:
    with Report(tmp_path) as report:
        report.write()
    assert Page((tmp_path / "report.html").read_text()).texts.count("0 lines") == 2
