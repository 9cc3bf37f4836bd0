"""Figures of a score and of paper A: the lines are the activities before and after the combination."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import risorius
from risorius.charts.draw import WIDTH, drawn, ticks
from risorius.charts.paper_a import DEMONSTRATION, FRAMES, FUNNELER, RATE, ZYGOMATIC, demonstration
from risorius.charts.sheet import SHOWN, ChartLine, ChartRow, ChartSheet, Panel
from risorius.cli import EXIT_FAULT, run
from risorius.errors import InputError, OutputError, ParameterError, UnusedSettingError

ROOT = Path(__file__).parent.parent.parent
SMILE = {"zygomatic_major.left": 0.8, "zygomatic_major.right": 0.8}
MOVEMENTS = [
    {"channel": "emotion", "start": 0.0, "end": 4.0, "onset": 0.5, "offset": 0.5, "targets": SMILE},
    {"channel": "signals", "start": 1.5, "end": 2.5, "onset": 0.2, "offset": 0.2,
     "targets": {FUNNELER: 0.9}},
    {"channel": "signals", "layer": "brows", "start": 0.5, "end": 2.0, "onset": 0.3, "offset": 0.3,
     "targets": {"frontalis_medialis.left": 1.0}},
    {"channel": "signals", "layer": "brows", "start": 1.5, "end": 3.0, "onset": 0.3, "offset": 0.3,
     "targets": {"frontalis_medialis.left": 0.4}},
    {"channel": "head", "start": 0.5, "end": 3.0, "onset": 0.3, "offset": 0.3,
     "targets": {"head_yaw": 9.0}},
]  # fmt: skip


@pytest.fixture
def score(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("x.score.json").write_text(json.dumps({"risorius": 1, "duration": 4.0, "movements": MOVEMENTS}))
    return "x.score.json"


def lines(row: ChartRow, number: int) -> dict[str, list[ChartLine]]:
    """Return the lines of a panel by their labels."""
    found: dict[str, list[ChartLine]] = {}
    for line in row.panels[number].lines:
        found.setdefault(line.label, []).append(line)
    return found


def at(line: ChartLine, time: float) -> float:
    return float(np.interp(time, line.times, line.values))


def row_of(sheet: ChartSheet, title: str) -> ChartRow:
    return next(row for row in sheet.rows if row.title == title)


def test_a_rival_is_shown_beside_what_it_takes(score: str) -> None:
    row = row_of(risorius.figures(score), "zygomatic_major (both sides)")
    before, after = lines(row, 0), lines(row, 1)
    (asked,), (shown,), (rival,) = before["emotion"], after["as shown"], after[f"its rival {FUNNELER}"]
    assert [at(asked, t) for t in (1.0, 2.0, 3.0)] == pytest.approx([0.8] * 3)
    assert [at(shown, t) for t in (1.0, 2.0, 3.0)] == pytest.approx([0.8, 0.0, 0.8], abs=1e-6)
    assert at(rival, 2.0) == pytest.approx(0.9)
    # It falls before the rival is active, as in Figure 6.
    assert at(shown, 1.45) < 0.7
    assert after["emotion"][0].dashed


def test_movements_of_a_channel_stand_alone_and_combined(score: str) -> None:
    row = row_of(risorius.figures(score, parameters=["frontalis_medialis"]), "frontalis_medialis.left")
    before = lines(row, 0)
    first, second = before["each movement by itself"]
    assert [at(first, 1.0), at(first, 2.5)] == pytest.approx([1.0, 0.0])
    assert [at(second, 1.0), at(second, 2.5)] == pytest.approx([0.0, 0.4])
    (combined,) = before["signals"]
    assert [at(combined, t) for t in (1.0, 2.5)] == pytest.approx([1.0, 0.4])
    (shown,) = lines(row, 1)["as shown"]
    assert np.abs(np.diff(shown.values)).max() < 0.05


def test_the_parameters_that_change_most_come_first_and_named_ones_alone(score: str) -> None:
    titles = [row.title for row in risorius.figures(score).rows]
    assert titles[0] == "zygomatic_major (both sides)"
    assert set(titles) == {
        "zygomatic_major (both sides)", FUNNELER, "frontalis_medialis.left", "head_yaw",
    }  # fmt: skip
    (yaw,) = risorius.figures(score, parameters=["head_yaw"]).rows
    assert (yaw.axis, yaw.high) == ("deg", pytest.approx(9.0))
    sides = risorius.figures(score, parameters=["zygomatic_major.right"]).rows
    assert [row.title for row in sides] == ["zygomatic_major.right"]


def test_a_span_is_cut_out(score: str) -> None:
    (row,) = risorius.figures(score, parameters=[FUNNELER], start=1.0, end=2.0).rows
    assert (row.start, row.end) == (1.0, 2.0)
    for panel in row.panels:
        assert all(line.times[0] >= 1.0 and line.times[-1] <= 2.0 for line in panel.lines)


def test_what_is_long_has_before_above_after(tmp_path: Path) -> None:
    file = tmp_path / "x.score.json"
    longer = [
        {**movement, "start": 4.0 * movement["start"], "end": 4.0 * movement["end"]} for movement in MOVEMENTS
    ]
    file.write_text(json.dumps({"risorius": 1, "duration": 16.0, "movements": longer}))
    before, after = risorius.figures(file, parameters=["head_yaw"]).rows
    assert [len(row.panels) for row in (before, after)] == [1, 1]
    assert "as shown" not in lines(before, 0)
    assert at(lines(after, 0)["as shown"][0], 8.0) == pytest.approx(9.0)
    assert (before.title, before.low, before.high) == (after.title, after.low, after.high)


def test_settings_override_the_score_s(score: str) -> None:
    settings = risorius.Settings(blend=risorius.BlendChoices(conflict="attenuate"))
    (row,) = risorius.figures(score, parameters=["zygomatic_major.left"], settings=settings).rows
    # 0.8 · (1 − 0.8 · 0.9)
    assert at(lines(row, 1)["as shown"][0], 2.0) == pytest.approx(0.224, abs=1e-6)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"parameters": ["zygmatic"]}, ParameterError, "zygmatic"),
        ({"parameters": ["masseter"]}, InputError, "masseter does not move from 0 to 4 s"),
        ({"parameters": "masseter"}, InputError, "expected a sequence of names"),
        ({"start": 3.0, "end": 2.0}, InputError, "from 3 to 2 s is not a span"),
        ({"start": 5.0}, InputError, "from 5 to 4 s is not a span"),
        ({"start": -1.0}, InputError, "start = -1 is out of range"),
        ({"start": 3.6, "end": 3.9, "parameters": [FUNNELER]}, InputError, "does not move from 3.6 to 3.9 s"),
        ({"output": "x.svg"}, OutputError, "figures are drawn as .png"),
        ({"settings": risorius.Settings(fps=25)}, UnusedSettingError, "fps has no effect"),
    ],
)
def test_what_cannot_be_drawn_is_named(
    arguments: dict[str, object], error: type[Exception], message: str, score: str
) -> None:
    with pytest.raises(error, match=re.escape(message)):
        risorius.figures(score, **arguments)  # type: ignore[arg-type]


def test_nothing_to_draw_is_an_error(tmp_path: Path) -> None:
    file = tmp_path / "x.score.json"
    file.write_text(json.dumps({"risorius": 1, "duration": 4.0, "movements": []}))
    with pytest.raises(InputError, match="nothing moves from 0 to 4 s"):
        risorius.figures(file)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["x.score.json"], "expected one -o fig.png"),
        (["x.score.json", "-o", "a.png", "-o", "b.png"], "expected one -o fig.png"),
        (["x.score.json", "-o", "a.mp4"], "figures are drawn as .png"),
        (["paper-a", "-o", "a.png", "--start", "1"], "--start has no effect"),
        (["paper-b", "-o", "a.png"], "paper-b"),
    ],
)
def test_the_command_refuses_what_it_cannot_do(
    words: list[str], message: str, score: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["figures", *words]) == EXIT_FAULT
    assert message in capsys.readouterr().err
    assert not list(Path().glob("*.png"))


def test_the_command_draws(score: str) -> None:
    assert run(["figures", score, "--parameter", "head_yaw", "-o", "a.png"]) == 0
    with Image.open("a.png") as picture:
        assert picture.width == WIDTH
        assert SHOWN in {colour for _, colour in picture.getcolors(1 << 20) or ()}  # type: ignore[comparison-overlap]


def test_lines_are_drawn_where_their_values_are() -> None:
    times = np.linspace(0.0, 2.0, 401)
    line = ChartLine("x", times, np.where(times < 1.0, 0.25, 0.75), SHOWN, 3.0)
    row = ChartRow("one", (Panel("", (line,)),), 0.0, 2.0)
    pixels = np.asarray(drawn(ChartSheet("sheet", (row,))).convert("RGB")).astype(int)
    near = np.abs(pixels - SHOWN).sum(axis=2) < 60
    rows, columns = np.nonzero(near)
    plot = columns > 100  # not the legend
    left, right = rows[plot & (columns < 500)], rows[plot & (columns > 800)]
    assert np.ptp(left) < 8
    assert np.ptp(right) < 8
    # Half of the axis, which is 176 pixels high with room for 4 % above and below.
    assert left.mean() - right.mean() == pytest.approx(0.5 * 176 / 1.08, abs=2.0)


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (0.0, 7.0), (-12.5, 9.0), (61.2, 61.9), (0.0, 3600.0)])
def test_ticks_are_round_and_inside(low: float, high: float) -> None:
    found = ticks(low, high)
    assert 3 <= len(found) <= 9
    assert low - 1e-6 <= found[0] < found[-1] <= high + 1e-6
    assert np.ptp(np.diff(found)) < 1e-9 * max(abs(high), 1.0)


@pytest.fixture(scope="module")
def sheet() -> ChartSheet:
    return risorius.figures("paper-a")


class TestPaperA:
    """The papers' own figures."""

    def test_figure_4_rises_for_two_seconds_holds_and_falls_for_three(self, sheet: ChartSheet) -> None:
        (line,) = sheet.rows[0].panels[0].lines
        half = np.sqrt(2.0) - 1.0
        found = [at(line, t) for t in (0.0, 1.0, 2.0, 3.0, 4.0, 5.5, 7.0)]
        assert found == pytest.approx([0, half, 1, 1, 1, half, 0], abs=1e-9)
        assert [name for _, _, name in sheet.rows[0].panels[0].phases] == ["onset", "apex", "offset"]

    def test_figure_5_is_released_to_a_half_from_3_s_on(self, sheet: ChartSheet) -> None:
        before, after = lines(sheet.rows[1], 0), lines(sheet.rows[1], 1)
        assert set(before) == {"first movement", "second movement"}
        (combined,) = after["combined"]
        assert [at(combined, t) for t in (3.0, 4.5, 7.0)] == pytest.approx([1.0, 0.5, 0.5], abs=1e-9)

    def test_figure_6_the_smile_gives_way_before_3_s(self, sheet: ChartSheet) -> None:
        smile = "Zygomatic Major (emotion)"
        (alone,), (shown,) = lines(sheet.rows[2], 0)[smile], lines(sheet.rows[2], 1)[smile]
        assert [at(alone, t) for t in (2.95, 3.5)] == pytest.approx([0.9, 0.9])
        assert at(shown, 2.7) == pytest.approx(0.9)
        assert at(shown, 2.95) < 0.6
        assert at(shown, 3.5) == 0.0

    def test_figure_7_has_the_faces_and_the_words(self, sheet: ChartSheet) -> None:
        assert [face.label.split()[1] for face in sheet.faces] == ["16", "23", "30", "34", "47"]
        said = sheet.rows[3].said
        assert said is not None
        assert [w.text for w in said.words][-2:] == ["very", "much"]
        assert [name for _, name in sheet.rows[3].panels[1].marks] == [str(f) for f in FRAMES]

    def test_its_script_is_the_example(self) -> None:
        assert (ROOT / "examples" / "demo.xml").read_text() == DEMONSTRATION

    def test_the_page_has_its_frames_as_they_are(self) -> None:
        """docs/combination.md sets the paper's frames beside ours."""
        page = (ROOT / "docs" / "combination.md").read_text(encoding="utf-8")
        table = page.partition("<!-- figure 7 -->")[2].partition("<!-- /figure 7 -->")[0]
        rows = [line.strip("|").split("|") for line in table.strip().splitlines()[2:]]
        take = demonstration(risorius.BlendChoices())
        assert take.performance.fps == RATE
        for row, frame in zip(rows, FRAMES, strict=True):
            assert int(row[0]) == frame
            shown = [float(take.curves[n][frame]) for n in ("frontalis_medialis.left", ZYGOMATIC, FUNNELER)]
            assert [float(text) for text in row[3:]] == pytest.approx(shown, abs=0.005), frame
        smile = take.curves[ZYGOMATIC]
        assert "full since frame 39" in rows[-1][2]
        assert smile[39] > 0.99 > smile[38]
        assert take.utterance is not None
        very = next(w for w in take.utterance.words if w.text == "very")
        assert round(very.start * float(RATE)) == 24
        assert round(take.utterance.words[-1].end * float(RATE)) == 34
